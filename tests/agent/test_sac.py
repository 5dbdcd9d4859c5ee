"""SAC: its losses, that it learns, repeats and resumes exactly, and refuses what makes no sense."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from agent import losses
from agent.algorithm import AgentError, CheckpointError
from agent.baseline_config import BASELINES, SacFactory
from agent.gaussian import GaussianActorCritic
from agent.resuming import Progress
from agent.sac import METRICS, Sac
from agent.td import Memory, Schedule
from tests.agent.toys import success_on_line, train_on_line

QUICK: dict[str, Any] = {
    "hidden_size": 32,
    "batch_size": 64,
    "warm_up": 64,
    "gradient_steps": 1,
    "learning_rate": 3e-3,
    "target_rate": 0.02,
    "discount": 0.9,
    "initial_temperature": 0.1,
}
HERE, THERE, ACTION = np.array([0.2]), np.array([0.4]), np.array([0.5])


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def sac(*, number: int = 0, size: int = 1, actions: int = 1, **settings: Any) -> Sac:
    factory = BASELINES["sac"]
    assert isinstance(factory, SacFactory)
    chosen = factory.settings(**{**QUICK, **settings})
    return factory(np.full(size, -1.0), np.full(size, 1.0), actions, chosen, number)


# --- losses


def networks() -> GaussianActorCritic:
    """Small, in float64, and away from the near-zero start at which many gradients vanish."""
    generator = torch.Generator().manual_seed(3)
    made = GaussianActorCritic(3, 2, hidden=[5], critics=2, initial_temperature=0.3, generator=generator).double()
    with torch.no_grad():
        for weight in made.parameters():
            weight.add_(torch.randn(weight.shape, generator=generator), alpha=0.3)
    return made


def assert_gradients_match_differences(network: nn.Module, loss: Callable[[], Tensor], step: float = 1e-6) -> None:
    """Every weight's gradient of `loss` against central differences."""
    network.zero_grad()
    loss().backward()  # type: ignore[no-untyped-call]
    for name, weight in network.named_parameters():
        found = torch.zeros_like(weight) if weight.grad is None else weight.grad.clone()
        expected, flat = torch.zeros_like(weight), weight.data.view(-1)
        for i in range(flat.numel()):
            before = flat[i].item()
            flat[i] = before + step
            above = loss().item()
            flat[i] = before - step
            expected.view(-1)[i] = (above - loss().item()) / (2 * step)
            flat[i] = before
        torch.testing.assert_close(found, expected, rtol=1e-4, atol=1e-7, msg=name)


STATES = torch.randn(4, 3, generator=torch.Generator().manual_seed(1), dtype=torch.float64)
ACTIONS = torch.rand(4, 2, generator=torch.Generator().manual_seed(2), dtype=torch.float64) * 2 - 1


def test_the_critics_gradient_matches_finite_differences() -> None:
    network = networks()
    targets = torch.tensor([1.0, 0.0, -2.0, 0.5], dtype=torch.float64)
    assert_gradients_match_differences(network, lambda: losses.critic_loss(network.values(STATES, ACTIONS), targets))


def test_the_actors_gradient_matches_finite_differences_and_is_nobody_elses() -> None:
    network = networks()

    def loss() -> Tensor:
        return network.climb(STATES, torch.Generator().manual_seed(7), -2.0).actor

    loss().backward()  # type: ignore[no-untyped-call]
    assert all(weight.grad is None for weight in network.critics.parameters())
    assert network.log_temperature.grad is None
    for weight in [*network.critics.parameters(), network.log_temperature]:
        weight.requires_grad_(False)
    actor = nn.Module()
    actor.add_module("actor", network.actor)
    assert_gradients_match_differences(actor, loss)


def test_the_actors_loss_is_sacs() -> None:
    """E[alpha log pi(u|s) - min Q(s, u)], from a draw repeated with torch's own distributions."""
    network = networks()
    mean, log_std = network.actor(STATES)[0].chunk(2, dim=-1)
    noise = torch.randn(1, 4, 2, generator=torch.Generator().manual_seed(7))[0]
    normal = torch.distributions.Normal(mean, log_std.exp())
    squashed = torch.distributions.TransformedDistribution(normal, torch.distributions.TanhTransform())
    actions = torch.tanh(mean + log_std.exp() * noise)
    density = squashed.log_prob(actions).sum(dim=-1)  # type: ignore[no-untyped-call]
    lowest = network.values(STATES, actions).min(dim=0).values
    climb = network.climb(STATES, torch.Generator().manual_seed(7), -2.0)
    temperature = network.log_temperature.exp().item()
    assert climb.actor.item() == pytest.approx((temperature * density - lowest).mean().item())
    assert climb.entropy.item() == pytest.approx(-density.mean().item())
    by_hand = network.log_temperature.item() * (-density.mean().item() + 2.0)
    assert climb.temperature.item() == pytest.approx(by_hand)


@pytest.mark.parametrize(("terminated", "worth"), [(True, 1.0), (False, 2.0)])
def test_an_episode_cut_by_its_horizon_is_worth_what_would_have_come(terminated: bool, worth: float) -> None:
    """Every step pays 1 and leads to where it began: 1 if that is the end, else 1 / (1 - discount)."""
    learner = sac(discount=0.5, initial_temperature=1e-4, action_entropy=-10.0, target_rate=0.1)
    for _ in range(64):
        learner.observe(HERE, learner.act(HERE), 1.0, HERE, terminated)
    for _ in range(400):
        metrics = learner.update()
    assert metrics is not None
    assert metrics["target_mean"] == pytest.approx(worth, abs=0.05)
    assert learner.values(HERE, np.array([[-0.5], [0.5]])).tolist() == pytest.approx([worth, worth], abs=0.15)


def test_slow_critics_start_as_the_fast_ones_and_follow_them() -> None:
    learner = sac(target_rate=0.25)
    fast, slow = (learner._progress.networks[name] for name in ("network", "target"))
    assert isinstance(fast, GaussianActorCritic)
    before = [w.clone() for w in slow.parameters()]
    assert all(torch.equal(a, b) for a, b in zip(before, fast.critics.parameters(), strict=True))
    learner.observe(HERE, ACTION, 1.0, THERE, False)
    learner.update()
    for old, new, ahead in zip(before, slow.parameters(), fast.critics.parameters(), strict=True):
        torch.testing.assert_close(new, old + 0.25 * (ahead - old))


# --- it learns


@pytest.mark.parametrize("number", [0, 1])
def test_it_learns_to_reach_a_point(number: int) -> None:
    learner = sac(number=number)
    untrained = success_on_line(learner)
    train_on_line(learner, 700, number)
    assert untrained <= 0.2
    assert success_on_line(learner) >= 0.85


# --- it repeats exactly


def test_acting_depends_on_seed_and_training_only() -> None:
    looked, plain = sac(), sac()
    first, second = (looked.act(HERE, deterministic=True) for _ in range(2))
    assert np.array_equal(first, second)
    assert [looked.act(HERE).item() for _ in range(3)] == [plain.act(HERE).item() for _ in range(3)]
    assert looked.act(HERE) != sac(number=1).act(HERE)


def test_actions_are_the_environments() -> None:
    drawn = np.array([sac(actions=5, size=4).act(np.zeros(4)) for _ in range(3)])
    assert drawn.shape == (3, 5)
    assert drawn.dtype == np.float64
    assert (np.abs(drawn) <= 1).all()


def test_a_resumed_learner_continues_bit_for_bit(tmp_path: Path) -> None:
    settings = {"warm_up": 40, "train_frequency": 3, "gradient_steps": 2, "replay_size": 150}
    learner, other = sac(**settings), sac(number=5, **settings)
    train_on_line(learner, 200, 0)
    learner.observe(HERE, ACTION, 0.0, THERE, False)
    learner.save(tmp_path / "a.ckpt")
    other.load(tmp_path / "a.ckpt")
    assert (other.policy_version, other.owed_updates) == (learner.policy_version, learner.owed_updates) == (106, 0)
    assert other.digest() == learner.digest()
    for each in (learner, other):
        train_on_line(each, 50, 3)
    assert learner.policy_version == other.policy_version == 140
    assert learner.digest() == other.digest()
    assert [learner.act(HERE).item() for _ in range(3)] == [other.act(HERE).item() for _ in range(3)]


def test_a_fresh_learner_can_be_saved_too(tmp_path: Path) -> None:
    sac().save(tmp_path / "a.ckpt")
    other = sac(number=5)
    other.load(tmp_path / "a.ckpt")
    assert other.digest() == sac().digest()
    assert other.update() is None


# --- the schedule


def test_updates_are_owed_after_the_warm_up() -> None:
    learner, seen = sac(warm_up=2, gradient_steps=5), []
    assert learner.update() is None
    for _ in range(4):
        learner.observe(HERE, ACTION, 0.0, THERE, False)
        seen.append(learner.owed_updates)
    assert seen == [0, 0, 5, 10]
    metrics = learner.update()
    assert metrics is not None
    assert tuple(metrics) == METRICS
    assert all(np.isfinite(value) for value in metrics.values())
    assert (learner.owed_updates, learner.policy_version) == (9, 1)


# --- what makes no sense


@pytest.mark.parametrize("state", [np.array([np.nan]), np.array([np.inf]), np.zeros(2)])
def test_a_bad_state_is_refused(state: Any) -> None:
    learner = sac()
    for attempt in (
        lambda: learner.act(state),
        lambda: learner.observe(state, ACTION, 0.0, THERE, False),
        lambda: learner.observe(HERE, ACTION, 0.0, state, False),
        lambda: learner.values(state, np.array([ACTION])),
    ):
        with pytest.raises(AgentError, match=r"state\[0\]|shape"):
            attempt()
    assert learner.update() is None, "nothing was remembered"


@pytest.mark.parametrize(
    ("action", "reward", "told"),
    [(np.array([np.nan]), 0.0, "action"), (np.zeros(2), 0.0, "action"), (ACTION, float("nan"), "reward")],
)
def test_a_bad_action_or_reward_is_refused(action: Any, reward: float, told: str) -> None:
    learner = sac()
    with pytest.raises(AgentError, match=told) as error:
        learner.observe(HERE, action, reward, THERE, False)
    assert "finite" in error.value.remedy
    assert learner.update() is None


def test_bounds_and_sizes_are_checked() -> None:
    with pytest.raises(AgentError, match="action_size is 0"):
        sac(actions=0)
    with pytest.raises(AgentError, match="bounds"):
        sac(size=0)


def test_divergence_is_told_and_leaves_the_networks_alone() -> None:
    learner = sac()
    learner.observe(HERE, ACTION, 1e30, THERE, False)
    before = learner.digest()
    with pytest.raises(AgentError, match="diverged at gradient step 0") as error:
        learner.update()
    assert "learning_rate" in error.value.remedy
    assert learner.digest() == before


def test_a_finite_loss_saves_no_gradient_that_is_not() -> None:
    root = nn.ParameterDict({"x": torch.zeros(1)})  # the slope of its square root is infinite there
    progress = Progress(
        networks={"root": root},
        optimiser=torch.optim.Adam(root.parameters()),
        memory=Memory(1),
        schedule=Schedule(1, 1, 0),
        dice={},
        drawing=np.random.default_rng(0),
    )
    with pytest.raises(AgentError, match="diverged at gradient step 0"):
        progress.descend(root["x"].sqrt().sum())
    assert (root["x"].item(), progress.version) == (0.0, 0)


@pytest.mark.parametrize(
    ("other", "told"),
    [
        ({"hidden_size": 16}, "hidden"),
        ({"size": 2}, "state"),
        ({"actions": 2}, "skills"),
        ({"hidden_layers": 1}, "hidden"),
    ],
)
def test_a_checkpoint_of_another_architecture_changes_nothing(tmp_path: Path, other: dict[str, Any], told: str) -> None:
    sac().save(tmp_path / "a.ckpt")
    foreign, untouched = sac(**other), sac(**other)
    with pytest.raises(CheckpointError, match=f"{told}: file has") as error:
        foreign.load(tmp_path / "a.ckpt")
    assert "train anew" in error.value.remedy
    assert foreign.digest() == untouched.digest()


def test_a_checkpoint_with_fewer_transitions_than_it_says_is_refused(tmp_path: Path) -> None:
    learner, smaller = sac(replay_size=100), sac(replay_size=20)
    for _ in range(50):
        learner.observe(HERE, ACTION, 0.0, THERE, False)
    learner.save(tmp_path / "a.ckpt")
    with pytest.raises(CheckpointError, match="50 transitions") as error:
        smaller.load(tmp_path / "a.ckpt")
    assert error.value.remedy
    assert smaller.update() is None


def test_a_damaged_checkpoint_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.ckpt"
    sac().save(path)
    path.write_bytes(path.read_bytes()[:-50])
    with pytest.raises(CheckpointError, match="damaged"):
        sac().load(path)
