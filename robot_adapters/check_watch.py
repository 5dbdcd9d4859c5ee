"""Says which method of a task raised, where, and for what: foreign code may raise anything."""

from __future__ import annotations

import functools
import inspect
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import numpy as np

from robot_adapters.base import Array, Scene, SkillCall
from robot_adapters.tasks.base import Task

METHODS = (
    "state",
    "sample_layout",
    "success",
    "violations",
    "events",
    "subgoal",
    "judge",
    "margin",
    "true_call",
    "sample_good",
    "keypoints",
)
"""What every task can be asked."""


class RuleRaised(Exception):
    """A method of the task raised; the message is a finding."""


class _Watched:
    """The task, except that an error in one of its methods becomes a `RuleRaised`."""

    def __init__(self, task: Task) -> None:
        self._task = task

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._task, name)
        return self._guarded(name, found) if name in METHODS else found

    def _guarded(self, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(method)
        def guarded(*args: Any, **named: Any) -> Any:
            try:
                return method(*args, **named)
            except Exception as error:
                given = ", ".join(told(value, self._task) for value in (*args, *named.values()))
                raise RuleRaised(
                    f"{name}() raised {said(error)} ({line_of(error, self._task)})\n  given {given}"
                ) from error

        return guarded


def watched(task: Task) -> Task:
    """`task`, whose methods raise nothing but `RuleRaised`."""
    return cast("Task", _Watched(task))


def said(error: Exception) -> str:
    """An error's kind and words."""
    return f"{type(error).__name__}: {error}"


def line_of(error: Exception, task: Task) -> str:
    """The deepest line of the task's own file that the error went through, or the deepest there is."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if frame.filename == inspect.getfile(type(task))]
    deepest = (own or list(frames))[-1]
    return f"{Path(deepest.filename).name}, line {deepest.lineno}"


def told(value: object, task: Task) -> str:
    """A method's argument in words: a state by its fields, a call by its parameters."""
    match value:
        case np.ndarray():
            return f"the state {told_state(value, task)}"
        case SkillCall():
            return told_call(value, task)
        case Scene():
            places = [f"{name} at {told_numbers(at)}" for name, at in sorted(value.objects.items())]
            return f"the scene with {', '.join(places)}, {value.held or 'nothing'} held"
        case np.random.Generator():
            return "a seeded generator"
        case _:
            return repr(value)


def told_state(state: Array, task: Task) -> str:
    """The state (n,) by its fields, in their units."""
    parts, start = [], 0
    for field in task.state_fields:
        parts.append(f"{field.name} {told_numbers(state[start : start + field.size])}")
        start += field.size
    return ", ".join(parts)


def told_call(call: SkillCall, task: Task) -> str:
    """The call with its parameters by name."""
    spec = next((s for s in task.skills if s.name == call.skill and len(s.parameters) == len(call.parameters)), None)
    if spec is None:
        return f"{call.skill}{call.parameters}"
    return f"{call.skill}({', '.join(f'{name}={float(value):.3f}' for name, value in call.named(spec).items())})"


def told_numbers(values: Any) -> str:
    """A few numbers, to the millimetre."""
    return "(" + ", ".join(f"{v:.3f}" for v in np.atleast_1d(values).tolist()) + ")"
