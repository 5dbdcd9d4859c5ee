"""How often every task is solved on robosuite: with true parameters, and with any that the teacher calls good."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Adapter, Array, SkillCall
from robot_adapters.registry import adapter, task
from robot_adapters.tasks.base import Task
from tests.benchmarks.result import Result

Choose = Callable[[Task, Array, np.random.Generator], SkillCall]

CHOICES: dict[str, Choose] = {
    "true": lambda chosen, state, _: chosen.true_call(state),
    "good": lambda chosen, state, rng: chosen.sample_good(state, rng),
}


@dataclass(frozen=True)
class Row:
    """A line of the table: so many seeds of a task have to be solved."""

    task: str
    parameters: str
    starts: int
    bar: int


ROWS = (
    Row("reaching", "true", 50, 48),
    Row("reaching", "good", 50, 45),
    Row("stacking", "true", 100, 98),
    Row("stacking", "good", 50, 45),
    Row("sweeping", "true", 50, 48),
    Row("sweeping", "good", 50, 45),
    Row("collecting_toy", "true", 50, 48),
    Row("collecting_toy", "good", 50, 45),
    Row("cooking_hotdog", "true", 50, 48),
    Row("cooking_hotdog", "good", 50, 45),
)


def run() -> Result:
    """Solve each row's seeds from 0 on; every failure is listed with its cause."""
    lines = [f"{'task':16}{'parameters':12}{'solved':>10}{'bar':>6}{'skills':>9}{'set-points':>12}"]
    reached = 0
    robots: dict[str, Adapter] = {}
    for row in ROWS:
        if row.task not in robots:
            for robot in robots.values():
                robot.close()
            factory = adapter("robosuite")
            # without pictures, which nobody looks at
            robots = {row.task: factory(row.task, factory.settings(draw=False))}
        chosen = task(row.task)
        episodes = [episode(chosen, robots[row.task], seed, CHOICES[row.parameters]) for seed in range(row.starts)]
        solved = sum(e.cause is None for e in episodes)
        skills, steps = (np.mean([getattr(e, name) for e in episodes]) for name in ("skills", "steps"))
        mark = "" if solved >= row.bar else "  NOT REACHED"
        of = f"{solved}/{row.starts}"
        lines.append(f"{row.task:16}{row.parameters:12}{of:>10}{row.bar:>6}{skills:>9.1f}{steps:>12.0f}{mark}")
        lines += [f"    seed {seed}: {e.cause}" for seed, e in enumerate(episodes) if e.cause is not None]
        reached += solved >= row.bar
    for robot in robots.values():
        robot.close()
    ok = reached == len(ROWS)
    return Result(
        "task_success", reached, f"of {len(ROWS)} rows reach their bar", bar=len(ROWS), ok=ok, lines=tuple(lines)
    )


@dataclass(frozen=True)
class Played:
    """An episode's length, and what went wrong (None: solved, and nothing and nobody in danger)."""

    skills: int
    steps: int
    cause: str | None


def episode(chosen: Task, robot: Adapter, seed: int, choose: Choose) -> Played:
    """Run calls until the task is solved, a rule is broken, or the horizon is reached."""
    rng = np.random.default_rng([seed, 1])
    state = robot.reset(seed).state
    steps, ends = 0, []
    for skills in range(1, chosen.horizon + 1):
        call = choose(chosen, state, rng)
        goal = chosen.subgoals[chosen.subgoal(state)].name
        result = robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
        steps += result.low_level_steps
        at = ", ".join(f"{p:.3f}" for p in call.parameters)
        ends.append(f"{goal}: {call.skill}({at}) {result.end}")
        if result.violations:
            return Played(skills, steps, "; ".join([*(v.detail for v in result.violations), *ends[-2:]]))
        if result.success:
            return Played(skills, steps, None)
        state = robot.observe().state
    return Played(skills, steps, "; ".join(["the horizon is reached", *ends[-3:]]))
