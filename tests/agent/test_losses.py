"""The losses against values worked out by hand, against sampling, and their gradients against finite differences."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import torch
from torch import Tensor

from agent import losses

HALVES = torch.tensor([[0.5, 0.5]], dtype=torch.float64).log()
QUARTERS = torch.tensor([[0.25, 0.75]], dtype=torch.float64).log()


def gradient_by_differences(function: Callable[[Tensor], Tensor], at: Tensor, step: float = 1e-6) -> Tensor:
    """Central differences of a scalar function."""
    result = torch.zeros_like(at)
    for index in np.ndindex(*at.shape):
        move = torch.zeros_like(at)
        move[index] = step
        result[index] = (function(at + move) - function(at - move)) / (2 * step)
    return result


def gradient(function: Callable[[Tensor], Tensor], at: Tensor) -> Tensor:
    """By backpropagation."""
    x = at.clone().requires_grad_()
    (result,) = torch.autograd.grad(function(x), x)
    return result


def test_eq1_is_the_mean_squared_distance_to_the_label() -> None:
    predicted = torch.tensor([[0.5, -0.5, 0.0]])
    labels = torch.tensor([1.0, -1.0, 0.0])
    assert losses.critic_loss(predicted, labels).item() == pytest.approx((0.25 + 0.25 + 0) / 3)


def test_eq1_adds_up_over_critics() -> None:
    predicted = torch.tensor([[0.5, -0.5], [1.0, 1.0]])
    labels = torch.tensor([1.0, -1.0])
    assert losses.critic_loss(predicted, labels).item() == pytest.approx(0.25 + 4 / 2)


def test_eq2_is_the_exact_sum_over_skills() -> None:
    predicted = torch.tensor([[0.2], [-0.6]], dtype=torch.float64)
    by_hand = 0.25 * (0.5 * math.log(0.25) - 0.2) + 0.75 * (0.5 * math.log(0.75) + 0.6)
    assert losses.skill_actor_loss(QUARTERS, predicted, torch.tensor(0.5)).item() == pytest.approx(by_hand)


def test_eq3_weighs_each_skill_by_its_probability() -> None:
    predicted = torch.tensor([[0.2], [-0.6]], dtype=torch.float64)
    density = torch.tensor([[-1.0], [2.0]], dtype=torch.float64)
    by_hand = 0.25 * (0.1 * -1.0 - 0.2) + 0.75 * (0.1 * 2.0 + 0.6)
    assert losses.parameter_actor_loss(QUARTERS, density, predicted, torch.tensor(0.1)).item() == pytest.approx(by_hand)


def test_eq2_and_eq3_take_the_mean_over_states() -> None:
    log_pi = torch.cat([HALVES, QUARTERS])
    predicted = torch.tensor([[0.2, 0.4], [-0.6, 0.1]], dtype=torch.float64)
    one = torch.tensor(1.0)
    apart = [losses.skill_actor_loss(log_pi[i : i + 1], predicted[:, i : i + 1], one).item() for i in (0, 1)]
    assert losses.skill_actor_loss(log_pi, predicted, one).item() == pytest.approx(sum(apart) / 2)
    apart = [
        losses.parameter_actor_loss(log_pi[i : i + 1], predicted[:, :1], predicted[:, i : i + 1], one).item()
        for i in (0, 1)
    ]
    together = losses.parameter_actor_loss(log_pi, predicted[:, :1].expand(2, 2), predicted, one).item()
    assert together == pytest.approx(sum(apart) / 2)


def test_gradient_of_eq2_reaches_the_skill_actor_only() -> None:
    predicted = torch.tensor([[0.3, -0.2], [-0.5, 0.9], [0.0, 0.4]], dtype=torch.float64, requires_grad=True)
    temperature = torch.tensor(0.3, dtype=torch.float64, requires_grad=True)

    def loss(logits: Tensor) -> Tensor:
        return losses.skill_actor_loss(torch.log_softmax(logits, dim=-1), predicted, temperature)

    logits = torch.tensor([[0.1, -0.4, 0.7], [1.0, 0.2, -2.0]], dtype=torch.float64)
    torch.testing.assert_close(gradient(loss, logits), gradient_by_differences(loss, logits).detach())
    loss(logits.requires_grad_()).backward()  # type: ignore[no-untyped-call]
    assert predicted.grad is None
    assert temperature.grad is None


def test_gradient_of_eq3_flows_through_the_sampled_parameters() -> None:
    generator = torch.Generator().manual_seed(1)
    noise = torch.randn(2, 1, 3, generator=generator, dtype=torch.float64)
    mask = torch.tensor([[[1.0, 1.0, 1.0]], [[1.0, 0.0, 0.0]]], dtype=torch.float64)
    slope = torch.tensor([0.7, -1.3, 0.4], dtype=torch.float64)

    def loss(mean_and_spread: Tensor) -> Tensor:
        mean, log_std = mean_and_spread.chunk(2, dim=-1)
        x, density = losses.sample_parameters(mean, log_std, mask, noise)
        critic = torch.sin(x @ slope) + x.square().sum(dim=-1)
        return losses.parameter_actor_loss(QUARTERS, density, critic, torch.tensor(0.2))

    at = torch.randn(2, 1, 6, generator=generator, dtype=torch.float64)
    computed = gradient(loss, at)
    torch.testing.assert_close(computed, gradient_by_differences(loss, at))
    assert computed[1, 0, [1, 2, 4, 5]].abs().max().item() == 0, "padded parameters must not be trained"


def test_gradient_of_eq3_leaves_the_skill_actor_alone() -> None:
    log_pi = HALVES.clone().requires_grad_()
    density = torch.zeros(2, 1, dtype=torch.float64, requires_grad=True)
    losses.parameter_actor_loss(log_pi, density, density * 2, torch.tensor(1.0)).backward()  # type: ignore[no-untyped-call]
    assert log_pi.grad is None


def test_density_of_a_tanh_gaussian_matches_torch() -> None:
    mean, log_std = (
        torch.tensor([[[0.3, -1.0]]], dtype=torch.float64),
        torch.tensor([[[-0.5, 0.4]]], dtype=torch.float64),
    )
    noise = torch.tensor([[[0.8, -0.1]]], dtype=torch.float64)
    x, density = losses.sample_parameters(mean, log_std, torch.ones(1, 1, 2, dtype=torch.float64), noise)
    reference = torch.distributions.TransformedDistribution(
        torch.distributions.Normal(mean, log_std.exp()), torch.distributions.TanhTransform()
    )
    expected = reference.log_prob(x).sum(dim=-1)  # type: ignore[no-untyped-call]
    torch.testing.assert_close(density, expected)
    assert density.item() == pytest.approx(
        sum(
            -0.5 * n**2 - s - 0.5 * math.log(2 * math.pi) - math.log(1 - math.tanh(m + math.exp(s) * n) ** 2)
            for m, s, n in ((0.3, -0.5, 0.8), (-1.0, 0.4, -0.1))
        )
    )


def test_density_integrates_to_one() -> None:
    x = torch.linspace(-1, 1, 200_001, dtype=torch.float64)[1:-1]
    before, spread = torch.atanh(x), 0.7
    density = losses.tanh_gaussian_log_probability(
        before[:, None], ((before - 0.4) / spread)[:, None], torch.tensor(math.log(spread)), torch.tensor(1.0)
    ).exp()
    assert torch.trapezoid(density, x).item() == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("before", [-400.0, -30.0, 30.0, 400.0])
def test_density_stays_finite_where_tanh_saturates(before: float) -> None:
    value = torch.full((1, 1), before)
    density = losses.tanh_gaussian_log_probability(value, torch.zeros(1, 1), torch.zeros(1, 1), torch.ones(1, 1))
    assert density.item() == pytest.approx(-0.5 * math.log(2 * math.pi) + 2 * (abs(before) - math.log(2)), rel=1e-5)


@pytest.mark.parametrize(("target", "sign"), [(0.9, -1), (0.1, 1)])
def test_skill_temperature_rises_while_the_entropy_is_too_low(target: float, sign: int) -> None:
    def loss(log_temperature: Tensor) -> Tensor:
        return losses.skill_temperature_loss(log_temperature, HALVES, target)

    by_hand = math.log(2) - target
    assert gradient(loss, torch.tensor(0.5)).item() == pytest.approx(by_hand, rel=1e-6)
    assert math.copysign(1, by_hand) == sign


def test_parameter_temperature_weighs_skills_and_their_own_targets() -> None:
    density = torch.tensor([[1.5], [0.0]], dtype=torch.float64)
    targets = torch.tensor([[-3.0], [0.0]], dtype=torch.float64)

    def loss(log_temperature: Tensor) -> Tensor:
        return losses.parameter_temperature_loss(log_temperature, QUARTERS, density, targets)

    # the second skill has no parameters: density and target 0, so it asks for nothing
    assert gradient(loss, torch.tensor(0.5, dtype=torch.float64)).item() == pytest.approx(0.25 * (-1.5 + 3.0))
