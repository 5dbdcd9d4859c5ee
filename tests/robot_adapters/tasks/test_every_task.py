"""Rules that hold for every task, tried on seeded starts and on whole episodes of the kinematic adapter."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot_adapters import registry
from robot_adapters.base import Array, Scene, SkillCall, check_call
from robot_adapters.contract import random_call
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.tasks.base import Task, state_bounds
from robot_adapters.tasks.layout import InvalidLayout
from robot_adapters.tasks.low_level import low_level_fields, low_level_state

SIZES = {"reaching": (4, 4), "stacking": (6, 10), "sweeping": (6, 10), "collecting_toy": (6, 10)}
SIZES["cooking_hotdog"] = (11, 15)
SKILLS = {
    "reaching": {"reach", "release"},
    "stacking": {"pick", "place"},
    "sweeping": {"pick", "push"},
    "collecting_toy": {"pick", "place", "push"},
    "cooking_hotdog": {"pick", "place"},
}
EVERY = pytest.mark.parametrize("name", sorted(SIZES))
SEEDS = st.integers(0, 2**31 - 1)


def build(name: str) -> tuple[KinematicAdapter, Task]:
    adapter = registry.adapter("kinematic")(name, KinematicSettings(draw=False))
    assert isinstance(adapter, KinematicAdapter)
    return adapter, registry.task(name)


def episode(name: str, seed: int) -> Iterator[tuple[Array, Scene]]:
    """State and scene before every right call of an episode, and after the last."""
    adapter, task = build(name)
    state = adapter.reset(seed).state
    for _ in task.subgoals:
        yield state, adapter._episode.scene()
        adapter.execute(task.true_call(state), should_stop=lambda: False, on_step=lambda: None)
        state = adapter.observe().state
    yield state, adapter._episode.scene()


@EVERY
def test_states_and_skills_are_the_papers(name: str) -> None:
    task = registry.task(name)
    assert {spec.name for spec in task.skills} == SKILLS[name]
    for state, scene in episode(name, 1):
        low_level = low_level_state(task, scene)
        assert (len(state), len(low_level)) == SIZES[name]
        assert sum(field.size for field in task.state_fields) == len(state)
        assert sum(field.size for field in low_level_fields(task)) == len(low_level)
        assert low_level[:3] == pytest.approx(scene.gripper)
        assert np.allclose(low_level[-len(state) :], state)


@EVERY
@settings(deadline=None, max_examples=40)
@given(seed=SEEDS)
def test_right_calls_solve_every_start_and_break_no_rule(name: str, seed: int) -> None:
    adapter, task = build(name)
    observation = adapter.reset(seed)
    low, high = state_bounds(task.state_fields)
    for stage in range(len(task.subgoals)):
        assert task.subgoal(observation.state) == stage
        assert ((observation.state >= low) & (observation.state <= high)).all()
        call = task.true_call(observation.state)
        check_call(call, task.skills)
        assert task.judge(observation.state, call) == 1
        assert task.margin(observation.state, call) > 0.003
        result = adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
        assert not result.violations
        assert result.success == (stage == len(task.subgoals) - 1)
        observation = adapter.observe()


@EVERY
def test_calls_from_anywhere_in_the_boxes_mostly_solve(name: str) -> None:
    """The bar of 45 in 50 that simulation is held to."""
    adapter, task = build(name)
    rng, solved = np.random.default_rng(5), 0
    for seed in range(50):
        state = adapter.reset(seed).state
        for _ in task.subgoals:
            call = task.sample_good(state, rng)
            assert task.judge(state, call) == 1
            result = adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
            state = adapter.observe().state
        solved += result.success
    assert solved >= 45


@EVERY
@settings(deadline=None, max_examples=30)
@given(seed=SEEDS)
def test_the_margin_is_the_distance_to_where_the_verdict_changes(name: str, seed: int) -> None:
    task, rng = registry.task(name), np.random.default_rng(seed)
    for state, _ in itertools.islice(episode(name, seed), len(task.subgoals)):
        for spec in task.skills:
            call = random_call(spec, rng)
            assert (task.margin(state, call) >= -1e-9) == (task.judge(state, call) == 1)
        good = task.sample_good(state, rng)
        margin = task.margin(state, good)
        position = np.array(good.parameters[:3])
        # nearer to the border than this in any direction: still good
        step = rng.normal(size=3)
        inside = position + step / np.linalg.norm(step) * margin * 0.99
        rest = good.parameters[3:]
        if good.skill == "push":
            # what counts is where a push ends, so it is kept
            rest = (rest[0], rest[1] + position[0] - inside[0])
        assert task.judge(state, SkillCall(good.skill, (*inside.tolist(), *rest))) == 1


@EVERY
def test_keypoints_are_near_every_right_call(name: str) -> None:
    task = registry.task(name)
    for state, _ in itertools.islice(episode(name, 2), len(task.subgoals)):
        call = task.true_call(state)
        everything, own = task.keypoints(state), task.keypoints(state, call.skill)
        assert len(everything) == sum(len(task.keypoints(state, spec.name)) for spec in task.skills)
        if len(everything):
            away = np.linalg.norm(own[:, :2] - call.parameters[:2], axis=1)
            assert away.min() < 0.01


@pytest.mark.parametrize("name", ["sweeping", "collecting_toy"])
def test_a_push_along_y_is_never_right(name: str) -> None:
    task = registry.task(name)
    for state, _ in episode(name, 4):
        call = task.true_call(state)
        if call.skill == "push":
            sideways = SkillCall("push", (*call.parameters[:3], 0.5, call.parameters[4]))
            assert task.judge(state, sideways) == -1
            assert task.margin(state, sideways) == -math.inf


@EVERY
def test_layout_ranges_are_settings(name: str) -> None:
    task = registry.task(name)
    for field, about in type(task.layout).model_fields.items():
        assert about.description
        low, high = getattr(task.layout, field)
        narrow = registry.task(name, {field: (low, high)})
        again = [t.sample_layout(np.random.default_rng(3)) for t in (task, narrow)]
        assert all(np.array_equal(again[0][k], again[1][k]) for k in again[0])
        with pytest.raises(InvalidLayout, match=field):
            registry.task(name, {field: (high, low)})
    with pytest.raises(InvalidLayout) as raised:
        registry.task(name, {"moon": (0, 1)})
    assert all(field in raised.value.remedy for field in type(task.layout).model_fields)


def test_a_layout_range_reaches_the_adapter() -> None:
    settings_ = KinematicSettings(draw=False, layout={"toy_y": (0.02, 0.03)})
    adapter = registry.adapter("kinematic")("sweeping", settings_)
    assert all(0.02 <= adapter.reset(seed).state[4] <= 0.03 for seed in range(20))
