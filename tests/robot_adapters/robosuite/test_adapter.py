"""Stacking and Reaching in physics: starts, skills, stops, what is held, and what went wrong."""

from __future__ import annotations

import numpy as np
import pytest

from robot_adapters.base import EndReason, SkillCall
from robot_adapters.registry import task
from robot_adapters.robosuite.adapter import RobosuiteAdapter, paced

STACKING = task("stacking")
REACHING = task("reaching")


def run(adapter: RobosuiteAdapter, call: SkillCall) -> EndReason:
    return adapter.execute(call, should_stop=lambda: False, on_step=lambda: None).end


def test_the_same_seed_gives_the_very_same_start_after_anything_else(stacking: RobosuiteAdapter) -> None:
    first = stacking.reset(5)
    pose, yaw = stacking.simulator.pose()
    run(stacking, STACKING.true_call(first.state))
    other = stacking.reset(6)
    again = stacking.reset(5)
    assert again.state == pytest.approx(first.state, abs=1e-9)
    assert stacking.simulator.pose()[0] == pytest.approx(pose, abs=1e-9)
    assert stacking.simulator.pose()[1] == pytest.approx(yaw, abs=1e-9)
    assert not np.allclose(other.state, first.state, atol=1e-3)
    assert {first.frames[c].jpeg == again.frames[c].jpeg for c in first.frames} == {True}


def test_the_start_is_the_task_s_layout(stacking: RobosuiteAdapter) -> None:
    layout = STACKING.sample_layout(np.random.default_rng(11))
    state = stacking.reset(11).state
    assert state == pytest.approx(np.concatenate([layout["block_a"], layout["block_b"]]), abs=1e-3)
    assert stacking.simulator.pose()[0] == pytest.approx(layout["gripper"], abs=2e-3)
    assert stacking.simulator.pose()[1] == pytest.approx(0.0, abs=1e-2)


@pytest.mark.parametrize("seed", [0, 1, 82])  # 1 needs the fingers turned away; 82 a descent that stays on its line
def test_true_parameters_stack(stacking: RobosuiteAdapter, seed: int) -> None:
    state = stacking.reset(seed).state
    assert run(stacking, STACKING.true_call(state)) is EndReason.ARRIVED
    assert stacking.simulator.scene().held == "block_a"
    assert not stacking.success()
    result = stacking.execute(
        STACKING.true_call(stacking.observe().state), should_stop=lambda: False, on_step=lambda: None
    )
    assert result.end is EndReason.ARRIVED
    assert result.success
    assert stacking.success()
    assert stacking.simulator.scene().held is None


def test_a_pick_beside_the_block_grasps_nothing_and_moves_no_block(stacking: RobosuiteAdapter) -> None:
    state = stacking.reset(3).state
    assert run(stacking, SkillCall("pick", (0.68, 0.13, -0.09))) is EndReason.NOTHING_GRASPED
    assert stacking.observe().state == pytest.approx(state, abs=1e-3)
    assert stacking.simulator.scene().held is None


def test_a_stop_in_mid_motion_leaves_the_arm_on_its_way(stacking: RobosuiteAdapter) -> None:
    stacking.reset(3)
    before = stacking.simulator.low_level_steps
    result = stacking.execute(
        SkillCall("pick", (0.68, 0.13, -0.09)),
        should_stop=lambda: stacking.simulator.low_level_steps - before >= 6,
        on_step=lambda: None,
    )
    assert result.end is EndReason.STOPPED
    assert result.low_level_steps == 7
    here = stacking.simulator.pose()[0]
    for _ in range(10):  # what follows is held still: it brakes within centimetres of where it was stopped
        stacking.simulator.step(here, 0.0, gripper_closed=False)
    assert np.linalg.norm(stacking.simulator.pose()[0] - here) < 0.02


def test_a_block_pushed_off_the_table_needs_a_hand(stacking: RobosuiteAdapter) -> None:
    stacking.reset(0)
    joint = stacking.simulator.model.joint(
        stacking.simulator.model.body_jntadr[stacking.simulator.model.body("block_b_main").id]
    )
    stacking.simulator.data.qpos[joint.qposadr[0]] = 0.9  # half a metre past the edge
    result = stacking.execute(SkillCall("pick", (0.43, 0.13, -0.09)), should_stop=lambda: False, on_step=lambda: None)
    assert [(v.kind, v.detail) for v in result.violations] == [("manual_reset", "block_b fell off the table")]
    assert not stacking.reset(0).state[5] < STACKING.table_height


def test_reaching_the_area_solves_reaching_and_release_does_not(reaching: RobosuiteAdapter) -> None:
    start = reaching.reset(2)
    assert start.state.shape == (4,)
    assert run(reaching, SkillCall("release")) is EndReason.ARRIVED
    assert not reaching.success()
    assert run(reaching, REACHING.true_call(start.state)) is EndReason.ARRIVED
    assert reaching.success()


def test_live_frames_come_while_a_skill_runs(reaching: RobosuiteAdapter) -> None:
    reaching.reset(2)
    frames: list[bytes] = []
    reaching.execute(
        REACHING.true_call(reaching.observe().state),
        should_stop=lambda: len(frames) >= 3,
        on_step=lambda: frames.append(reaching.frame("left").jpeg),
    )
    assert len(set(frames)) == len(frames) == 4


def test_pace_waits_for_the_period_and_lets_lost_time_go() -> None:
    now = 0.0
    waits: list[float] = []
    work = iter([0.01, 0.09, 0.01])

    def hook() -> None:
        nonlocal now
        now += next(work)

    def sleep(seconds: float) -> None:
        nonlocal now
        waits.append(seconds)
        now += seconds

    step = paced(hook, 0.05, clock=lambda: now, sleep=sleep)
    for _ in range(3):
        step()
    assert waits == pytest.approx([0.04, 0.04])
