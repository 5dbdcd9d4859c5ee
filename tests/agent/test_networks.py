"""Stacked networks compute what separate ones would, and learn apart from one another."""

from __future__ import annotations

import pytest
import torch

from agent.networks import Layout, Networks, StackedMLP


def generator() -> torch.Generator:
    return torch.Generator().manual_seed(3)


def networks(*counts: int, critics: int = 2) -> Networks:
    layout = Layout(3, counts)
    return Networks(layout, hidden=[16, 16], critics=critics, initial_temperature=0.5, generator=generator())


def test_a_stack_equals_its_networks_one_by_one() -> None:
    stack = StackedMLP(3, [4, 8, 8, 2], 0.5, generator())
    x = torch.randn(5, 4, generator=generator())
    together = stack(x)
    for index in range(3):
        h = x
        for weight, bias in zip(stack.weights[:-1], stack.biases[:-1], strict=True):
            h = torch.relu(h @ weight[index] + bias[index])
        torch.testing.assert_close(together[index], h @ stack.weights[-1][index] + stack.biases[-1][index])


def test_a_frozen_pass_trains_its_input_only() -> None:
    stack = StackedMLP(1, [4, 8, 1], 0.5, generator())
    x = torch.randn(5, 4, generator=generator(), requires_grad=True)
    torch.testing.assert_close(stack(x, frozen=True), stack(x))
    stack(x, frozen=True).sum().backward()
    assert x.grad is not None
    assert x.grad.abs().sum() > 0
    assert all(p.grad is None for p in stack.parameters())


def test_the_mask_follows_each_skills_parameters() -> None:
    assert Layout(3, (3, 1, 0)).mask().tolist() == [[[1, 1, 1]], [[1, 0, 0]], [[0, 0, 0]]]
    assert Layout(3, (0,)).mask().tolist() == [[[0]]]


def test_every_skill_is_judged_by_the_most_sceptical_critic() -> None:
    nets = networks(2, 1)
    states = torch.randn(5, 3, generator=generator())
    parameters = torch.rand(2, 5, 2, generator=generator())
    together = nets.predict_every_skill(states, parameters)
    for skill in range(2):
        alone = nets.predict(states, torch.full((5,), skill), parameters[skill])
        torch.testing.assert_close(together[skill], alone.min(dim=0).values)


def test_a_fresh_skill_actor_has_no_favourite() -> None:
    probabilities = networks(3, 3, 0).skill_log_probabilities(torch.randn(50, 3, generator=generator())).exp()
    torch.testing.assert_close(probabilities, torch.full_like(probabilities, 1 / 3), atol=0.01, rtol=0)


def test_one_skills_actor_is_trained_apart_from_the_others() -> None:
    nets = networks(2, 2)
    mean, _ = nets.parameter_distributions(torch.randn(5, 3, generator=generator()))
    mean[0].sum().backward()  # type: ignore[no-untyped-call]
    for weight in nets.parameter_actors.weights:
        assert weight.grad is not None
        assert weight.grad[0].abs().sum() > 0
        assert weight.grad[1].abs().sum() == 0


def test_temperatures_start_where_told() -> None:
    nets = networks(1)
    assert nets.log_skill_temperature.exp().item() == pytest.approx(0.5)
    assert nets.log_parameter_temperature.exp().item() == pytest.approx(0.5)
