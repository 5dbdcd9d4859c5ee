"""Courses of learners that command the gripper itself, through gymnasium: SAC by reward, TAMER by an oracle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Protocol

import gymnasium
import numpy as np

from agent.study.episodes import Counts, start_seed
from robot_adapters.base import Array

Env = gymnasium.Env[Array, Array]
"""Observation: the low-level state (n,). Action: (k,) in [-1, 1]. `info` has `violations`."""


class LowLevelLearner(Protocol):
    """What SAC and TAMER have in common. TAMER asks its oracle itself."""

    @property
    def policy_version(self) -> int:
        """Gradient steps taken so far."""

    @property
    def owed_updates(self) -> int:
        """Gradient steps owed and not yet taken."""

    def act(self, state: Array, *, deterministic: bool = False) -> Array:
        """An action (k,)."""

    def update(self) -> Mapping[str, float] | None:
        """One gradient step."""

    def save(self, path: Path) -> None:
        """Write a checkpoint with everything that was observed."""

    def load(self, path: Path) -> None:
        """Read one."""


class Observe(Protocol):
    """Tell the learner of one step."""

    def __call__(self, state: Array, action: Array, reward: float, next_state: Array, terminated: bool) -> None:
        """terminated: the task is solved; False where an episode was only cut short."""


@dataclass(frozen=True)
class LowLevelStage:
    """One environment to train in, one to be evaluated in: of the same states and actions."""

    env: Env
    judged_in: Env
    seed: int


class LowLevelCourse:
    """One action, one step of the environment, one observation of the learner."""

    def __init__(self, stage: LowLevelStage, learner: LowLevelLearner, observe: Observe) -> None:
        self._stage = stage
        self._learner = learner
        self._observe = observe
        self._actions: list[Array] = []
        self._state: Array = np.empty(0)
        self.counts = Counts()
        self._begin()

    @property
    def updates(self) -> int:
        """Gradient steps taken so far."""
        return self._learner.policy_version

    def decide(self) -> None:
        """One action."""
        state, counts = self._state, self.counts
        action = self._learner.act(state)
        after, reward, terminated, truncated, info = self._stage.env.step(action)
        self._actions.append(action)
        self._state = after
        counts.decisions += 1
        counts.low_level_steps += 1
        counts.executions += 1
        counts.successes += terminated
        counts.violations += len(info["violations"])
        self._observe(state, action, float(reward), after, terminated)
        if terminated or truncated:
            counts.episodes += 1
            self._begin()

    def learn(self) -> None:
        """Take every gradient step that is owed."""
        while self._learner.owed_updates:
            self._learner.update()

    def succeeds(self, seed: int) -> bool:
        """One rollout of the deterministic policy."""
        env = self._stage.judged_in
        state, _ = env.reset(seed=seed)
        while True:
            state, _, terminated, truncated, _ = env.step(self._learner.act(state, deterministic=True))
            if terminated or truncated:
                return terminated

    def save(self, learner: Path) -> Mapping[str, Any]:
        """Write the learner with what it observed."""
        self._learner.save(learner)
        return {"counts": asdict(self.counts), "actions": [action.tolist() for action in self._actions]}

    def load(self, learner: Path, saved: Mapping[str, Any]) -> None:
        """Go on: the open episode is begun anew and the same actions are taken, which leads to the same state."""
        self.counts = Counts(**saved["counts"])
        self._begin()
        for action in saved["actions"]:
            self._actions.append(np.array(action, dtype=np.float64))
            self._state = self._stage.env.step(self._actions[-1])[0]
        self._learner.load(learner)

    def close(self) -> None:
        """Release the environments."""
        self._stage.env.close()
        self._stage.judged_in.close()

    def _begin(self) -> None:
        self._actions = []
        self._state, _ = self._stage.env.reset(seed=start_seed(self._stage.seed, self.counts.episodes))
