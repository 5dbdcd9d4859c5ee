"""Moved labels stay true: key points and the teacher's verdict move with the scene."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from agent.algorithm import Problem
from agent.encoding import Encoder
from agent.replay import Batch
from agent.symmetry import Symmetries
from robot_adapters import registry
from robot_adapters.base import Array, ParameterSpec, SkillCall, SkillSpec
from tests.agent.problems import XYZ, judged, of_task


def batch_of(name: str, count: int = 60) -> tuple[Problem, Batch, list[int]]:
    """Labels of a task as a batch, with the teacher's values."""
    problem, labels = of_task(name), judged(name, count)
    encoder = Encoder(problem, keypoints="skill")
    entries = [encoder.entry(label, affordance_penalty=0) for label in labels]
    batch = Batch(
        np.stack([e.state for e in entries]),
        np.array([e.skill for e in entries]),
        np.stack([e.parameters for e in entries]),
        np.array([e.target for e in entries], dtype=np.float32),
        np.stack([e.keypoints for e in entries]),
    )
    return problem, batch, [label.value for label in labels]


def back(problem: Problem, batch: Batch, row: int) -> tuple[Array, SkillCall]:
    """State and call in their own units, also outside their bounds."""
    low, high = problem.state_low, problem.state_high
    state = low + (batch.states[row].astype(np.float64) + 1) / 2 * (high - low)
    spec = problem.skills[batch.skills[row]]
    scaled = batch.parameters[row, : len(spec.parameters)].astype(np.float64)
    return state, SkillCall(spec.name, tuple((spec.low + (scaled + 1) / 2 * (spec.high - spec.low)).tolist()))


# what may be done to each task without its fixtures, which the state leaves out, mattering to the verdict
@pytest.mark.parametrize("name", ["stacking", "sweeping"])
def test_the_teacher_judges_a_moved_label_alike(name: str) -> None:
    problem, batch, values = batch_of(name)
    moved = Symmetries(problem, translation=0.1, flip=True, rotation=False).applied(batch, np.random.default_rng(0))
    task = registry.task(name)
    assert np.abs(moved.states - batch.states).max() > 0.05
    assert [task.judge(*back(problem, moved, row)) for row in range(len(values))] == values
    assert {1, -1} == set(values)


@pytest.mark.parametrize("name", ["stacking", "sweeping"])
def test_key_points_move_with_the_state(name: str) -> None:
    problem, batch, values = batch_of(name)
    rng = np.random.default_rng(1)
    moved = Symmetries(problem, translation=0.1, flip=True, rotation=True).applied(batch, rng)
    encoder = Encoder(problem, keypoints="skill")
    for row in range(len(values)):
        np.testing.assert_allclose(moved.keypoints[row], encoder.keypoints(back(problem, moved, row)[0]), atol=1e-5)


@pytest.mark.parametrize("name", ["sweeping", "collecting_toy", "cooking_hotdog"])
def test_what_has_a_front_is_not_turned(name: str) -> None:
    problem, batch, _ = batch_of(name)
    moved = Symmetries(problem, translation=0.0, flip=False, rotation=True).applied(batch, np.random.default_rng(2))
    np.testing.assert_allclose(moved.states, batch.states, atol=1e-5)
    np.testing.assert_allclose(moved.parameters, batch.parameters, atol=1e-5)


def test_a_turn_keeps_distances_and_heights() -> None:
    problem, batch, _ = batch_of("stacking")
    moved = Symmetries(problem, translation=0.0, flip=False, rotation=True).applied(batch, np.random.default_rng(2))
    turned = 0
    for row in range(len(batch.skills)):
        (_, before), (_, after) = back(problem, batch, row), back(problem, moved, row)
        k = batch.skills[row]
        old = np.array(before.parameters[:3]) - batch.keypoints[row, k, 0]
        new = np.array(after.parameters[:3]) - moved.keypoints[row, k, 0]
        assert math.hypot(*old[:2]) == pytest.approx(math.hypot(*new[:2]), abs=1e-5)
        assert old[2] == pytest.approx(new[2], abs=1e-6)
        turned += float(np.abs(old - new).max()) > 1e-3
    assert turned > 30


def test_a_push_keeps_its_way() -> None:
    """Along x it is moved and mirrored in y only: where it ends is told by nothing that is moved."""
    problem, batch, _ = batch_of("collecting_toy")
    moved = Symmetries(problem, translation=0.1, flip=True, rotation=True).applied(batch, np.random.default_rng(3))
    pushes = batch.skills == [s.name for s in problem.skills].index("push")
    along_x = pushes & (batch.parameters[:, 3] < 0)
    along_y = pushes & (batch.parameters[:, 3] >= 0)
    assert along_x.sum() > 3
    assert along_y.sum() > 3
    assert np.abs(moved.parameters[along_y][:, 0] - batch.parameters[along_y][:, 0]).min() > 1e-4
    np.testing.assert_allclose(
        moved.parameters[along_x][:, [0, 2, 3, 4]], batch.parameters[along_x][:, [0, 2, 3, 4]], atol=1e-5
    )
    np.testing.assert_allclose(moved.parameters[along_y][:, 1:], batch.parameters[along_y][:, 1:], atol=1e-5)
    assert np.abs(moved.parameters[along_x][:, 1] - batch.parameters[along_x][:, 1]).min() > 1e-4


@pytest.mark.parametrize(
    ("flip", "angle", "expected"), [(1.0, 0.3, 0.5), (-1.0, 0.0, -0.2), (-1.0, 0.3, 0.1), (1.0, math.pi, 0.2)]
)
def test_a_yaw_turns_with_the_scene(flip: float, angle: float, expected: float) -> None:
    spec = SkillSpec("pick", (*XYZ, ParameterSpec("yaw", "rad", -math.pi / 2, math.pi / 2)))
    problem = Problem("turned", np.zeros(3), np.ones(3), (spec,), position_fields=(0,))
    call = spec.normalise(np.array([0.5, 0.1, 0.0, 0.2])).astype(np.float32)
    batch = Batch(
        np.zeros((1, 3), np.float32),
        np.array([0]),
        call[None],
        np.ones(1, np.float32),
        np.zeros((1, 0, 0, 3), np.float32),
    )
    symmetries = Symmetries(problem, translation=0.0, flip=True, rotation=True)
    moved = symmetries.moved(batch, np.zeros((1, 2)), np.array([flip]), np.array([angle]))
    assert spec.denormalise(moved.parameters[0])[3] == pytest.approx(expected, abs=1e-6)


def test_flags_and_everything_else_stay() -> None:
    problem, batch, _ = batch_of("cooking_hotdog")
    moved = Symmetries(problem, translation=0.1, flip=True, rotation=True).applied(batch, np.random.default_rng(4))
    np.testing.assert_array_equal(moved.states[:, [2, 5, 6, 7, 8, 9, 10]], batch.states[:, [2, 5, 6, 7, 8, 9, 10]])
    assert dataclasses.replace(moved, states=batch.states).targets is batch.targets
