"""An algorithm whose training diverges while a file is there, as it does where a learning rate is too high."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import BaseModel

from agent.algorithm import AgentError, Label, Problem

if TYPE_CHECKING:
    from tests.plugins.seed_scripted import Scripted, ScriptedSettings
else:  # a plug-in is found by its directory, and knows nothing of the project's tests
    from seed_scripted import Scripted, ScriptedSettings


class DivergingSettings(BaseModel, extra="forbid"):
    """Settings of `Diverging`."""

    flag: str
    """A file's path: training diverges while it is there."""


class Diverging(Scripted):
    """Takes one empty step a label."""

    def __init__(self, problem: Problem, settings: DivergingSettings, seed: int) -> None:
        super().__init__(problem, ScriptedSettings(), seed)
        self._flag = Path(settings.flag)
        self._labels: set[int] = set()

    @property
    def owed_updates(self) -> int:
        """One a label."""
        return len(self._labels) - self.policy_version

    def add(self, labels: Sequence[Label]) -> None:
        """Owe a step for each that is new."""
        super().add(labels)
        self._labels |= {label.id for label in labels}

    def update(self) -> Mapping[str, float] | None:
        """Diverge, or do nothing."""
        if self._flag.exists():
            raise AgentError("training diverged", remedy="start anew")
        self.policy_version += 1
        return {}


class DivergingFactory:
    """Builds `Diverging`."""

    name = "diverging"
    description = "Diverges when it is told to; for tests."
    settings: type[BaseModel] = DivergingSettings
    presets: Mapping[str, Mapping[str, object]] = {}

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Diverging:
        """Build it."""
        return Diverging(problem, DivergingSettings.model_validate(settings.model_dump()), seed)


DIVERGING = DivergingFactory()
