"""What an operator does at a real robot, beside judging: attend it, leave it, and ask something of the arm itself.

Each is written down: who attends before anybody counts on them, what the arm is to do before it does anything, and that
somebody has left after the robot has been told, because a stop waits for nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal

from server.principal import Principal
from server.runner import Runner
from server.schemas import Lifecycle
from server.store import Conflict, Store

Order = Literal["home", "recover"]


async def attend(runner: Runner, store: Store, who: Principal, seconds: float) -> None:
    """Somebody stands at the robot, for so long from now.

    Raises:
        Conflict: somebody else does, or the robot is a simulated one. StoreError: it can't be written down.
    """
    attendance = runner.attendance
    if attendance is None:
        raise Conflict("a simulated robot needs nobody to attend it", remedy="just start the experiment")
    attendance.must_be_free_for(who.name)
    if attendance.operator is None:
        await store.add_event(runner.experiment.id, "attended", {"by": who.name})
    attendance.take(who, seconds)


async def leave(runner: Runner, store: Store, operator: str) -> None:
    """They have left; nothing happens where they didn't attend it."""
    attendance = runner.attendance
    if attendance is not None and attendance.leave(operator):
        await store.add_event(runner.experiment.id, "unattended", {"by": operator})


def attending(runners: Iterable[Runner]) -> list[Principal]:
    """Everybody who stands at a robot."""
    return [r.attendance.who for r in runners if r.attendance is not None and r.attendance.who is not None]


async def let_out(runners: Iterable[Runner], store: Store, ended: Callable[[Principal], bool]) -> None:
    """Count no more on those whose access has ended: what moves stops. Every robot is told, then it is written down."""
    gone = []
    for runner in runners:
        attendance = runner.attendance
        if attendance is not None and (who := attendance.who) is not None and ended(who):
            attendance.leave(who.name)
            gone.append((runner.experiment.id, who.name))
    for experiment_id, name in gone:
        await store.add_event(experiment_id, "unattended", {"operator": name, "let_out": True})


def must_not_move_another_s(runner: Runner, who: Principal) -> None:
    """Whoever attends a real robot may have their hands at it: nobody else sets going what may move it.

    Without a login nobody can be told from the other, and everybody sits at this machine.

    Raises:
        Conflict: somebody else attends it.
    """
    attendance = runner.attendance
    if attendance is not None and attendance.present and not who.local:
        attendance.must_be(who)


async def tend(runner: Runner, store: Store, what: Order, who: Principal) -> None:
    """Have the arm do something, while no loop goes on. who: has ordered it.

    Raises:
        Conflict: it moves by proposals, `who` doesn't attend it, or a stop is latched. StoreError: it can't be written
            down.
        CommandFailed, WorkerDied: the arm can't do it, or its worker is gone.
    """
    attendance, experiment = runner.attendance, runner.experiment
    if attendance is None:
        raise Conflict("this robot is a simulated one", remedy="reset the episode instead")
    if experiment.lifecycle is Lifecycle.RUNNING:
        raise Conflict(f"can't {what} while the experiment runs", remedy="pause it first")
    await runner.idle()  # what is on its way comes to its end
    attendance.must_be(who)
    if what == "home" and runner.crew.halted:
        raise Conflict("the emergency stop is latched", remedy="re-arm the experiment first")
    await store.add_event(experiment.id, f"{what}_ordered", {"by": who.name})
    station = runner.stations[0]
    await station.mend()
    await station.robot.post.fill()
    if what == "home":
        arrived = await station.home()
        await store.add_event(experiment.id, "robot_homed", {"operator": who.name, "arrived": arrived})
    else:
        await station.robot.recover()
        station.forget()
        await store.add_event(experiment.id, "robot_recovered", {"operator": who.name})
