"""What an adapter remembers within one episode so that tasks can stay pure functions of what is there now."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from robot_adapters.base import Array, EndReason, SafetyViolation, Scene, SkillCall
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.rules import by_hand

MISSES = 2
"""Good picks in a row that may fail before somebody must look at the object."""


class Episode:
    """Events that count for the rest of the episode, and picks that ought to have worked. One per adapter.

    `look` gives the adapter's snapshots: it wraps them in what is remembered.
    """

    def __init__(self, task: Task, look: Callable[[], Scene]) -> None:
        self._task = task
        self._look = look
        self._latched: frozenset[str] = frozenset()
        self._missed = 0

    def reset(self) -> None:
        """Forget everything: a new episode."""
        self._latched, self._missed = frozenset(), 0

    def scene(self) -> Scene:
        """A snapshot now, with what has happened so far."""
        scene = self._look()
        self._latched |= self._task.events(scene)
        return replace(scene, latched=self._latched) if self._latched else scene

    def executed(self, state: Array, call: SkillCall, end: EndReason, scene: Scene) -> tuple[SafetyViolation, ...]:
        """The rules that are broken after `call` was run in `state` (n,) and led to `scene`; call it once each."""
        found = self._task.violations(scene)
        if call.skill != "pick" or end is EndReason.STOPPED or self._task.judge(state, call) <= 0:
            return found
        self._missed = 0 if scene.held is not None else self._missed + 1
        if self._missed >= MISSES:
            found += (by_hand(f"{self._missed} good picks took nothing"),)
        return found
