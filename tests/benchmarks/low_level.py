"""Steps a second of low-level control under random actions, resets included, on both simulated adapters."""

from __future__ import annotations

import time

import numpy as np

from robot_adapters import low_level
from tests.benchmarks.result import Result

STEPS = {"kinematic": 20_000, "robosuite": 2_000}
TASKS = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")


def run() -> Result:
    """Every task on every adapter; the value is Stacking's on robosuite."""
    rates = {(task, adapter): _rate(task, adapter) for adapter in STEPS for task in TASKS}
    lines = (
        f"{'task':16}" + "".join(f"{adapter:>12}" for adapter in STEPS),
        *(f"{task:16}" + "".join(f"{rates[task, adapter]:>12,.0f}" for adapter in STEPS) for task in TASKS),
    )
    return Result("low_level", rates["stacking", "robosuite"], "steps/s", lines=lines)


def _rate(task: str, adapter: str) -> float:
    env = low_level.make(task, adapter, seed=0)
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (STEPS[adapter], *(env.action_space.shape or ())))
    env.reset()
    started = time.perf_counter()
    for action in actions:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()
    rate = len(actions) / (time.perf_counter() - started)
    env.close()
    return rate
