"""An algorithm that tells which labels it holds, and from how many trainers, in the place of what it thinks."""

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
        self._held: dict[int, Label] = {}
        self._heard: set[int] = set()

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """As `Scripted`, with feedback id -> value of every label held; uncertainty: how many trainers gave them."""
        held = {str(label_id): float(label.value) for label_id, label in sorted(self._held.items())}
        trainers = float(len({label.trainer for label in self._held.values()}))
        suggestion = super().propose(state, deterministic=deterministic)
        return replace(suggestion, skill_probabilities=held, uncertainty=trainers)

    def add(self, labels: Sequence[Label]) -> None:
        """Hold those whose ids are new to it."""
        super().add(labels)
        self._held |= {label.id: label for label in labels if label.id not in self._heard}
        self._heard |= {label.id for label in labels}

    def restore(self, labels: Sequence[Label]) -> None:
        """Hold these and no others."""
        self._held.clear()
        self._heard.clear()
        self.add(labels)

    def recollect(self, labels: Sequence[Label]) -> None:
        """Hold these too, as far as they are new to it."""
        self.add(labels)

    def forget(self, label_id: int) -> None:
        """Hold one less, which doesn't come again by `add`."""
        self._held.pop(label_id, None)

    def relabel(self, label: Label) -> None:
        """Hold it as it is now."""
        self._held[label.id] = label
        self._heard.add(label.id)


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
