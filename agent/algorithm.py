"""The `Algorithm` protocol and the values that cross it. Imports no torch, so that anything may import this."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, runtime_checkable

from pydantic import BaseModel

from robot_adapters.base import Array, SkillCall, SkillSpec

if TYPE_CHECKING:
    import torch

DeviceName = Literal["auto", "cpu", "cuda"]
"""Where to train; `agent.device` says what each means."""


class AgentError(Exception):
    """Base of every error of this package. `remedy` says what the reader can do about it."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


class CheckpointError(AgentError):
    """A checkpoint that is damaged, of another version, or of another task or architecture."""


@dataclass(frozen=True)
class Problem:
    """What an algorithm is told of its task.

    state_low, state_high: (n,) bounds used to scale the state to about [-1, 1].
    state_names: a name for each of the n entries, for messages; may be left out.
    keypoints: (n,) state and a skill's name (None: all skills) -> (k, 3) m, robot base frame, where the grip site acts
    on task-relevant objects (`Task.keypoints`); None where there are none. k is the same in every state.
    position_fields: indices into the state where an x in m stands with its y right after, both in the base frame.
    """

    task: str
    state_low: Array
    state_high: Array
    skills: tuple[SkillSpec, ...]
    state_names: tuple[str, ...] = ()
    keypoints: Callable[[Array, str | None], Array] | None = None
    position_fields: tuple[int, ...] = ()


@dataclass(frozen=True)
class Suggestion:
    """A skill call with what the agent thinks of it.

    predicted_feedback: the critic's estimate of the label, about [-1, 1] (paper, eq. 1).
    skill_probabilities: pi_phi(a|s) by skill name. policy_version: gradient steps taken so far.
    uncertainty: how far the critics of an ensemble disagree about this call, a standard deviation in units of
    predicted_feedback; None where it isn't known. One critic can't disagree, and a 0 would say that it is sure.
    """

    call: SkillCall
    predicted_feedback: float
    skill_probabilities: Mapping[str, float]
    policy_version: int
    uncertainty: float | None = None


@dataclass(frozen=True)
class Label:
    """One stored feedback as the learner sees it.

    id: the feedback's id in the store, ascending. state: (n,). value: -1, 0 or +1.
    near: whether the call's position is within reach of a task-relevant object (the paper's affordance).
    trainer: whose it is, a number that tells trainers apart and nothing else of them; 0: not known.
    """

    id: int
    state: Array
    call: SkillCall
    value: int
    near: bool = True
    trainer: int = 0


class Algorithm(Protocol):
    """Something that suggests skill calls and learns from labels. Used from one thread."""

    policy_version: int
    """Gradient steps taken so far."""

    last_label_id: int
    """The newest label that `add` has seen; 0 before any."""

    @property
    def owed_updates(self) -> int:
        """Gradient steps that the schedule asks for because of labels added and not yet worked off."""

    @property
    def spare_updates(self) -> int:
        """Steps beyond the owed ones that fresh labels allow while a person thinks; `update` takes them last."""

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """Suggest a call for state (n,).

        Raises:
            AgentError: the state has the wrong shape or holds a value that is not finite.
        """

    def add(self, labels: Sequence[Label]) -> None:
        """Take labels into the replay. Each is taken once: an id seen before is ignored."""

    def restore(self, labels: Sequence[Label]) -> None:
        """Fill the replay after `load`: labels up to `last_label_id` owe no updates, newer ones do."""

    def forget(self, label_id: int) -> None:
        """Take a label out of the replay, until it is relabelled; unknown ids are ignored."""

    def relabel(self, label: Label) -> None:
        """Hold this label in the place of the one of the same id; if none is held, take it. It owes no steps."""

    def update(self) -> Mapping[str, float] | None:
        """One gradient step; its metrics, or None where there is nothing to learn from yet."""

    def save(self, path: Path) -> None:
        """Write networks, optimisers, temperatures, random state and counters atomically. The replay isn't written."""

    def load(self, path: Path) -> None:
        """Read what `save` wrote.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """


@runtime_checkable
class Pausing(Protocol):
    """An algorithm whose gradient steps may take long: it calls `pause` within them, now and then.

    What `pause` does may ask the algorithm for proposals, and nothing else: they are those of before the step.
    """

    pause: Callable[[], None]


@runtime_checkable
class Movable(Protocol):
    """An algorithm that can train elsewhere than on the CPU. What it proposes and saves doesn't depend on where."""

    def move(self, device: torch.device) -> None:
        """Take all further gradient steps there."""


@runtime_checkable
class Estimating(Protocol):
    """An algorithm that tells what it expects to be said of calls that it doesn't propose."""

    def estimate(self, state: Array, calls: Sequence[SkillCall]) -> Array:
        """(n,) state and C calls -> (C,) predicted feedback, as of `Suggestion`. Changes nothing, and draws nothing.

        Raises:
            AgentError: the state or a call doesn't fit the task.
        """


@runtime_checkable
class Recollecting(Protocol):
    """An algorithm that can be asked for proposals before it has all of its old labels back."""

    def recollect(self, labels: Sequence[Label]) -> None:
        """After `restore`, take others, older or newer: as if `restore` had been given them too."""


@runtime_checkable
class Considering(Estimating, Protocol):
    """An algorithm that also tells what it would do with each skill."""

    def consider(self, state: Array) -> list[SkillCall]:
        """(n,) state -> a call of each skill, the one that its actor thinks likeliest. Changes and draws nothing.

        Raises:
            AgentError: the state doesn't fit the task.
        """


class AlgorithmFactory(Protocol):
    """What an entry point of the group `seed.algorithms` names."""

    name: str
    description: str
    settings: type[BaseModel]
    """Pydantic model of the algorithm's settings, each field documented."""

    presets: Mapping[str, Mapping[str, Any]]
    """Preset name -> settings that differ from the defaults."""

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Algorithm:
        """Build the algorithm. Only here may torch be imported."""
