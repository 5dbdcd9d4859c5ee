"""Worlds small enough to be learned in a second: a point on a line, and something to fetch with two skills."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from agent.algorithm import Problem, Suggestion
from agent.sac import Sac
from agent.tamer import Tamer
from robot_adapters.base import Array, ParameterSpec, SkillCall, SkillSpec

LOW, HIGH = np.array([-1.0]), np.array([1.0])
GOAL, REACH, STEP = 0.5, 0.1, 0.2


class Line:
    """A point in [-1, 1] that an action moves by up to 0.2; solved within 0.1 of 0.5. Pays 1 when solved, else 0."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)
        self._x, self._steps = 0.0, 0

    def reset(self) -> Array:
        """Somewhere not solved."""
        self._steps = 0
        while True:
            self._x = float(self._rng.uniform(-1, 1))
            if abs(self._x - GOAL) > REACH:
                return np.array([self._x])

    def step(self, action: Array) -> tuple[Array, float, bool, bool]:
        """Next state, reward, terminated, truncated."""
        self._x = float(np.clip(self._x + STEP * action[0], -1, 1))
        self._steps += 1
        solved = abs(self._x - GOAL) <= REACH
        return np.array([self._x]), float(solved), solved, not solved and self._steps >= 20


class Actor(Protocol):
    """Something that moves the point."""

    def act(self, state: Array, *, deterministic: bool = False) -> Array: ...


def train_on_line(learner: Sac | Tamer, steps: int, seed: int, *, until: float = 2.0) -> int:
    """Steps taken until the success rate, looked at every 50 steps, is `until`; at most `steps`."""
    world = Line(seed)
    state = world.reset()
    for taken in range(1, steps + 1):
        action = learner.act(state)
        reached, reward, terminated, truncated = world.step(action)
        if isinstance(learner, Sac):
            learner.observe(state, action, reward, reached, terminated)
        else:
            learner.observe(state, action, reward)
        while learner.owed_updates:
            learner.update()
        state = world.reset() if terminated or truncated else reached
        if taken % 50 == 0 and until <= 1 and success_on_line(learner) >= until:
            return taken
    return steps


def success_on_line(actor: Actor, rollouts: int = 20) -> float:
    """Share of deterministic rollouts from fixed starts that end solved."""
    world, solved = Line(777), 0
    for _ in range(rollouts):
        state, over = world.reset(), False
        while not over:
            state, _, terminated, truncated = world.step(actor.act(state, deterministic=True))
            over = terminated or truncated
        solved += terminated
    return solved / rollouts


ALONG = (ParameterSpec("x", "m", -1, 1),)
FETCH = Problem(
    "fetch", np.array([-1.0, 0.0]), np.array([1.0, 1.0]), (SkillSpec("pick", ALONG), SkillSpec("place", ALONG))
)


class Fetch:
    """State: where something lies and whether it is held. Pays 1 for a place beyond 0.5 with it in hand, else 0."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)
        self._state, self._calls = np.zeros(2), 0

    def reset(self) -> Array:
        """Anywhere, not held."""
        self._state, self._calls = np.array([self._rng.uniform(-1, 1), 0.0]), 0
        return self._state.copy()

    def step(self, call: SkillCall) -> tuple[Array, float, bool, bool]:
        """Next state, reward, terminated, truncated."""
        self._calls += 1
        (x,) = call.parameters
        solved = call.skill == "place" and bool(self._state[1]) and x > 0.5
        if call.skill == "pick":
            self._state[1] = float(abs(x - self._state[0]) < 0.25)
        return self._state.copy(), float(solved), solved, not solved and self._calls >= 4


def success_at_fetching(propose: Callable[[Array], Suggestion], rollouts: int = 40) -> float:
    """Share of rollouts from fixed starts that end solved."""
    world, solved = Fetch(99), 0
    for _ in range(rollouts):
        state, over = world.reset(), False
        while not over:
            state, _, terminated, truncated = world.step(propose(state).call)
            over = terminated or truncated
        solved += terminated
    return solved / rollouts
