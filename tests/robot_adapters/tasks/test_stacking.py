"""Stacking's rules."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot_adapters.base import Scene, SkillCall, check_call
from robot_adapters.tasks import table
from robot_adapters.tasks.stacking import (
    HALF_A,
    HALF_B,
    PICK_ABOVE,
    PICK_BELOW,
    PLACE_ABOVE,
    PLACE_BELOW,
    PLACE_OVER,
    SEPARATION,
    SPREAD,
    Stacking,
    X,
    Y,
)

TASK = Stacking()
ON_TABLE_A, ON_TABLE_B = table.HEIGHT + HALF_A, table.HEIGHT + HALF_B
B_AT = (0.60, -0.05, ON_TABLE_B)
START = (0.52, 0.05, ON_TABLE_A)
IN_HAND = (0.52, 0.05, table.HEIGHT + 0.17)
ON_B = (0.60, -0.05, ON_TABLE_B + HALF_A + HALF_B)
SEEDS = st.integers(0, 2**31 - 1)


def scene(a: tuple[float, ...], b: tuple[float, ...] = B_AT, held: str | None = None) -> Scene:
    return Scene({"block_a": np.array(a), "block_b": np.array(b)}, np.array([0.5, 0, 0.1]), held is not None, held)


def state(a: tuple[float, ...], b: tuple[float, ...] = B_AT) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return TASK.state(scene(a, b))


def moved(at: tuple[float, ...], axis: int, by: float) -> tuple[float, ...]:
    return tuple(v + by * (i == axis) for i, v in enumerate(at))


def test_the_state_is_the_papers() -> None:
    assert state(START).tolist() == [*START, *B_AT]
    assert [s.name for s in TASK.skills] == ["pick", "place"]
    assert TASK.keypoints(state(START)).tolist() == [list(START), list(moved(B_AT, 2, PLACE_ABOVE))]


@given(SEEDS)
def test_blocks_start_apart_on_the_table(seed: int) -> None:
    layout = TASK.sample_layout(np.random.default_rng(seed))
    a, b = layout["block_a"], layout["block_b"]
    for block, height in ((a, ON_TABLE_A), (b, ON_TABLE_B)):
        assert np.abs(block[:2] - table.CENTRE).max() <= SPREAD
        assert block[2] == height
    assert np.linalg.norm(a[:2] - b[:2]) >= SEPARATION
    assert layout["gripper"][2] > table.HEIGHT + 0.1
    start = Scene({"block_a": a, "block_b": b}, layout["gripper"], gripper_closed=False)
    assert not TASK.success(start)
    assert not TASK.violations(start)


@pytest.mark.parametrize(
    ("a", "held", "solved"),
    [
        (ON_B, None, True),
        (moved(ON_B, 0, 0.02), None, True),
        (moved(ON_B, 2, 0.005), None, True),
        (ON_B, "block_a", False),
        (moved(ON_B, 0, 0.035), None, False),
        (moved(ON_B, 2, 0.02), None, False),
        (START, None, False),
        (IN_HAND, "block_a", False),
    ],
)
def test_success_is_a_block_that_rests_on_the_other(a: tuple[float, ...], held: str | None, solved: bool) -> None:
    assert TASK.success(scene(a, held=held)) is solved


def test_subgoals_follow_from_the_state_alone() -> None:
    assert TASK.subgoals[TASK.subgoal(state(START))].description == "pick up the red block"
    assert TASK.subgoals[TASK.subgoal(state(IN_HAND))].description == "place it on the green block"


@pytest.mark.parametrize(
    ("a", "skill", "target", "below", "above"),
    [
        (START, "pick", START, PICK_BELOW, PICK_ABOVE),
        (IN_HAND, "place", moved(B_AT, 2, PLACE_ABOVE), PLACE_BELOW, PLACE_OVER),
        (ON_B, "place", moved(B_AT, 2, PLACE_ABOVE), PLACE_BELOW, PLACE_OVER),
    ],
)
def test_the_teachers_boxes(
    a: tuple[float, ...],
    skill: str,
    target: tuple[float, ...],
    below: tuple[float, float, float],
    above: tuple[float, float, float],
) -> None:
    s = state(a)
    for axis in range(3):
        for by in (above[axis], -below[axis]):
            assert TASK.judge(s, SkillCall(skill, moved(target, axis, by))) == 1
            assert TASK.judge(s, SkillCall(skill, moved(target, axis, by * 1.05))) == -1


def test_the_right_skill_at_the_wrong_time_is_bad() -> None:
    on_b = moved(B_AT, 2, PLACE_ABOVE)
    assert TASK.judge(state(START), SkillCall("place", on_b)) == -1
    assert TASK.judge(state(IN_HAND), SkillCall("pick", IN_HAND)) == -1
    assert TASK.judge(state(START), SkillCall("pick", B_AT)) == -1
    assert TASK.judge(state(IN_HAND), SkillCall("place", START)) == -1


coordinate = st.tuples(st.floats(*X), st.floats(*Y), st.floats(table.HEIGHT + HALF_A, table.HEIGHT + 0.25))


@given(coordinate, st.floats(*X), st.floats(*Y))
def test_the_true_call_is_inside_the_bounds_and_judged_good(a: tuple[float, ...], x: float, y: float) -> None:
    s = state(a, (x, y, ON_TABLE_B))
    if a[2] < ON_TABLE_A + 0.02:
        s[2] = ON_TABLE_A
    call = TASK.true_call(s)
    check_call(call, TASK.skills)
    assert TASK.judge(s, call) == 1


@pytest.mark.parametrize(
    ("a", "held", "detail"),
    [
        (moved(START, 2, -0.3), None, "block_a fell off the table"),
        ((0.52, 0.15, ON_TABLE_A), None, "block_a is out of reach"),
        ((0.72, 0.0, ON_TABLE_A), None, "block_a is out of reach"),
        ((0.52, 0.142, ON_TABLE_A), None, None),
        ((0.52, 0.27, 0.1), "block_a", None),
        (START, None, None),
    ],
)
def test_a_block_that_no_skill_can_take_needs_a_hand(
    a: tuple[float, ...], held: str | None, detail: str | None
) -> None:
    found = TASK.violations(scene(a, held=held))
    assert [(v.kind, v.detail) for v in found] == ([("manual_reset", detail)] if detail else [])
