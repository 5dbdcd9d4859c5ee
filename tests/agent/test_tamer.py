"""TAMER: the oracle's rule, that labels teach faster than rewards, and the usual promises of a learner."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from agent.algorithm import AgentError, CheckpointError
from agent.baseline_config import BASELINES, TamerFactory, TamerSettings
from agent.sac import Sac
from agent.tamer import METRICS, Tamer, judge
from tests.agent.test_sac import QUICK, sac
from tests.agent.toys import success_on_line, train_on_line

HERE, ACTION = np.array([0.2]), np.array([0.5])
SETTINGS = {name: value for name, value in QUICK.items() if name in TamerSettings.model_fields}
BUDGET = 1000


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


@cache
def trained(number: int) -> tuple[Sac, int]:
    """A SAC agent with 1000 steps on the line, and after how many it first solved 9 of 10 starts."""
    learner = sac(number=number)
    needed = train_on_line(learner, BUDGET, number, until=0.9)
    train_on_line(learner, BUDGET - needed, number + 100)
    return learner, needed


def tamer(*, number: int = 0, oracle: Sac | None = None, size: int = 1, actions: int = 1, **settings: Any) -> Tamer:
    factory = BASELINES["tamer"]
    assert isinstance(factory, TamerFactory)
    chosen = factory.settings(**{**SETTINGS, **settings})
    judged_by = oracle or sac(number=4, size=size, actions=actions)
    return factory(np.full(size, -1.0), np.full(size, 1.0), actions, chosen, number, oracle=judged_by)


# --- the oracle's rule


@pytest.mark.parametrize(
    ("value", "best", "strictness", "label"),
    [
        (0.9991, 1.0, 0.999, 1),
        (0.9989, 1.0, 0.999, -1),
        (1.2, 1.0, 0.999, 1),  # the oracle's own action need not be its critic's favourite
        (-1.0009, -1.0, 0.999, 1),
        (-1.0011, -1.0, 0.999, -1),
        (-0.5, -1.0, 0.999, 1),
        (0.0, 0.0, 0.999, 1),
        (-0.0001, 0.0, 0.999, -1),
        (-0.1, 0.05, 0.9, -1),
    ],
)
def test_an_action_may_fall_short_of_the_oracles_by_a_share(
    value: float, best: float, strictness: float, label: int
) -> None:
    assert judge(value, best, strictness) == label


FINITE = st.floats(-1e6, 1e6)
STRICT = st.floats(0.5, 1.0)


@given(value=FINITE, best=st.floats(0.0, 1e6), strictness=STRICT)
def test_for_a_positive_q_it_is_the_papers_inequality(value: float, best: float, strictness: float) -> None:
    if abs(value - strictness * best) > 1e-6 * (1 + abs(best)):  # not where rounding decides
        assert judge(value, best, strictness) == (1 if value >= strictness * best else -1)


@given(best=FINITE, strictness=STRICT)
def test_the_oracle_never_refuses_its_own_action(best: float, strictness: float) -> None:
    """As the inequality taken literally does wherever Q is negative."""
    assert judge(best, best, strictness) == 1
    if best < -1 and strictness < 0.999:
        assert not best >= strictness * best


@given(value=FINITE, best=FINITE, strictness=STRICT, more=STRICT)
def test_a_stricter_oracle_accepts_no_more(value: float, best: float, strictness: float, more: float) -> None:
    low, high = sorted((strictness, more))
    assert judge(value, best, high) <= judge(value, best, low)


def test_alpha_rises_with_the_labels(tmp_path: Path) -> None:
    learner = tamer(strictness=0.9, final_strictness=0.98, strictness_labels=4)
    seen = []
    for _ in range(6):
        seen.append(learner.strictness)
        learner.observe(HERE, ACTION)
    assert seen == pytest.approx([0.9, 0.92, 0.94, 0.96, 0.98, 0.98])
    learner.save(tmp_path / "a.ckpt")
    other = tamer(strictness=0.9, final_strictness=0.98, strictness_labels=4)
    other.load(tmp_path / "a.ckpt")
    assert other.strictness == learner.strictness


def test_the_oracle_is_asked_about_the_action_taken() -> None:
    """A little left of the goal, a trained oracle likes to go right and not left, and likes its own action."""
    oracle, _ = trained(0)
    learner = tamer(oracle=oracle)
    here = np.array([0.0])
    assert learner.observe(here, np.array([1.0])) == 1
    assert learner.observe(here, np.array([-1.0])) == -1
    assert learner.observe(here, oracle.act(here, deterministic=True)) == 1


# --- it learns


@pytest.mark.parametrize("number", [0, 1])
def test_labels_of_a_trained_oracle_teach_faster_than_rewards(number: int) -> None:
    """Steps until 9 of 10 starts are solved, at equal network sizes, batches and learning rates."""
    oracle, needed = trained(number)
    assert success_on_line(oracle) >= 0.85
    taught = tamer(number=number, oracle=oracle)
    steps = train_on_line(taught, BUDGET, number, until=0.9)
    assert steps <= needed / 2, f"TAMER took {steps} steps, SAC {needed}"
    assert success_on_line(taught) >= 0.9


@pytest.mark.parametrize("reward", [0.0, 1.0])
def test_the_critic_predicts_the_label_and_the_sparse_reward(reward: float) -> None:
    learner = tamer(oracle=trained(0)[0])
    here, good, bad = np.array([0.0]), np.array([1.0]), np.array([-1.0])
    for _ in range(20):
        learner.observe(here, good, reward)
        learner.observe(here, bad)
    for _ in range(250):
        metrics = learner.update()
    assert metrics is not None
    assert metrics["critic_loss"] < 0.05
    assert metrics["good_share"] == 0.5
    states, actions = torch.zeros(2, 1), torch.tensor([[1.0], [-1.0]])
    predicted = learner._networks.values(states, actions)[0].tolist()
    assert predicted == pytest.approx([1 + reward, -1], abs=0.25)


def test_batches_are_half_good_where_good_is_rare() -> None:
    learner = tamer(oracle=trained(0)[0], batch_size=64)
    here = np.array([0.0])
    for i in range(60):
        learner.observe(here, np.array([1.0 if i == 7 else -1.0]))
    batch, share = learner._balanced()
    assert share == pytest.approx(1 / 60)
    assert (batch["label"] > 0).sum().item() == 32
    assert (batch["label"] < 0).sum().item() == 32


# --- it repeats exactly


def test_a_resumed_learner_continues_bit_for_bit(tmp_path: Path) -> None:
    oracle, _ = trained(0)
    learner, other = (tamer(number=n, oracle=oracle, replay_size=100) for n in (0, 9))
    train_on_line(learner, 150, 0)
    learner.save(tmp_path / "a.ckpt")
    other.load(tmp_path / "a.ckpt")
    assert other.policy_version == learner.policy_version == 150 - 64
    for each in (learner, other):
        train_on_line(each, 40, 3)
    learner.save(tmp_path / "b.ckpt")
    other.save(tmp_path / "c.ckpt")
    assert (tmp_path / "b.ckpt").read_bytes() == (tmp_path / "c.ckpt").read_bytes()


def test_an_oracle_from_a_checkpoint_judges_as_the_one_that_was_saved(tmp_path: Path) -> None:
    oracle, _ = trained(0)
    oracle.save(tmp_path / "oracle.ckpt")
    loaded = sac(number=9)
    loaded.load(tmp_path / "oracle.ckpt")
    one, two = tamer(oracle=oracle), tamer(oracle=loaded)
    for each in (one, two):
        train_on_line(each, 100, 0)
        each.save(tmp_path / f"{id(each)}.ckpt")
    assert (tmp_path / f"{id(one)}.ckpt").read_bytes() == (tmp_path / f"{id(two)}.ckpt").read_bytes()


# --- what makes no sense


def test_a_bad_state_action_or_reward_is_refused() -> None:
    learner = tamer()
    for attempt in (
        lambda: learner.act(np.array([np.nan])),
        lambda: learner.observe(np.array([np.nan]), ACTION),
        lambda: learner.observe(HERE, np.array([np.inf])),
        lambda: learner.observe(HERE, ACTION, float("nan")),
    ):
        with pytest.raises(AgentError, match=r"finite|action|reward"):
            attempt()
    assert learner.update() is None, "nothing was remembered"


def test_an_oracle_of_another_task_is_refused() -> None:
    with pytest.raises(AgentError, match="states of 2 and actions of 1 entries, not 1 and 1") as error:
        tamer(oracle=sac(size=2))
    assert "same task" in error.value.remedy


def test_a_checkpoint_of_another_algorithm_size_or_oracle_is_refused(tmp_path: Path) -> None:
    learner = tamer()
    learner.save(tmp_path / "tamer.ckpt")
    sac().save(tmp_path / "sac.ckpt")
    for path, other, told in (
        ("sac.ckpt", learner, "algorithm: file has sac"),
        ("tamer.ckpt", tamer(hidden_size=16), "hidden: file has"),
        ("tamer.ckpt", tamer(critics=2), "critics: file has"),
        ("tamer.ckpt", tamer(oracle=sac(number=5)), "oracle: file has"),
    ):
        with pytest.raises(CheckpointError, match=told) as error:
            other.load(tmp_path / path)
        assert "train anew" in error.value.remedy


def test_divergence_is_told() -> None:
    learner = tamer()
    learner.observe(HERE, ACTION, 1e30)
    with pytest.raises(AgentError, match="diverged at gradient step 0"):
        learner.update()


def test_an_update_reports_what_it_did() -> None:
    learner = tamer()
    learner.observe(HERE, ACTION)
    metrics = learner.update()
    assert metrics is not None
    assert tuple(metrics) == METRICS
    assert all(np.isfinite(value) for value in metrics.values())
