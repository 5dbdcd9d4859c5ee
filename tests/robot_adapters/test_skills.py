"""The skills' logic on an ideal arm: paths, limits, stops and why they end. Physics is tested with the simulator."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from robot_adapters import skills
from robot_adapters.base import Array, EndReason, ParameterSpec, SkillCall, SkillSpec
from robot_adapters.skills import BRAKING, clear_yaw, run_skill

TABLE = -0.1
START = np.array([0.4, -0.1, 0.1])
XYZ = ("x", "y", "z")


class IdealArm:
    """Goes a share of the way to each set-point; a floor stops it, `grip` is what its fingers close on, m.

    From set-point number `limit` on, a force is over its limit.
    """

    table_height = TABLE

    def __init__(self, *, share: float = 0.6, floor: float = -math.inf, grip: float = 0.04,
                 limit: int | None = None) -> None:  # fmt: skip
        self.at, self.yaw, self.closed = START.copy(), 0.0, False
        self.share, self.floor, self.grip, self.limit = share, floor, grip, limit
        self.set_points: list[tuple[Array, float, bool]] = []
        self.path: list[Array] = []

    def pose(self) -> tuple[Array, float]:
        return self.at.copy(), self.yaw

    def gripper_width(self) -> float:
        return self.grip if self.closed else 0.08

    def gripper_closed(self) -> bool:
        return self.closed

    def step(self, target: Array, yaw: float, gripper_closed: bool) -> None:
        self.set_points.append((target.copy(), yaw, gripper_closed))
        self.at += self.share * (target - self.at)
        self.at[2] = max(self.at[2], self.floor)
        self.yaw += self.share * (yaw - self.yaw)
        self.closed = gripper_closed
        self.path.append(self.at.copy())

    def overload(self) -> str | None:
        return "too much" if self.limit is not None and len(self.path) >= self.limit else None


def spec(name: str, *names: str) -> SkillSpec:
    return SkillSpec(name, tuple(ParameterSpec(n, "m", -2.0, 2.0) for n in names))


def run(arm: IdealArm, name: str, *values: float, names: tuple[str, ...] = XYZ, stop_after: float = math.inf,
        yaw: float | None = None) -> tuple[EndReason, int]:  # fmt: skip
    hooked = 0

    def hook() -> None:
        nonlocal hooked
        hooked += 1

    end, steps = run_skill(
        arm, SkillCall(name, values), spec(name, *names),
        should_stop=lambda: len(arm.set_points) >= stop_after, on_step=hook, yaw=yaw,
    )  # fmt: skip
    assert steps == hooked == len(arm.set_points)
    return end, steps


def test_reach_arrives_within_tolerance() -> None:
    arm = IdealArm()
    end, _ = run(arm, "reach", 0.6, 0.1, 0.0)
    assert end is EndReason.ARRIVED
    assert np.linalg.norm(arm.at - [0.6, 0.1, 0.0]) <= skills.FINE_TOLERANCE


def test_no_set_point_is_farther_than_the_cap() -> None:
    arm = IdealArm(share=0.3)
    run(arm, "pick", 0.6, 0.1, 0.0, yaw=math.pi / 2)
    before = [START, *arm.path]
    for (target, _, _), here in zip(arm.set_points, before, strict=False):
        assert np.linalg.norm(target - here) <= skills.STEP_CAP + skills.OFF_LINE


def test_sideways_motion_stays_above_the_blocks() -> None:
    arm = IdealArm()
    arm.at = np.array([0.4, -0.1, TABLE + 0.02])
    run(arm, "pick", 0.7, 0.1, TABLE + 0.02)
    for before, after in itertools.pairwise(arm.path):
        if np.linalg.norm((after - before)[:2]) > 0.01:
            assert before[2] > TABLE + 0.10


def test_pick_closes_at_the_target_and_lifts() -> None:
    arm = IdealArm()
    end, _ = run(arm, "pick", 0.6, 0.1, 0.0)
    assert end is EndReason.ARRIVED
    first = next(i for i, (_, _, closed) in enumerate(arm.set_points) if closed)
    assert np.linalg.norm(arm.path[first - 1] - [0.6, 0.1, 0.0]) <= skills.FINE_TOLERANCE
    assert arm.closed
    assert arm.at[2] > TABLE + skills.TRANSIT_CLEARANCE - skills.TRANSIT_TOLERANCE


def test_pick_of_nothing_says_so() -> None:
    assert run(IdealArm(grip=0.0), "pick", 0.6, 0.1, 0.0)[0] is EndReason.NOTHING_GRASPED


def test_place_opens_at_the_target_and_carries_it_closed() -> None:
    arm = IdealArm()
    arm.closed = True
    assert run(arm, "place", 0.6, 0.1, 0.0)[0] is EndReason.ARRIVED
    opened = next(i for i, (_, _, closed) in enumerate(arm.set_points) if not closed)
    assert np.linalg.norm(arm.path[opened - 1] - [0.6, 0.1, 0.0]) <= skills.FINE_TOLERANCE
    assert not any(closed for _, _, closed in arm.set_points[opened:])


@pytest.mark.parametrize(("direction", "shift"), [(-1.0, (0.1, 0.0)), (1.0, (0.0, 0.1))])
def test_push_goes_along_its_axis_with_closed_fingers(direction: float, shift: tuple[float, float]) -> None:
    arm = IdealArm()
    end, _ = run(arm, "push", 0.5, 0.0, 0.0, direction, 0.1, names=(*XYZ, "direction", "delta"))
    assert end is EndReason.ARRIVED
    low = np.array([p for p in arm.path if p[2] < 0.01])
    assert low[-1][:2] == pytest.approx([0.5 + shift[0], shift[1]], abs=0.005)
    assert all(closed for _, _, closed in arm.set_points)


def test_release_opens_where_the_gripper_is() -> None:
    arm = IdealArm()
    arm.closed = True
    assert run(arm, "release", names=()) == (EndReason.ARRIVED, skills.OPENING_DWELL)
    assert not arm.closed
    assert arm.at == pytest.approx(START)


def test_yaw_is_turned_before_the_descent() -> None:
    arm = IdealArm()
    run(arm, "pick", 0.4, -0.1, 0.0, 1.2, names=(*XYZ, "yaw"))
    descent = next(i for i, p in enumerate(arm.path) if p[2] < 0.05)
    assert arm.set_points[descent][1] == pytest.approx(1.2, abs=0.03)


def test_the_gripper_never_goes_into_the_table() -> None:
    arm = IdealArm()
    run(arm, "reach", 0.4, -0.1, TABLE - 0.05)
    assert min(p[2] for p in arm.path) >= TABLE + skills.LOWEST - 1e-9


def test_an_arm_that_is_blocked_stalls() -> None:
    arm = IdealArm(floor=0.05)
    end, steps = run(arm, "pick", 0.4, -0.1, 0.0)
    assert end is EndReason.STALLED
    assert steps < 40
    assert not any(closed for _, _, closed in arm.set_points)


def test_touching_near_the_target_is_good_enough_to_let_go() -> None:
    arm = IdealArm(floor=0.01)
    arm.closed = True
    assert run(arm, "place", 0.4, -0.1, 0.0)[0] is EndReason.ARRIVED
    assert not arm.closed


def test_an_arm_that_creeps_times_out() -> None:
    arm = IdealArm(share=0.012)
    end, steps = run(arm, "reach", 1.4, -0.1, 0.1)
    assert end is EndReason.TIMEOUT
    assert steps == skills.SEGMENT_LIMIT


@pytest.mark.parametrize("stop_after", [0, 1, 7, 11, 14])
def test_a_stop_sends_one_set_point_that_holds_the_present_pose(stop_after: int) -> None:
    arm = IdealArm()
    end, steps = run(arm, "pick", 0.6, 0.1, 0.0, stop_after=stop_after)
    assert end is EndReason.STOPPED
    assert steps == stop_after + 1
    held = arm.path[-2] if stop_after else START
    target, _, closed = arm.set_points[-1]
    assert target == pytest.approx(held)
    assert stop_after == 0 or closed == arm.set_points[-2][2]


def test_a_stop_keeps_what_is_held() -> None:
    arm = IdealArm()
    arm.closed = True
    run(arm, "place", 0.6, 0.1, 0.0, stop_after=3)
    assert arm.closed


@pytest.mark.parametrize(
    ("neighbour", "yaw"),
    [((0.6, 0.07), math.pi / 2), ((0.6, -0.07), math.pi / 2), ((0.67, 0.0), 0.0), ((0.9, 0.3), 0.0)],
)
def test_the_fingers_turn_away_from_a_neighbour(neighbour: tuple[float, float], yaw: float) -> None:
    assert clear_yaw(np.array([0.6, 0.0, 0.0]), [np.array([*neighbour, 0.0])]) == yaw


def test_without_neighbours_the_gripper_is_straight() -> None:
    assert clear_yaw(np.array([0.6, 0.0, 0.0]), []) == 0.0


def test_an_overload_ends_the_skill_and_the_arm_brakes() -> None:
    arm = IdealArm(limit=3)
    end, steps = run(arm, "reach", 0.5, 0.1, 0.2)
    assert end is EndReason.FORCE_LIMIT
    assert steps == len(arm.set_points) == 3 + BRAKING
    held = arm.path[2]
    assert all(target == pytest.approx(held) for target, _, _ in arm.set_points[3:])


def test_a_push_arrives_although_what_is_held_stands_on_the_table() -> None:
    arm = IdealArm(floor=TABLE + 0.03)
    end, _ = run(arm, "push", 0.4, 0.0, TABLE + 0.02, -1.0, 0.2, names=("x", "y", "z", "direction", "delta"))
    assert end is EndReason.ARRIVED
    assert max(at[0] for at in arm.path) == pytest.approx(0.6, abs=5e-3)
