"""One experiment's life: its loop (`server.training`), with a person's clicks, pauses, stops and deaths in between.

What the outside wants of the loop comes in three ways: a leave event that ends it at its next step, news about an open
proposal (judged, undone, withdrawn), and the stop, which goes straight to the robot workers.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Coroutine, Sequence
from contextlib import AsyncExitStack, asynccontextmanager
from typing import Any, Literal

from agent.algorithm import AgentError
from robot_adapters import registry
from robot_adapters.base import AdapterError
from server.attendance import Attendance
from server.course import Course, Work
from server.crew import Crew
from server.images import Images
from server.ledger import Ledger
from server.lifecycle import Verb
from server.messages import AttendanceChanged, FrameHeader, RobotTold, StreamEvent
from server.principal import SERVICE, acting
from server.publisher import Publisher
from server.quota import Quota
from server.rollouts import roll_out
from server.schemas import Evaluation, Experiment, Lifecycle, Phase
from server.seating import Seating
from server.settings import Settings
from server.standing import Standing
from server.station import Shared, Station
from server.store import Conflict, Store, StoreError
from server.store_values import Concluded
from server.training import train, train_in_step
from server.witness import Witness
from server.worker import WorkerDied, WorkerError

log = logging.getLogger(__name__)

STOP_GRACE = 2.0
"""Seconds after an emergency stop until a robot worker that still moves is killed."""


class Runner:
    """Runs one experiment. Its public methods are the hub's; all of it lives on one event loop."""

    def __init__(
        self, experiment: Experiment, store: Store, settings: Settings, publisher: Publisher, seating: Seating
    ) -> None:
        self._store = store
        self._publisher = publisher
        factory = registry.adapters().get(experiment.adapter)  # an experiment whose plug-in is gone can be looked at
        self.attendance = (
            None if factory is None or factory.simulated else Attendance(self._attended_by, lapsed=self._lapsed)
        )
        """Of a real robot."""
        self.witness = Witness(experiment.id, store, Images(settings.data_dir), self._publish)
        self.crew = Crew(
            experiment,
            store,
            settings,
            on_frame=self._show if publisher.shows_frames else None,
            on_change=self._publish,
            on_told=self._hear,
            attendance=self.attendance,
        )
        self.standing = Standing(experiment, store, self.crew, publish=self._publish)
        self.crew.recollection.on_progress = self.standing.tell
        self._ledger = Ledger(
            experiment,
            store,
            self.crew,
            checkpoint_every=settings.checkpoint_every,
            publish=self._publish,
            changed=self.changed,
        )
        self._quota = Quota(store, self.standing)
        shared = Shared(
            store,
            self.crew,
            self.standing,
            self._ledger,
            self._quota,
            self._publish,
            ask_operator=self._ask_operator,
            stop=self.stop,
            witness=self.witness,
            seating=seating,
            still=lambda: sum(not station.moving for station in self.stations),
        )
        self.stations = tuple(Station(robot, shared) for robot in self.crew.robots)
        self._course = Course(f"experiment {experiment.id}")
        self._evaluating = False
        self._seated: set[asyncio.Task[None]] = set()
        self.seating = seating
        seating.opened = lambda: [proposal for station in self.stations for proposal in station.desk.opened]
        seating.on_change = self._wake
        seating.on_arrived = lambda: self._soon(self._welcome())
        seating.on_vanished = lambda names: self._soon(self._do_without(names))
        seating.follow(experiment.aggregation, experiment.together, going=False)

    # --- what the hub asks --------------------------------------------------------------------------------------

    @property
    def experiment(self) -> Experiment:
        """As everyone is told of it."""
        return self.standing.experiment

    @property
    def busy(self) -> bool:
        """Whether the loop or an evaluation goes on."""
        return self._course.busy

    @property
    def evaluating(self) -> bool:
        """Whether an evaluation goes on."""
        return self.busy and self._evaluating

    @property
    def simulated(self) -> bool:
        """Whether the robots are simulated ones."""
        return self._first.acting.simulated

    def check(self, verb: Verb) -> None:
        """Whether the robot could move after this verb, as far as this process knows; to be asked before it is stored.

        Raises:
            Conflict: a stop is latched. UnknownName, UnknownTeacher: a plug-in of the experiment isn't installed.
        """
        self.standing.must_be_armed(verb)
        _ = self._first.acting.task, self.simulated, self._first.judge

    def go(self, *, until: int | None = None) -> None:
        """Run the loop, after whatever still goes on; pause by itself once `until` feedback is stored.

        Raises:
            Conflict: a stop came while the verb that leads here was stored; what it stores follows.
        """
        self.standing.must_be_armed("resume")
        self._evaluating = False
        self._quota.until = until
        self.crew.forgive()
        self._follow(self._run)

    def evaluate(self, evaluation: Evaluation) -> None:
        """Roll out the deterministic policy in the background."""
        self._evaluating = True
        self._follow(lambda leave: self._evaluate(evaluation, leave))

    def dismiss(self) -> None:
        """End the workers once nothing goes on: the experiment is over."""
        self._evaluating = False
        self._follow(lambda _: self._dismiss())

    def leave(self) -> None:
        """End the loop at its next step; a skill that moves ends first."""
        self._course.leave()
        self._wake()

    def stop(self) -> None:
        """Emergency stop: the robots first, all at once and latched; then the loop."""
        self.crew.stop()
        self.leave()
        for station in self.stations:
            station.forget()
        moving = [(station, station.homing or self._course.task) for station in self.stations if station.moving]
        if moving:
            asyncio.get_running_loop().call_later(STOP_GRACE, self._insist, moving)

    def brake(self) -> None:
        """The service is about to end: a real robot stands still from now on, whatever its answers still wait for."""
        if self.attendance is not None:
            self.stop()

    async def rearm(self, upto: int) -> None:
        """Lift the stops up to number `upto`; nothing moves by that."""
        await self.crew.rearm(upto)

    async def reset(self, robot: int | None) -> None:
        """Begin a new episode, of one robot or of each: now where a proposal waits, else once the skill has ended."""
        for station in self.stations:
            if robot in (None, station.robot.index):
                await station.want_reset()

    async def withdraw(self) -> None:
        """Close every open proposal without a verdict."""
        for station in self.stations:
            await station.desk.withdraw()

    def drop(self) -> None:
        """Put away what lies on the desks, where the store can't be told."""
        for station in self.stations:
            station.desk.drop()

    @asynccontextmanager
    async def turn(self) -> AsyncIterator[None]:
        """Between two steps of every robot: none of them meets a state that it didn't expect."""
        async with AsyncExitStack() as turns:
            for station in self.stations:
                await turns.enter_async_context(station.desk.turn)
            yield

    async def idle(self) -> None:
        """Wait until neither the loop nor an evaluation goes on."""
        await self._course.idle()
        await self._ledger.settled()

    async def close(self, *, grace: float) -> None:
        """End loop and workers; what still goes on after `grace` seconds is cut off, and found interrupted later."""
        self.leave()
        if self.busy and any(station.moving for station in self.stations):
            self.crew.stop()
        await self._course.end(grace)
        await self._ledger.settled()
        await self.crew.close()
        await self.witness.settled()
        await self.standing.owed.close()

    def changed(self, experiment: Experiment) -> None:
        """Take over what is stored, unless something newer is known, and tell everyone."""
        self.standing.changed(experiment)
        now = self.experiment
        going = now.lifecycle is Lifecycle.RUNNING and not now.halted
        self.seating.follow(now.aggregation, now.together, going=going)
        self._wake()

    def conclude(self, concluded: Sequence[Concluded]) -> None:
        """Take over what votes on open proposals add up to now."""
        for station in self.stations:
            station.desk.conclude(concluded)
        self.seating.deal()

    # --- who is there --------------------------------------------------------------------------------------------

    async def _do_without(self, names: list[str]) -> None:
        """These trainers are gone: nothing that is open waits for them any more."""
        async with self.turn():  # also on what is just being opened
            if any(set(names) & set(proposal.electorate) for proposal in self.seating.opened()):
                self.conclude(await self._store.leave_electorates(self.experiment.id, names))
        await self._welcome()

    async def _welcome(self) -> None:
        """Somebody has come: what too few were there for is theirs too."""
        if self.seating.short:
            async with self.turn():
                self.conclude(await self._store.enter_electorates(self.experiment.id, self.seating.names))

    def _soon(self, work: Coroutine[Any, Any, None]) -> None:
        async def follow() -> None:
            try:
                await work
            except StoreError as error:
                log.warning("experiment %d: who is there could not be stored: %s", self.experiment.id, error)

        task = asyncio.create_task(follow(), name=f"seats of experiment {self.experiment.id}")
        self._seated.add(task)
        task.add_done_callback(self._seated.discard)

    # --- the loop -----------------------------------------------------------------------------------------------

    def _follow(self, work: Work) -> None:
        self._course.follow(lambda leave: self._guarded(work(leave)))

    async def _run(self, leave: asyncio.Event) -> None:
        """The loop, until it is told to leave: in step, or each robot by itself."""
        for station in self.stations:
            station.desk.drop_judged()  # by a click that came while the last loop failed
        if self.experiment.lockstep:
            await self._keep_on(self.stations, leave)
        else:
            alone = (self._keep_on([station], leave) for station in self.stations)
            ends = await asyncio.gather(*alone, return_exceptions=True)  # where one fails, a motion of another ends
            for error in ends:
                if error is not None:
                    raise error
        for station in self.stations:
            await station.close_up()
        await self._ledger.leave()

    async def _keep_on(self, stations: Sequence[Station], leave: asyncio.Event) -> None:
        """Train, mended after every death, until told to leave; where that ends, it ends for the others too."""
        try:
            while not leave.is_set() and not await self._quota.reached():
                try:
                    for station in stations:
                        await station.mend()
                    if self.experiment.lockstep:
                        await train_in_step(stations, self.crew, self._quota, leave)
                    else:
                        await train(stations[0], self.crew, self._quota, leave)
                except WorkerDied as death:
                    for station in stations:
                        await station.mend(death)
                except Conflict:
                    if not leave.is_set():  # else a pause or a stop came between two steps
                        raise
        finally:
            leave.set()
            self._wake()
            if len(stations) < len(self.stations):  # the others may take a while
                for station in stations:
                    station.enter(Phase.IDLE)

    async def _guarded(self, work: Coroutine[Any, Any, None]) -> None:
        """Run the loop or an evaluation; what it can't mend makes the experiment fail, and says why."""
        try:
            await work
        except (WorkerError, AdapterError, AgentError, StoreError) as error:
            log.warning("experiment %d failed: %s", self.experiment.id, error)
            await self.crew.distrust(error)
            await self._fail(f"{error}. {error.remedy}")
        except Exception:
            log.exception("experiment %d failed", self.experiment.id)
            await self._fail("the service met an error of its own. See the server's log, then resume")
        finally:
            for station in self.stations:
                station.enter(Phase.IDLE)

    async def _evaluate(self, evaluation: Evaluation, leave: asyncio.Event) -> None:
        self._first.enter(Phase.EVALUATING)
        await self._end_episodes()
        try:
            await self._first.mend()
            await roll_out(evaluation, self._first, self.crew, self._store, leave=leave, publish=self._publish)
        except WorkerDied as death:
            await self.crew.bury(death)
        finally:
            if self.experiment.lifecycle is Lifecycle.FINISHED:
                await self.crew.close()

    async def _dismiss(self) -> None:
        await self._end_episodes()
        await self.crew.close()

    async def _fail(self, why: str) -> None:
        for station in self.stations:
            station.forget()
            with contextlib.suppress(StoreError):  # what fails says so below; the next verb closes it in the store
                await station.interrupt()
            station.desk.drop()
        if self.crew.halted:  # after damage, perhaps, that could not be stored
            self.standing.owe_halt()
        if self._evaluating:
            with contextlib.suppress(StoreError):  # the evaluation itself is closed by the next start
                await self._store.add_event(self.experiment.id, "evaluation_failed", {"detail": why})
        else:
            await self.standing.fail(why)

    async def _end_episodes(self) -> None:
        for station in self.stations:
            await station.end_episode("reset")

    async def _ask_operator(self, verb: Literal["halt", "pause"], why: Sequence[str]) -> None:
        """Go no further until a person has looked: after damage only once the stop is lifted."""
        self.leave()
        with contextlib.suppress(Conflict):  # paused, or over, by a verb that was quicker
            self.changed(await self._store.transition(self.experiment.id, verb))
        await self._store.add_event(self.experiment.id, "operator_needed", {"response": verb, "why": list(why)})

    def _attended_by(self, operator: str | None) -> None:
        self._publish(AttendanceChanged(operator=operator))

    def _lapsed(self, operator: str) -> None:
        async def store() -> None:
            acting.set(SERVICE)  # they have said nothing
            await self._store.add_event(self.experiment.id, "unattended", {"operator": operator, "lapsed": True})

        self._soon(store())

    def _insist(self, moving: Sequence[tuple[Station, asyncio.Task[Any] | None]]) -> None:
        """The emergency stop's last word: a robot worker that still moves, for what it moved for then, is killed."""
        for station, work in moving:
            if work is not None and not work.done() and station.moving:
                name = station.robot.post.name
                log.error("experiment %d: the %s worker did not stop in %g s", self.experiment.id, name, STOP_GRACE)
                station.robot.post.kill()

    @property
    def _first(self) -> Station:
        return self.stations[0]

    def _hear(self, told: RobotTold) -> None:
        self._publish(told)
        if told.telemetry.scene == "changed":
            self._wake()  # what is judged there is of yesterday

    def _wake(self) -> None:
        for station in self.stations:
            station.desk.wake()

    def _show(self, header: FrameHeader, jpeg: bytes) -> None:
        self.witness.see(header, jpeg)
        self._publisher.publish_frame(self.experiment.id, header, jpeg)

    def _publish(self, event: StreamEvent) -> None:
        self._publisher.publish(self.experiment.id, event)
