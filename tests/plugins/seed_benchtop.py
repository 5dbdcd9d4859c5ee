"""The kinematic adapter, but it says that it is a real robot: what only a person may approve."""

from __future__ import annotations

from pydantic import BaseModel

from robot_adapters.base import Adapter
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.registry import adapter


class BenchtopFactory:
    """Builds what only claims to be a real robot."""

    name = "benchtop"
    description = "Claims to be a real robot; for tests."
    simulated = False
    tasks: tuple[str, ...] = ("reaching", "stacking")
    settings: type[BaseModel] = KinematicSettings

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build it."""
        return adapter("kinematic")(task, settings)


BENCHTOP = BenchtopFactory()
