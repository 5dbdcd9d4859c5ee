"""Sweeping (paper, section 'Long-horizon manipulation tasks'): take a broom and sweep a toy into a dustpan."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from robot_adapters.base import Array, SafetyViolation, Scene, SkillSpec
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Grip, ObjectSpec, Part, Seat, StateField, Subgoal, Vector
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.layout import LayoutSettings, Range, draw
from robot_adapters.tasks.rules import misplaced

BROOM, TOY, PAN = "broom", "toy", "dustpan"
YELLOW, BLUE, PINK, GREEN = (0.96, 0.78, 0.12), (0.13, 0.36, 0.85), (0.95, 0.38, 0.66), (0.13, 0.62, 0.30)

# The broom stands by itself: a wide head and, upright on it, a flat handle. It ends where fingers that close 15 mm
# too high still hold it, and the palm (31 mm above the grip site) of a hand 20 mm too low only touches it. Its origin
# is the grasp site on the handle
GRASP_HEIGHT = 0.08
HEAD_HALF: Vector = (0.02, 0.05, 0.015)
HANDLE_HALF: Vector = (0.012, 0.015, 0.033)
HEAD = Part((0.0, 0.0, HEAD_HALF[2] - GRASP_HEIGHT), HEAD_HALF, YELLOW)
HANDLE = Part((0.0, 0.0, 2 * HEAD_HALF[2] + HANDLE_HALF[2] - GRASP_HEIGHT), HANDLE_HALF, BLUE)
BROOM_TOP = 2 * HEAD_HALF[2] + 2 * HANDLE_HALF[2] - GRASP_HEIGHT

TOY_HALF = 0.02

# The dustpan lies open towards the robot: a floor 2 mm high, a back, and sides that begin 35 mm behind the lip so that
# the broom's head may come in a little
PAN_HALF = (0.05, 0.09)
PAN_AT: Vector = (0.745, 0.0, table.HEIGHT)
PAN_FLOOR, PAN_WALL = 0.002, 0.03
SIDES_BEGIN = 0.035
PAN_PARTS = (
    Part((0.0, 0.0, PAN_FLOOR / 2), (*PAN_HALF, PAN_FLOOR / 2), GREEN),
    Part((PAN_HALF[0], 0.0, PAN_WALL / 2), (0.003, PAN_HALF[1], PAN_WALL / 2), GREEN),
    *(
        Part(
            (SIDES_BEGIN / 2, side * PAN_HALF[1], PAN_WALL / 2),
            (PAN_HALF[0] - SIDES_BEGIN / 2, 0.003, PAN_WALL / 2),
            GREEN,
        )
        for side in (-1, 1)
    ),
)

SWEPT_Z = 0.03
"""The toy's centre is at most this high above the table once it lies in the dustpan."""
BEHIND = 0.075
"""The grip site starts its push this far before the toy: half the head, half the toy, and room to come down."""
PUSH_END = 0.685
"""x where a push ends: the head stands in the pan's mouth, the toy behind the lip."""

# The teacher's boxes, m. Inside them a skill succeeds in simulation
PICK_BELOW, PICK_ABOVE = (0.012, 0.020, 0.020), (0.015, 0.020, 0.015)
PUSH_BELOW, PUSH_ABOVE = (0.015, 0.025, 0.004, 0.015), (0.012, 0.025, 0.012, 0.025)

PICK_X, PICK_Y, PICK_Z = (0.38, 0.54), (-0.23, 0.23), table.above(0.045, 0.115)
PUSH_X, PUSH_Y, PUSH_Z = (0.40, 0.58), (-0.07, 0.07), table.above(0.07, 0.10)
PUSH_DELTA = (-0.10, 0.30)


class SweepingLayout(LayoutSettings):
    """Where broom and toy start."""

    broom_x: Range = Field((0.42, 0.50), description="x of the broom, m")
    broom_aside: Range = Field((0.14, 0.20), description="distance of the broom from the middle line, m; either side")
    toy_x: Range = Field((0.50, 0.58), description="x of the toy, m")
    toy_y: Range = Field((-0.04, 0.04), description="y of the toy, m; the dustpan's middle is at 0")


class Sweeping(Boxed):
    """State: the broom's grasp site, the toy's x and y, and whether the broom is in the hand."""

    name = "sweeping"
    title = "Sweeping"
    instruction = "Pick up the broom and sweep the pink toy into the green dustpan."
    reset_by_hand = (
        "Stand the broom up again in front of the robot, its blue handle upwards. Put the toy back on "
        "the table, and empty the dustpan."
    )
    table_height = table.HEIGHT
    horizon = 6
    objects = (
        ObjectSpec(
            BROOM,
            "thing",
            parts=(HEAD, HANDLE),
            half=(HEAD_HALF[0], HEAD_HALF[1], (GRASP_HEIGHT + BROOM_TOP) / 2),
            middle=(0.0, 0.0, (BROOM_TOP - GRASP_HEIGHT) / 2),
            grip=Grip((0.0, 0.0, 0.0), (0.017, 0.024, 0.025), (0.018, 0.024, 0.017)),
            tips=True,
        ),
        ObjectSpec(TOY, "block", TOY_HALF, PINK),
        ObjectSpec(
            PAN,
            "fixture",
            fixed=PAN_AT,
            parts=PAN_PARTS,
            half=(*PAN_HALF, PAN_WALL / 2),
            middle=(0.0, 0.0, PAN_WALL / 2),
            seat=Seat((0.0, 0.0, PAN_FLOOR), PAN_HALF),
        ),
    )
    state_fields = (
        StateField(
            "broom_position",
            3,
            "m",
            "grasp site on the broom's handle, base frame",
            (0.38, -0.25, table.HEIGHT + 0.05),
            (0.75, 0.25, table.HEIGHT + 0.20),
        ),
        StateField("toy_position", 2, "m", "x and y of the toy's centre, base frame", (0.45, -0.15), (0.80, 0.15)),
        StateField("broom_grasped", 1, "", "1 while the broom is in the hand, else 0", (0.0,), (1.0,)),
    )
    skills = (
        table.picking(x=PICK_X, y=PICK_Y, z=PICK_Z, yaw=0.0),
        SkillSpec(
            "push",
            table.push("where the push starts", x=PUSH_X, y=PUSH_Y, z=PUSH_Z, delta=PUSH_DELTA),
            "Come down at a position and move straight on, with closed fingers or with what they hold.",
            yaw=0.0,
        ),
    )
    subgoals = (
        Subgoal("pick up the broom", "pick up the broom by its blue handle"),
        Subgoal("sweep the toy", "sweep the pink toy into the green dustpan"),
    )

    def __init__(self, layout: SweepingLayout | None = None) -> None:
        self.layout = layout or SweepingLayout()

    def state(self, scene: Scene) -> Array:
        """(6,) broom x, y, z and toy x, y in m, base frame; whether the broom is held."""
        held = float(scene.held == BROOM)
        return np.concatenate((scene.objects[BROOM], scene.objects[TOY][:2], [held]), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """The broom standing left or right, the toy flat before the dustpan; the gripper open and above them."""
        ranges = self.layout
        broom_x, aside, toy_x, toy_y = draw(rng, ranges.broom_x, ranges.broom_aside, ranges.toy_x, ranges.toy_y)
        side = 1.0 if rng.random() < 0.5 else -1.0
        return {
            BROOM: np.array([broom_x, side * aside, table.HEIGHT + GRASP_HEIGHT]),
            TOY: np.array([toy_x, toy_y, table.HEIGHT + TOY_HALF]),
            "gripper": np.array(draw(rng, (0.46, 0.60), (-0.08, 0.08), table.above(0.20, 0.28))),
        }

    def success(self, scene: Scene) -> bool:
        """Whether the toy lies inside the dustpan's rectangle."""
        x, y, z = scene.objects[TOY]
        inside = abs(x - PAN_AT[0]) <= PAN_HALF[0] and abs(y - PAN_AT[1]) <= PAN_HALF[1]
        return bool(inside and table.HEIGHT <= z <= table.HEIGHT + SWEPT_Z)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """A broom that fell, or a broom or toy where no skill of this task can do anything about it."""
        found = misplaced(scene, BROOM, PICK_X, PICK_Y, "the broom")
        if not self.success(scene):
            reach = (PUSH_X[0] + BEHIND, PUSH_X[1] + BEHIND)
            found += misplaced(scene, TOY, reach, PUSH_Y, "the toy")
        return tuple(found)

    def subgoal(self, state: Array) -> int:
        """0 (pick) until the broom is in the hand, then 1 (push)."""
        return int(state[5] > 0.5)

    def box(self, state: Array) -> Box:
        """Pick at the broom's grasp site; then push along x from before the toy into the dustpan."""
        s = state.tolist()
        if s[5] > 0.5:
            start = _before(s[3], s[4])
            return Box("push", (*start, PUSH_END), PUSH_BELOW, PUSH_ABOVE)
        return Box("pick", (s[0], s[1], s[2]), PICK_BELOW, PICK_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(2, 3): the broom's grasp site, and where a push of the toy starts; with `skill`, (1, 3)."""
        points = {"pick": state[:3].tolist(), "push": _before(float(state[3]), float(state[4]))}
        return np.array([at for name, at in points.items() if skill in {None, name}]).reshape(-1, 3)


def _before(toy_x: float, toy_y: float) -> Vector:
    """Where the grip site starts to push the toy, the broom standing on the table."""
    return (toy_x - BEHIND, toy_y, table.HEIGHT + GRASP_HEIGHT)
