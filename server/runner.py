"""One experiment's loop: Algorithm 1 of the paper, with a person's clicks, pauses, stops and deaths in between.

`_train` is the algorithm. What the outside wants of it comes in three ways: a leave event that ends the loop at its
next step, news about the open proposal (judged, undone, withdrawn), and the stop, which goes straight to the robot
worker.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Coroutine
from functools import cached_property
from typing import Any, Literal

from agent.algorithm import AgentError
from robot_adapters.base import AdapterError
from server.acting import Acting
from server.course import Course, Work
from server.crew import Crew
from server.crew_values import Done, Seen
from server.desk import Desk
from server.judging import Judge
from server.ledger import Ledger
from server.lifecycle import Verb
from server.messages import StreamEvent
from server.publisher import Publisher
from server.rollouts import roll_out
from server.schemas import CloseReason, Evaluation, Experiment, Lifecycle, Phase, Proposal, Verdict
from server.seeds import episode_seed
from server.settings import Settings
from server.standing import Standing
from server.store import Conflict, Store, StoreError
from server.store_values import EpisodeOutcome, NewProposal
from server.violations import Response, respond
from server.worker import WorkerDied, WorkerError

log = logging.getLogger(__name__)

STOP_GRACE = 2.0
"""Seconds after an emergency stop until a robot worker that still moves is killed."""


class Runner:
    """Runs one experiment. Its public methods are the hub's; all of it lives on one event loop."""

    def __init__(self, experiment: Experiment, store: Store, settings: Settings, publisher: Publisher) -> None:
        self._store = store
        self._publisher = publisher
        self.crew = Crew(
            experiment,
            store,
            settings,
            on_frame=lambda header, jpeg: publisher.publish_frame(experiment.id, header, jpeg),
            on_change=self._publish,
        )
        self.standing = Standing(experiment, store, publish=self._publish, halted=lambda: self.crew.halted)
        self._acting = Acting(experiment, store, self.crew, self._publish, self.standing.owed)
        self._ledger = Ledger(
            experiment,
            store,
            self.crew,
            checkpoint_every=settings.checkpoint_every,
            publish=self._publish,
            changed=self.changed,
        )
        self._course = Course(f"experiment {experiment.id}")
        self._evaluating = False
        self._until: int | None = None
        # the episode that goes on, and what was seen last in it; None: reset, or look again
        self._episode_open = False
        self._executed = 0
        self._seen: Seen | None = None
        self._reset_wanted = False
        self.desk = Desk(store, self.crew, self._ledger, self._publish, lambda: self.experiment)

    # --- what the hub asks --------------------------------------------------------------------------------------

    @property
    def experiment(self) -> Experiment:
        """As everyone is told of it."""
        return self.standing.experiment

    @property
    def phase(self) -> Phase:
        """What goes on right now."""
        return self.standing.phase

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
        """Whether the robot is a simulated one."""
        return self._acting.simulated

    def check(self, verb: Verb) -> None:
        """Whether the robot could move after this verb, as far as this process knows; to be asked before it is stored.

        Raises:
            Conflict: a stop is latched. UnknownName, UnknownTeacher: a plug-in of the experiment isn't installed.
        """
        self.standing.must_be_armed(verb)
        _ = self._acting.task, self.simulated, self._judge

    def go(self, *, until: int | None = None) -> None:
        """Run the loop, after whatever still goes on; pause by itself once `until` feedback is stored.

        Raises:
            Conflict: a stop came while the verb that leads here was stored; what it stores follows.
        """
        self.standing.must_be_armed("resume")
        self._evaluating = False
        self._until = until
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
        self.desk.wake()

    def stop(self) -> None:
        """Emergency stop: the robot first, at once and latched; then the loop."""
        self.crew.stop()
        self.leave()
        self._seen = None
        if self.phase in (Phase.EXECUTING, Phase.EVALUATING):
            asyncio.get_running_loop().call_later(STOP_GRACE, self._insist, self._course.task)

    async def rearm(self, upto: int) -> None:
        """Lift the stops up to number `upto`; nothing moves by that."""
        with contextlib.suppress(WorkerDied):  # the next one starts re-armed
            await self.crew.rearm(upto)

    async def reset(self) -> None:
        """Begin a new episode: now if a proposal waits, else as soon as the skill has ended, or at resume."""
        self._reset_wanted = True
        await self.desk.withdraw()

    async def idle(self) -> None:
        """Wait until neither the loop nor an evaluation goes on."""
        await self._course.idle()
        await self._ledger.settled()

    async def close(self, *, grace: float) -> None:
        """End loop and workers; what still goes on after `grace` seconds is cut off, and found interrupted later."""
        self.leave()
        if self.busy and self.phase in (Phase.EXECUTING, Phase.EVALUATING):
            self.crew.stop()
        await self._course.end(grace)
        await self._ledger.settled()
        await self.crew.close()
        await self.standing.owed.close()

    def changed(self, experiment: Experiment) -> None:
        """Take over what is stored, unless something newer is known, and tell everyone."""
        self.standing.changed(experiment)
        self.desk.wake()

    @cached_property
    def _judge(self) -> Judge | None:
        return Judge(self.experiment, self._acting.task, self.desk) if self.experiment.teacher else None

    # --- the loop -----------------------------------------------------------------------------------------------

    async def _train(self, leave: asyncio.Event) -> None:
        """Algorithm 1; in brackets the lines of the paper."""
        self.standing.enter(Phase.STARTING)
        await self.crew.bring_up()  # [1] the replay is a view of the stored feedback
        while not leave.is_set() and not await self._enough():
            seen = await self._look()  # [2-4] a new episode where the last one has ended
            await self._propose(seen)  # [5, 6]
            await self.desk.consider(simulated=self.simulated)  # none of the paper's: off unless it is asked for
            judged = await self._query(seen, leave)  # [7, 8]
            if judged is not None and judged.verdict is Verdict.GOOD:
                await self._execute(judged, seen)  # [9-11]
            if self.experiment.lockstep and not leave.is_set():
                self.standing.enter(Phase.LEARNING)
                await self.crew.flush()  # [12] otherwise the learner works while nobody asks it anything

    async def _look(self) -> Seen:
        """What the robot sees now: of a new episode, or of the one that goes on."""
        if self._reset_wanted:
            self._reset_wanted = False
            await self._end_episode("reset")
        if not self._episode_open:
            self.standing.enter(Phase.OBSERVING)
            number = (await self._store.experiment(self.experiment.id)).counters.episodes + 1
            seed = episode_seed(self.experiment.seed, number)
            async with self.desk.turn:
                await self._store.begin_episode(self.experiment.id, seed)
            self._episode_open, self._executed = True, 0
            self._seen = await self.crew.reset(seed)
        elif self._seen is None:
            self.standing.enter(Phase.OBSERVING)
            self._seen = await self.crew.observe()
        return self._seen

    async def _propose(self, seen: Seen) -> None:
        """Have a proposal open, unless an undo or a click has opened one, or one waits for the gate."""
        if self.desk.open is None and self.desk.judged is None:
            self.standing.enter(Phase.PROPOSING)
            await self.desk.present(await self._acting.draw(seen))

    async def _query(self, seen: Seen, leave: asyncio.Event) -> Proposal | None:
        """The proposal that was judged, by a person or by the teacher; None where none was.

        Raises:
            WorkerDied: a worker went away while this waited.
        """
        if self.desk.open is not None:
            self.standing.enter(Phase.AWAITING_FEEDBACK)
            self._ledger.write()
            asked = self.desk.open
            if self._judge is not None and not self._judge.has_judged(asked):
                await self._judge.judge(asked, self._acting.call_of(asked), leave)
            elif not self.experiment.lockstep:
                self.desk.draw_ahead(lambda: asyncio.create_task(self._draw_ahead(seen)))
        return await self.desk.verdict(leave)

    async def _draw_ahead(self, seen: Seen) -> NewProposal:
        """What would be proposed next if nothing moves: once the learner is done, its policy stands still."""
        await self.crew.flush()
        return await self._acting.draw(seen)

    async def _execute(self, judged: Proposal, seen: Seen) -> None:
        """Run the approved call if the gate opens, and end the episode if that solved or spoiled the task."""
        self.standing.enter(Phase.DECIDING)
        async with self.desk.turn:
            if self.desk.judged is not judged:  # taken back in the meantime
                return
            self.desk.judged = None
            execution = await self._acting.decide(judged, seen)
        if execution is None:
            return
        self.standing.enter(Phase.EXECUTING)
        done = await self._acting.move(judged, execution, self._latch_after_damage)
        self._seen = None
        self._executed += 1
        response = self._response(done)
        if response in (Response.HALT, Response.PAUSE):
            await self._ask_operator(response, done)
        if response is not Response.NOTHING:
            await self._end_episode("violation")
        elif done.task_success:
            await self._end_episode("success")
        elif self._executed >= self._acting.task.horizon:
            await self._end_episode("horizon")

    # --- around the loop ----------------------------------------------------------------------------------------

    def _follow(self, work: Work) -> None:
        self._course.follow(lambda leave: self._guarded(work(leave)))

    async def _run(self, leave: asyncio.Event) -> None:
        """The loop, mended after every death, until it is told to leave."""
        self.desk.drop_judged()  # by a click that came while the last loop failed
        while not leave.is_set() and not await self._enough():
            try:
                await self._train(leave)
            except WorkerDied as death:
                await self._mend(death)
            except Conflict:
                if not leave.is_set():  # else a pause or a stop came between two steps
                    raise
        await self.desk.withdraw()
        self.desk.drop_judged()
        self.desk.forget_ahead()
        await self._ledger.leave()

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
            self.standing.enter(Phase.IDLE)

    async def _mend(self, death: WorkerDied) -> None:
        """Clear up after a death; the next round of the loop starts a new worker."""
        await self.crew.bury(death)
        if death.worker == "robot":
            self._seen = None
            await self.desk.withdraw(CloseReason.INTERRUPTED)
            await self._end_episode("interrupted")

    async def _evaluate(self, evaluation: Evaluation, leave: asyncio.Event) -> None:
        self.standing.enter(Phase.EVALUATING)
        await self._end_episode("reset")
        try:
            await roll_out(evaluation, self._acting, self.crew, self._store, leave=leave, publish=self._publish)
        except WorkerDied as death:
            await self.crew.bury(death)
        finally:
            if self.experiment.lifecycle is Lifecycle.FINISHED:
                await self.crew.close()

    async def _dismiss(self) -> None:
        await self._end_episode("reset")
        await self.crew.close()

    async def _fail(self, why: str) -> None:
        self._seen = None
        with contextlib.suppress(StoreError):  # what fails says so below; the verb that follows closes it in the store
            await self.desk.withdraw(CloseReason.INTERRUPTED)
            await self._end_episode("interrupted")
        self.desk.drop()
        if self.crew.halted:  # after damage, perhaps, that could not be stored
            self.standing.owe_halt()
        if self._evaluating:
            with contextlib.suppress(StoreError):  # the evaluation itself is closed by the next start
                await self._store.add_event(self.experiment.id, "evaluation_failed", {"detail": why})
        else:
            await self.standing.fail(why)

    async def _enough(self) -> bool:
        """Whether the wanted amount of feedback is stored; then the experiment pauses itself."""
        if self._until is None:
            return False
        stored = await self._store.experiment(self.experiment.id)
        if stored.counters.feedback < self._until:
            return False
        if stored.lifecycle is Lifecycle.RUNNING:
            self.changed(await self._store.transition(self.experiment.id, "pause"))
        return True

    async def _end_episode(self, outcome: EpisodeOutcome) -> None:
        if self._episode_open:
            self._episode_open = False
            await self._store.end_episode(self.experiment.id, outcome)
        self._seen = None

    def _response(self, done: Done) -> Response:
        kinds = [kind for kind, _ in done.violations]
        return respond(kinds, simulated=self.simulated, taught=self._judge is not None)

    def _latch_after_damage(self, done: Done) -> None:
        """The robot first, then the database."""
        if self._response(done) is Response.HALT:
            self.crew.stop()  # `stop` would also kill a robot worker that moves; this one has ended its motion

    async def _ask_operator(self, response: Response, done: Done) -> None:
        """Go no further until a person has looked: after damage only once the stop is lifted."""
        self.leave()
        with contextlib.suppress(Conflict):  # paused, or over, by a verb that was quicker
            verb: Literal["halt", "pause"] = "halt" if response is Response.HALT else "pause"
            self.changed(await self._store.transition(self.experiment.id, verb))
        why = [detail for _, detail in done.violations]
        await self._store.add_event(self.experiment.id, "operator_needed", {"response": response, "why": why})

    def _insist(self, task: asyncio.Task[None] | None) -> None:
        """The emergency stop's last word: a robot worker that still moves is killed."""
        if task is not None and not task.done() and self.phase in (Phase.EXECUTING, Phase.EVALUATING):
            log.error("experiment %d: the robot worker did not stop in %g s", self.experiment.id, STOP_GRACE)
            self.crew.kill_robot()

    def _publish(self, event: StreamEvent) -> None:
        self._publisher.publish(self.experiment.id, event)
