"""Cooking-Hotdog (paper, section 'Long-horizon manipulation tasks'): cook a sausage in a skillet, put it in a bun."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from robot_adapters.base import Array, SafetyViolation, Scene
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Grip, ObjectSpec, Part, Seat, StateField, Subgoal, Vector
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.layout import LayoutSettings, Range, draw
from robot_adapters.tasks.rules import TILTED, misplaced

SAUSAGE, SKILLET, STOVE, BUN = "sausage", "skillet", "stove", "bun"
COOKED = "cooked"
"""The event that is remembered."""
BLUE, IRON, GREY, RED = (0.13, 0.36, 0.85), (0.20, 0.21, 0.23), (0.60, 0.62, 0.65), (0.88, 0.16, 0.14)
MEAT, BREAD, CRUST = (0.70, 0.25, 0.17), (0.93, 0.76, 0.47), (0.79, 0.56, 0.28)

# A round pan with a handle towards the robot. Its origin is on its axis, half its height above what it stands on
PAN_RADIUS, PAN_HALF_HEIGHT, PAN_FLOOR = 0.085, 0.015, 0.004
HANDLE_X = -0.125
"""x of the grasp site on the handle, from the skillet's origin."""
HANDLE_Z = 0.015
HANDLE_HALF: Vector = (0.045, 0.012, 0.010)
SKILLET_GRASP: Vector = (HANDLE_X, 0.0, HANDLE_Z)
FLOOR_Z = PAN_FLOOR - PAN_HALF_HEIGHT
"""z of the pan's floor, from the skillet's origin."""

# The sausage lies along x
SAUSAGE_HALF: Vector = (0.045, 0.012, 0.012)
SAUSAGE_GRASP_Z = 0.004
"""The grip site is best this far above the sausage's centre."""

STOVE_AT: Vector = (0.68, 0.14, table.HEIGHT)
STOVE_HALF: Vector = (0.085, 0.085, 0.015)
BUN_AT: Vector = (0.42, 0.06, table.HEIGHT)
# along x, with sides that lean outwards: what comes down between them slides to the middle
BUN_HALF: Vector = (0.06, 0.035, 0.018)
BUN_FLOOR = 0.010

ON_STOVE = 0.045
"""The skillet's centre is at most this far from the stove's, upright."""
ON_STOVE_Z = 0.012
COOKING = 0.06
"""The sausage's centre is at most this far from the pan's."""
COOKING_Z = 0.015
IN_BUN = (0.035, 0.015)
IN_BUN_Z = 0.050

# The teacher's boxes, m. Inside them a skill succeeds in simulation
HANDLE_BELOW = HANDLE_ABOVE = (0.020, 0.020, 0.008)
SAUSAGE_BELOW = SAUSAGE_ABOVE = (0.020, 0.020, 0.004)
PLACE_BELOW, PLACE_ABOVE = (0.020, 0.020, 0.005), (0.020, 0.020, 0.025)
BUN_BELOW, BUN_ABOVE = (0.015, 0.008, 0.004), (0.015, 0.008, 0.020)
SETTLE = 0.002
"""What is placed is let go this far above where it will rest, not pressed in."""

PICK_X, PICK_Y, PICK_Z = (0.35, 0.75), (-0.17, 0.21), table.above(0.01, 0.068)
PLACE_X, PLACE_Y, PLACE_Z = (0.38, 0.73), (0.01, 0.19), table.above(0.02, 0.12)


class CookingHotdogLayout(LayoutSettings):
    """Where skillet and sausage start; stove and bun have their places."""

    skillet_x: Range = Field((0.65, 0.68), description="x of the skillet's centre, m")
    skillet_y: Range = Field((-0.13, -0.09), description="y of the skillet's centre, m")
    sausage_x: Range = Field((0.38, 0.41), description="x of the sausage's centre, m")
    sausage_y: Range = Field((-0.14, -0.07), description="y of the sausage's centre, m")


class CookingHotdog(Boxed):
    """State: sausage, skillet, and five flags. The longest of the paper's tasks."""

    name = "cooking_hotdog"
    title = "Cooking-Hotdog"
    instruction = "Put the skillet on the stove, cook the sausage in it, and put the sausage into the bun."
    reset_by_hand = (
        "Put the skillet and the sausage back on the table, apart from each other, clear of the stove and of the bun."
    )
    table_height = table.HEIGHT
    horizon = 12
    objects = (
        ObjectSpec(
            SKILLET,
            "thing",
            parts=(
                Part((0.0, 0.0, 0.0), (PAN_RADIUS, PAN_RADIUS, PAN_HALF_HEIGHT), IRON, "disc"),
                Part((HANDLE_X, 0.0, HANDLE_Z), HANDLE_HALF, BLUE),
            ),
            half=(PAN_RADIUS, PAN_RADIUS, PAN_HALF_HEIGHT),
            grip=Grip(SKILLET_GRASP, (0.025, 0.025, 0.012), (0.025, 0.025, 0.014)),
            seat=Seat((0.0, 0.0, FLOOR_Z), (COOKING, COOKING)),
            tips=True,
        ),
        ObjectSpec(
            SAUSAGE,
            "thing",
            parts=(Part((0.0, 0.0, 0.0), SAUSAGE_HALF, MEAT),),
            half=SAUSAGE_HALF,
            grip=Grip((0.0, 0.0, SAUSAGE_GRASP_Z), (0.030, 0.025, 0.008), (0.030, 0.025, 0.008)),
        ),
        ObjectSpec(
            STOVE,
            "fixture",
            fixed=STOVE_AT,
            parts=(
                Part((0.0, 0.0, STOVE_HALF[2]), STOVE_HALF, GREY),
                Part((0.0, 0.0, 2 * STOVE_HALF[2]), (0.075, 0.075, 0.0005), RED, "ring"),
            ),
            half=STOVE_HALF,
            middle=(0.0, 0.0, STOVE_HALF[2]),
            seat=Seat((0.0, 0.0, 2 * STOVE_HALF[2]), (ON_STOVE, ON_STOVE)),
        ),
        ObjectSpec(
            BUN,
            "fixture",
            fixed=BUN_AT,
            parts=(
                Part((0.0, 0.0, BUN_FLOOR / 2), (BUN_HALF[0], BUN_HALF[1], BUN_FLOOR / 2), BREAD),
                *(Part((0.0, side * 0.026, BUN_HALF[2]), (BUN_HALF[0], 0.009, BUN_HALF[2]), CRUST) for side in (-1, 1)),
            ),
            half=BUN_HALF,
            middle=(0.0, 0.0, BUN_HALF[2]),
            seat=Seat((0.0, 0.0, BUN_FLOOR), (IN_BUN[0], 0.004), funnel=(IN_BUN[0], 0.014)),
        ),
    )
    state_fields = (
        StateField(
            "sausage_position",
            3,
            "m",
            "centre of the sausage, base frame",
            (0.35, -0.20, table.HEIGHT),
            (0.80, 0.25, table.HEIGHT + 0.20),
        ),
        StateField(
            "skillet_position",
            3,
            "m",
            "on the skillet's axis at half its height, base frame",
            (0.50, -0.20, table.HEIGHT),
            (0.80, 0.25, table.HEIGHT + 0.20),
        ),
        StateField("skillet_held", 1, "", "1 while the skillet is in the hand, else 0", (0.0,), (1.0,)),
        StateField("skillet_on_stove", 1, "", "1 while the skillet stands on the stove, else 0", (0.0,), (1.0,)),
        StateField("sausage_held", 1, "", "1 while the sausage is in the hand, else 0", (0.0,), (1.0,)),
        StateField("sausage_cooked", 1, "", "1 once the sausage lay in the skillet on the stove", (0.0,), (1.0,)),
        StateField("sausage_in_bun", 1, "", "1 while the sausage lies in the bun, else 0", (0.0,), (1.0,)),
    )
    skills = (
        table.picking(x=PICK_X, y=PICK_Y, z=PICK_Z, yaw=0.0),
        table.placing(x=PLACE_X, y=PLACE_Y, z=PLACE_Z, yaw=0.0),
    )
    subgoals = (
        Subgoal("pick up the skillet", "pick up the skillet by its blue handle"),
        Subgoal("put it on the stove", "put the skillet on the stove's red ring"),
        Subgoal("pick up the sausage", "pick up the sausage"),
        Subgoal("put it in the skillet", "put the sausage into the skillet to cook it"),
        Subgoal("pick up the cooked sausage", "pick the cooked sausage up again"),
        Subgoal("put it in the bun", "put the sausage into the bun"),
    )

    def __init__(self, layout: CookingHotdogLayout | None = None) -> None:
        self.layout = layout or CookingHotdogLayout()

    def state(self, scene: Scene) -> Array:
        """(11,) sausage x, y, z, skillet x, y, z in m, base frame; then the five flags."""
        flags = (
            scene.held == SKILLET,
            _on_stove(scene),
            scene.held == SAUSAGE,
            COOKED in scene.latched or _cooks(scene),
            _in_bun(scene),
        )
        return np.concatenate((scene.objects[SAUSAGE], scene.objects[SKILLET], flags), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """Skillet and sausage on the table on the right, the gripper open and above them."""
        ranges = self.layout
        x, y = draw(rng, ranges.skillet_x, ranges.skillet_y)
        sausage_x, sausage_y = draw(rng, ranges.sausage_x, ranges.sausage_y)
        return {
            SKILLET: np.array([x, y, table.HEIGHT + PAN_HALF_HEIGHT]),
            SAUSAGE: np.array([sausage_x, sausage_y, table.HEIGHT + SAUSAGE_HALF[2]]),
            "gripper": np.array(draw(rng, (0.46, 0.60), (-0.08, 0.08), table.above(0.20, 0.28))),
        }

    def success(self, scene: Scene) -> bool:
        """Whether the cooked sausage lies in the bun."""
        return COOKED in scene.latched and _in_bun(scene)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """Skillet or sausage off the table, fallen over, or where no skill of this task can take it."""
        handle = (PICK_X[0] - HANDLE_X, PICK_X[1] - HANDLE_X)
        return (
            *misplaced(scene, SKILLET, handle, PICK_Y, "the skillet"),
            *misplaced(scene, SAUSAGE, PICK_X, PICK_Y, "the sausage", rolls=True),
        )

    def events(self, scene: Scene) -> frozenset[str]:
        """The sausage is cooked once it lay in the skillet on the stove, both let go of."""
        return frozenset({COOKED}) if _cooks(scene) else frozenset()

    def subgoal(self, state: Array) -> int:
        """The first of the six that is left to do.

        A raw sausage in the hand while the skillet isn't on the stove has nowhere to go: the skillet comes first, and
        to pick it the gripper lets go of the sausage.
        """
        skillet_held, on_stove, sausage_held, cooked, _ = (bool(flag > 0.5) for flag in state[6:])
        if cooked:
            return 5 if sausage_held else 4
        if not on_stove:
            return int(skillet_held)
        return 3 if sausage_held else 2

    def box(self, state: Array) -> Box:
        """Pick at a handle or the sausage, place where it will rest."""
        s = state.tolist()
        sausage, skillet = (s[0], s[1], s[2]), (s[3], s[4], s[5])
        match self.subgoal(state):
            case 0:
                return Box("pick", _handle(skillet), HANDLE_BELOW, HANDLE_ABOVE)
            case 1:
                return Box("place", _raised(_handle(ON_THE_STOVE), SETTLE), PLACE_BELOW, PLACE_ABOVE)
            case 3:
                return Box("place", _in_pan(skillet), PLACE_BELOW, PLACE_ABOVE)
            case 5:
                return Box("place", OVER_BUN, BUN_BELOW, BUN_ABOVE)
            case _:
                return Box("pick", _raised(sausage, SAUSAGE_GRASP_Z), SAUSAGE_BELOW, SAUSAGE_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(5, 3): handle and sausage to pick; over stove, pan and bun to place; with `skill`, (2, 3) or (3, 3)."""
        s = state.tolist()
        skillet = (s[3], s[4], s[5])
        points = {
            "pick": [_handle(skillet), (s[0], s[1], s[2])],
            "place": [_handle(ON_THE_STOVE), _in_pan(skillet), OVER_BUN],
        }
        return np.array([at for name, all_ in points.items() if skill in {None, name} for at in all_]).reshape(-1, 3)


def _raised(at: Vector, by: float) -> Vector:
    return (at[0], at[1], at[2] + by)


def _handle(skillet: Vector) -> Vector:
    """The grasp site of a skillet at this place."""
    return (skillet[0] + HANDLE_X, skillet[1], skillet[2] + HANDLE_Z)


def _in_pan(skillet: Vector) -> Vector:
    """Where the grip site lets a sausage go into a skillet at this place."""
    return _raised(skillet, FLOOR_Z + SAUSAGE_HALF[2] + SAUSAGE_GRASP_Z + SETTLE)


ON_THE_STOVE: Vector = _raised(STOVE_AT, 2 * STOVE_HALF[2] + PAN_HALF_HEIGHT)
"""The skillet's origin when it stands on the stove's middle."""
OVER_BUN: Vector = _raised(BUN_AT, BUN_FLOOR + SAUSAGE_HALF[2] + SAUSAGE_GRASP_Z + SETTLE)
"""Where the grip site lets the sausage go into the bun."""


def _on_stove(scene: Scene) -> bool:
    """Whether the skillet stands upright on the stove, let go of."""
    offset = np.asarray(scene.objects[SKILLET]) - ON_THE_STOVE
    stands = float(np.hypot(*offset[:2])) <= ON_STOVE and abs(float(offset[2])) <= ON_STOVE_Z
    return stands and scene.held != SKILLET and scene.tilts.get(SKILLET, 0.0) <= TILTED


def _cooks(scene: Scene) -> bool:
    """Whether the sausage lies in the skillet on the stove, both let go of."""
    x, y, z = np.asarray(scene.objects[SAUSAGE]) - scene.objects[SKILLET]
    lies = float(np.hypot(x, y)) <= COOKING and abs(float(z) - FLOOR_Z - SAUSAGE_HALF[2]) <= COOKING_Z
    return lies and scene.held != SAUSAGE and _on_stove(scene)


def _in_bun(scene: Scene) -> bool:
    """Whether the sausage lies in the bun, let go of."""
    x, y, z = np.asarray(scene.objects[SAUSAGE]) - BUN_AT
    return bool(abs(x) < IN_BUN[0] and abs(y) < IN_BUN[1] and 0 < z < IN_BUN_Z and scene.held != SAUSAGE)
