"""The scenes of Sweeping, Collecting-Toy and Cooking-Hotdog in physics: what stands, slides, is held, and breaks."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robot_adapters.base import EndReason, SkillCall, SkillResult
from robot_adapters.registry import task
from robot_adapters.robosuite import FACTORY
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from robot_adapters.tasks.base import Task
from tests.robot_adapters.robosuite.conftest import shared

SCENES = ("sweeping", "collecting_toy", "cooking_hotdog")


def run(adapter: RobosuiteAdapter, call: SkillCall) -> SkillResult:
    return adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)


def advance(adapter: RobosuiteAdapter, chosen: Task, skills: int) -> SkillResult:
    """The last result of so many true calls."""
    for _ in range(skills):
        result = run(adapter, chosen.true_call(adapter.observe().state))
        assert not result.violations
    return result


@pytest.mark.parametrize("name", SCENES)
def test_everything_stays_where_the_layout_puts_it(name: str) -> None:
    adapter, chosen = shared(name), task(name)
    adapter.reset(3)
    layout = chosen.sample_layout(np.random.default_rng(3))
    here, yaw = adapter.simulator.pose()
    for _ in range(40):  # two seconds
        adapter.simulator.step(here, yaw, gripper_closed=False)
    scene = adapter.simulator.scene()
    for spec in chosen.objects:
        if spec.movable:
            assert scene.objects[spec.name] == pytest.approx(layout[spec.name], abs=2e-3)
            assert scene.tilts.get(spec.name, 0.0) < math.radians(2)
        elif spec.shape == "slider":
            assert scene.joints[spec.name] == pytest.approx(layout[spec.name][0], abs=1e-3)


@pytest.mark.parametrize("name", SCENES)
def test_a_solved_episode_leaves_nothing_behind(name: str) -> None:
    adapter, chosen = shared(name), task(name)
    first = adapter.reset(5)
    while not run(adapter, chosen.true_call(adapter.observe().state)).success:
        pass
    again = adapter.reset(5)
    assert not adapter.success()
    assert again.state == pytest.approx(first.state, abs=1e-9)


@pytest.mark.parametrize("name", SCENES)
def test_any_parameters_that_the_teacher_calls_good_solve_the_task(name: str) -> None:
    adapter, chosen, rng = shared(name), task(name), np.random.default_rng(2)
    adapter.reset(2)
    for _ in range(chosen.horizon):
        result = run(adapter, chosen.sample_good(adapter.observe().state, rng))
        assert not result.violations
        if result.success:
            return
    pytest.fail(f"not solved; the last skill ended {result.end}")


def test_the_broom_is_held_and_its_head_stays_level(sweeping: RobosuiteAdapter) -> None:
    sweeping.reset(0)
    advance(sweeping, task("sweeping"), 1)
    scene = sweeping.simulator.scene()
    assert scene.held == "broom"
    assert scene.tilts["broom"] < math.radians(10)


def test_a_broom_that_lies_needs_a_hand(sweeping: RobosuiteAdapter) -> None:
    sweeping.reset(0)
    model, data = sweeping.simulator.model, sweeping.simulator.data
    start = model.joint("broom_free").qposadr[0]
    data.qpos[start + 3 : start + 7] = [math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0]  # on its side
    result = run(sweeping, SkillCall("push", (0.5, -0.07, -0.02, 1.0, 0.02)))
    assert [(v.kind, v.detail) for v in result.violations] == [("manual_reset", "the broom fell over")]


def test_a_drawer_pushed_shut_without_the_toy_needs_a_hand(collecting_toy: RobosuiteAdapter) -> None:
    opening = collecting_toy.reset(0).state[3]
    start = 0.775 - opening - 0.111 - 0.045
    result = run(collecting_toy, SkillCall("push", (start, 0.0, -0.082, -1.0, 0.662 - start)))
    assert collecting_toy.observe().state[3] < 0.02
    assert "the drawer is closed and the toy outside" in {v.detail for v in result.violations}


def test_a_drawer_stays_where_it_is_let_go(collecting_toy: RobosuiteAdapter) -> None:
    opening = collecting_toy.reset(0).state[3]
    start = 0.775 - opening - 0.111 - 0.045
    run(collecting_toy, SkillCall("push", (start, 0.0, -0.082, -1.0, 0.095)))
    pushed = collecting_toy.observe().state[3]
    assert pushed == pytest.approx(opening - (0.095 - 0.045), abs=0.015)  # the push starts 45 mm before the handle
    here, yaw = collecting_toy.simulator.pose()
    for _ in range(20):
        collecting_toy.simulator.step(here, yaw, gripper_closed=True)
    assert collecting_toy.simulator.scene().joints["drawer"] == pytest.approx(pushed, abs=5e-4)


def test_cooking_is_remembered_when_the_sausage_leaves_the_pan(cooking_hotdog: RobosuiteAdapter) -> None:
    chosen = task("cooking_hotdog")
    cooking_hotdog.reset(0)
    advance(cooking_hotdog, chosen, 4)
    assert cooking_hotdog.observe().state[6:].tolist() == [0, 1, 0, 1, 0]
    advance(cooking_hotdog, chosen, 1)
    assert cooking_hotdog.observe().state[6:].tolist() == [0, 1, 1, 1, 0]
    assert advance(cooking_hotdog, chosen, 1).success
    assert cooking_hotdog.reset(1).state[6:].tolist() == [0, 0, 0, 0, 0]


def test_pressing_on_the_stove_stops_at_once_and_the_arm_can_go_on(cooking_hotdog: RobosuiteAdapter) -> None:
    chosen = task("cooking_hotdog")
    state = cooking_hotdog.reset(0).state
    result = run(cooking_hotdog, SkillCall("place", (0.636, 0.12, -0.089)))
    assert result.end is EndReason.FORCE_LIMIT
    assert [v.kind for v in result.violations] == ["damage"]
    assert result.violations[0].detail.endswith("N at the wrist")
    assert cooking_hotdog.simulator.pose()[0][2] < -0.05  # it didn't even lift
    after = run(cooking_hotdog, chosen.true_call(state))
    assert (after.end, after.violations) == (EndReason.ARRIVED, ())


def test_a_push_out_of_reach_ends_before_a_joint_is_at_its_limit(sweeping: RobosuiteAdapter) -> None:
    sweeping.reset(0)
    result = run(sweeping, SkillCall("push", (0.554, -0.065, -0.02, -0.65, 0.245)))
    assert result.end is EndReason.FORCE_LIMIT
    assert [(v.kind, v.detail.split(" ", 2)[2]) for v in result.violations] == [("damage", "runs into its limit")]
    model, angles = sweeping.simulator.model, sweeping.simulator.data.qpos[:7]
    limits = np.array([model.joint(f"robot0_joint{i}").range for i in range(1, 8)])
    assert (angles > limits[:, 0]).all()
    assert (angles < limits[:, 1]).all()


def test_a_task_without_a_scene_is_staged_if_it_has_blocks_and_areas_only() -> None:
    tower, cupboard = task("stacking"), task("collecting_toy")
    tower.name, cupboard.name = "tower", "cupboard"  # names that no scene has
    assert FACTORY.stages(tower)
    assert not FACTORY.stages(cupboard)
    assert all(FACTORY.stages(task(name)) for name in FACTORY.tasks)
