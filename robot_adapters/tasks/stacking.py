"""Stacking (paper, section 'Long-horizon manipulation tasks'): put the small block on top of the large one."""

from __future__ import annotations

import math

import numpy as np
from pydantic import Field, model_validator

from robot_adapters.base import Array, SafetyViolation, Scene
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.layout import LayoutSettings, Range, draw
from robot_adapters.tasks.rules import misplaced

A, B = "block_a", "block_b"
HALF_A, HALF_B = 0.02, 0.025

# As in robosuite's Stack, whose blocks start within 8 cm of the table's middle
SPREAD = 0.08
# centre to centre: the open fingers (5 cm to each side of a block) must miss the other block (2.5 cm)
SEPARATION = 0.085
# A's centre stands 45 mm above B's when stacked; 2 mm on top let it settle instead of being pressed in
PLACE_ABOVE = HALF_A + HALF_B + 0.002

# The teacher's boxes around the two targets, m. Inside them a skill succeeds in simulation
PICK_BELOW, PICK_ABOVE = (0.015, 0.015, 0.015), (0.015, 0.015, 0.012)
PLACE_BELOW, PLACE_OVER = (0.015, 0.015, 0.008), (0.015, 0.015, 0.025)

# A block tips over the edge beyond half the lower one's size; a turned square reaches a little further
STACKED_XY = 0.03
STACKED_Z = 0.010
RAISED = 0.02
"""A block this much above where the table would hold it is between the fingers, or on the other block."""

# Bounds of each skill: 5 cm and more around where blocks start; a place may be as high as a stack of three
X, Y = (0.42, 0.70), (-0.14, 0.14)
PICK_Z, PLACE_Z = table.above(0.005, 0.085), table.above(0.005, 0.155)

_FIELD_LOW = (table.X[0], table.Y[0], table.HEIGHT)
_FIELD_HIGH = (table.X[1], table.Y[1], table.HEIGHT + 0.25)


class StackingLayout(LayoutSettings):
    """Where the blocks start; they are drawn again until they are 85 mm apart, as the open fingers need."""

    x: Range = Field((table.CENTRE[0] - SPREAD, table.CENTRE[0] + SPREAD), description="x of both blocks, m")
    y: Range = Field((table.CENTRE[1] - SPREAD, table.CENTRE[1] + SPREAD), description="y of both blocks, m")

    @model_validator(mode="after")
    def _roomy(self) -> StackingLayout:
        if math.dist((self.x[0], self.y[0]), (self.x[1], self.y[1])) < 1.2 * SEPARATION:
            raise ValueError("two blocks don't fit: make x or y wider")
        return self


class Stacking(Boxed):
    """Block A (small, red) goes on block B (large, green). State: both centres, nothing of the robot."""

    name = "stacking"
    title = "Stacking"
    instruction = "Stack the red block on the green block."
    reset_by_hand = (
        "Put both blocks back on the table inside the marked area, apart from each other. Take out what "
        "the gripper holds."
    )
    table_height = table.HEIGHT
    horizon = 6
    objects = (
        ObjectSpec(A, "block", HALF_A, (0.84, 0.18, 0.16)),
        ObjectSpec(B, "block", HALF_B, (0.18, 0.62, 0.28)),
    )
    state_fields = (
        StateField(f"{A}_position", 3, "m", "centre of the small red block, base frame", _FIELD_LOW, _FIELD_HIGH),
        StateField(f"{B}_position", 3, "m", "centre of the large green block, base frame", _FIELD_LOW, _FIELD_HIGH),
    )
    skills = (
        table.picking(x=X, y=Y, z=PICK_Z),
        table.placing(x=X, y=Y, z=PLACE_Z),
    )
    subgoals = (
        Subgoal("pick", "pick up the red block"),
        Subgoal("place", "place it on the green block"),
    )

    def __init__(self, layout: StackingLayout | None = None) -> None:
        self.layout = layout or StackingLayout()

    def state(self, scene: Scene) -> Array:
        """(6,) centres of block A and block B, m, robot base frame."""
        return np.concatenate((scene.objects[A], scene.objects[B]), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """Both blocks flat on the table near its middle, `SEPARATION` apart; the gripper open and above them."""
        ranges = self.layout
        while True:
            a, b = draw(rng, ranges.x, ranges.y), draw(rng, ranges.x, ranges.y)
            if math.dist(a, b) >= SEPARATION:
                break
        low, high = np.array([-0.10, -0.10, 0.18]), np.array([0.06, 0.10, 0.28])
        gripper = np.array([*table.CENTRE, table.HEIGHT]) + rng.uniform(low, high)
        return {
            A: np.array([*a, table.HEIGHT + HALF_A]),
            B: np.array([*b, table.HEIGHT + HALF_B]),
            "gripper": gripper,
        }

    def success(self, scene: Scene) -> bool:
        """Whether A rests on B and nothing holds it."""
        return scene.held not in {A, B} and _stacked(self.state(scene).tolist())

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """A block off the table, or where no skill of this task can take it."""
        return tuple(v for spec in self.objects for v in misplaced(scene, spec.name, X, Y))

    def subgoal(self, state: Array) -> int:
        """0 (pick) until A is off the table, then 1 (place)."""
        return int(_raised(state.tolist()))

    def box(self, state: Array) -> Box:
        """Pick at block A while it is on the table, place on block B while A is raised.

        A block on the other that isn't let go of yet looks as if it were stacked; to place it is still right.
        """
        s = state.tolist()
        if _raised(s):
            return Box("place", (s[3], s[4], s[5] + PLACE_ABOVE), PLACE_BELOW, PLACE_OVER)
        return Box("pick", (s[0], s[1], s[2]), PICK_BELOW, PICK_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(2, 3) centre of A and where it goes on B, m, robot base frame; with `skill`, (1, 3)."""
        points = {"pick": state[:3], "place": state[3:] + np.array([0.0, 0.0, PLACE_ABOVE])}
        return np.array([at for name, at in points.items() if skill in {None, name}]).reshape(-1, 3)


def _stacked(s: list[float]) -> bool:
    """Whether A rests on B, from the state alone."""
    return math.hypot(s[0] - s[3], s[1] - s[4]) <= STACKED_XY and abs(s[2] - s[5] - HALF_A - HALF_B) <= STACKED_Z


def _raised(s: list[float]) -> bool:
    """Whether A is off the table: as long as the task isn't solved, that is in the hand."""
    return s[2] > table.HEIGHT + HALF_A + RAISED
