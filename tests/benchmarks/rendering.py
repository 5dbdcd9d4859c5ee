"""Milliseconds of processor time for one 640x480 view, against robosuite's stock scene and renderer in one run."""

from __future__ import annotations

import time
from collections.abc import Callable

from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from tests.benchmarks.result import Result

VIEWS = 30
BAR = 40.0  # ms


def run() -> Result:
    """Draw each view in turn, as an observation does, and robosuite's stock Stack from its own camera."""
    robot = FACTORY("stacking", RobosuiteSettings(stills="smooth"))
    assert isinstance(robot, RobosuiteAdapter)
    cameras = robot.info.cameras
    ours = _milliseconds(lambda i: robot.cameras.render(cameras[i % 2]))
    smooth = _milliseconds(lambda i: robot.cameras.render(cameras[i % 2], still=True))
    encoded = _milliseconds(lambda i: robot.frame(cameras[i % 2]))
    robot.close()

    import robosuite  # noqa: PLC0415  the adapter has chosen the graphics before

    stock = robosuite.make(
        "Stack", robots="Panda", has_renderer=False, has_offscreen_renderer=True, use_camera_obs=False
    )
    stock.reset()
    theirs = _milliseconds(lambda _: stock.sim.render(width=640, height=480, camera_name="agentview"))
    stock.close()
    return Result(
        "rendering",
        ours,
        "ms a view",
        baseline=theirs,
        bar=BAR,
        ok=ours <= BAR,
        lines=(
            f"{theirs / ours:.1f} times as fast as stock; with JPEG {encoded:.1f} ms; a smooth still {smooth:.1f} ms; "
            f"{robot.info.details}",
        ),
    )


def _milliseconds(draw: Callable[[int], object]) -> float:
    """Mean over `VIEWS`, after two to warm up."""
    for i in range(2):
        draw(i)
    started = time.process_time()
    for i in range(VIEWS):
        draw(i)
    return (time.process_time() - started) / VIEWS * 1e3
