"""Reaching (paper, section 'Long-horizon manipulation tasks'): move the gripper into a fixed area."""

from __future__ import annotations

import itertools
import math

import numpy as np
from pydantic import Field, model_validator

from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall, SkillSpec
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal
from robot_adapters.tasks.layout import LayoutSettings, Range, draw

# 13 cm above the table and left of its middle: seen by both cameras, far from every joint limit
TARGET = (0.56, 0.12, 0.02)
RADIUS = 0.05
# clear of the area, so that no episode starts solved
START_DISTANCE = RADIUS + 0.06


class ReachingLayout(LayoutSettings):
    """Where the gripper starts; it is drawn again while it is in or near the area."""

    x: Range = Field((0.42, 0.70), description="x of the gripper, m")
    y: Range = Field((-0.20, 0.20), description="y of the gripper, m")
    z: Range = Field(table.above(0.08, 0.26), description="z of the gripper, m; the table is at -0.112")

    @model_validator(mode="after")
    def _roomy(self) -> ReachingLayout:
        corners = itertools.product(self.x, self.y, self.z)
        if max(math.dist(corner, TARGET) for corner in corners) < START_DISTANCE * 1.2:
            raise ValueError("every start would be in or near the area: make a range wider")
        return self


class Reaching:
    """The gripper starts somewhere over the table; the trainer sees the area, the agent is never told of it.

    `release` is offered although it never helps: learning to leave it alone is part of the task (paper).
    """

    name = "reaching"
    title = "Reaching"
    instruction = "Move the gripper into the blue area."
    reset_by_hand = "Nothing to put back: see that the gripper is free, with nothing in its way."
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
        SkillSpec(
            "reach",
            # no farther: outside, a joint of the Panda runs into its limit
            table.position("where the gripper goes", x=table.FREE_X, y=table.FREE_Y),
            "Move the gripper to a position.",
        ),
        SkillSpec("release", (), "Open the gripper."),
    )
    subgoals = (Subgoal("reach the area", instruction),)

    def __init__(self, layout: ReachingLayout | None = None) -> None:
        self.layout = layout or ReachingLayout()

    def state(self, scene: Scene) -> Array:
        """(4,) gripper x, y, z in m, robot base frame, and whether it is closed."""
        return np.append(np.asarray(scene.gripper, dtype=np.float64), float(scene.gripper_closed))

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """A gripper start over the table, at least `START_DISTANCE` from the area's centre."""
        ranges = self.layout
        while True:
            start = np.array(draw(rng, ranges.x, ranges.y, ranges.z))
            if np.linalg.norm(start - TARGET) >= START_DISTANCE:
                return {"gripper": start}

    def success(self, scene: Scene) -> bool:
        """Whether the grip site is inside the area."""
        return _inside(scene.gripper)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:  # noqa: ARG002 - the protocol's signature
        """None: there is nothing to knock over."""
        return ()

    def events(self, scene: Scene) -> frozenset[str]:  # noqa: ARG002 - the protocol's signature
        """Nothing is to be remembered."""
        return frozenset()

    def subgoal(self, state: Array) -> int:  # noqa: ARG002 - the protocol's signature
        """Always the only one."""
        return 0

    def judge(self, state: Array, call: SkillCall) -> int:  # noqa: ARG002 - the rule is the same from everywhere
        """+1 for a reach into the area, -1 for anything else."""
        return 1 if call.skill == "reach" and _inside(call.parameters) else -1

    def margin(self, state: Array, call: SkillCall) -> float:  # noqa: ARG002 - the rule is the same from everywhere
        """Metres from the call to the area's surface, negative outside; -inf for another skill."""
        return RADIUS - math.dist(call.parameters, TARGET) if call.skill == "reach" else -math.inf

    def true_call(self, state: Array) -> SkillCall:  # noqa: ARG002 - the same from everywhere
        """Reach the area's centre."""
        return SkillCall("reach", TARGET)

    def sample_good(self, state: Array, rng: np.random.Generator) -> SkillCall:  # noqa: ARG002 - as above
        """Reach a place drawn uniformly from the area."""
        while True:
            offset = rng.uniform(-RADIUS, RADIUS, size=3)
            if np.linalg.norm(offset) < RADIUS:
                return SkillCall("reach", tuple((TARGET + offset).tolist()))

    def keypoints(self, state: Array, skill: str | None = None) -> Array:  # noqa: ARG002 - the state holds no object
        """(0, 3): the area isn't part of the state, and giving it away would solve the task."""
        return np.zeros((0, 3))


def _inside(position: Array | tuple[float, ...]) -> bool:
    return bool(np.linalg.norm(np.asarray(position, dtype=np.float64) - TARGET) <= RADIUS)
