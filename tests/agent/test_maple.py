"""MAPLE: its targets, that it learns which skill and where, repeats and resumes exactly, and refuses what is wrong."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from agent.algorithm import AgentError, CheckpointError, Problem
from agent.baseline_config import BASELINES, MapleFactory
from agent.maple import METRICS, Maple
from robot_adapters.base import SkillCall, SkillSpec, check_call
from tests.agent.problems import PICK, PUSH, RELEASE, of_task, problem
from tests.agent.test_sac import sac
from tests.agent.toys import FETCH, Fetch, success_at_fetching

QUICK: dict[str, Any] = {
    "hidden_size": 32,
    "batch_size": 64,
    "warm_up": 64,
    "gradient_steps": 2,
    "target_rate": 0.02,
    "discount": 0.9,
    "initial_temperature": 0.1,
}
STATE = np.array([0.3, 0.0])
CALL = SkillCall("pick", (0.2,))


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def maple(of: Problem = FETCH, *, name: str = "maple", number: int = 0, **settings: Any) -> Maple:
    factory = BASELINES[name]
    assert isinstance(factory, MapleFactory)
    return factory(of, factory.settings(**{**QUICK, **settings}), number)


def train(learner: Maple, calls: int, seed: int) -> None:
    world = Fetch(seed)
    state = world.reset()
    for _ in range(calls):
        call = learner.propose(state).call
        reached, reward, terminated, truncated = world.step(call)
        learner.observe(state, call, reward, reached, terminated)
        while learner.owed_updates:
            learner.update()
        state = world.reset() if terminated or truncated else reached


def written(learner: Maple, path: Path) -> bytes:
    learner.save(path)
    return path.read_bytes()


# --- it learns


@pytest.mark.parametrize("number", [0, 1])
def test_it_learns_two_skills_in_order_from_a_reward_at_the_end(number: int) -> None:
    learner = maple(number=number)
    assert success_at_fetching(lambda s: learner.propose(s, deterministic=True)) <= 0.2
    train(learner, 450, number)
    assert success_at_fetching(lambda s: learner.propose(s, deterministic=True)) >= 0.95
    assert success_at_fetching(learner.propose) >= 0.7, "its samples as well; untrained it is about 0.05"
    held = learner.propose(np.array([0.3, 1.0]), deterministic=True)
    assert held.call.skill == "place"
    assert held.predicted_feedback == pytest.approx(1, abs=0.25), "what is about to be earned"


@pytest.mark.parametrize(("terminated", "worth"), [(True, 1.0), (False, 2.0)])
def test_an_episode_cut_by_its_horizon_is_worth_what_would_have_come(terminated: bool, worth: float) -> None:
    """Every call pays 1 and leads to where it began: 1 if that is the end, else 1 / (1 - discount)."""
    learner = maple(discount=0.5, initial_temperature=1e-4, skill_entropy=0.0, parameter_entropy=-10.0, target_rate=0.1)
    for _ in range(64):
        learner.observe(STATE, learner.propose(STATE).call, 1.0, STATE, terminated)
    for _ in range(400):
        metrics = learner.update()
    assert metrics is not None
    assert metrics["target_mean"] == pytest.approx(worth, abs=0.05)
    assert learner.propose(STATE).predicted_feedback == pytest.approx(worth, abs=0.15)


def test_a_first_target_is_the_reward_and_the_fresh_critics_entropy() -> None:
    """Fresh actors are near uniform over skills and near N(0, 1) before tanh; fresh critics say about 0."""
    learner = maple(discount=0.9, batch_size=4096, initial_temperature=0.5)
    learner.observe(STATE, CALL, 2.0, STATE, False)
    metrics = learner.update()
    assert metrics is not None
    density = -metrics["parameter_entropy"]
    assert metrics["target_mean"] == pytest.approx(2 + 0.9 * 0.5 * (math.log(2) - density), abs=0.03)
    assert metrics["critic_loss"] == pytest.approx(metrics["target_mean"] ** 2, rel=0.1)


def test_exploring_keeps_every_skill_in_play_for_a_while() -> None:
    """Only picks pay. With MAPLE's higher target entropies of the start, places are still tried."""
    entropies = []
    for exploring in (0, 10_000):
        learner = maple(exploring_updates=exploring, initial_temperature=1.0, learning_rate=1e-2)
        for i in range(200):
            call = SkillCall("pick" if i % 2 else "place", (0.0,))
            learner.observe(STATE, call, float(i % 2), STATE, True)
        for _ in range(300):
            metrics = learner.update()
        assert metrics is not None
        entropies.append(metrics["skill_entropy"] / math.log(2))
    assert entropies[0] < 0.7
    assert entropies[1] > 0.9


# --- affordance


@pytest.mark.parametrize(
    ("name", "y", "paid"), [("maple", 0.0, 1), ("maple", 0.1, 1), ("maple-aff", 0.0, 1), ("maple-aff", 0.1, 0.9)]
)
def test_maple_aff_pays_a_tenth_for_what_is_near_nothing(name: str, y: float, paid: float) -> None:
    stacking = of_task("stacking")
    state = np.array([0.5, 0.0, -0.09, 0.6, 0.1, -0.087])
    learner = maple(stacking, name=name)
    learner.observe(state, SkillCall("pick", (0.5, y, -0.09)), 1.0, state, True)
    metrics = learner.update()
    assert metrics is not None
    assert metrics["target_mean"] == pytest.approx(paid)


# --- it repeats exactly


def test_proposals_depend_on_seed_and_training_only() -> None:
    looked, plain = maple(), maple()
    first, second = (looked.propose(STATE, deterministic=True) for _ in range(2))
    assert first == second
    assert [looked.propose(STATE) for _ in range(3)] == [plain.propose(STATE) for _ in range(3)]
    assert looked.propose(STATE) != maple(number=1).propose(STATE)


def test_a_resumed_learner_continues_bit_for_bit(tmp_path: Path) -> None:
    settings: dict[str, Any] = {"replay_size": 100, "train_frequency": 2, "gradient_steps": 3}
    learner, other = maple(**settings), maple(number=9, **settings)
    train(learner, 150, 0)
    learner.observe(STATE, CALL, 0.0, STATE, False)
    learner.observe(STATE, CALL, 0.0, STATE, False)
    learner.save(tmp_path / "a.ckpt")
    other.load(tmp_path / "a.ckpt")
    assert (other.policy_version, other.owed_updates) == (43 * 3, 3)
    for each in (learner, other):
        train(each, 40, 3)
    assert written(learner, tmp_path / "b.ckpt") == written(other, tmp_path / "c.ckpt")
    assert learner.propose(STATE) == other.propose(STATE)


# --- every kind of task


@pytest.mark.parametrize("skills", [(RELEASE,), (PICK,), (PICK, PUSH, RELEASE)])
def test_any_set_of_skills_works(skills: tuple[SkillSpec, ...], tmp_path: Path) -> None:
    learner, state = maple(problem(*skills), warm_up=0), np.ones(3)
    for _ in range(20):
        suggestion = learner.propose(state)
        check_call(suggestion.call, skills)
        assert sum(suggestion.skill_probabilities.values()) == pytest.approx(1)
        learner.observe(state, suggestion.call, 0.0, state, False)
        metrics = learner.update()
    assert metrics is not None
    assert tuple(metrics) == METRICS
    assert all(np.isfinite(value) for value in metrics.values())
    learner.save(tmp_path / "a.ckpt")


# --- what makes no sense


@pytest.mark.parametrize("state", [np.array([0.0, np.nan]), np.zeros(3)])
def test_a_bad_state_is_refused(state: Any) -> None:
    learner = maple()
    for attempt in (
        lambda: learner.propose(state),
        lambda: learner.observe(state, CALL, 0.0, STATE, False),
        lambda: learner.observe(STATE, CALL, 0.0, state, False),
    ):
        with pytest.raises(AgentError, match=r"state\[1\]|shape"):
            attempt()
    assert learner.update() is None, "nothing was remembered"


@pytest.mark.parametrize(
    ("call", "reward", "told"),
    [
        (SkillCall("push", (0.0,)), 0.0, "no skill 'push'"),
        (SkillCall("pick", (2.0,)), 0.0, "outside"),
        (SkillCall("pick", (float("nan"),)), 0.0, "outside"),
        (CALL, float("inf"), "reward is inf"),
    ],
)
def test_a_bad_call_or_reward_is_refused(call: SkillCall, reward: float, told: str) -> None:
    learner = maple()
    with pytest.raises(AgentError, match=told) as error:
        learner.observe(STATE, call, reward, STATE, False)
    assert error.value.remedy
    assert learner.update() is None


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (maple(hidden_size=16), "hidden"),
        (maple(problem(PICK)), "skills"),
        (maple(name="maple-aff"), "affordance_penalty"),
    ],
    ids=["size", "task", "reward"],
)
def test_a_checkpoint_of_something_else_changes_nothing(tmp_path: Path, other: Maple, told: str) -> None:
    maple().save(tmp_path / "a.ckpt")
    before = written(other, tmp_path / "b.ckpt")
    with pytest.raises(CheckpointError, match=f"{told}: file has") as error:
        other.load(tmp_path / "a.ckpt")
    assert "train anew" in error.value.remedy
    assert written(other, tmp_path / "b.ckpt") == before


def test_a_checkpoint_of_another_algorithm_is_refused(tmp_path: Path) -> None:
    sac().save(tmp_path / "a.ckpt")
    with pytest.raises(CheckpointError, match="algorithm: file has sac, wanted maple"):
        maple().load(tmp_path / "a.ckpt")


def test_divergence_is_told() -> None:
    learner = maple()
    learner.observe(STATE, CALL, 1e30, STATE, True)
    with pytest.raises(AgentError, match="diverged at gradient step 0"):
        learner.update()
