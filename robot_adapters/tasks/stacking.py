"""Stacking (paper, section 'Long-horizon manipulation tasks'): put the small block on top of the large one."""

from __future__ import annotations

import math

import numpy as np

from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall, SkillSpec
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal

A, B = "block_a", "block_b"
HALF_A, HALF_B = 0.02, 0.025

# As in robosuite's Stack, whose blocks start within 8 cm of the table's middle
SPREAD = 0.08
# centre to centre: the open fingers (5 cm to each side of a block) must miss the other block (2.5 cm)
SEPARATION = 0.085
# A's centre stands 45 mm above B's when stacked; 2 mm on top let it settle instead of being pressed in
PLACE_ABOVE = HALF_A + HALF_B + 0.002

# The teacher's boxes around the two targets, m: (x and y, below, above). Inside them a skill succeeds in simulation
PICK_BOX = (0.015, 0.015, 0.012)
PLACE_BOX = (0.015, 0.008, 0.025)

# A block tips over the edge beyond half the lower one's size; a turned square reaches a little further
STACKED_XY = 0.03
STACKED_Z = 0.010
RAISED = 0.02
"""A block this much above where the table would hold it is between the fingers, or on the other block."""
REACH_MARGIN = 0.005
"""A block this little outside the workspace can still be taken off-centre."""

_FIELD_LOW = (table.X[0], table.Y[0], table.HEIGHT)
_FIELD_HIGH = (table.X[1], table.Y[1], table.HEIGHT + 0.25)


class Stacking:
    """Block A (small, red) goes on block B (large, green). State: both centres, nothing of the robot."""

    name = "stacking"
    title = "Stacking"
    instruction = "Stack the red block on the green block."
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
        SkillSpec("pick", table.position("where the fingers close"), "Take what is at a position, and lift it."),
        SkillSpec("place", table.position("where the fingers open"), "Bring what is held to a position; let go."),
    )
    subgoals = (
        Subgoal("pick", "pick up the red block"),
        Subgoal("place", "place it on the green block"),
    )

    def state(self, scene: Scene) -> Array:
        """(6,) centres of block A and block B, m, robot base frame."""
        return np.concatenate((scene.objects[A], scene.objects[B]), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """Both blocks flat on the table near its middle, `SEPARATION` apart; the gripper open and above them."""
        while True:
            a, b = rng.uniform(-SPREAD, SPREAD, size=(2, 2)) + table.CENTRE
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
        found = []
        for spec in self.objects:
            x, y, z = (float(v) for v in scene.objects[spec.name])
            if scene.held == spec.name:
                continue
            if z < table.HEIGHT:
                found.append(SafetyViolation("manual_reset", f"{spec.name} fell off the table"))
            elif not (_within(x, table.X) and _within(y, table.Y)):
                found.append(SafetyViolation("manual_reset", f"{spec.name} is out of reach"))
        return tuple(found)

    def subgoal(self, state: Array) -> int:
        """0 (pick) until A is off the table, then 1 (place)."""
        return int(_raised(state.tolist()))

    def judge(self, state: Array, call: SkillCall) -> int:
        """+1 for a pick at block A while it is on the table, or a place on block B while A is raised; otherwise -1.

        A block on the other that isn't let go of yet looks as if it were stacked; to place it is still right.
        """
        s = state.tolist()
        if call.skill == "place" and _raised(s):
            return _judge_box(call, (s[3], s[4], s[5] + PLACE_ABOVE), PLACE_BOX)
        if call.skill == "pick" and not _raised(s):
            return _judge_box(call, (s[0], s[1], s[2]), PICK_BOX)
        return -1

    def true_call(self, state: Array) -> SkillCall:
        """Pick A at its centre, or place it just above B; kept inside the workspace."""
        s = state.tolist()
        held = self.subgoal(state) == 1
        target = (s[3], s[4], s[5] + PLACE_ABOVE) if held else (s[0], s[1], s[2])
        inside = tuple(
            min(max(v, low), high) for v, (low, high) in zip(target, (table.X, table.Y, table.Z), strict=True)
        )
        return SkillCall("place" if held else "pick", inside)

    def keypoints(self, state: Array) -> Array:
        """(2, 3) centres of A and B, m, robot base frame."""
        return state.reshape(2, 3).copy()


def _stacked(s: list[float]) -> bool:
    """Whether A rests on B, from the state alone."""
    return math.hypot(s[0] - s[3], s[1] - s[4]) <= STACKED_XY and abs(s[2] - s[5] - HALF_A - HALF_B) <= STACKED_Z


def _raised(s: list[float]) -> bool:
    """Whether A is off the table: as long as the task isn't solved, that is in the hand."""
    return s[2] > table.HEIGHT + HALF_A + RAISED


def _within(value: float, bounds: tuple[float, float]) -> bool:
    return bounds[0] - REACH_MARGIN <= value <= bounds[1] + REACH_MARGIN


def _judge_box(call: SkillCall, centre: tuple[float, float, float], box: tuple[float, float, float]) -> int:
    """+1 inside `box` (half width in x and y, below, above) around `centre`, else -1."""
    dx, dy, dz = (p - c for p, c in zip(call.parameters, centre, strict=True))
    wide, below, above = box
    # 1e-9: the box includes its faces, whatever rounding did to them
    inside = abs(dx) <= wide + 1e-9 and abs(dy) <= wide + 1e-9 and -below - 1e-9 <= dz <= above + 1e-9
    return 1 if inside else -1
