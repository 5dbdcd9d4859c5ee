"""The gradients worked out by hand are those that autograd finds for the paper's losses, for every shape of task."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
import torch
from torch import Tensor

from agent import kernels, losses
from agent.arena import Arena
from agent.encoding import Encoder
from agent.gradients import Gradients, Lesson
from agent.grounding import grounding
from agent.networks import Layout, Networks
from tests.agent.problems import of_task

SKILL_ENTROPY = 0.4


def networks(task: str, *, grounded: bool, hidden: int, critics: int, count: int) -> list[Networks]:
    """Some that differ, with weights far enough from their start that every bound is met somewhere."""
    problem = of_task(task)
    encoder = Encoder(problem, keypoints="skill" if grounded else "none")
    reads = grounding(problem.skills, encoder.keypoint_counts, grounded=grounded, relative=grounded, radius=0.04)
    layout = Layout(encoder.state_size, encoder.parameter_counts)
    made = []
    for seed in range(count):
        dice = torch.Generator().manual_seed(seed)
        sizes = [hidden, hidden]
        made.append(
            Networks(layout, hidden=sizes, critics=critics, initial_temperature=0.3, generator=dice, grounding=reads)
        )
        with torch.no_grad():
            for parameter in made[-1].parameters():
                parameter.add_(4.0 / hidden * torch.randn(parameter.shape, generator=dice))
    return made


def lesson(of: Networks, learners: int, batch: int, keypoints: tuple[int, ...]) -> Lesson:
    dice = torch.Generator().manual_seed(5)
    options, _, width = of.mask.shape

    def normal(*shape: int) -> Tensor:
        return torch.randn(learners, *shape, generator=dice)

    return Lesson(
        states=normal(batch, of.layout.state_size),
        skills=torch.randint(of.layout.skills, (learners, batch), generator=dice),
        parameters=normal(batch, width).tanh(),
        targets=normal(batch),
        keypoints=normal(batch, *keypoints) * 0.1,
        noise=normal(options, batch, width),
    )


def by_autograd(of: Networks, all_lessons: Lesson, learner: int) -> tuple[float, Mapping[str, Tensor]]:
    """The total loss and its gradients, from `agent.losses` and the networks as `agent.proposing` uses them."""
    states, skills, parameters, targets, keypoints, noise = (
        getattr(all_lessons, name)[learner]
        for name in ("states", "skills", "parameters", "targets", "keypoints", "noise")
    )
    log_pi = of.skill_log_probabilities(states)
    mean, log_std = of.parameter_distributions(states)
    imagined, log_pi_x = losses.sample_parameters(mean, log_std, of.mask, noise)
    predicted = of.predict_every_skill(states, imagined, keypoints)
    entropy_target = -of.mask.sum(dim=-1)
    total = (
        losses.critic_loss(of.predict(states, skills, parameters, keypoints), targets)
        + losses.skill_actor_loss(log_pi, predicted, of.log_skill_temperature.exp())
        + losses.parameter_actor_loss(log_pi, log_pi_x, predicted, of.log_parameter_temperature.exp())
        + losses.skill_temperature_loss(of.log_skill_temperature, log_pi, SKILL_ENTROPY)
        + losses.parameter_temperature_loss(of.log_parameter_temperature, log_pi, log_pi_x, entropy_target)
    )
    named = dict(of.named_parameters())
    found = torch.autograd.grad(total, list(named.values()))
    return total.item(), dict(zip(named, found, strict=True))


def check(task: str, *, grounded: bool, hidden: int, critics: int, count: int, batch: int) -> None:
    learners = networks(task, grounded=grounded, hidden=hidden, critics=critics, count=count)
    shape = Encoder(of_task(task), keypoints="skill" if grounded else "none").keypoint_shape
    given = lesson(learners[0], count, batch, shape)
    expected = [by_autograd(each, given, at) for at, each in enumerate(learners)]
    arena = Arena(learners, learning_rate=1e-3)
    metrics, total = Gradients(arena, SKILL_ENTROPY, -learners[0].mask.sum(dim=-1))(given)
    assert torch.isfinite(metrics).all()
    for at, (loss, gradients) in enumerate(expected):
        assert total[at].item() == pytest.approx(loss, rel=1e-5)
        for name, gradient in gradients.items():
            ours, scale = arena.block(name, arena.gradients)[at], gradient.abs().max().item()
            torch.testing.assert_close(ours, gradient, rtol=1e-4, atol=1e-5 * scale, msg=name)


@pytest.mark.parametrize("critics", [1, 2])
@pytest.mark.parametrize("count", [1, 3])
@pytest.mark.parametrize(
    ("task", "grounded"), [("reaching", False), ("sweeping", True), ("cooking_hotdog", True), ("collecting_toy", True)]
)
def test_small_networks(task: str, grounded: bool, count: int, critics: int) -> None:
    check(task, grounded=grounded, hidden=32, critics=critics, count=count, batch=16)


@pytest.mark.parametrize("batch", [256, 552])
def test_large_networks(batch: int) -> None:
    """The paper's sizes, where the processor lets each network go alone, in several parts."""
    check("sweeping", grounded=True, hidden=256, critics=2, count=1, batch=batch)


def test_without_onednn_large_networks_learn_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernels, "onednn", lambda: False)
    check("stacking", grounded=False, hidden=256, critics=1, count=1, batch=256)
