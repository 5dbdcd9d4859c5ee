"""What the preset `recommended` adds to SEED, each ingredient by itself and all together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
import torch

from agent.algorithm import AgentError, Label, Problem
from agent.config import SEED, SeedSettings
from agent.encoding import Encoder
from agent.grounding import grounding
from robot_adapters import registry
from robot_adapters.base import Adapter, SkillCall, check_call
from tests.agent.problems import PICK, RELEASE, judged, of_task, problem

QUICK: dict[str, Any] = {"hidden_size": 16, "batch_size": 16, "gradient_steps": 2}


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def kinematic(task: str) -> Adapter:
    factory = registry.adapter("kinematic")
    return factory(task, factory.settings.model_validate({"draw": False}))


def solved(task_name: str, feedback: int) -> float:
    """Share of 20 rollouts that succeed after so many labels of the synthetic teacher."""
    task, robot = registry.task(task_name), kinematic(task_name)
    learner = SEED(of_task(task_name), SeedSettings(**SEED.presets["recommended"]), 0)
    try:
        state = robot.reset(0).state
        for label_id in range(1, feedback + 1):
            call = learner.propose(state).call
            value = task.judge(state, call)
            learner.add([Label(label_id, state, call, value)])
            while learner.owed_updates:
                learner.update()
            if value == 1:
                result = robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
                over = result.success or result.violations
                state = robot.reset().state if over else robot.observe().state
        good = 0
        for start in range(20):
            state = robot.reset(500 + start).state
            for _ in range(task.horizon):
                call = learner.propose(state, deterministic=True).call
                if robot.execute(call, should_stop=lambda: False, on_step=lambda: None).success:
                    break
                state = robot.observe().state
            good += robot.success()
        return good / 20
    finally:
        robot.close()


# the bars of one seed; `tests/benchmarks/clicks_kinematic.py` has the means of several
@pytest.mark.parametrize(("task", "feedback"), [("stacking", 25), ("reaching", 60)])
def test_few_clicks_are_enough(task: str, feedback: int) -> None:
    assert solved(task, feedback) >= 0.9


@pytest.mark.parametrize(
    "off",
    [
        {"relative_critic": False},
        {"grounded_actor": False},
        {"augment_translation": 0.0, "augment_flip": False, "augment_rotation": False},
        {"candidates": 0},
        {"recall": 0},
        {"keypoints": "all"},
        {"keypoints": "none"},
    ],
    ids=lambda off: next(iter(off)),
)
@pytest.mark.parametrize("task", ["collecting_toy", "cooking_hotdog"])
def test_each_ingredient_can_be_taken_away(task: str, off: Mapping[str, Any]) -> None:
    learner = SEED(of_task(task), SeedSettings(**{**SEED.presets["recommended"], **QUICK, **off}), 0)
    labels = judged(task, 12)
    learner.add(labels)
    while learner.owed_updates:
        metrics = learner.update()
        assert metrics is not None
        assert all(np.isfinite(value) for value in metrics.values())
    for label in labels:
        check_call(learner.propose(label.state).call, of_task(task).skills)


def test_a_fresh_grounded_actor_goes_to_key_points() -> None:
    learner = SEED(of_task("stacking"), SeedSettings(**SEED.presets["recommended"]), 0)
    for label in judged("stacking", 10):
        call = learner.propose(label.state, deterministic=True).call
        point = registry.task("stacking").keypoints(label.state, call.skill)[0]
        np.testing.assert_allclose(call.parameters, point, atol=1e-3)


def test_a_refused_call_is_not_made_again_in_the_same_situation() -> None:
    """Reaching's release has no parameters: once refused, only reaches are proposed, well apart."""
    learner = SEED(of_task("reaching"), SeedSettings(**{**SEED.presets["recommended"], **QUICK}), 0)
    state = np.array([0.5, 0.0, 0.1, 0.0])
    learner.add([Label(1, state, SkillCall("release"), -1)])
    spots = []
    for label_id in range(2, 22):
        call = learner.propose(state).call
        assert call.skill == "reach"
        spots.append(call.parameters)
        learner.add([Label(label_id, state, call, -1)])
    away = np.linalg.norm(np.array(spots)[:, None] - np.array(spots)[None], axis=-1) + np.eye(20)
    assert away.min() > 0.03


def test_cannot_tell_rules_nothing_out() -> None:
    """The only place left is asked about again after neutral clicks there, but not at the same spot right after one."""
    learner = SEED(problem(PICK), SeedSettings(**{**SEED.presets["recommended"], **QUICK}), 0)
    state, unclear = np.zeros(3), np.array([0.55, 0.1, 0.0])
    axes = [np.arange(low, high, 0.06) for low, high in zip(PICK.low, PICK.high, strict=True)]
    spots = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 3)
    refused = [SkillCall("pick", tuple(s)) for s in spots.tolist() if np.linalg.norm(s - unclear) > 0.06]
    answers = [(call, -1) for call in refused] + 20 * [(SkillCall("pick", tuple(unclear.tolist())), 0)]
    learner.add([Label(i, state, call, value) for i, (call, value) in enumerate(answers, start=1)])
    assert np.linalg.norm(np.array(learner.propose(state).call.parameters) - unclear) > 0.02
    learner.add([Label(1000, state, refused[0], -1)])
    assert np.linalg.norm(np.array(learner.propose(state).call.parameters) - unclear) < 0.05


def test_local_parameters_and_calls_are_each_others_reverse() -> None:
    problem_ = of_task("cooking_hotdog")
    encoder = Encoder(problem_, keypoints="skill")
    assert encoder.keypoint_counts == (2, 3)
    ground = grounding(problem_.skills, encoder.keypoint_counts, grounded=True, relative=True, radius=0.04)
    state = judged("cooking_hotdog", 1)[0].state
    keypoints = torch.from_numpy(encoder.keypoints(state))[None]
    local = 0.5 * torch.rand((ground.options, 1, 3), generator=torch.Generator().manual_seed(0))
    calls = ground.decode(local, keypoints)[:, 0]
    options, again = ground.encode(ground.option_skill, calls, keypoints.expand(ground.options, -1, -1, -1))
    assert options.tolist() == list(range(5))
    torch.testing.assert_close(again, local[:, 0], atol=1e-5, rtol=0)


def test_changing_key_points_are_told() -> None:
    told = problem(PICK, RELEASE)
    growing = Problem(
        told.task, told.state_low, told.state_high, told.skills, keypoints=lambda state, _: np.zeros((int(state[0]), 3))
    )
    learner = SEED(growing, SeedSettings(**{**SEED.presets["recommended"], **QUICK}), 0)
    learner.propose(np.ones(3))
    with pytest.raises(AgentError, match="key points") as error:
        learner.propose(np.full(3, 2.0))
    assert "keypoints" in error.value.remedy
