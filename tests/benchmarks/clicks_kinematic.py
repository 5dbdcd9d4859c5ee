"""Feedback that SEED's `paper_sim` preset needs until 90 % of its deterministic rollouts succeed, without physics.

Learner, kinematic adapter and the task's own judge in one process, five seeds; Stacking is the figure, Reaching is
printed beside it. A seed stops at the budget: `BENCH_FEEDBACK` labels (default 500, which keeps all seeds of both tasks
under about four minutes on one core). A seed that did not get there counts as the budget, and is told as "not within".
"""

from __future__ import annotations

import os
import statistics
import time

import torch

from agent.algorithm import Algorithm, Label, Problem
from agent.config import SEED, SeedSettings
from robot_adapters import registry
from robot_adapters.base import Adapter, SkillCall, SkillResult
from robot_adapters.tasks.base import Task, state_bounds
from tests.benchmarks.result import Result

SEEDS = range(5)
EVERY = 50
"""Feedback between two evaluations."""
ROLLOUTS = 20
REACHED = 0.9
DEFAULT_BUDGET = 500


def run() -> Result:
    """Both tasks, every seed; the value is Stacking's median."""
    budget = int(os.environ.get("BENCH_FEEDBACK", str(DEFAULT_BUDGET)))
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        lines, medians = [], {}
        for name in ("reaching", "stacking"):
            start = time.perf_counter()
            needed = [_feedback_needed(name, seed, budget) for seed in SEEDS]
            told = ", ".join(f"not within {budget}" if n is None else str(n) for n in needed)
            lines.append(f"{name}: {told} ({time.perf_counter() - start:.0f} s)")
            medians[name] = statistics.median(budget if n is None else n for n in needed)
            if sum(n is None for n in needed) > len(needed) // 2:
                lines.append(
                    f"{name}: most seeds did not reach {REACHED:.0%} within {budget}: the median is a lower bound"
                )
    finally:
        torch.set_num_threads(threads)
    unit = f"feedback to {REACHED:.0%} (median of {len(SEEDS)} seeds; {budget} is the budget, not a success)"
    return Result("clicks_kinematic", medians["stacking"], unit, lines=tuple(lines))


def _feedback_needed(task_name: str, seed: int, budget: int) -> int | None:
    """Labels until 90 % of the rollouts succeed, checked every `EVERY`; None where the budget ran out before."""
    task = registry.task(task_name)
    low, high = state_bounds(task.state_fields)
    settings = SeedSettings(**SEED.presets["paper_sim"])
    learner = SEED(Problem(task.name, low, high, task.skills), settings, seed)
    robot, judged_on = _kinematic(task_name), _kinematic(task_name)
    try:
        state, executed = robot.reset(seed).state, 0
        for label_id in range(1, budget + 1):
            call = learner.propose(state).call
            value = task.judge(state, call)
            learner.add([Label(label_id, state, call, value)])
            while learner.owed_updates:
                learner.update()
            if value == 1:
                result, executed = _execute(robot, call), executed + 1
                over = result.success or result.violations or executed == task.horizon
                state, executed = (robot.reset().state, 0) if over else (robot.observe().state, executed)
            if label_id % EVERY == 0 and _success_rate(learner, task, judged_on) >= REACHED:
                return label_id
        return None
    finally:
        robot.close()
        judged_on.close()


def _success_rate(learner: Algorithm, task: Task, robot: Adapter) -> float:
    """Share of deterministic rollouts from fixed starts that solve the task within its horizon."""
    solved = 0
    for start in range(ROLLOUTS):
        state = robot.reset(10_000 + start).state
        for _ in range(task.horizon):
            result = _execute(robot, learner.propose(state, deterministic=True).call)
            if result.success or result.violations:
                break
            state = robot.observe().state
        solved += robot.success()
    return solved / ROLLOUTS


def _kinematic(task_name: str) -> Adapter:
    factory = registry.adapter("kinematic")
    return factory(task_name, factory.settings.model_validate({"draw": False}))


def _execute(robot: Adapter, call: SkillCall) -> SkillResult:
    return robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
