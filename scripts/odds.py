"""How often a proposal drawn uniformly from a task's skills and bounds is good: `python -m scripts.odds`.

The rarer, the more clicks a beginner's policy costs. docs/tasks.md shows this table.
"""

from __future__ import annotations

import math

import numpy as np

from robot_adapters import registry
from robot_adapters.base import SkillSpec
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.reaching import RADIUS

STARTS = 50
# places at which the length of a push is integrated over its start
SLICES = 400


def table() -> str:
    """The Markdown table over all tasks."""
    lines = ["| task | subgoal | skill | one proposal in |", "|---|---|---|---|"]
    for name in ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog"):
        task = registry.task(name)
        for subgoal, (skill, share) in zip(task.subgoals, odds(name), strict=True):
            lines.append(f"| {task.title} | {subgoal.name} | {skill} | {round(1 / share, -1):,.0f} |")
    return "\n".join(lines)


def odds(name: str) -> list[tuple[str, float]]:
    """For each subgoal its skill and the share of good proposals, the mean over seeded starts."""
    task = registry.task(name)
    adapter = registry.adapter("kinematic")(name, KinematicSettings(draw=False))
    shares = np.zeros((STARTS, len(task.subgoals)))
    skills = [""] * len(task.subgoals)
    for seed in range(STARTS):
        state = adapter.reset(seed).state
        for stage in range(len(task.subgoals)):
            call = task.true_call(state)
            skills[stage] = call.skill
            spec = next(spec for spec in task.skills if spec.name == call.skill)
            shares[seed, stage] = _share(task, task.box(state) if isinstance(task, Boxed) else None, spec)
            adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
            state = adapter.observe().state
    return list(zip(skills, shares.mean(axis=0).tolist(), strict=True))


def _share(task: Task, box: Box | None, spec: SkillSpec) -> float:
    """The share of uniform proposals (a skill, then its parameters) inside the box; Reaching has a ball."""
    if box is None:
        return 4 / 3 * math.pi * RADIUS**3 / float(np.prod(spec.high - spec.low)) / len(task.skills)
    inside = [
        _overlap((c - below, c + above), (p.low, p.high))
        for c, below, above, p in zip(box.centre, box.below, box.above, spec.parameters, strict=False)
    ][:3]
    volume = math.prod(high - low for low, high in inside)
    volume /= math.prod(p.high - p.low for p in spec.parameters[:3])
    if box.skill == "push":
        along, delta = spec.parameters[3:]
        end = (box.centre[3] - box.below[3], box.centre[3] + box.above[3])
        starts = np.linspace(*inside[0], SLICES)
        lengths = [np.diff(_overlap((end[0] - x, end[1] - x), (delta.low, delta.high)))[0] for x in starts]
        volume *= float(np.mean(lengths)) / (delta.high - delta.low) * -along.low / (along.high - along.low)
    return volume / len(task.skills)


def _overlap(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    low, high = max(a[0], b[0]), min(a[1], b[1])
    return low, max(low, high)


if __name__ == "__main__":
    print(table())
