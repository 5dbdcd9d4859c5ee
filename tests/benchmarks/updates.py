"""Gradient steps per second of SEED with the paper's layers (two of 256), on one core, beside three others.

SEED has one critic here, as in figure 2 of the paper; the presets have twins.

- plain: the same losses in plain PyTorch: a module a network, an optimiser each, a backward each;
- SAC: stable-baselines3's trainer, layers of equal size, which has twin critics with targets and one actor;
- the floor: the matrix products of SEED's step and nothing else, by the very kernels SEED uses, and by plain
  `torch.bmm`.

They take a few steps each in turns, so that a busy machine slows all, and what counts is the processor's time, which
others on the machine don't use up; the figures are medians over steps. The bars: 1.6 times the plain version, .55 of
the floor.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import gymnasium
import numpy as np
import torch
from stable_baselines3 import SAC
from stable_baselines3.common.logger import Logger
from torch import Tensor, nn

from agent import kernels
from agent.algorithm import Label, Problem
from agent.config import SEED, SeedSettings
from agent.replay import Float32
from robot_adapters.base import ParameterSpec, SkillCall, SkillSpec
from tests.benchmarks.result import Result

ROUNDS = 15
LABELS = 500
HIDDEN = 256
STATE = 15
"""Entries of the state: Cooking-Hotdog's low-level one, the longest of the paper."""
WIDTH = 5
PLAIN_BAR, FLOOR_BAR = 1.6, 0.55
COUNTS = {2: (3, 5), 5: (3, 3, 3, 5, 0)}
"""Parameters of each skill, by number of skills: pick and push; reach, pick, place, push and release."""


def run() -> Result:
    """Time all of them for each size; the value is the lowest ratio to the plain version."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        rows = [_measure(skills, batch) for batch in (256, 1024) for skills in COUNTS]
    finally:
        torch.set_num_threads(threads)
    worst = min(row.to_plain for row in rows)
    share = min(row.of_floor for row in rows)
    head = "batch skills  SEED/s  plain/s ratio  SB3 SAC/s ratio  floor/s share  bmm floor/s share"
    told = f"lowest share of the floor: {share:.2f}, bar {FLOOR_BAR}"
    return Result(
        "updates",
        worst,
        "times plain PyTorch",
        baseline=1.0,
        bar=PLAIN_BAR,
        ok=worst >= PLAIN_BAR and share >= FLOOR_BAR,
        lines=(head, *(row.line() for row in rows), told),
    )


@dataclass(frozen=True)
class Row:
    """Steps per second of each."""

    skills: int
    batch: int
    seed: float
    plain: float
    sac: float
    floor: float
    bmm: float

    @property
    def to_plain(self) -> float:
        return self.seed / self.plain

    @property
    def of_floor(self) -> float:
        return self.seed / self.floor

    def line(self) -> str:
        others = f"{self.sac:10.0f} {self.seed / self.sac:5.2f} {self.floor:8.0f} {self.of_floor:5.2f}"
        ours = f"{self.batch:5} {self.skills:6} {self.seed:7.0f} {self.plain:8.0f} {self.to_plain:5.2f}"
        return f"{ours} {others} {self.bmm:12.0f} {self.seed / self.bmm:5.2f}"


def _measure(skills: int, batch: int) -> Row:
    counts = COUNTS[skills]
    every: dict[str, Callable[[], object]] = {
        "seed": _seed(counts, batch),
        "plain": _Plain(STATE, counts, batch).update,
        "sac": _sac(batch),
        "floor": _floor(skills, batch, _quickest),
        "bmm": _floor(skills, batch, _plain_product),
    }
    seen: dict[str, list[float]] = {name: [] for name in every}
    for _ in range(ROUNDS):
        for name, update in every.items():
            seen[name].extend(_times(update, max(3, 12 * 256 // batch)))
    return Row(skills, batch, **{name: 1 / statistics.median(seconds) for name, seconds in seen.items()})


def _times(update: Callable[[], object], steps: int) -> list[float]:
    """Seconds of the processor for each step, after one that warms the caches."""
    update()
    ends = [time.process_time()]
    for _ in range(steps):
        update()
        ends.append(time.process_time())
    return [after - before for before, after in pairwise(ends)]


def _seed(counts: tuple[int, ...], batch: int) -> Callable[[], object]:
    rng = np.random.default_rng(0)
    specs = tuple(
        SkillSpec(f"skill_{k}", tuple(ParameterSpec(f"p{i}", "", -1, 1) for i in range(count)))
        for k, count in enumerate(counts)
    )
    learner = SEED(
        Problem("speed", -np.ones(STATE), np.ones(STATE), specs), SeedSettings(batch_size=batch, critics=1), 0
    )
    labels = []
    for label_id in range(1, LABELS + 1):
        spec = specs[rng.integers(len(specs))]
        call = SkillCall(spec.name, tuple(rng.uniform(-1, 1, len(spec.parameters)).tolist()))
        labels.append(Label(label_id, rng.uniform(-1, 1, STATE), call, int(rng.choice([-1, 1]))))
    learner.add(labels)
    return learner.update


class _Plain:
    """Equations 1-3 and both temperatures, one network after another, without waste: actors leave the critic alone."""

    def __init__(self, n: int, counts: tuple[int, ...], batch: int) -> None:
        self.counts, self.batch, self.K, self.P = counts, batch, len(counts), max(counts)
        self.skill_actor = _mlp(n, self.K)
        self.parameter_actors = [_mlp(n, 2 * count) if count else None for count in counts]
        self.critic = _mlp(n + self.K + self.P, 1)
        self.log_alphas = [nn.Parameter(torch.zeros(())) for _ in range(2)]
        self.skill_adam, self.critic_adam = _adam(self.skill_actor), _adam(self.critic)
        self.actor_adams = [_adam(actor) if actor else None for actor in self.parameter_actors]
        self.alpha_adams = [torch.optim.Adam([log_alpha], lr=3e-3) for log_alpha in self.log_alphas]
        self.targets = -torch.tensor(counts, dtype=torch.float32)
        self.states = torch.rand(LABELS, n)
        self.skills = nn.functional.one_hot(torch.arange(LABELS) % self.K, self.K).float()
        self.parameters = torch.rand(LABELS, self.P)
        self.labels = torch.arange(LABELS) % 2 * 2.0 - 1

    def update(self) -> None:
        drawn = torch.randint(LABELS, (self.batch,))
        states = self.states[drawn]

        predicted = self.critic(torch.cat([states, self.skills[drawn], self.parameters[drawn]], dim=1)).squeeze(1)
        _descend((predicted - self.labels[drawn]).square().mean(), self.critic_adam)

        skill_alpha, parameter_alpha = (log_alpha.exp().detach() for log_alpha in self.log_alphas)
        log_pi = torch.log_softmax(self.skill_actor(states), dim=1)
        pi = log_pi.exp().detach()
        self.critic.requires_grad_(False)
        judged, surplus = [], torch.zeros(())
        for skill, (actor, adam) in enumerate(zip(self.parameter_actors, self.actor_adams, strict=True)):
            x, log_x = torch.zeros(len(states), self.P), torch.zeros(len(states))
            if actor:
                mean, log_std = actor(states).chunk(2, dim=1)
                normal = torch.distributions.Normal(mean, log_std.clamp(-20, 2).exp(), validate_args=False)
                before = normal.rsample()
                drawn_x = torch.tanh(before)
                log_x = (normal.log_prob(before) - torch.log(1 - drawn_x.square() + 1e-6)).sum(dim=1)  # type: ignore[no-untyped-call]
                x = nn.functional.pad(drawn_x, (0, self.P - drawn_x.shape[1]))
            one_hot = torch.zeros(len(states), self.K)
            one_hot[:, skill] = 1
            h = self.critic(torch.cat([states, one_hot, x], dim=1)).squeeze(1)
            judged.append(h.detach())
            if adam:
                _descend((pi[:, skill] * (parameter_alpha * log_x - h)).mean(), adam)
            surplus -= (pi[:, skill] * (log_x.detach() + self.targets[skill])).mean()
        self.critic.requires_grad_(True)
        _descend((log_pi.exp() * (skill_alpha * log_pi - torch.stack(judged, dim=1))).sum(1).mean(), self.skill_adam)
        entropy = -(pi * log_pi.detach()).sum(1).mean() - 0.5
        for log_alpha, adam, more in zip(self.log_alphas, self.alpha_adams, (entropy, surplus), strict=True):
            _descend(log_alpha * more, adam)


def _mlp(size_in: int, size_out: int) -> nn.Sequential:
    layers = nn.Linear(size_in, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, size_out)
    return nn.Sequential(*layers)


def _adam(module: nn.Module) -> torch.optim.Adam:
    return torch.optim.Adam(module.parameters(), lr=3e-3)


def _descend(loss: Tensor, optimiser: torch.optim.Optimizer) -> None:
    optimiser.zero_grad()
    loss.backward()  # type: ignore[no-untyped-call]
    optimiser.step()


class _Still(gymnasium.Env[Float32, Float32]):
    """An environment that is never stepped: SB3 asks one for its spaces."""

    def __init__(self) -> None:
        self.observation_space = gymnasium.spaces.Box(-1, 1, (STATE,), np.float32)
        self.action_space = gymnasium.spaces.Box(-1, 1, (WIDTH,), np.float32)


def _sac(batch: int) -> Callable[[], object]:
    """One gradient step of stable-baselines3's SAC on a filled replay buffer."""
    policy = {"net_arch": [HIDDEN, HIDDEN]}
    model = SAC("MlpPolicy", _Still(), batch_size=batch, buffer_size=LABELS, policy_kwargs=policy, device="cpu", seed=0)
    model.set_logger(Logger(folder=None, output_formats=[]))
    rng, buffer = np.random.default_rng(0), model.replay_buffer
    assert buffer is not None
    for _ in range(LABELS):
        states = rng.uniform(-1, 1, (2, 1, STATE))
        buffer.add(states[0], states[1], rng.uniform(-1, 1, (1, WIDTH)), rng.uniform(size=1), np.zeros(1), [{}])
    return lambda: model.train(gradient_steps=1, batch_size=batch)


@dataclass(frozen=True)
class _Net:
    """Networks of the step. learnt: rows that weights learn from; of the others the inputs get a gradient."""

    count: int
    sizes: tuple[int, ...]
    rows: int
    learnt: int


def _floor(skills: int, batch: int, way: Callable[[_Net], Callable[[], object]]) -> Callable[[], object]:
    """The products of one step: forward, by inputs, by weights."""
    hidden = (HIDDEN, HIDDEN)
    nets = (
        _Net(1, (STATE, *hidden, skills), batch, batch),
        _Net(skills, (STATE, *hidden, 2 * WIDTH), batch, batch),
        _Net(1, (STATE + skills + WIDTH, *hidden, 1), (1 + skills) * batch, batch),
    )
    every = [way(net) for net in nets]

    def products() -> None:
        with torch.no_grad():
            for each in every:
                each()

    return products


def _quickest(net: _Net) -> Callable[[], object]:
    """By oneDNN where SEED uses it, in the same pieces; narrow products transposed, as SEED does."""
    asked: list[Callable[[], object]] = []
    for _ in range(net.count):
        most = kernels.ACTIVATIONS // HIDDEN
        pieces = [(most, True)] * (net.learnt // most) + [(most, False)] * ((net.rows - net.learnt) // most)
        for rows, learnt in pieces:
            for depth, (i, o) in enumerate(pairwise(net.sizes)):
                x, weight, gradient = torch.randn(rows, i), torch.randn(i, o), torch.randn(rows, o)
                wide = o > kernels.NARROW and kernels.onednn()
                asked.append(
                    partial(kernels._onednn, x, weight.t(), None, "none")
                    if wide
                    else partial(torch.mm, weight.t(), x.t())
                )
                if depth:
                    narrow_back = torch.mul if o == 1 else torch.mm
                    asked.append(
                        partial(kernels._onednn, gradient, weight, None, "none")
                        if wide
                        else partial(narrow_back, gradient, weight.t())
                    )
                elif not learnt:
                    asked.append(partial(torch.mm, weight[-WIDTH:], gradient.t()))
                if learnt:
                    large = wide and rows * i * o >= kernels.LARGE
                    narrow = (
                        partial(torch.mm, gradient.t(), x)
                        if o <= kernels.NARROW
                        else partial(torch.mm, x.t(), gradient)
                    )
                    asked.append(partial(kernels._onednn, x.t(), gradient.t(), None, "none") if large else narrow)
    return lambda: [product() for product in asked]


def _plain_product(net: _Net) -> Callable[[], object]:
    """By `torch.bmm`, whole."""
    asked: list[Callable[[], object]] = []
    for depth, (i, o) in enumerate(pairwise(net.sizes)):
        x, weight, gradient = (torch.randn(net.count, *s) for s in ((net.rows, i), (i, o), (net.rows, o)))
        asked.append(partial(torch.bmm, x, weight))
        asked.append(partial(torch.bmm, x[:, : net.learnt].transpose(1, 2), gradient[:, : net.learnt]))
        if depth:
            asked.append(partial(torch.bmm, gradient, weight.transpose(1, 2)))
        elif net.rows > net.learnt:
            asked.append(partial(torch.bmm, gradient[:, net.learnt :], weight[:, -WIDTH:].transpose(1, 2)))
    return lambda: [product() for product in asked]
