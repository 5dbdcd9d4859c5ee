"""Reaching (paper, section 'Long-horizon manipulation tasks'): move the gripper into a fixed area."""

from __future__ import annotations

import numpy as np

from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall, SkillSpec
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal

# 13 cm above the table and left of its middle: seen by both cameras, far from every joint limit
TARGET = (0.56, 0.12, 0.02)
RADIUS = 0.05
# clear of the area, so that no episode starts solved
START_DISTANCE = RADIUS + 0.06


class Reaching:
    """The gripper starts somewhere over the table; the trainer sees the area, the agent is never told of it.

    `release` is offered although it never helps: learning to leave it alone is part of the task (paper).
    """

    name = "reaching"
    title = "Reaching"
    instruction = "Move the gripper into the blue area."
    table_height = table.HEIGHT
    horizon = 4
    objects = (ObjectSpec("target", "area", RADIUS, (0.16, 0.42, 0.86), TARGET),)
    state_fields = (
        StateField(
            "gripper_position",
            3,
            "m",
            "grip site, robot base frame",
            (table.X[0], table.Y[0], table.HEIGHT),
            (table.X[1], table.Y[1], table.HEIGHT + 0.3),
        ),
        StateField("gripper_closed", 1, "", "1 while the fingers are commanded closed, else 0", (0.0,), (1.0,)),
    )
    skills = (
        SkillSpec("reach", table.position("where the gripper goes"), "Move the gripper to a position."),
        SkillSpec("release", (), "Open the gripper."),
    )
    subgoals = (Subgoal("reach the area", instruction),)

    def state(self, scene: Scene) -> Array:
        """(4,) gripper x, y, z in m, robot base frame, and whether it is closed."""
        return np.append(np.asarray(scene.gripper, dtype=np.float64), float(scene.gripper_closed))

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """A gripper start over the table, at least `START_DISTANCE` from the area's centre."""
        low = np.array([0.42, -0.20, table.HEIGHT + 0.08])
        high = np.array([0.70, 0.20, table.HEIGHT + 0.26])
        while True:
            start = rng.uniform(low, high)
            if np.linalg.norm(start - TARGET) >= START_DISTANCE:
                return {"gripper": start}

    def success(self, scene: Scene) -> bool:
        """Whether the grip site is inside the area."""
        return _inside(scene.gripper)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:  # noqa: ARG002 - the protocol's signature
        """None: there is nothing to knock over."""
        return ()

    def subgoal(self, state: Array) -> int:  # noqa: ARG002 - the protocol's signature
        """Always the only one."""
        return 0

    def judge(self, state: Array, call: SkillCall) -> int:  # noqa: ARG002 - the rule is the same from everywhere
        """+1 for a reach into the area, -1 for anything else."""
        return 1 if call.skill == "reach" and _inside(call.parameters) else -1

    def true_call(self, state: Array) -> SkillCall:  # noqa: ARG002 - the same from everywhere
        """Reach the area's centre."""
        return SkillCall("reach", TARGET)

    def keypoints(self, state: Array) -> Array:  # noqa: ARG002 - the state holds no object
        """(0, 3): the area isn't part of the state, and giving it away would solve the task."""
        return np.zeros((0, 3))


def _inside(position: Array | tuple[float, ...]) -> bool:
    return bool(np.linalg.norm(np.asarray(position, dtype=np.float64) - TARGET) <= RADIUS)
