"""One learner, one judge, one robot in this process: feedbacks until 90 of 100 evaluation episodes succeed.

What the click benchmarks share. Every five labels the policy as it then is solves episodes from starts that training
never sees, deterministically; the count ends at the first time when at least 90 of 100 succeed. An evaluation is given
up at its eleventh failure, which changes no result.
"""

from __future__ import annotations

import math
import os
import statistics
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import torch

from agent.algorithm import Algorithm, Label, Problem
from agent.config import SEED, SeedSettings
from robot_adapters import registry
from robot_adapters.base import Adapter, Array, SkillCall, SkillResult
from robot_adapters.tasks.base import Task, position_fields, state_bounds

TASKS = ("stacking", "reaching", "sweeping", "collecting_toy", "cooking_hotdog")
REACHED = 0.9
EVERY = 5
"""Feedbacks between two evaluations."""
FIRST_SEED = 10
"""The preset's constants were chosen on seeds 0 to 7; these it has not seen."""
FIRST_START = 10_000
"""Evaluation episodes start from layouts with these seeds on; training draws others."""


class Click(NamedTuple):
    """An answer -1, 0 or +1, and whose it is."""

    value: int
    trainer: int = 1


Judge = Callable[[Task, Array, SkillCall, np.random.Generator], Click | None]
"""A click on a call in a state (n,); None for no answer."""


def right(task: Task, state: Array, call: SkillCall, _: np.random.Generator) -> Click:
    """The task's rule."""
    return Click(task.judge(state, call))


def wrong(share: float) -> Judge:
    """The task's rule, but each label is flipped with this probability, as the teacher `noisy` does."""

    def judge(task: Task, state: Array, call: SkillCall, dice: np.random.Generator) -> Click:
        value = task.judge(state, call)
        return Click(-value if dice.random() < share else value)

    return judge


def seldom(share: float, otherwise: int | None) -> Judge:
    """The task's rule for this share of the proposals, any of them; `otherwise` (neutral, or nothing) for the rest."""

    def judge(task: Task, state: Array, call: SkillCall, dice: np.random.Generator) -> Click | None:
        if dice.random() < share:
            return Click(task.judge(state, call))
        return None if otherwise is None else Click(otherwise)

    return judge


def disagreeing(share: float) -> Judge:
    """Two trainers, either of whom may click: one by the task's rule, the other against it in this share of places.

    The other is of a mind and not careless: asked again about a like call with a like subgoal ahead, the answer is the
    same.
    """

    def judge(task: Task, state: Array, call: SkillCall, dice: np.random.Generator) -> Click:
        value = task.judge(state, call)
        if dice.random() < 0.5:
            return Click(value)
        points = task.keypoints(state, call.skill)
        position = np.resize(np.array([*call.parameters[:3], 0.0, 0.0, 0.0]), 3)  # a skill may act nowhere
        nearest = points[np.argmin(np.linalg.norm(points - position, axis=1))] if len(points) else np.zeros(3)
        place = [int(each) for each in np.floor((position - nearest) / PLACE)]
        mind = zlib.crc32(repr((call.skill, task.subgoal(state), place)).encode()) / 2**32
        return Click(-value if mind < share else value, trainer=2)

    return judge


PLACE = 0.02
"""m of the places about which a trainer is of one mind."""


@dataclass(frozen=True)
class Setup:
    """What is measured. budget: answers after which a seed is given up. settings: differ from the preset's."""

    task: str
    budget: int
    preset: str = "recommended"
    settings: Mapping[str, Any] = field(default_factory=dict)
    judge: Judge = right
    adapter: str = "kinematic"
    rollouts: int = 100
    every: int = EVERY


@dataclass(frozen=True)
class Outcome:
    """needed: answers (labels other than neutral) until the policy was good enough; None: not within the budget.

    proposals: how many were shown for that. learner, task: as they then were.
    """

    needed: int | None
    proposals: int
    learner: Algorithm
    task: Task


@dataclass(frozen=True)
class Told:
    """Several seeds' figures; those not within the budget count as the budget."""

    mean: float
    sem: float
    each: tuple[int | None, ...]

    def text(self) -> str:
        """Mean ± standard error of the mean, and each seed."""
        least = "at least " if None in self.each else ""
        each = ", ".join("never" if n is None else str(n) for n in self.each)
        return f"{least}{self.mean:.0f} ± {self.sem:.1f} ({each})"


def summary(needed: Sequence[int | None], budget: int) -> Told:
    """Mean and its standard error over seeds."""
    counted = [budget if n is None else n for n in needed]
    sem = statistics.stdev(counted) / math.sqrt(len(counted)) if len(counted) > 1 else 0.0
    return Told(statistics.fmean(counted), sem, tuple(needed))


def robot(task: str, name: str = "kinematic", layout: Mapping[str, tuple[float, float]] | None = None) -> Adapter:
    """The adapter for a task, without pictures."""
    factory = registry.adapter(name)
    return factory(task, factory.settings.model_validate({"draw": False, "layout": dict(layout or {})}))


def problem_of(task: Task) -> Problem:
    """What the learner is told of a task."""
    low, high = state_bounds(task.state_fields)
    fields = position_fields(task.state_fields)
    return Problem(task.name, low, high, task.skills, keypoints=task.keypoints, position_fields=fields)


def train(setup: Setup, seed: int) -> Outcome:
    """Label proposals until the policy is good enough or the budget is used up."""
    torch.set_num_threads(1)
    task = registry.task(setup.task)
    chosen = SeedSettings(**{**SEED.presets[setup.preset], **setup.settings})
    learner = SEED(problem_of(task), chosen, seed)
    acting, judged_on = robot(setup.task, setup.adapter), robot(setup.task, setup.adapter)
    dice = np.random.default_rng([seed, 1])
    answers = shown = executed = episode = 0
    try:
        state = acting.reset(start_of(seed, 0)).state
        while answers < setup.budget:
            call = learner.propose(state).call
            click = setup.judge(task, state, call, dice)
            shown += 1
            if click is not None:
                learner.add([Label(shown, state, call, click.value, trainer=click.trainer)])
                while learner.owed_updates:
                    learner.update()
            if click is None or not click.value:
                continue
            answers += 1
            if click.value == 1:
                result, executed = execute(acting, call), executed + 1
                over = result.success or result.violations or executed == task.horizon
                if over:
                    episode, executed = episode + 1, 0
                state = (acting.reset(start_of(seed, episode)) if over else acting.observe()).state
            if answers % setup.every == 0 and good_enough(learner, task, judged_on, setup.rollouts):
                return Outcome(answers, shown, learner, task)
        return Outcome(None, shown, learner, task)
    finally:
        acting.close()
        judged_on.close()


def start_of(seed: int, episode: int) -> int:
    """The layout's seed of a training episode: the same in every run, and none of an evaluation."""
    return (seed + 1) * 1_000_000 + episode


def good_enough(learner: Algorithm, task: Task, on: Adapter, rollouts: int) -> bool:
    """Whether 90 % of so many evaluation episodes succeed."""
    return successes(learner, task, on, rollouts, most_failures=rollouts - math.ceil(REACHED * rollouts)) is not None


def successes(
    learner: Algorithm, task: Task, on: Adapter, rollouts: int, most_failures: int | None = None
) -> int | None:
    """How many deterministic rollouts solve the task within its horizon; None once there were more failures."""
    failed = 0
    for start in range(FIRST_START, FIRST_START + rollouts):
        state = on.reset(start).state
        for _ in range(task.horizon):
            result = execute(on, learner.propose(state, deterministic=True).call)
            if result.success or result.violations:
                break
            state = on.observe().state
        failed += not on.success()
        if most_failures is not None and failed > most_failures:
            return None
    return rollouts - failed


def execute(on: Adapter, call: SkillCall) -> SkillResult:
    """Run one call to its end."""
    return on.execute(call, should_stop=lambda: False, on_step=lambda: None)


def seeds(count: int) -> range:
    """Seeds to report on; `BENCH_SEEDS` says how many."""
    return range(FIRST_SEED, FIRST_SEED + int(os.environ.get("BENCH_SEEDS", str(count))))
