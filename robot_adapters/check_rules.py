"""What is wrong with a task's rules, tried on seeded starts and on the states that its own right calls lead to.

Every finding is a pair: what is wrong with what to do about it, and what it was seen with.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from robot_adapters.base import Array, InvalidCall, Scene, check_call
from robot_adapters.check_watch import told_call, told_numbers, told_state
from robot_adapters.contract import random_call
from robot_adapters.kinematic import FACTORY, KinematicSettings
from robot_adapters.tasks.base import Task, state_bounds

STARTS = 20
EPISODES = 5
RANDOM_CALLS = 200
GOOD_CALLS = 20
# a call this close to the border may be judged either way
BORDER = 1e-6


class Finding(NamedTuple):
    """`what` is wrong and how to mend it, the same wherever it shows; `seen` is one place where it did."""

    what: str
    seen: str


def on_starts(task: Task) -> Iterator[Finding]:
    """What is wrong in the start of several episodes."""
    low, high = state_bounds(task.state_fields)
    outside = 0
    for seed in range(STARTS):
        layout, again = (task.sample_layout(np.random.default_rng(seed)) for _ in range(2))
        if (wrong := _layout(task, layout)) is not None:
            yield Finding(wrong, f"with seed {seed}")
            return
        if any(not np.array_equal(layout[name], again[name]) for name in layout):
            yield Finding(
                "sample_layout() gives two starts for one seed: draw only from the generator it is handed",
                f"with seed {seed}",
            )
        slides = [spec.name for spec in task.objects if spec.shape == "slider"]
        scene = Scene(
            {spec.name: layout[spec.name] for spec in task.objects if spec.movable},
            layout["gripper"],
            gripper_closed=False,
            joints={name: float(layout[name][0]) for name in slides},
        )
        state = task.state(scene)
        if (wrong := _state(task, state)) is not None:
            yield Finding(wrong, f"on the start of seed {seed}")
            return
        where = f"on the start of seed {seed}, {told_state(state, task)}"
        outside += bool(((state < low) | (state > high)).any())
        yield from _start(task, scene, where)
        yield from _teacher(task, state, np.random.default_rng(seed), where)
    if outside > STARTS // 2:
        yield Finding(
            "most starts lie outside the state fields' low and high: widen them, learners scale by them",
            f"on {outside} of {STARTS} starts",
        )


def on_episodes(task: Task) -> Iterator[Finding]:
    """What is wrong on the way to the goal: the kinematic adapter takes the task's own right calls."""
    # here: it loads a drawing library
    from robot_adapters.kinematic.adapter import KinematicAdapter  # noqa: PLC0415

    if not FACTORY.stages(task):
        return
    adapter = KinematicAdapter(task, KinematicSettings(draw=False))
    solved, met = 0, set()
    for seed in range(EPISODES):
        observation, way, done = adapter.reset(seed), [], False
        for step in range(task.horizon):
            state = observation.state
            where = f"at step {step + 1} of the episode of seed {seed}, {told_state(state, task)}"
            wrong = list(_teacher(task, state, np.random.default_rng(seed), where))
            yield from wrong
            if wrong:
                return
            met.add(task.subgoal(state))
            call = task.true_call(state)
            result = adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
            way.append(f"{told_call(call, task)} {result.end.replace('_', ' ')}")
            for violation in result.violations:
                yield Finding(f"a right call breaks a rule ({violation.detail}): one of the two is wrong", where)
            if done := result.success:
                break
            observation = adapter.observe()
        solved += done
        if not done:
            yield Finding(
                f"{task.horizon} true calls (the horizon) don't solve the task: let true_call() end every subgoal, "
                "subgoal() see that it is ended, and success() what the last one leads to",
                f"in the episode of seed {seed}: {'; '.join(way[:4])}{'; and so on' if len(way) > 4 else ''}",
            )
    for i, goal in enumerate(task.subgoals):
        if solved == EPISODES and i not in met:
            yield Finding(
                f"the subgoal {goal.name!r} never comes up, although the task is solved: remove it, or let subgoal() "
                "give it",
                f"in {EPISODES} episodes",
            )


def _layout(task: Task, layout: Mapping[str, Array]) -> str | None:
    """What of a start doesn't fit the objects."""
    sizes = {
        spec.name: 1 if spec.shape == "slider" else 3 for spec in task.objects if spec.movable or spec.shape == "slider"
    }
    sizes["gripper"] = 3
    if layout.keys() != sizes.keys():
        return f"sample_layout() places {sorted(layout)}: place exactly what moves and `gripper`, {sorted(sizes)}"
    for name, size in sizes.items():
        at = layout[name]
        if np.shape(at) != (size,) or not np.isfinite(np.asarray(at, dtype=np.float64)).all():
            what = "x, y, z in m, robot base frame" if size == 3 else "how far it is open, m"
            return f"sample_layout() places {name} at {at}: give a finite array of shape ({size},), {what}"
    return None


def _state(task: Task, state: object) -> str | None:
    """What of a state doesn't fit its fields."""
    size = sum(field.size for field in task.state_fields)
    if not isinstance(state, np.ndarray) or state.dtype != np.float64:
        return f"state() gives {type(state).__name__}: give a numpy array of float64, shape ({size},)"
    if state.shape != (size,):
        fields = " + ".join(f"{field.name} {field.size}" for field in task.state_fields)
        return f"state() has shape {state.shape}, its fields make ({size},): {fields}. Make them agree"
    start = 0
    for field in task.state_fields:
        if not np.isfinite(part := state[start : start + field.size]).all():
            return (
                f"state() isn't finite: {field.name} is {told_numbers(part)}. Give numbers, whatever the scene is like"
            )
        start += field.size
    return None


def _start(task: Task, scene: Scene, where: str) -> Iterator[Finding]:
    """What is wrong with a start as a scene."""
    solved = task.success(scene)
    if not isinstance(solved, bool):
        yield Finding(f"success() gives {solved!r}, no plain bool: wrap it in bool(...)", where)
    if solved:
        yield Finding("a start is already solved: keep starts away from the goal in sample_layout()", where)
    for violation in task.violations(scene):
        if violation.kind not in {"damage", "manual_reset"}:
            yield Finding(f"a violation is of kind {violation.kind!r}: use damage or manual_reset", where)
        yield Finding(f"a start already breaks a rule ({violation.detail}): keep starts inside the workspace", where)


def _teacher(task: Task, state: Array, rng: np.random.Generator, where: str) -> Iterator[Finding]:
    """What is wrong with subgoal, keypoints and the teacher's rule in one state (n,)."""
    yield from _points(task, state, where)
    goal = task.subgoal(state)
    if not isinstance(goal, int) or not 0 <= goal < len(task.subgoals):
        yield Finding(f"subgoal() gives {goal!r}: give an int, an index into the {len(task.subgoals)} subgoals", where)
    call = task.true_call(state)
    try:
        spec = check_call(call, task.skills)
    except InvalidCall as error:
        yield Finding(
            "true_call() is outside the skills' bounds: widen the bounds, or aim inside them",
            f"{where}: {error}; {error.remedy}",
        )
        return
    if task.judge(state, call) != 1:
        named = call.named(spec)
        cut = [
            f"{p.name} at its bound {named[p.name]:.3f}" for p in spec.parameters if named[p.name] in {p.low, p.high}
        ]
        yield Finding(
            "judge() finds the true call bad: the teacher's rule must contain it, and the skill's bounds must contain "
            "the rule's centre",
            f"{where}: {told_call(call, task)}" + (f", {' and '.join(cut)}" if cut else ""),
        )
        yield from _random(task, state, rng, where)
        return
    if task.margin(state, call) < 0:
        yield Finding(
            "margin() is below 0 for the true call: give how far a call is inside what judge() calls good, in m",
            f"{where}: {task.margin(state, call):.4f} for {told_call(call, task)}",
        )
    yield from _good(task, state, rng, where)
    yield from _random(task, state, rng, where)


def _points(task: Task, state: Array, where: str) -> Iterator[Finding]:
    """What is wrong with the keypoints, of all skills and of each."""
    for skill in (None, *(spec.name for spec in task.skills)):
        points = task.keypoints(state, skill)
        if not isinstance(points, np.ndarray) or points.ndim != 2 or points.shape[1] != 3:
            yield Finding(
                f"keypoints() gives shape {np.shape(points)}: give (k, 3), or np.zeros((0, 3)) where there are none",
                f"for the skill {skill} {where}",
            )
        elif not np.isfinite(points).all():
            yield Finding("keypoints() aren't finite: give places in m", f"for the skill {skill} {where}: {points}")


def _good(task: Task, state: Array, rng: np.random.Generator, where: str) -> Iterator[Finding]:
    """What is wrong with the sampled good calls."""
    for _ in range(GOOD_CALLS):
        call = task.sample_good(state, rng)
        try:
            check_call(call, task.skills)
        except InvalidCall as error:
            yield Finding(
                "sample_good() leaves the skills' bounds: keep its calls inside them",
                f"{where}: {error}; {error.remedy}",
            )
            return
        if task.judge(state, call) != 1:
            yield Finding(
                "judge() finds a call of sample_good() bad: draw only what the teacher's rule calls good, and keep "
                "the skill's bounds wide enough for it",
                f"{where}: {told_call(call, task)}",
            )
            return


def _random(task: Task, state: Array, rng: np.random.Generator, where: str) -> Iterator[Finding]:
    """What is wrong with the verdicts on calls drawn anywhere inside the bounds."""
    calls = [random_call(spec, rng) for spec in task.skills for _ in range(RANDOM_CALLS // len(task.skills))]
    verdicts = [task.judge(state, call) for call in calls]
    odd = next((v for v in verdicts if not isinstance(v, int) or v not in {-1, 1}), None)
    if odd is not None:
        yield Finding(f"judge() gives {odd!r}: give the int +1 or -1", where)
        return
    if sum(v == 1 for v in verdicts) > len(verdicts) / 2:
        yield Finding(
            "judge() finds most random calls good, so there is nothing to learn: tighten the teacher's rule", where
        )
    for call, verdict in zip(calls, verdicts, strict=True):
        if (margin := task.margin(state, call)) * verdict < -BORDER:
            yield Finding(
                "judge() and margin() disagree: a call is good where its margin isn't negative",
                f"{where}: {verdict:+d} and {margin:.4f} for {told_call(call, task)}",
            )
            return
