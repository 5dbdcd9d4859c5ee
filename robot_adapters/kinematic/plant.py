"""The physics-free world under low-level control: every set-point is where the gripper then is."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot_adapters.base import Array, Scene
from robot_adapters.kinematic.world import World
from robot_adapters.tasks.base import Task


class KinematicPlant:
    """`Plant` of `low_level.py`. The gripper doesn't turn; fingers act first and at once, then the gripper moves.

    Closed fingers, or what they hold, push what is in the way sideways; open ones pass around it. Nothing is damaged.
    """

    def __init__(self, task: Task) -> None:
        self.table_height = task.table_height
        self._world = World(task.objects, task.table_height)

    def reset(self, layout: Mapping[str, Array], rng: np.random.Generator) -> None:  # noqa: ARG002  nothing is random
        """Put everything where `layout` says, the gripper open and empty."""
        self._world.reset(layout)

    def pose(self) -> tuple[Array, float]:
        """Grip site (3,) m, base frame, and yaw 0."""
        return np.array(self._world.gripper), 0.0

    def gripper_width(self) -> float:
        """Distance between the fingers, m."""
        return self._world.opening()

    def gripper_closed(self) -> bool:
        """Whether the fingers were last commanded to close."""
        return self._world.closed

    def step(self, target: Array, yaw: float, gripper_closed: bool) -> None:  # noqa: ARG002  it doesn't turn
        """Close or open the fingers, then go to `target` (3,) m, base frame, or as far as contact allows."""
        world = self._world
        if gripper_closed and not world.closed:
            world.grasp()
        elif world.closed and not gripper_closed:
            world.open()
        world.drive(target.tolist())

    def overload(self) -> str | None:
        """None: there are no forces."""
        return None

    def scene(self) -> Scene:
        """A snapshot."""
        return self._world.scene()

    def close(self) -> None:
        """Nothing to release."""
