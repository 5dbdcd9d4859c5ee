"""One experiment's loop: Algorithm 1 of the paper, with a person's clicks, pauses, stops and deaths in between.

`_train` is the algorithm. What the outside wants of it comes in three ways: a leave event that ends the loop at its
next step, news about the open proposal (judged, undone, withdrawn), and the stop, which goes straight to the robot
worker.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable, Coroutine
from typing import Any, Literal

from agent.algorithm import AgentError
from robot_adapters.base import AdapterError
from server.acting import Acting
from server.crew import Crew, Done, Seen
from server.desk import Desk
from server.judging import Judge
from server.ledger import Ledger
from server.publisher import Publisher
from server.rollouts import roll_out
from server.schemas import (
    CloseReason,
    Evaluation,
    Experiment,
    ExperimentChanged,
    Lifecycle,
    Phase,
    Proposal,
    StreamEvent,
    Verdict,
)
from server.seeds import episode_seed
from server.settings import Settings
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
        self.experiment = experiment
        self._store = store
        self._publisher = publisher
        self._crew = Crew(
            experiment,
            store,
            settings,
            on_frame=lambda header, jpeg: publisher.publish_frame(experiment.id, header, jpeg),
            on_change=self._publish,
        )
        self._acting = Acting(experiment, store, self._crew, self._publish)
        self._ledger = Ledger(
            experiment,
            store,
            self._crew,
            checkpoint_every=settings.checkpoint_every,
            publish=self._publish,
            changed=self.changed,
        )
        self._task: asyncio.Task[None] | None = None
        self._leave = asyncio.Event()
        self._evaluating = False
        self._until: int | None = None
        # the episode that goes on, and what was seen last in it; None: reset, or look again
        self._episode_open = False
        self._executed = 0
        self._seen: Seen | None = None
        self._reset_wanted = False
        self.desk = Desk(store, self._crew, self._ledger, self._publish, lambda: self.experiment)
        self._judge = Judge(experiment, self._acting.task, self.desk) if experiment.teacher else None

    # --- what the hub asks --------------------------------------------------------------------------------------

    @property
    def phase(self) -> Phase:
        """What goes on right now."""
        return self.experiment.phase

    @property
    def busy(self) -> bool:
        """Whether the loop or an evaluation goes on."""
        return self._task is not None and not self._task.done()

    @property
    def evaluating(self) -> bool:
        """Whether an evaluation goes on."""
        return self.busy and self._evaluating

    @property
    def simulated(self) -> bool:
        """Whether the robot is a simulated one."""
        return self._acting.simulated

    @property
    def worker_pids(self) -> dict[str, int]:
        """Process ids of the living workers, by role."""
        return self._crew.pids

    @property
    def stops(self) -> int:
        """Number of the newest emergency stop."""
        return self._crew.stops

    def go(self, *, until: int | None = None) -> None:
        """Run the loop, after whatever still goes on; pause by itself once `until` feedback is stored."""
        if self._crew.halted:  # the stop came while the verb that leads here was stored
            return
        self._evaluating = False
        self._until = until
        self._crew.forgive()
        self._follow(self._run)

    def evaluate(self, evaluation: Evaluation) -> None:
        """Roll out the deterministic policy in the background."""
        self._evaluating = True
        self._follow(lambda leave: self._evaluate(evaluation, leave))

    async def policy_version(self) -> int:
        """Gradient steps taken, once those that are owed are taken too; of the newest checkpoint if none learns now."""
        if self._crew.learner_ready:
            with contextlib.suppress(WorkerError):
                await self._crew.flush()
                return self._crew.policy_version
        newest = await self._store.latest_checkpoint(self.experiment.id)
        return newest.policy_version if newest is not None else 0

    def dismiss(self) -> None:
        """End the workers once nothing goes on: the experiment is over."""
        self._evaluating = False
        self._follow(lambda _: self._dismiss())

    def leave(self) -> None:
        """End the loop at its next step; a skill that moves ends first."""
        self._leave.set()
        self.desk.wake()

    def stop(self) -> None:
        """Emergency stop: the robot first, at once and latched; then the loop."""
        self._crew.stop()
        self.leave()
        self._seen = None
        if self.phase in (Phase.EXECUTING, Phase.EVALUATING):
            asyncio.get_running_loop().call_later(STOP_GRACE, self._insist, self._task)

    async def rearm(self, upto: int) -> None:
        """Lift the stops up to number `upto`; nothing moves by that."""
        with contextlib.suppress(WorkerDied):  # the next one starts re-armed
            await self._crew.rearm(upto)

    async def reset(self) -> None:
        """Begin a new episode: now if a proposal waits, else as soon as the skill has ended, or at resume."""
        self._reset_wanted = True
        await self.desk.withdraw()

    async def idle(self) -> None:
        """Wait until neither the loop nor an evaluation goes on."""
        while self._task is not None and not self._task.done():
            await asyncio.wait({self._task})
        await self._ledger.settled()

    async def close(self, *, grace: float) -> None:
        """End loop and workers; what still goes on after `grace` seconds is cut off, and found interrupted later."""
        self.leave()
        if self._task is not None and not self._task.done():
            if self.phase in (Phase.EXECUTING, Phase.EVALUATING):
                self._crew.stop()
            _, late = await asyncio.wait({self._task}, timeout=grace)
            for task in late:
                task.cancel()
                with contextlib.suppress(asyncio.CancelledError):
                    await task
        await self._ledger.settled()
        await self._crew.close()

    def changed(self, experiment: Experiment) -> None:
        """Take over what is stored, unless something newer is known; keep the live phase, and tell everyone."""
        if experiment.updated_at < self.experiment.updated_at:
            return
        self.experiment = experiment.model_copy(update={"phase": self.phase})
        self.desk.wake()
        self._publish(ExperimentChanged(experiment=self.experiment))

    # --- the loop -----------------------------------------------------------------------------------------------

    async def _train(self, leave: asyncio.Event) -> None:
        """Algorithm 1; in brackets the lines of the paper."""
        self.enter(Phase.STARTING)
        await self._crew.bring_up()  # [1] the replay is a view of the stored feedback
        while not leave.is_set() and not await self._enough():
            seen = await self._look()  # [2-4] a new episode where the last one has ended
            await self._propose(seen)  # [5, 6]
            judged = await self._query(seen, leave)  # [7, 8]
            if judged is not None and judged.verdict is Verdict.GOOD:
                await self._execute(judged, seen)  # [9-11]
            if self.experiment.lockstep and not leave.is_set():
                self.enter(Phase.LEARNING)
                await self._crew.flush()  # [12] otherwise the learner works while nobody asks it anything

    async def _look(self) -> Seen:
        """What the robot sees now: of a new episode, or of the one that goes on."""
        if self._reset_wanted:
            self._reset_wanted = False
            await self._end_episode("reset")
        if not self._episode_open:
            self.enter(Phase.OBSERVING)
            number = (await self._store.experiment(self.experiment.id)).counters.episodes + 1
            seed = episode_seed(self.experiment.seed, number)
            async with self.desk.turn:
                await self._store.begin_episode(self.experiment.id, seed)
            self._episode_open, self._executed = True, 0
            self._seen = await self._crew.reset(seed)
        elif self._seen is None:
            self.enter(Phase.OBSERVING)
            self._seen = await self._crew.observe()
        return self._seen

    async def _propose(self, seen: Seen) -> None:
        """Have a proposal open, unless an undo or a click has opened one, or one waits for the gate."""
        if self.desk.open is None and self.desk.judged is None:
            self.enter(Phase.PROPOSING)
            await self.desk.present(await self._acting.draw(seen))

    async def _query(self, seen: Seen, leave: asyncio.Event) -> Proposal | None:
        """The proposal that was judged, by a person or by the teacher; None where none was.

        Raises:
            WorkerDied: a worker went away while this waited.
        """
        if self.desk.open is not None:
            self.enter(Phase.AWAITING_FEEDBACK)
            self._ledger.write()
            asked = self.desk.open
            if self._judge is not None and not self._judge.has_judged(asked):
                await self._judge.judge(asked, self._acting.call_of(asked), leave)
            elif not self.experiment.lockstep:
                self.desk.draw_ahead(lambda: asyncio.create_task(self._draw_ahead(seen)))
        return await self.desk.verdict(leave)

    async def _draw_ahead(self, seen: Seen) -> NewProposal:
        """What would be proposed next if nothing moves: once the learner is done, its policy stands still."""
        await self._crew.flush()
        return await self._acting.draw(seen)

    async def _execute(self, judged: Proposal, seen: Seen) -> None:
        """Run the approved call if the gate opens, and end the episode if that solved or spoiled the task."""
        self.enter(Phase.DECIDING)
        async with self.desk.turn:
            if self.desk.judged is not judged:  # taken back in the meantime
                return
            self.desk.judged = None
            execution = await self._acting.decide(judged, seen)
        if execution is None:
            return
        self.enter(Phase.EXECUTING)
        done = await self._acting.move(judged, execution)
        self._seen = None
        self._executed += 1
        kinds = [kind for kind, _ in done.violations]
        response = respond(kinds, simulated=self.simulated, taught=self._judge is not None)
        if response in (Response.HALT, Response.PAUSE):
            await self._ask_operator(response, done)
        if response is not Response.NOTHING:
            await self._end_episode("violation")
        elif done.task_success:
            await self._end_episode("success")
        elif self._executed >= self._acting.task.horizon:
            await self._end_episode("horizon")

    # --- around the loop ----------------------------------------------------------------------------------------

    def _follow(self, work: Callable[[asyncio.Event], Coroutine[Any, Any, None]]) -> None:
        """Start `work` once what goes on has ended. Each has a leave event of its own."""
        previous, self._leave = self._task, asyncio.Event()
        leave = self._leave

        async def follow() -> None:
            if previous is not None:
                await asyncio.wait({previous})
            await self._guarded(work(leave))

        self._task = asyncio.create_task(follow(), name=f"experiment {self.experiment.id}")

    async def _run(self, leave: asyncio.Event) -> None:
        """The loop, mended after every death, until it is told to leave."""
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
            await self._fail(f"{error}. {error.remedy}")
        except Exception:
            log.exception("experiment %d failed", self.experiment.id)
            await self._fail("the service met an error of its own. See the server's log, then resume")
        finally:
            self.enter(Phase.IDLE)

    async def _mend(self, death: WorkerDied) -> None:
        """Clear up after a death; the next round of the loop starts a new worker."""
        await self._crew.bury(death)
        if death.worker == "robot":
            self._seen = None
            await self.desk.withdraw(CloseReason.INTERRUPTED)
            await self._end_episode("interrupted")

    async def _evaluate(self, evaluation: Evaluation, leave: asyncio.Event) -> None:
        self.enter(Phase.EVALUATING)
        await self._end_episode("reset")
        try:
            await roll_out(evaluation, self._acting, self._crew, self._store, leave=leave, publish=self._publish)
        except WorkerDied as death:
            await self._crew.bury(death)
        finally:
            if self.experiment.lifecycle is Lifecycle.FINISHED:
                await self._crew.close()

    async def _dismiss(self) -> None:
        await self._end_episode("reset")
        await self._crew.close()

    async def _fail(self, why: str) -> None:
        self._seen = None
        with contextlib.suppress(StoreError):  # a full disk can't even be told of; the log has it
            await self.desk.withdraw(CloseReason.INTERRUPTED)
            await self._end_episode("interrupted")
            if self._evaluating:
                await self._store.add_event(self.experiment.id, "evaluation_failed", {"detail": why})
            else:
                self.changed(await self._store.transition(self.experiment.id, "fail", failure=why))

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

    async def _ask_operator(self, response: Response, done: Done) -> None:
        """Go no further until a person has looked: after damage only once the stop is lifted."""
        if response is Response.HALT:
            self._crew.stop()  # `stop` would also kill a robot worker that moves; this one has ended its motion
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
            self._crew.kill_robot()

    def enter(self, phase: Phase) -> None:
        """Change the live phase and tell everyone."""
        if self.phase is not phase:
            self.experiment = self.experiment.model_copy(update={"phase": phase})
            self._publish(ExperimentChanged(experiment=self.experiment))

    def _publish(self, event: StreamEvent) -> None:
        self._publisher.publish(self.experiment.id, event)
