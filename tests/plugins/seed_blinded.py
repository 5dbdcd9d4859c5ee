"""The kinematic adapter, but while a file exists it doesn't see an object: what perception does when one is hidden."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pydantic import BaseModel, Field

from robot_adapters.base import Adapter, Observation
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.registry import task as task_by_name
from robot_adapters.tasks.base import Task

HIDDEN = 4
"""Index into the state of what isn't known then."""


class BlindedSettings(KinematicSettings):
    """Settings of `Blinded`."""

    flag: Path = Field(description="while this file exists, one number of the state is not a number")


class Blinded(KinematicAdapter):
    """Moves as the kinematic adapter does."""

    def __init__(self, task: Task, settings: BlindedSettings) -> None:
        self._flag = settings.flag
        super().__init__(task, settings)

    def observe(self) -> Observation:
        """As it is, but for what is hidden."""
        seen = super().observe()
        if not self._flag.exists():
            return seen
        state = seen.state.copy()
        state[HIDDEN] = np.nan
        return replace(seen, state=state)


class BlindedFactory:
    """Builds `Blinded`."""

    name = "blinded"
    description = "The kinematic adapter that loses sight of an object; for tests."
    simulated = True
    tasks: tuple[str, ...] = ("stacking",)
    settings: type[BaseModel] = BlindedSettings

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build it."""
        chosen = BlindedSettings.model_validate(settings.model_dump())
        return Blinded(task_by_name(task, chosen.layout), chosen)


BLINDED = BlindedFactory()
