"""Synthetic trainers: stand-ins for a person, who judge by a rule and vote through the same door."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import entry_points
from typing import Annotated, Any, Protocol, cast, runtime_checkable

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from server.worker import WorkerError

log = logging.getLogger("seed.teachers")


@dataclass(frozen=True)
class Case:
    """What a teacher judges: this call in state (n,), the task's units.

    low_level: (m,) `robot_adapters.tasks.low_level.low_level_state` of the same moment; None where it isn't known.
    random: the dice for this very proposal; the same seed and proposal number give the same.
    """

    state: Array
    call: SkillCall
    random: np.random.Generator
    low_level: Array | None = None


@dataclass(frozen=True)
class Judgement:
    """-1, 0 or +1, clicked `delay` seconds after the proposal was seen."""

    value: int
    delay: float = 0.0


class Teacher(Protocol):
    """Judges proposals of one task."""

    def judge(self, case: Case) -> Judgement:
        """The click on this case. It must depend on nothing but the case, or a run can't be repeated."""


QFunction = Callable[[Array, Array], float]
"""Q(s, u) of low-level state (m,) and low-level action (k,), as a learner of low-level actions estimates it."""


@runtime_checkable
class Oracle(Teacher, Protocol):
    """A teacher that judges by the value of what a call leads to, as the paper's does with SAC's critic.

    `take` hands over the Q function that was trained elsewhere, before the first case. Cases carry `low_level` for it.
    """

    def take(self, q: QFunction) -> None:
        """Judge by this Q function from now on."""


class TeacherFactory(Protocol):
    """What an entry point of the group `seed.teachers` names. Importing it is cheap."""

    description: str
    settings: type[BaseModel]
    """Pydantic model of the teacher's settings, each field documented and with a default."""

    def __call__(self, task: Task, settings: BaseModel) -> Teacher:
        """Build the teacher for a task."""


Noise = Annotated[float, Field(ge=0, le=1, description="Probability that a good or bad label is flipped.")]
SkipWithin = Annotated[
    float,
    Field(
        ge=0, le=1, allow_inf_nan=False, description="m from the border of the good box within which it clicks neutral."
    ),
]
Delay = Annotated[
    float,
    Field(ge=0, le=600, description="Median s between seeing a proposal and clicking; 0 clicks at once."),
]
DelaySpread = Annotated[
    float,
    Field(ge=0, le=2, description="Standard deviation of the delay's natural logarithm; 0 always takes the median."),
]


class SyntheticSettings(BaseModel):
    """Settings of the teachers that judge by the task's rule; as they stand here, of one that is always right."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    noise: Noise = 0.0
    skip_within: SkipWithin = 0.0
    delay: Delay = 0.0
    delay_spread: DelaySpread = 0.0


class NoisySettings(SyntheticSettings):
    """One that errs now and then."""

    noise: Noise = 0.1


class SkippingSettings(SyntheticSettings):
    """One that doesn't judge what is hard to tell: within half a centimetre of the border, as an eye is."""

    skip_within: SkipWithin = 0.005


class DelayedSettings(SyntheticSettings):
    """One that takes its time; human response times are about log-normal, so most are short and a few are long."""

    delay: Delay = 1.0
    delay_spread: DelaySpread = 0.4


class Synthetic:
    """Judges by the task's own rule: good if the call serves the next subgoal, otherwise bad; with human failings."""

    def __init__(self, task: Task, settings: SyntheticSettings) -> None:
        self._task = task
        self._settings = settings

    def judge(self, case: Case) -> Judgement:
        """+1 or -1; 0 near the border of what is good."""
        chosen = self._settings
        # both are always drawn, so that changing one setting leaves the dice of the other alone
        flip, slowness = float(case.random.random()), float(case.random.standard_normal())
        value = self._task.judge(case.state, case.call)
        if abs(self._task.margin(case.state, case.call)) < chosen.skip_within:
            value = 0
        elif flip < chosen.noise:
            value = -value
        return Judgement(value, chosen.delay * math.exp(chosen.delay_spread * slowness))


class SyntheticFactory:
    """Builds `Synthetic`; the entry points differ by the defaults of their settings only."""

    def __init__(self, description: str, settings: type[SyntheticSettings]) -> None:
        self.description = description
        self.settings: type[BaseModel] = settings
        self._settings = settings

    def __call__(self, task: Task, settings: BaseModel) -> Synthetic:
        """Build it."""
        return Synthetic(task, self._settings.model_validate(settings.model_dump()))


SYNTHETIC = SyntheticFactory("Judges by the task's rule, always right and at once.", SyntheticSettings)
NOISY = SyntheticFactory("Judges by the task's rule and errs now and then.", NoisySettings)
SKIPPING = SyntheticFactory("Judges by the task's rule, neutral where that is hard to tell.", SkippingSettings)
DELAYED = SyntheticFactory("Judges by the task's rule, after as long as a person takes.", DelayedSettings)


class UnknownTeacher(WorkerError):
    """No installed package brings a teacher of this name."""


def teachers() -> dict[str, TeacherFactory]:
    """Teachers by name; one that can't be loaded is skipped."""
    found: dict[str, TeacherFactory] = {}
    for entry in entry_points(group="seed.teachers"):
        try:
            found[entry.name] = cast(TeacherFactory, entry.load())
        except Exception as error:  # noqa: BLE001  a foreign plug-in may fail in any way; the others must still work
            log.warning("the teacher %s can't be loaded: %s", entry.name, error)
    return dict(sorted(found.items()))


def teacher(name: str, task: Task, settings: Mapping[str, Any]) -> Teacher:
    """The teacher of this name for a task.

    Raises:
        UnknownTeacher: there is none.
    """
    known = teachers()
    if name not in known:
        raise UnknownTeacher(f"unknown teacher {name!r}", remedy=f"use one of: {', '.join(known)}")
    return known[name](task, known[name].settings.model_validate(dict(settings)))
