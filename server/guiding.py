"""A calibration of a real robot's cameras, step by step, while its experiment doesn't run."""

from __future__ import annotations

from typing import Any

from server.runner import Runner
from server.schemas import Lifecycle
from server.store import Conflict


async def guide(runner: Runner, step: str, **arguments: Any) -> dict[str, Any]:
    """Do one step. Nothing moves by it.

    Raises:
        Conflict: the robot is a simulated one, or the experiment runs.
        CommandFailed, WorkerDied: the cameras or the arm can't do it, or the worker is gone.
    """
    if runner.attendance is None:
        raise Conflict("a simulated robot's cameras are exact", remedy="just start the experiment")
    if runner.experiment.lifecycle is Lifecycle.RUNNING:
        raise Conflict("can't calibrate while the experiment runs", remedy="pause it first")
    await runner.idle()
    station = runner.stations[0]
    await station.mend()
    await station.robot.post.fill()
    told = await station.robot.guide(step, **arguments)
    station.forget()  # what was seen before was seen by other cameras
    return told
