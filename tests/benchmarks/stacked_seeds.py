"""Whole runs of five seeds trained in one pass, beside the run of one seed: time of the processor.

`recommended` on the kinematic adapter: propose, judge, execute what is good, twenty gradient steps a label. Both go
in turns, label by label. The bar: five seeds take at most 2.5 times the time of one.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import torch

from agent.algorithm import Label, Problem
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from agent.stacked import StackedSeeds
from robot_adapters import registry
from robot_adapters.base import Adapter
from robot_adapters.tasks.base import Task, position_fields, state_bounds
from tests.benchmarks.result import Result

TASKS = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")
SEEDS = 5
LABELS = 25
BAR = 2.5


def run() -> Result:
    """Time every task; the value is the worst ratio."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        rows = {task: _measure(task) for task in TASKS}
    finally:
        torch.set_num_threads(threads)
    lines = [
        f"{task}: {one.seconds / LABELS * 1000:.0f} ms a label for one seed, {five.seconds / LABELS * 1000:.0f} ms for "
        f"{SEEDS}: ratio {five.seconds / one.seconds:.2f}; of gradient steps alone {five.updating / one.updating:.2f}"
        for task, (one, five) in rows.items()
    ]
    worst = max(five.seconds / one.seconds for one, five in rows.values())
    unit = f"times one seed's time for {SEEDS} seeds"
    return Result("stacked_seeds", worst, unit, baseline=SEEDS, bar=BAR, ok=worst <= BAR, lines=tuple(lines))


def _measure(task_name: str) -> tuple[_Run, _Run]:
    one, five = _Run(task_name, 1), _Run(task_name, SEEDS)
    for number in range(LABELS + 1):
        if number == 1:  # the first warms up
            one.seconds = one.updating = five.seconds = five.updating = 0.0
        for each in (one, five):
            each.label(number + 1)
    for each in (one, five):
        each.close()
    return one, five


@dataclass
class _Run:
    """So many seeds, each with its own robot. seconds: of the processor; updating: those in gradient steps."""

    task_name: str
    seeds: int
    seconds: float = 0.0
    updating: float = 0.0
    task: Task = field(init=False)
    stack: StackedSeeds = field(init=False)
    robots: list[Adapter] = field(init=False)

    def __post_init__(self) -> None:
        self.task = task = registry.task(self.task_name)
        low, high = state_bounds(task.state_fields)
        fields = position_fields(task.state_fields)
        problem = Problem(task.name, low, high, task.skills, keypoints=task.keypoints, position_fields=fields)
        self.stack = StackedSeeds.fresh(problem, SeedSettings(**SEED.presets["recommended"]), range(self.seeds))
        factory = registry.adapter("kinematic")
        drawn = factory.settings.model_validate({"draw": False})
        self.robots = [factory(self.task_name, drawn) for _ in range(self.seeds)]
        for seed, robot in enumerate(self.robots):
            robot.reset(seed)

    def label(self, label_id: int) -> None:
        """One label for each seed, and the gradient steps that it owes."""
        start = time.process_time()
        for learner, robot in zip(self.stack.learners, self.robots, strict=True):
            self._judged(learner, robot, label_id)
        learning = time.process_time()
        self.stack.work_off()
        end = time.process_time()
        self.seconds += end - start
        self.updating += end - learning

    def _judged(self, learner: Seed, robot: Adapter, label_id: int) -> None:
        state = robot.observe().state
        call = learner.propose(state).call
        value = self.task.judge(state, call)
        learner.add([Label(label_id, state, call, value)])
        if value == 1:
            result = robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
            if result.success or result.violations:
                robot.reset()

    def close(self) -> None:
        for robot in self.robots:
            robot.close()
