"""Milliseconds of processor time to start an episode, without pictures, against robosuite's own reset in one run."""

from __future__ import annotations

import time
from collections.abc import Callable

from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from tests.benchmarks.result import Result

RESETS = 50
STOCK_RESETS = 5  # robosuite builds the whole model anew
BAR = 10.0  # ms
TASKS = FACTORY.tasks


def run() -> Result:
    """Reset every task, and robosuite's Stack as it comes (`hard_reset`). The value is Stacking's, all have to pass."""
    times = {task: _ours(task, draw=False) for task in TASKS}
    drawn = _ours("stacking", draw=True)

    import robosuite  # noqa: PLC0415  the adapter has loaded it quietly

    stock = robosuite.make(
        "Stack", robots="Panda", has_renderer=False, has_offscreen_renderer=False, use_camera_obs=False
    )
    theirs = _milliseconds(lambda _: stock.reset(), STOCK_RESETS)
    stock.close()
    ours = times["stacking"]
    lines = (
        ", ".join(f"{task} {ms:.1f}" for task, ms in times.items()),
        f"{theirs / ours:.0f} times as fast as stock; with two pictures {drawn:.1f} ms",
    )
    return Result("reset", ours, "ms", baseline=theirs, bar=BAR, ok=max(times.values()) <= BAR, lines=lines)


def _ours(task: str, *, draw: bool) -> float:
    robot = FACTORY(task, RobosuiteSettings(draw=draw))
    mean = _milliseconds(robot.reset, RESETS)
    robot.close()
    return mean


def _milliseconds(reset: Callable[[int], object], times: int) -> float:
    """Mean over `times`, after one to warm up."""
    reset(0)
    started = time.process_time()
    for i in range(times):
        reset(i)
    return (time.process_time() - started) / times * 1e3
