"""What an operator does at a real robot, beside judging: attend it, leave it, and ask something of the arm itself.

Each is written down: who attends before anybody counts on them, what the arm is to do before it does anything, and that
somebody has left after the robot has been told, because a stop waits for nothing.
"""

from __future__ import annotations

from typing import Literal

from server.attendance import ANYBODY
from server.runner import Runner
from server.schemas import Lifecycle
from server.store import Conflict, Store

Order = Literal["home", "recover"]


async def attend(runner: Runner, store: Store, operator: str, seconds: float) -> None:
    """Somebody stands at the robot, for so long from now.

    Raises:
        Conflict: somebody else does, or the robot is a simulated one. StoreError: it can't be written down.
    """
    attendance = runner.attendance
    if attendance is None:
        raise Conflict("a simulated robot needs nobody to attend it", remedy="just start the experiment")
    attendance.must_be_free_for(operator)
    if attendance.operator is None:
        await store.add_event(runner.experiment.id, "attended", {"by": operator})
    attendance.take(operator, seconds)


async def leave(runner: Runner, store: Store, operator: str) -> None:
    """They have left; nothing happens where they didn't attend it."""
    attendance = runner.attendance
    if attendance is not None and attendance.leave(operator):
        await store.add_event(runner.experiment.id, "unattended", {"by": operator})


async def tend(runner: Runner, store: Store, what: Order) -> None:
    """Have the arm do something, while no loop goes on.

    Raises:
        Conflict: it moves by proposals, nobody attends it, or a stop is latched. StoreError: it can't be written down.
        CommandFailed, WorkerDied: the arm can't do it, or its worker is gone.
    """
    attendance, experiment = runner.attendance, runner.experiment
    if attendance is None:
        raise Conflict("this robot is a simulated one", remedy="reset the episode instead")
    if experiment.lifecycle is Lifecycle.RUNNING:
        raise Conflict(f"can't {what} while the experiment runs", remedy="pause it first")
    await runner.idle()  # what is on its way comes to its end
    operator = attendance.operator
    if operator is None:
        raise Conflict(ANYBODY, remedy="attend it first: stand where you see it and can reach its stop button")
    if what == "home" and runner.crew.halted:
        raise Conflict("the emergency stop is latched", remedy="re-arm the experiment first")
    await store.add_event(experiment.id, f"{what}_ordered", {"by": operator})
    station = runner.stations[0]
    await station.mend()
    await station.robot.post.fill()
    await (station.robot.home() if what == "home" else station.robot.recover())
    station.forget()
    done = "robot_homed" if what == "home" else "robot_recovered"
    await store.add_event(experiment.id, done, {"operator": operator})
