"""Episodes of skills on a robot: begun from seeds, and begun again up to where an interrupted run was."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Adapter, Array, SkillCall
from robot_adapters.tasks.base import Task

FIRST_START = 10_000
"""Seed of the first evaluated rollout's start, the same for everyone who is compared."""


@dataclass
class Counts:
    """What training has come to. executions: skills or low-level actions that the robot carried out."""

    decisions: int = 0
    low_level_steps: int = 0
    executions: int = 0
    episodes: int = 0
    successes: int = 0
    violations: int = 0


@dataclass(frozen=True)
class Done:
    """What one execution led to: its low-level steps, violations, the state (n,) after it, and whether that is all."""

    state: Array
    success: bool
    over: bool
    violations: int
    low_level_steps: int


def start_seed(seed: int, episode: int) -> int:
    """The seed of an episode's start, for `Adapter.reset`; different for every run's seed and episode."""
    return int(np.random.SeedSequence([seed, episode]).generate_state(1)[0] >> 1)


class SkillEpisodes:
    """Episodes end at success, at a violation, or after the task's horizon of executed skills."""

    def __init__(self, task: Task, robot: Adapter, *, first_subgoal: bool) -> None:
        self._task = task
        self._robot = robot
        self._first_subgoal = first_subgoal
        self._seed = 0
        self._calls: list[SkillCall] = []
        self.state: Array = np.empty(0)
        """(n,) the task's state now."""

    def begin(self, seed: int) -> None:
        """Start an episode; the same seed gives the same start."""
        self._seed, self._calls = seed, []
        self.state = self._robot.reset(seed).state

    def execute(self, call: SkillCall) -> Done:
        """Run one skill."""
        result = self._robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
        self._calls.append(call)
        self.state = self._robot.observe().state
        success = result.success or (self._first_subgoal and self._task.subgoal(self.state) > 0)
        over = success or bool(result.violations) or len(self._calls) >= self._task.horizon
        return Done(self.state, success, over, len(result.violations), result.low_level_steps)

    def rollout(self, seed: int, choose: Callable[[Array], SkillCall]) -> bool:
        """A whole episode of a policy; whether it ended in success."""
        self.begin(seed)
        while True:
            done = self.execute(choose(self.state))
            if done.over:
                return done.success

    def saved(self) -> dict[str, object]:
        """The open episode, for JSON: its seed and what was executed in it."""
        return {"seed": self._seed, "calls": [[call.skill, *call.parameters] for call in self._calls]}

    def restore(self, seed: int, calls: Sequence[Sequence[object]]) -> None:
        """Begin the saved episode anew and execute the same skills: a simulator comes to the same state."""
        self.begin(seed)
        for skill, *parameters in calls:
            self.execute(SkillCall(str(skill), tuple(float(str(value)) for value in parameters)))

    def close(self) -> None:
        """Release the robot."""
        self._robot.close()
