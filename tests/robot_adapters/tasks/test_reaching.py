"""Reaching's rules."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from robot_adapters.base import Scene, SkillCall, check_call
from robot_adapters.tasks import table
from robot_adapters.tasks.reaching import RADIUS, START_DISTANCE, TARGET, Reaching

TASK = Reaching()
SEEDS = st.integers(0, 2**31 - 1)
UNIT = st.floats(-1, 1)


def scene(gripper: tuple[float, float, float], *, closed: bool = False) -> Scene:
    return Scene({}, np.array(gripper), gripper_closed=closed)


def test_the_state_is_the_papers() -> None:
    assert TASK.state(scene((0.5, 0.1, 0.2))).tolist() == [0.5, 0.1, 0.2, 0.0]
    assert TASK.state(scene((0.5, 0.1, 0.2), closed=True)).tolist() == [0.5, 0.1, 0.2, 1.0]
    assert [s.name for s in TASK.skills] == ["reach", "release"]
    assert sum(f.size for f in TASK.state_fields) == 4


@given(SEEDS)
def test_episodes_start_away_from_the_area_over_the_table(seed: int) -> None:
    layout = TASK.sample_layout(np.random.default_rng(seed))
    start = layout["gripper"]
    assert layout.keys() == {"gripper"}
    assert np.linalg.norm(start - TARGET) >= START_DISTANCE
    assert table.X[0] <= start[0] <= table.X[1]
    assert table.Y[0] <= start[1] <= table.Y[1]
    assert start[2] > table.HEIGHT + 0.05
    assert not TASK.success(Scene({}, start, gripper_closed=False))


@given(UNIT, UNIT, UNIT)
def test_the_teacher_approves_what_would_succeed(x: float, y: float, z: float) -> None:
    target = tuple(TASK.skills[0].denormalise(np.array([x, y, z])).tolist())
    state = TASK.state(scene((0.45, -0.1, 0.1)))
    verdict = TASK.judge(state, SkillCall("reach", target))
    assert (verdict == 1) == TASK.success(scene(target))


def test_the_areas_edge_counts_and_beyond_does_not() -> None:
    x, y, z = TARGET
    assert TASK.success(scene((x, y, z + RADIUS * 0.999)))
    assert not TASK.success(scene((x, y, z + RADIUS * 1.001)))


def test_release_is_never_right() -> None:
    assert TASK.judge(TASK.state(scene((0.45, -0.1, 0.1))), SkillCall("release")) == -1
    assert TASK.judge(TASK.state(scene(TARGET)), SkillCall("release")) == -1


def test_the_true_call_is_right_and_the_target_stays_hidden() -> None:
    state = TASK.state(scene((0.45, -0.1, 0.1)))
    call = TASK.true_call(state)
    assert check_call(call, TASK.skills).name == "reach"
    assert TASK.judge(state, call) == 1
    assert TASK.keypoints(state).shape == (0, 3)
    assert TASK.objects[0].fixed == TARGET
