"""Collecting-Toy (paper, section 'Long-horizon manipulation tasks'): put a toy into a drawer and push it closed."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from robot_adapters.base import Array, SafetyViolation, Scene, SkillSpec
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Grip, ObjectSpec, Part, Seat, StateField, Subgoal, Vector
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.layout import LayoutSettings, Range, draw
from robot_adapters.tasks.rules import by_hand, misplaced

TOY, DRAWER, CABINET = "toy", "drawer", "cabinet"
BLUE, PINK = (0.13, 0.36, 0.85), (0.95, 0.38, 0.66)
WOOD, DARK = (0.80, 0.66, 0.48), (0.55, 0.43, 0.30)

TOY_HALF = 0.02

# The tray slides along x; closed, all of it is inside the cabinet. Its origin is the middle of its floor's top
TRAY_HALF = (0.065, 0.06)
"""Inner half sizes, x and y."""
WALL = 0.004
"""Half the thickness of the tray's walls."""
TRAY_WALL, TRAY_FLOOR = 0.035, 0.006
TRAY_CLOSED: Vector = (0.775, 0.0, table.HEIGHT + TRAY_FLOOR)
"""Where the tray's origin is when the drawer is closed."""
FRONT = -TRAY_HALF[0] - 2 * WALL
"""x of the tray's front face, from its origin."""
PROTRUDES = 0.03
HANDLE_Z = 0.03
"""The handle's height above the table."""
HANDLE = Part((FRONT - PROTRUDES / 2, 0.0, HANDLE_Z - TRAY_FLOOR), (PROTRUDES / 2, 0.03, 0.008), BLUE)
HANDLE_TIP = FRONT - PROTRUDES
"""x of the handle's face towards the robot, from the tray's origin."""
TRAY_PARTS = (
    Part((0.0, 0.0, -TRAY_FLOOR / 2), (TRAY_HALF[0], TRAY_HALF[1], TRAY_FLOOR / 2), WOOD),
    *(
        Part((side * (TRAY_HALF[0] + WALL), 0.0, TRAY_WALL / 2), (WALL, TRAY_HALF[1] + 2 * WALL, TRAY_WALL / 2), WOOD)
        for side in (-1, 1)
    ),
    *(
        Part((0.0, side * (TRAY_HALF[1] + WALL), TRAY_WALL / 2), (TRAY_HALF[0], WALL, TRAY_WALL / 2), WOOD)
        for side in (-1, 1)
    ),
    HANDLE,
)
TRAVEL = 0.18
"""How far the drawer opens at most."""

# It begins where the closed tray's front is, so that a hand that pushes the handle stays before it. Its top is
# see-through: a trainer sees what is in the closed drawer
CABINET_HALF: Vector = (0.083, 0.08, 0.031)
CABINET_AT: Vector = (TRAY_CLOSED[0] + 0.008, 0.0, table.HEIGHT)
CABINET_PARTS = (
    *(
        Part((0.0, side * (CABINET_HALF[1] - 0.004), CABINET_HALF[2]), (CABINET_HALF[0], 0.004, CABINET_HALF[2]), DARK)
        for side in (-1, 1)
    ),
    Part((CABINET_HALF[0] - 0.004, 0.0, CABINET_HALF[2]), (0.004, CABINET_HALF[1] - 0.008, CABINET_HALF[2]), DARK),
    Part((0.0, 0.0, 2 * CABINET_HALF[2] - 0.002), (CABINET_HALF[0], CABINET_HALF[1], 0.002), DARK, opacity=0.3),
)

CLOSED = 0.02
"""A drawer open by less than this counts as closed."""
IN_DRAWER_Z = 0.050
"""A toy inside the tray's rectangle and below this height above the table is in the drawer."""

# The teacher's boxes, m. Inside them a skill succeeds in simulation
PICK_ABOVE_CENTRE = 0.002
PICK_BELOW, PICK_ABOVE = (0.012, 0.015, 0.010), (0.012, 0.012, 0.012)
PLACE_HEIGHT = 0.10
PLACE_BELOW, PLACE_ABOVE = (0.040, 0.025, 0.020), (0.040, 0.025, 0.040)
BEFORE_HANDLE = 0.045
FINGER = 0.010
"""Half the closed fingers' size in x: the grip site is this far from the handle when they touch it."""
OVER_PUSH = 0.010
"""The right push ends this far beyond where the drawer is closed; the box, from 0 to 40 mm beyond."""
PUSH_BELOW, PUSH_ABOVE = (0.040, 0.020, 0.012, OVER_PUSH), (0.040, 0.020, 0.012, 0.040 - OVER_PUSH)

PICK_X, PICK_Y, PICK_Z = (0.34, 0.49), (-0.16, 0.16), table.above(0.01, 0.05)
PLACE_X, PLACE_Y, PLACE_Z = (0.42, 0.71), (-0.15, 0.15), table.above(0.05, 0.17)
PUSH_X, PUSH_Y, PUSH_Z = (0.40, 0.53), (-0.08, 0.08), table.above(0.01, 0.06)
PUSH_DELTA = (-0.10, 0.30)


class CollectingToyLayout(LayoutSettings):
    """Where the toy starts, and how far the drawer is open."""

    toy_x: Range = Field((0.37, 0.46), description="x of the toy, m")
    toy_y: Range = Field((-0.13, 0.13), description="y of the toy, m")
    opening: Range = Field((0.15, 0.17), description="how far the drawer is open, m")


class CollectingToy(Boxed):
    """State: the toy's centre, how far the drawer is open, whether the toy is in the hand and in the drawer."""

    name = "collecting_toy"
    title = "Collecting-Toy"
    instruction = "Put the pink toy into the drawer and push the drawer closed."
    reset_by_hand = "Put the toy back on the table in front of the drawer, and pull the drawer open by its blue handle."
    table_height = table.HEIGHT
    horizon = 8
    objects = (
        ObjectSpec(
            TOY,
            "block",
            TOY_HALF,
            PINK,
            grip=Grip((0.0, 0.0, PICK_ABOVE_CENTRE), (0.018, 0.019, 0.012), (0.018, 0.019, 0.015)),
        ),
        ObjectSpec(
            DRAWER,
            "slider",
            fixed=TRAY_CLOSED,
            parts=TRAY_PARTS,
            half=(TRAY_HALF[0] + 2 * WALL, TRAY_HALF[1] + 2 * WALL, (TRAY_WALL + TRAY_FLOOR) / 2),
            middle=(0.0, 0.0, (TRAY_WALL - TRAY_FLOOR) / 2),
            seat=Seat((0.0, 0.0, 0.0), (TRAY_HALF[0] - TOY_HALF + 0.01, TRAY_HALF[1] - TOY_HALF + 0.01)),
            handle=HANDLE,
        ),
        ObjectSpec(
            CABINET,
            "fixture",
            fixed=CABINET_AT,
            parts=CABINET_PARTS,
            half=CABINET_HALF,
            middle=(0.0, 0.0, CABINET_HALF[2]),
            seat=Seat((0.0, 0.0, 2 * CABINET_HALF[2]), CABINET_HALF[:2]),
        ),
    )
    state_fields = (
        StateField(
            "toy_position",
            3,
            "m",
            "centre of the toy, base frame",
            (0.35, -0.17, table.HEIGHT),
            (0.80, 0.17, table.HEIGHT + 0.20),
        ),
        StateField("drawer_opening", 1, "m", "how far the drawer is from closed", (0.0,), (TRAVEL,)),
        StateField("toy_grasped", 1, "", "1 while the toy is in the hand, else 0", (0.0,), (1.0,)),
        StateField("toy_in_drawer", 1, "", "1 while the toy lies in the drawer, else 0", (0.0,), (1.0,)),
    )
    skills = (
        table.picking(x=PICK_X, y=PICK_Y, z=PICK_Z, yaw=0.0),
        SkillSpec(
            "push",
            table.push("where the push starts", x=PUSH_X, y=PUSH_Y, z=PUSH_Z, delta=PUSH_DELTA),
            "Come down at a position with closed fingers and move straight on.",
            yaw=0.0,
        ),
        table.placing(x=PLACE_X, y=PLACE_Y, z=PLACE_Z, yaw=0.0),
    )
    subgoals = (
        Subgoal("pick up the toy", "pick up the pink toy"),
        Subgoal("put it in the drawer", "put the toy into the open drawer"),
        Subgoal("close the drawer", "push the drawer's blue handle until the drawer is closed"),
    )

    def __init__(self, layout: CollectingToyLayout | None = None) -> None:
        self.layout = layout or CollectingToyLayout()

    def state(self, scene: Scene) -> Array:
        """(6,) toy x, y, z in m, base frame; drawer opening in m; toy held; toy in the drawer."""
        more = [scene.joints[DRAWER], float(scene.held == TOY), float(_in_drawer(scene))]
        return np.concatenate((scene.objects[TOY], more), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """The toy flat on the table between robot and open drawer; the gripper open and above them."""
        ranges = self.layout
        x, y, opening = draw(rng, ranges.toy_x, ranges.toy_y, ranges.opening)
        return {
            TOY: np.array([x, y, table.HEIGHT + TOY_HALF]),
            DRAWER: np.array([opening]),
            "gripper": np.array(draw(rng, (0.44, 0.58), (-0.08, 0.08), table.above(0.20, 0.28))),
        }

    def success(self, scene: Scene) -> bool:
        """Whether the drawer is closed with the toy in it."""
        return _in_drawer(scene) and scene.joints[DRAWER] < CLOSED

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """A drawer closed without the toy, or a toy where no skill of this task can take it."""
        if _in_drawer(scene):
            return ()
        found = [by_hand("the drawer is closed and the toy outside")] if scene.joints[DRAWER] < CLOSED else []
        return (*found, *misplaced(scene, TOY, PICK_X, PICK_Y, "the toy"))

    def subgoal(self, state: Array) -> int:
        """0 (pick) until the toy is in the hand, 1 (place) until it is in the drawer, then 2 (push)."""
        return 2 if state[5] > 0.5 else int(state[4] > 0.5)

    def box(self, state: Array) -> Box:
        """Pick at the toy; place above the tray's middle; push from before the handle to where it is closed."""
        match self.subgoal(state):
            case 0:
                x, y, z = state[:3].tolist()
                return Box("pick", (x, y, z + PICK_ABOVE_CENTRE), PICK_BELOW, PICK_ABOVE)
            case 1:
                return Box("place", _over_tray(float(state[3])), PLACE_BELOW, PLACE_ABOVE)
            case _:
                start = _before_handle(float(state[3]))
                end = TRAY_CLOSED[0] + HANDLE_TIP - FINGER + OVER_PUSH
                return Box("push", (*start, end), PUSH_BELOW, PUSH_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(3, 3): the toy, above the tray, and before the handle; with `skill`, (1, 3)."""
        opening = float(state[3])
        points = {"pick": state[:3].tolist(), "place": _over_tray(opening), "push": _before_handle(opening)}
        return np.array([at for name, at in points.items() if skill in {None, name}]).reshape(-1, 3)


def _in_drawer(scene: Scene) -> bool:
    """Whether the toy lies in the tray, and nothing holds it."""
    x, y, z = scene.objects[TOY]
    tray_x = TRAY_CLOSED[0] - scene.joints[DRAWER]
    inside = abs(x - tray_x) <= TRAY_HALF[0] and abs(y - TRAY_CLOSED[1]) <= TRAY_HALF[1]
    return bool(inside and table.HEIGHT <= z <= table.HEIGHT + IN_DRAWER_Z and scene.held != TOY)


def _over_tray(opening: float) -> Vector:
    """Where the toy is let go, for a drawer open by `opening` m."""
    return (TRAY_CLOSED[0] - opening, TRAY_CLOSED[1], table.HEIGHT + PLACE_HEIGHT)


def _before_handle(opening: float) -> Vector:
    """Where the grip site starts to push a drawer open by `opening` m."""
    return (TRAY_CLOSED[0] - opening + HANDLE_TIP - BEFORE_HANDLE, TRAY_CLOSED[1], table.HEIGHT + HANDLE_Z)
