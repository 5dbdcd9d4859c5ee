"""The state of methods that command the gripper itself (SAC, TAMER in the paper): the task's state and the gripper."""

from __future__ import annotations

import numpy as np

from robot_adapters.base import Array, Scene
from robot_adapters.tasks import table
from robot_adapters.tasks.base import StateField, Task

GRIPPER = (
    StateField(
        "gripper_position",
        3,
        "m",
        "grip site, base frame",
        (table.X[0], table.Y[0], table.HEIGHT),
        (table.X[1], table.Y[1], table.HEIGHT + 0.3),
    ),
    StateField("gripper_closed", 1, "", "1 while the fingers are commanded closed, else 0", (0.0,), (1.0,)),
)


def low_level_fields(task: Task) -> tuple[StateField, ...]:
    """The fields of `low_level_state`: the gripper's first, unless the task's state holds them already."""
    names = {field.name for field in task.state_fields}
    return (*(field for field in GRIPPER if field.name not in names), *task.state_fields)


def low_level_state(task: Task, scene: Scene) -> Array:
    """(n,) gripper x, y, z in m and whether it is closed, then the task's state; Reaching's is that already."""
    names = {field.name for field in task.state_fields}
    gripper = {"gripper_position": scene.gripper, "gripper_closed": np.array([float(scene.gripper_closed)])}
    parts = [at for name, at in gripper.items() if name not in names]
    return np.concatenate((*parts, task.state(scene)), dtype=np.float64)
