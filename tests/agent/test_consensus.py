"""Labels that vote on each other: what a wrong click does, and doesn't."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import torch

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from agent.consensus import Consensus
from agent.encoding import Encoder
from agent.grounding import grounding
from agent.replay import Replay
from robot_adapters import registry
from robot_adapters.base import Array, SkillCall
from tests.agent.problems import judged, of_task

TOLERANCE = 0.008


def replay_of(task: str, labels: Sequence[Label], tolerance: float = TOLERANCE) -> Replay:
    """Labels as SEED with `consensus` would hold them."""
    problem = of_task(task)
    encoder = Encoder(problem, keypoints="skill")
    ground = grounding(problem.skills, encoder.keypoint_counts, grounded=True, relative=True, radius=0.04)
    consensus = Consensus(ground, encoder.state_size, problem.position_fields, tolerance)
    width = max(1, *encoder.parameter_counts)
    replay = Replay(encoder.state_size, width, encoder.keypoint_shape, believed=consensus.believed)
    for label in labels:
        replay.add(encoder.entry(label, affordance_penalty=0.0))
    return replay


def at_first_subgoal(task: str, values: Sequence[int], aside: float = 0.0) -> list[Label]:
    """The right call in different start states, labelled so; `aside` m off in y every other time."""
    starts = [label.state for label in judged(task, len(values))]
    calls = [registry.task(task).true_call(state) for state in starts]
    moved = [
        SkillCall(c.skill, (c.parameters[0], c.parameters[1] + aside * (i % 2), *c.parameters[2:]))
        for i, c in enumerate(calls)
    ]
    return [Label(i, s, c, v) for i, (s, c, v) in enumerate(zip(starts, moved, values, strict=True), start=1)]


@pytest.mark.parametrize("task", ["stacking", "sweeping", "collecting_toy", "cooking_hotdog", "reaching"])
def test_one_wrong_label_among_right_ones_is_outvoted(task: str) -> None:
    assert replay_of(task, at_first_subgoal(task, [1, 1, -1, 1])).counts() == {1: 4, 0: 0, -1: 0}
    assert replay_of(task, at_first_subgoal(task, [-1, 1, -1, -1])).counts() == {1: 0, 0: 0, -1: 4}


def test_a_label_alone_is_taken_at_its_word_and_a_tie_says_nothing() -> None:
    assert replay_of("stacking", at_first_subgoal("stacking", [1])).counts() == {1: 1, 0: 0, -1: 0}
    assert replay_of("stacking", at_first_subgoal("stacking", [1, -1])).counts() == {1: 0, 0: 2, -1: 0}


def test_neutral_neither_votes_nor_is_outvoted() -> None:
    assert replay_of("stacking", at_first_subgoal("stacking", [1, 0, 0, 0])).counts() == {1: 1, 0: 3, -1: 0}


def test_calls_further_apart_than_the_tolerance_do_not_vote_on_each_other() -> None:
    labels = at_first_subgoal("stacking", [1, -1, 1, -1], aside=1.2 * TOLERANCE)
    assert replay_of("stacking", labels).counts() == {1: 2, 0: 0, -1: 2}


def test_situations_that_look_different_do_not_vote_on_each_other() -> None:
    """Picking the sausage is right while it is raw and wrong while the skillet is not on the stove."""
    state = judged("cooking_hotdog", 1)[0].state
    later = state.copy()
    later[7] = 1.0  # the skillet is on the stove
    call = SkillCall("pick", tuple(registry.task("cooking_hotdog").keypoints(state, "pick")[1].tolist()))
    labels = [Label(i, s, call, v) for i, (s, v) in enumerate([(state, -1), (state, -1), (later, 1)])]
    assert replay_of("cooking_hotdog", labels).counts() == {1: 1, 0: 0, -1: 2}


def test_an_outvoted_refusal_is_asked_about_again_once() -> None:
    labels = at_first_subgoal("stacking", [1, 1, 1, -1])
    replay, encoder = replay_of("stacking", labels), Encoder(of_task("stacking"), keypoints="skill")
    state = encoder.state(labels[-1].state)
    assert not len(replay.refused(state, 0.02).skills)
    replay.add(encoder.entry(Label(9, labels[-1].state, labels[-1].call, -1), affordance_penalty=0.0))
    assert len(replay.refused(state, 0.02).skills) == 2


def test_a_forgotten_vote_no_longer_counts() -> None:
    replay = replay_of("stacking", at_first_subgoal("stacking", [1, -1, -1]))
    assert replay.counts() == {1: 0, 0: 0, -1: 3}
    replay.forget(3)
    replay.forget(2)
    assert replay.counts() == {1: 1, 0: 0, -1: 0}


def test_a_batch_has_what_labels_mean_as_target() -> None:
    replay = replay_of("stacking", at_first_subgoal("stacking", [1, 1, -1]))
    np.testing.assert_array_equal(replay.sample(16, np.random.default_rng(0)).targets, np.ones(16))


def found(state: Array, consensus: float) -> Array:
    """Where SEED reaches after a wrong good label and a right refusal of the same spot from two states."""
    torch.set_num_threads(1)
    chosen = {**SEED.presets["recommended"], "hidden_size": 16, "batch_size": 16, "consensus": consensus}
    learner = SEED(of_task("reaching"), SeedSettings(**chosen), 0)
    spot = SkillCall("reach", (0.4, -0.1, 0.0))
    elsewhere = state + np.array([0.1, 0.1, 0.0, 0.0])
    learner.add([Label(1, state, spot, 1), Label(2, elsewhere, spot, -1), Label(3, state, SkillCall("release"), -1)])
    return np.array(learner.propose(state).call.parameters)


def test_a_wrong_good_reach_doesnt_end_the_search() -> None:
    state, spot = np.array([0.5, 0.0, 0.1, 0.0]), np.array([0.4, -0.1, 0.0])
    assert np.linalg.norm(found(state, TOLERANCE) - spot) > 0.05
