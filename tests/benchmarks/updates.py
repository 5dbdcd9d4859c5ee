"""Gradient steps per second of SEED beside the same step written in the plainest PyTorch, on one core.

Baseline: one module a network, a loop over skills, three optimisers with three backward passes, as one would write it
from equations 1-3 without a thought for speed. Both are timed in turns, so that a busy machine slows both.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np
import torch
from torch import Tensor, nn

from agent.algorithm import Label, Problem
from agent.config import SEED, SeedSettings
from robot_adapters import registry
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task, state_bounds
from tests.benchmarks.result import Result

ROUNDS = 5
LABELS = 500


def run() -> Result:
    """Time both at the table's batch sizes; the value is for 256."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        (ours, plain), large = (_measure(batch, steps) for batch, steps in ((256, 40), (1024, 10)))
    finally:
        torch.set_num_threads(threads)
    lines = tuple(
        f"batch {batch}: {a:.0f} updates/s ({1000 / a:.1f} ms), plain PyTorch {b:.0f} updates/s: ratio {a / b:.2f}"
        for batch, (a, b) in ((256, (ours, plain)), (1024, large))
    )
    return Result("updates", ours, "updates/s", baseline=plain, bar=plain, ok=ours >= plain, lines=lines)


def _measure(batch_size: int, steps: int) -> tuple[float, float]:
    """Updates per second, SEED's and the plain one's: medians over rounds."""
    task = registry.task("stacking")
    low, high = state_bounds(task.state_fields)
    problem = Problem(task.name, low, high, task.skills)
    learner = SEED(problem, SeedSettings(batch_size=batch_size), 0)
    learner.add(_labels(task, low, high))
    plain = _Plain(len(low), len(task.skills), 3, batch_size)
    rates: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for update, seen in zip((learner.update, plain.update), rates, strict=True):
            seen.append(_rate(update, steps))
    return statistics.median(rates[0]), statistics.median(rates[1])


def _rate(update: Callable[[], object], steps: int) -> float:
    update()
    start = time.perf_counter()
    for _ in range(steps):
        update()
    return steps / (time.perf_counter() - start)


def _labels(task: Task, low: Array, high: Array) -> list[Label]:
    rng = np.random.default_rng(0)
    labels = []
    for label_id in range(1, LABELS + 1):
        spec = task.skills[rng.integers(len(task.skills))]
        unit = rng.uniform(-1, 1, len(spec.parameters))
        call = SkillCall(spec.name, tuple(spec.denormalise(unit).tolist()))
        labels.append(Label(label_id, rng.uniform(low, high), call, int(rng.choice([-1, 1]))))
    return labels


class _Plain:
    """Equations 1-3 and both temperatures, one thing after another."""

    def __init__(self, n: int, K: int, P: int, batch_size: int) -> None:
        self.K, self.P, self.batch_size = K, P, batch_size
        self.skill_actor = _mlp(n, K)
        self.parameter_actors = nn.ModuleList([_mlp(n, 2 * P) for _ in range(K)])
        self.critic = _mlp(n + K + P, 1)
        self.log_alphas = nn.ParameterList([torch.zeros(()), torch.zeros(())])
        self.critic_adam = torch.optim.Adam(self.critic.parameters(), lr=3e-3)
        actors = [*self.skill_actor.parameters(), *self.parameter_actors.parameters()]
        self.actor_adam = torch.optim.Adam(actors, lr=3e-3)
        self.alpha_adam = torch.optim.Adam(self.log_alphas.parameters(), lr=3e-3)
        self.rows = [(torch.rand(n), i % K, torch.rand(P), float(i % 2) * 2 - 1) for i in range(LABELS)]

    def update(self) -> None:
        drawn = [self.rows[i] for i in np.random.default_rng(0).integers(LABELS, size=self.batch_size)]
        states = torch.stack([row[0] for row in drawn])
        skills = nn.functional.one_hot(torch.tensor([row[1] for row in drawn]), self.K).float()
        parameters = torch.stack([row[2] for row in drawn])
        labels = torch.tensor([row[3] for row in drawn])

        predicted = self.critic(torch.cat([states, skills, parameters], dim=1)).squeeze(1)
        _descend((predicted - labels).square().mean(), self.critic_adam)

        log_pi = torch.log_softmax(self.skill_actor(states), dim=1)
        skill_alpha, parameter_alpha = (log_alpha.exp().detach() for log_alpha in self.log_alphas)
        loss, skill_surplus, parameter_surplus = torch.zeros(()), torch.zeros(()), torch.zeros(())
        for skill, actor in enumerate(self.parameter_actors):
            mean, log_std = actor(states).chunk(2, dim=1)
            normal = torch.distributions.Normal(mean, log_std.clamp(-20, 2).exp())
            before = normal.rsample()
            x = torch.tanh(before)
            log_x = (normal.log_prob(before) - torch.log(1 - x.square() + 1e-6)).sum(dim=1)  # type: ignore[no-untyped-call]
            one_hot = torch.zeros(len(states), self.K)
            one_hot[:, skill] = 1
            h = self.critic(torch.cat([states, one_hot, x], dim=1)).squeeze(1)
            p = log_pi[:, skill].exp()
            loss = loss + (p * (skill_alpha * log_pi[:, skill] - h.detach())).mean()
            loss = loss + (p.detach() * (parameter_alpha * log_x - h)).mean()
            skill_surplus = skill_surplus - (p * log_pi[:, skill]).mean().detach()
            parameter_surplus = parameter_surplus - (p * (log_x - self.P)).mean().detach()
        _descend(loss, self.actor_adam)
        _descend(self.log_alphas[0] * skill_surplus + self.log_alphas[1] * parameter_surplus, self.alpha_adam)


def _mlp(size_in: int, size_out: int) -> nn.Module:
    return nn.Sequential(nn.Linear(size_in, 256), nn.ReLU(), nn.Linear(256, 256), nn.ReLU(), nn.Linear(256, size_out))


def _descend(loss: Tensor, optimiser: torch.optim.Optimizer) -> None:
    optimiser.zero_grad()
    loss.backward()  # type: ignore[no-untyped-call]
    optimiser.step()
