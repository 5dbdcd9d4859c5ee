"""An algorithm that proposes what it is told to: so many bad calls, then the true ones.

It is a foreign plug-in like any other: its own distribution, found by its entry point, loaded in the learner worker.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from pydantic import BaseModel, Field

from agent.algorithm import CheckpointError, Label, Problem, Suggestion
from robot_adapters.base import Array, SkillCall
from robot_adapters.registry import task
from robot_adapters.tasks.base import Task

ATTEMPTS = 1000
"""Random calls tried for one that the task's rule calls bad; nearly every one is."""


class ScriptedSettings(BaseModel, extra="forbid"):
    """Settings of `Scripted`."""

    bad_first: int = Field(default=0, ge=0, description="bad calls that are proposed before the first true one")


class Scripted:
    """Knows the task: `Task.true_call` is what it proposes after `bad_first` bad calls."""

    def __init__(self, problem: Problem, settings: ScriptedSettings, seed: int) -> None:
        self._task: Task = task(problem.task)
        self._skills = problem.skills
        self._settings = settings
        self._random = np.random.default_rng(seed)
        self._proposed = 0
        self.policy_version = 0
        self.last_label_id = 0

    @property
    def owed_updates(self) -> int:
        """It learns nothing."""
        return 0

    @property
    def spare_updates(self) -> int:
        """Nor does it while somebody thinks."""
        return 0

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """The true call, or a bad one at first. The deterministic policy is always right."""
        right = deterministic or self._proposed >= self._settings.bad_first
        self._proposed += not deterministic
        call = self._task.true_call(state) if right else self._bad(state)
        chances = {spec.name: float(spec.name == call.skill) for spec in self._skills}
        return Suggestion(call, 0.9 if right else -0.9, chances, self.policy_version)

    def _bad(self, state: Array) -> SkillCall:
        """A random call inside the bounds that the task's rule calls bad."""
        for _ in range(ATTEMPTS):
            spec = self._skills[self._random.integers(len(self._skills))]
            unit = self._random.uniform(-1.0, 1.0, size=len(spec.parameters))
            call = SkillCall(spec.name, tuple(float(v) for v in spec.denormalise(unit)))
            if self._task.judge(state, call) < 0:
                return call
        raise RuntimeError(f"{self._task.name} calls nothing bad")

    def add(self, labels: Sequence[Label]) -> None:
        """Remember how far they go."""
        self.last_label_id = max([self.last_label_id, *(label.id for label in labels)])

    def restore(self, labels: Sequence[Label]) -> None:
        """As `add`."""
        self.add(labels)

    def forget(self, label_id: int) -> None:
        """There is nothing to forget."""

    def relabel(self, label: Label) -> None:
        """Nor to correct."""

    def update(self) -> Mapping[str, float] | None:
        """Nothing to learn."""
        return None

    def save(self, path: Path) -> None:
        """Keep how far it has heard."""
        path.write_text(json.dumps(self.last_label_id), "utf-8")

    def load(self, path: Path) -> None:
        """Read what `save` wrote."""
        try:
            self.last_label_id = int(json.loads(path.read_text("utf-8")))
        except ValueError as error:
            raise CheckpointError(f"{path.name} is damaged", remedy="remove it") from error


class ScriptedFactory:
    """Builds `Scripted`."""

    name = "scripted"
    description = "Proposes the true call; for tests."
    settings: type[BaseModel] = ScriptedSettings
    presets: Mapping[str, Mapping[str, object]] = {"recommended": {}, "stubborn": {"bad_first": 1_000_000}}

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Scripted:
        """Build it."""
        return Scripted(problem, ScriptedSettings.model_validate(settings.model_dump()), seed)


SCRIPTED = ScriptedFactory()
