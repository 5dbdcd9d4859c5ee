"""Synthetic trainers: stand-ins for a person, who judge by a rule and vote through the same door."""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import Protocol

from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from server.worker import WorkerError


class Teacher(Protocol):
    """What an entry point of the group `seed.teachers` names, built for a task."""

    def judge(self, state: Array, call: SkillCall) -> int:
        """-1, 0 or +1 for this call in state (n,)."""


class Synthetic:
    """Judges by the task's own rule: good if the call serves the next subgoal, otherwise bad."""

    def __init__(self, task: Task) -> None:
        self._task = task

    def judge(self, state: Array, call: SkillCall) -> int:
        """+1 or -1 for this call in state (n,), the task's units."""
        return self._task.judge(state, call)


class UnknownTeacher(WorkerError):
    """No installed package brings a teacher of this name."""


def teacher(name: str, task: Task) -> Teacher:
    """The teacher of this name for a task.

    Raises:
        UnknownTeacher: there is none.
    """
    entries = {entry.name: entry for entry in entry_points(group="seed.teachers")}
    if name not in entries:
        raise UnknownTeacher(f"unknown teacher {name!r}", remedy=f"use one of: {', '.join(sorted(entries))}")
    built: Teacher = entries[name].load()(task)
    return built
