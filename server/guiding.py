"""A calibration of a real robot's cameras, step by step, while its experiment doesn't run."""

from __future__ import annotations

from typing import Any

from server.runner import Runner
from server.schemas import Lifecycle
from server.store import Conflict, Store
from server.worker import CommandFailed

UNFIT = {"NotEnough", "TooInaccurate", "Refusal"}
"""What the worker calls it where the poses won't do, or none were taken: that is for people to put right."""


async def guide(runner: Runner, store: Store, step: str, **arguments: Any) -> dict[str, Any]:
    """Do one step. Nothing moves by it.

    Raises:
        Conflict: the robot is a simulated one, the experiment runs, or there are no poses that would do.
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
    try:
        told = await station.robot.guide(step, **arguments)
    except CommandFailed as refusal:
        if refusal.kind not in UNFIT:
            raise
        raise Conflict(str(refusal), remedy=refusal.remedy) from refusal
    station.forget()  # what was seen before was seen by other cameras
    if step == "guide_store":
        await store.add_event(runner.experiment.id, "cameras_calibrated", {"apart_mm": told.get("apart_mm")})
    return told


async def under_way(runner: Runner) -> dict[str, Any]:
    """The calibration that goes on, if one does: nothing is started or built to tell.

    Raises:
        Conflict: the robot is a simulated one.
        CommandFailed, WorkerDied: the cameras or the arm can't be asked, or the worker is gone.
    """
    if runner.attendance is None:
        raise Conflict("a simulated robot's cameras are exact", remedy="just start the experiment")
    robot = runner.stations[0].robot
    if runner.experiment.lifecycle is Lifecycle.RUNNING or runner.busy or not robot.post.ready:
        return {}
    return await robot.guide("guide_state")
