"""An algorithm whose critic is sure of itself: of every proposal it predicts the same, rightly or not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from pydantic import BaseModel, Field

from agent.algorithm import Problem, Suggestion
from robot_adapters.base import Array

if TYPE_CHECKING:
    from tests.plugins.seed_scripted import Scripted, ScriptedSettings
else:  # a plug-in is found by its directory, and knows nothing of the project's tests
    from seed_scripted import Scripted, ScriptedSettings


class ConfidentSettings(ScriptedSettings):
    """Settings of `Confident`."""

    critics: int = Field(default=2, ge=1, description="what it says to have; it computes nothing")
    predicted: float = Field(default=0.95, description="predicted feedback of every proposal")
    uncertainty: float = Field(default=0.02, ge=0, description="disagreement about every proposal")


class Confident(Scripted):
    """Proposes as `Scripted` does."""

    def __init__(self, problem: Problem, settings: ConfidentSettings, seed: int) -> None:
        super().__init__(problem, settings, seed)
        self._chosen = settings

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """As `Scripted`, but always equally sure."""
        suggestion = super().propose(state, deterministic=deterministic)
        chosen = self._chosen
        return replace(suggestion, predicted_feedback=chosen.predicted, uncertainty=chosen.uncertainty)


class ConfidentFactory:
    """Builds `Confident`."""

    name = "confident"
    description = "Sure of itself; for tests."
    settings: type[BaseModel] = ConfidentSettings
    presets: Mapping[str, Mapping[str, object]] = {}

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Confident:
        """Build it."""
        return Confident(problem, ConfidentSettings.model_validate(settings.model_dump()), seed)


CONFIDENT = ConfidentFactory()
