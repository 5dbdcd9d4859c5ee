"""An algorithm that tells which labels it holds, in the place of its skills' probabilities."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pydantic import BaseModel

from agent.algorithm import Label, Problem, Suggestion
from robot_adapters.base import Array

if TYPE_CHECKING:
    from tests.plugins.seed_scripted import Scripted, ScriptedSettings
else:  # a plug-in is found by its directory, and knows nothing of the project's tests
    from seed_scripted import Scripted, ScriptedSettings


class Candid(Scripted):
    """Proposes as `Scripted` does."""

    def __init__(self, problem: Problem, settings: ScriptedSettings, seed: int) -> None:
        super().__init__(problem, settings, seed)
        self._held: dict[int, int] = {}

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """As `Scripted`, with feedback id -> value of every label held."""
        held = {str(label_id): float(value) for label_id, value in sorted(self._held.items())}
        return replace(super().propose(state, deterministic=deterministic), skill_probabilities=held)

    def add(self, labels: Sequence[Label]) -> None:
        """Hold them."""
        super().add(labels)
        self._held |= {label.id: label.value for label in labels}

    def restore(self, labels: Sequence[Label]) -> None:
        """Hold these and no others."""
        self._held.clear()
        self.add(labels)

    def forget(self, label_id: int) -> None:
        """Hold one less."""
        self._held.pop(label_id, None)

    def relabel(self, label: Label) -> None:
        """Hold it as it is now."""
        self._held[label.id] = label.value


class CandidFactory:
    """Builds `Candid`."""

    name = "candid"
    description = "Tells which labels it holds; for tests."
    settings: type[BaseModel] = ScriptedSettings
    presets: Mapping[str, Mapping[str, object]] = {}

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Candid:
        """Build it."""
        return Candid(problem, ScriptedSettings.model_validate(settings.model_dump()), seed)


CANDID = CandidFactory()
