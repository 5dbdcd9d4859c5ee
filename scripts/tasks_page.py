"""Writes docs/tasks.md from the tasks themselves: `python -m scripts.tasks_page > docs/tasks.md`."""

from __future__ import annotations

import numpy as np

from robot_adapters import registry
from robot_adapters.base import SkillSpec
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.boxes import Boxed
from scripts.odds import table as odds_table

NAMES = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")
INTRO = """# The tasks

The five tasks of the paper, staged by the kinematic adapter and, with physics, by robosuite. Everything here is in
metres in the robot base frame (x forward, y left, z up); the table's surface is at z = -0.112 and the middle of the
table at x = 0.56, y = 0. robosuite's world frame is this one plus (-0.56, 0, 0.912).

A skill's **bounds** are what may be proposed. They are tight, per task and per skill, because most proposals of a
beginner's policy are bad. The **good box** is the rule of the synthetic teacher: the right skill for the subgoal, with
parameters no farther from the target than the millimetres given (below/above for x, y, z at the grip site; for a push
also for the x where it ends, and a push along y is never good). `judge` says good or bad, `margin` how many metres a
call is inside its box.

Methods without skills command the gripper itself: [low-level control](low-level.md).

Where things start is drawn from the ranges under *start*. They are settings: an adapter's setting `layout`, for
instance `{"toy_y": [-0.02, 0.02]}`, replaces some of them.

*Needs a hand* lists the violations of kind `manual_reset`. For every task but Reaching one more counts: two good picks
in a row that took nothing.
"""
SOLVED = {
    "reaching": "the grip site is within 5 cm of the area's centre.",
    "stacking": "the small block rests on the large one within 3 cm of its middle, and nothing holds it.",
    "sweeping": "the toy is inside the dustpan's rectangle and at most 3 cm above the table.",
    "collecting_toy": "the toy lies in the drawer, and the drawer is open by less than 2 cm.",
    "cooking_hotdog": "the cooked sausage lies in the bun, within 3.5 cm in x and 1.5 cm in y. It is cooked, for the "
    "rest of the episode, once it lay within 6 cm of the skillet's centre, the skillet upright within 4.5 cm of the "
    "stove's, both let go of.",
}
HAND = {
    "reaching": "nothing.",
    "stacking": "a block off the table or out of reach.",
    "sweeping": "broom or toy off the table or out of reach; the broom tilted by more than 45°.",
    "collecting_toy": "the drawer closed with the toy outside; the toy off the table or out of reach.",
    "cooking_hotdog": "skillet or sausage off the table or out of reach; the skillet tilted by more than 45°.",
}


def page() -> str:
    """The whole of docs/tasks.md."""
    sections = [_section(name, registry.task(name)) for name in NAMES]
    odds = (
        "## Odds\n\nHow rare a good proposal is when skill and parameters are drawn uniformly (mean over 50 starts; "
        f"`python -m scripts.odds`). All of the workspace for every skill would make it once in up to 34,000.\n\n"
        f"{odds_table()}\n"
    )
    return "\n".join([INTRO, *sections, odds])


def _section(name: str, task: Task) -> str:
    lines = [f"## {task.title} (`{name}`)", "", task.instruction, ""]
    lines += [f"Solved when {SOLVED[name]} An episode ends after {task.horizon} executed skills.", ""]
    lines += ["| state | size | unit | meaning |", "|---|---|---|---|"]
    lines += [f"| `{f.name}` | {f.size} | {f.unit or '0 or 1'} | {f.description} |" for f in task.state_fields]
    lines += ["", "| skill | bounds |", "|---|---|"]
    lines += [f"| `{spec.name}` | {_bounds(spec)} |" for spec in task.skills]
    lines += ["", *_stages(name, task), "", "Start:", ""]
    for field, about in type(task.layout).model_fields.items():
        low, high = getattr(task.layout, field)
        lines.append(f"- `{field}` [{low:.3g}, {high:.3g}]: {about.description}")
    return "\n".join([*lines, "", f"Needs a hand: {HAND[name]}", ""])


def _bounds(spec: SkillSpec) -> str:
    parts = [f"{p.name} {p.low:.3f} to {p.high:.3f}" for p in spec.parameters]
    fixed = [] if spec.yaw is None else [f"yaw fixed at {spec.yaw:g}"]
    return ", ".join(parts + fixed) or "none"


def _stages(name: str, task: Task) -> list[str]:
    """The subgoals with their boxes, in the states of one solved episode."""
    if not isinstance(task, Boxed):
        return ["| subgoal | good |", "|---|---|", f"| {task.subgoals[0].description} | `reach` into the area |"]
    adapter = registry.adapter("kinematic")(name, KinematicSettings(draw=False))
    lines = ["| subgoal | skill | good box: below/above, mm |", "|---|---|---|"]
    for subgoal in task.subgoals:
        box = task.box(adapter.observe().state)
        axes = ("x", "y", "z", "end")
        faces = zip(axes, np.array(box.below) * 1000, np.array(box.above) * 1000, strict=False)
        mm = ", ".join(f"{axis} -{below:.0f}/+{above:.0f}" for axis, below, above in faces)
        lines.append(f"| {subgoal.description} | `{box.skill}` | {mm} |")
        call = task.true_call(adapter.observe().state)
        adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
    return lines


if __name__ == "__main__":
    print(page(), end="")
