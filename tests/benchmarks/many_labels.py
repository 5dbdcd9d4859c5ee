"""How long a learner takes to be filled with a million stored labels, as after a restart, and what it needs for them.

`BENCH_LABELS` is how many (default 100,000: the time grows in proportion).
"""

from __future__ import annotations

import os
import resource
import time
from collections.abc import Callable

import numpy as np
import torch

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from agent.study.lessons import whole_problem
from robot_adapters import registry
from tests.benchmarks.composition import kinematic
from tests.benchmarks.result import Result

DISTINCT = 1000
"""Labels that are made; the others repeat them under other ids."""


def run() -> Result:
    """Seconds from an empty learner to a filled one: `recommended` on Cooking-Hotdog, which has most key points."""
    count = int(os.environ.get("BENCH_LABELS", "100000"))
    torch.set_num_threads(1)
    task = registry.task("cooking_hotdog")
    robot, rng = kinematic(task), np.random.default_rng(0)
    states = [robot.reset(seed).state for seed in range(DISTINCT)]
    calls = [task.sample_good(state, rng) for state in states]
    labels = [Label(i + 1, states[i % DISTINCT], calls[i % DISTINCT], 1 - 2 * (i % 2)) for i in range(count)]
    learner = SEED(whole_problem(task), SeedSettings(**SEED.presets["recommended"]), 0)
    before = _megabytes()
    restored = _seconds(lambda: learner.restore(labels))
    grown = _megabytes() - before
    learner.update()
    told = {
        "gradient step": _seconds(learner.update),
        "proposal": _seconds(lambda: learner.propose(states[0])),
        "one more label": _seconds(lambda: learner.add([Label(count + 1, states[0], calls[0], 1)])),
        "one label that came late": _seconds(lambda: learner.add([Label(0, states[0], calls[0], 1)])),
    }
    lines = (f"{grown:.0f} MB more", *(f"{name}: {1000 * seconds:.1f} ms" for name, seconds in told.items()))
    return Result("many_labels", restored, f"s to take {count} labels", lines=lines)


def _seconds(act: Callable[[], object]) -> float:
    start = time.perf_counter()
    act()
    return time.perf_counter() - start


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
