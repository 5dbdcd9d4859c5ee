"""Milliseconds to start an episode (with its two pictures), against robosuite's own reset in the same run."""

from __future__ import annotations

import time
from collections.abc import Callable

from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from tests.benchmarks.result import Result

RESETS = 20
STOCK_RESETS = 3  # a second each: robosuite builds the whole model anew


def run() -> Result:
    """Reset the adapter and robosuite's stock Stack (no pictures) with their defaults."""
    robot = FACTORY("stacking", RobosuiteSettings())
    ours = _milliseconds(robot.reset, RESETS)
    robot.close()

    import robosuite  # noqa: PLC0415  the adapter has chosen the graphics before

    stock = robosuite.make(
        "Stack", robots="Panda", has_renderer=False, has_offscreen_renderer=False, use_camera_obs=False
    )
    theirs = _milliseconds(lambda _: stock.reset(), STOCK_RESETS)
    stock.close()
    return Result("reset", ours, "ms", baseline=theirs, lines=(f"{theirs / ours:.0f} times as fast as stock",))


def _milliseconds(reset: Callable[[int], object], times: int) -> float:
    """Mean over `times`."""
    started = time.perf_counter()
    for i in range(times):
        reset(i)
    return (time.perf_counter() - started) / times * 1e3
