"""How far the critic of `recommended` may be trusted, without physics: calibration, and what it would approve itself.

Learner, kinematic adapter and the task's own judge in one process, 150 labels on each of five seeds that the preset was
not chosen on. Each prediction is taken when the proposal is made, before its label trains. What the first 50 labels say
is left out: auto-approval waits for as many. Told for each task: expected calibration error; the mean disagreement of
the critics where the sign of the prediction was right and where it was wrong; the share of proposals that the default
rule of auto-approval would let pass, and how many of those the judge calls good, with Wilson's interval. With
`BENCH_NOISE` (default 0) that share of the labels is turned round before the learner sees it, while the judge stays
right. The value is the calibration error over all tasks. `BENCH_SEEDS` says how many seeds are run.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
import torch

from agent.algorithm import Label, Problem
from agent.config import SEED, SeedSettings
from agent.trust import reliability, wilson
from robot_adapters import registry
from robot_adapters.base import Adapter
from robot_adapters.tasks.base import position_fields, state_bounds
from server.auto_approval import Case, Decision, decide
from server.schemas import Mode
from server.schemas_trust import AutoApproval
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.clicks_kinematic import BARS
from tests.benchmarks.result import Result

LABELS, SKIPPED = 150, 50


@dataclass(frozen=True)
class Judged:
    """What was predicted of a proposal, how far the critics disagreed, what the judge said; and if it would pass."""

    predicted: float
    uncertainty: float
    label: int
    passes: bool


def run() -> Result:
    """A line for each task; the value is the error over all of them."""
    seeds = clicks.seeds(5)
    noise = float(os.environ.get("BENCH_NOISE", "0"))
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        judged = {task: [each for seed in seeds for each in _judged(task, seed, noise)] for task in BARS}
    finally:
        torch.set_num_threads(threads)
    every = [each for task in judged.values() for each in task]
    return Result(
        "calibration",
        _error(every),
        f"expected calibration error (labels {SKIPPED + 1} to {LABELS}, {len(seeds)} seeds, {noise:.0%} wrong labels)",
        lines=tuple(_line(task, found) for task, found in judged.items()),
    )


def _judged(task_name: str, seed: int, noise: float) -> list[Judged]:
    task, rule = registry.task(task_name), AutoApproval()
    low, high = state_bounds(task.state_fields)
    fields = position_fields(task.state_fields)
    problem = Problem(task.name, low, high, task.skills, keypoints=task.keypoints, position_fields=fields)
    learner = SEED(problem, SeedSettings(**SEED.presets["recommended"]), seed)
    dice = np.random.default_rng(seed)
    factory = registry.adapter("kinematic")
    robot: Adapter = factory(task_name, factory.settings.model_validate({"draw": False}))
    found = []
    try:
        state, executed = robot.reset(seed).state, 0
        for label_id in range(1, LABELS + 1):
            suggestion = learner.propose(state)
            value = task.judge(state, suggestion.call)
            predicted, uncertainty = suggestion.predicted_feedback, suggestion.uncertainty
            assert uncertainty is not None
            case = Case(predicted, uncertainty, True, Mode.EXECUTE_APPROVED, label_id - 1, 0, seed)
            found.append(Judged(predicted, uncertainty, value, decide(rule, case) is not Decision.ASK))
            told = -value if dice.random() < noise else value
            learner.add([Label(label_id, state, suggestion.call, told)])
            while learner.owed_updates:
                learner.update()
            if told == 1:
                result = robot.execute(suggestion.call, should_stop=lambda: False, on_step=lambda: None)
                executed += 1
                over = result.success or result.violations or executed == task.horizon
                state, executed = (robot.reset().state, 0) if over else (robot.observe().state, executed)
    finally:
        robot.close()
    return found[SKIPPED:]


def _error(judged: list[Judged]) -> float:
    error = reliability([(each.predicted, each.label) for each in judged]).error
    assert error is not None
    return error


def _line(task: str, judged: list[Judged]) -> str:
    right = [j.uncertainty for j in judged if (j.predicted > 0) == (j.label > 0)]
    wrong = [j.uncertainty for j in judged if (j.predicted > 0) != (j.label > 0)]
    passed = [j.label == 1 for j in judged if j.passes]
    low, high = wilson(sum(passed), len(passed))
    spread = " / ".join(f"{np.mean(each):.2f}" if each else "-" for each in (right, wrong))
    return (
        f"{task}: error {_error(judged):.3f}; disagreement where right / wrong: {spread} ({len(wrong)} wrong); "
        f"{len(passed)} of {len(judged)} pass, {sum(passed)} of them good ({low:.1%} to {high:.1%})"
    )
