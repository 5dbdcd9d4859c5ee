"""The kinematic adapter, but it says that it is a real robot: what only a person may approve, and what has a home."""

from __future__ import annotations

import os
import time
from pathlib import Path

from pydantic import BaseModel, Field

from robot_adapters.base import Adapter, StepHook, StopCheck
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.registry import task as task_by_name

HOMING = "homing"
"""Name of the file in the data directory that is there once it is on its way home."""


class BenchtopSettings(KinematicSettings):
    """Settings of `Benchtop`."""

    home_seconds: float = Field(0.0, ge=0.0, description="that the way home takes")


class Benchtop(KinematicAdapter):
    """Moves as the kinematic adapter does, and has a home (`Tended`)."""

    home_seconds = 0.0

    def home(self, *, should_stop: StopCheck, on_step: StepHook) -> bool:
        """Wait for the end of the way, or a stop."""
        (Path(os.environ["SEED_DATA_DIR"]) / HOMING).touch()
        arrives = time.monotonic() + self.home_seconds
        while time.monotonic() < arrives:
            if should_stop():
                return False
            on_step()
            time.sleep(0.01)
        return True

    def recover(self) -> None:
        """Nothing ever stops it."""

    def refresh(self) -> None:
        """Nothing changes by itself."""

    def halt(self) -> None:
        """Nothing goes on by itself."""


class BenchtopFactory:
    """Builds what only claims to be a real robot."""

    name = "benchtop"
    description = "Claims to be a real robot; for tests."
    simulated = False
    tasks: tuple[str, ...] = ("reaching", "stacking")
    settings: type[BaseModel] = BenchtopSettings

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build it."""
        chosen = BenchtopSettings.model_validate(settings.model_dump())
        made = Benchtop(task_by_name(task, chosen.layout), chosen)
        made.home_seconds = chosen.home_seconds
        return made


BENCHTOP = BenchtopFactory()
