"""The registry of runners: everything that routes, the stream and the command line may ask of experiments."""

from __future__ import annotations

import asyncio
import logging
from collections import defaultdict
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any, Literal

from robot_adapters import registry
from server import auto_approval, catalogue, tending
from server.desk import Desk
from server.guiding import guide, under_way
from server.lifecycle import MOVING
from server.looks import Looks
from server.messages import EvaluationChanged, ExecutionEnded, ExperimentChanged, Snapshot
from server.presence import Presence
from server.principal import Principal, acting
from server.publisher import Publisher
from server.runner import Runner
from server.schemas import (
    Evaluation,
    EvaluationCreate,
    Experiment,
    ExperimentPage,
    ExperimentUpdate,
    Feedback,
    FeedbackCreate,
    Lifecycle,
    Mode,
    Proposal,
)
from server.schemas_labels import RelabelCreate
from server.schemas_listing import Listing
from server.seats import Seats
from server.settings import Settings
from server.store import Conflict, NotFound, Receipt, Store, StoreError

log = logging.getLogger(__name__)

Act = Literal["start", "pause", "resume", "finish", "reset", "halt", "rearm", "archive"]

CLOSE_GRACE = 1.0
"""Seconds that a runner has for its last step when the service ends."""


class Hub:
    """Runs experiments. One for a store; used from one event loop."""

    def __init__(self, store: Store, settings: Settings, publisher: Publisher) -> None:
        self.store = store
        self.presence = Presence()
        self._settings = settings
        self._publisher = publisher
        self._runners: dict[int, Runner] = {}
        self.seats = Seats(store, publisher)
        self._looks = Looks(store)
        # verbs of one experiment come one after another; a halt waits for none of them
        self._verbs: defaultdict[int, asyncio.Lock] = defaultdict(asyncio.Lock)

    async def start(self) -> None:
        """Clear up what an earlier process left half-done. Nothing moves until someone resumes."""
        await self.store.recover()

    def brake(self) -> None:
        """Have every real robot stand still, because the service ends: at once, before anything is waited for."""
        for runner in self._runners.values():
            runner.brake()

    async def close(self) -> None:
        """Pause what runs and end all workers, within about two seconds."""
        self.brake()
        closing = (self._close(experiment_id, runner) for experiment_id, runner in self._runners.items())
        outcomes = await asyncio.gather(*closing, return_exceptions=True)
        self._runners.clear()
        for outcome in outcomes:
            if outcome is not None:
                raise outcome

    # --- looking ------------------------------------------------------------------------------------------------

    async def view(self, experiment_id: int) -> Experiment:
        """The experiment with its live phase."""
        return self._live(await self.store.experiment(experiment_id))

    async def views(self, cursor: str | None = None, limit: int = 50, listing: Listing | None = None) -> ExperimentPage:
        """Experiments, newest first unless the listing says otherwise, with their live phases."""
        page = await self.store.experiments(cursor=cursor, limit=limit, listing=listing)
        return page.model_copy(update={"items": [self._live(item) for item in page.items]})

    async def snapshot(self, experiment_id: int, boot_id: str, trainer: str | None = None) -> Snapshot:
        """Everything a page needs to draw itself. trainer: whose it is; None: nobody's in particular."""
        seen = await self._looks.at(experiment_id, trainer)
        seating = self.seats.of(experiment_id)
        finishing = None if trainer is None else seating.finishing(trainer)
        runner = self._runners.get(experiment_id)
        return Snapshot(
            experiment=self._live(seen.experiment),
            proposal=seen.proposals[0] if seen.proposals else None,
            proposals=seen.proposals,
            finishing=finishing,
            execution=seen.executions[0] if seen.executions else None,
            executions=seen.executions,
            undoable=seen.undoable,
            judges=seating.judges,
            robots=[] if runner is None else runner.crew.told,
            operator=self._attending(experiment_id),
            server_time=datetime.now(UTC),
            boot_id=boot_id,
        )

    async def idle(self, experiment_id: int) -> None:
        """Wait until neither the experiment's loop nor an evaluation of it goes on."""
        if runner := self._runners.get(experiment_id):
            await runner.idle()

    def at_work(self, experiment_id: int) -> Runner | None:
        """The runner of an experiment, if it has one; ask its workers nothing that changes them."""
        return self._runners.get(experiment_id)

    def worker_pids(self, experiment_id: int) -> dict[str, int]:
        """Process ids of the experiment's living workers, by role."""
        runner = self._runners.get(experiment_id)
        return {} if runner is None else runner.crew.pids

    async def troubles(self) -> dict[int, str]:
        """What keeps running experiments from going on, and what could not be stored, by experiment."""
        found = {}
        for experiment_id, runner in self._runners.items():
            if runner.standing.owed:
                found[experiment_id] = "what has happened could not be stored yet; free space where the database lies"
        for experiment_id in await self.store.running():
            runner_of = self._runners.get(experiment_id)
            alive = runner_of is not None and runner_of.busy
            # a verb that is just being carried out starts or ends the loop
            if not alive and not self._verbs[experiment_id].locked():
                found.setdefault(experiment_id, "it should run and doesn't; pause and resume it")
        return found

    # --- verbs --------------------------------------------------------------------------------------------------

    async def act(
        self, experiment_id: int, verb: Act, *, until: int | None = None, robot: int | None = None
    ) -> Experiment:
        """Do what a person asks of an experiment.

        until: pause by itself once so much feedback is stored. robot: reset this one only.

        Raises:
            NotFound: no such experiment, or robot of it. Conflict: the verb is illegal now; nothing has changed.
        """
        if verb == "halt":
            return await self._halt(experiment_id)
        async with self._verbs[experiment_id]:
            runner = await self._runner(experiment_id)
            if verb in MOVING or verb == "rearm":
                tending.must_not_move_another_s(runner, acting.get())
            if runner.evaluating and verb != "rearm":
                raise Conflict(
                    f"can't {verb} an experiment while it is evaluated", remedy="wait for its end, or halt it"
                )
            if robot is not None and robot >= len(runner.stations):
                raise NotFound(
                    "robot", robot, remedy=f"the robots of this experiment are 0 to {len(runner.stations) - 1}"
                )
            # what has happened already is stored first
            await runner.standing.owed.settle()
            if verb in MOVING:
                runner.check(verb)
            stops = runner.crew.stops
            async with runner.turn():
                experiment = await self._store_verb(runner, experiment_id, verb, robot)
                if verb in ("pause", "finish", "archive"):
                    runner.leave()
            await self._follow(runner, verb, until, stops, robot)
            runner.changed(experiment)
            return runner.experiment

    async def evaluate(self, experiment_id: int, body: EvaluationCreate, receipt: Receipt | None = None) -> Evaluation:
        """Start rollouts of the deterministic policy; they go on in the background.

        Raises:
            NotFound: no such experiment. Conflict: it runs, is halted, is being evaluated, or moves a real robot.
        """
        async with self._verbs[experiment_id]:
            runner = await self._runner(experiment_id)
            if runner.evaluating:
                raise Conflict("an evaluation of this experiment goes on", remedy="wait for its end, or halt it")
            if not runner.simulated:
                raise Conflict("evaluations move simulated robots only", remedy="judge its proposals yourself")
            await runner.standing.owed.settle()
            runner.check("evaluate")
            await self._store_verb(runner, experiment_id, "evaluate")
            evaluation = await self.store.create_evaluation(
                experiment_id,
                rollouts=body.rollouts,
                seed=body.seed,
                policy_version=await runner.crew.newest_policy_version(),
                receipt=receipt,
            )
            self._publisher.publish(experiment_id, EvaluationChanged(evaluation=evaluation, done=0))
            runner.evaluate(evaluation)
            return evaluation

    async def attend(self, experiment_id: int, who: Principal, seconds: float) -> None:
        """Somebody stands at the real robot of this experiment; see `server.tending`."""
        await tending.attend(await self._runner(experiment_id), self.store, who, seconds)

    async def leave(self, experiment_id: int, operator: str) -> None:
        """They have left."""
        await tending.leave(await self._runner(experiment_id), self.store, operator)

    @property
    def attending(self) -> list[Principal]:
        """Everybody who stands at a real robot."""
        return tending.attending(self._runners.values())

    async def let_out(self, ended: Callable[[Principal], bool]) -> None:
        """Close what these have open, and count on none of them at a robot."""
        self.presence.cut_off(ended)
        await tending.let_out(self._runners.values(), self.store, ended)

    async def tend(self, experiment_id: int, what: tending.Order, who: Principal) -> Experiment:
        """Do what an operator asks of the arm itself."""
        async with self._verbs[experiment_id]:
            runner = await self._runner(experiment_id)
            await tending.tend(runner, self.store, what, who)
            return runner.experiment

    async def guide(self, experiment_id: int, step: str, **arguments: Any) -> dict[str, Any]:
        """One step of a calibration of the cameras; see `server.guiding`."""
        async with self._verbs[experiment_id]:
            return await guide(await self._runner(experiment_id), self.store, step, **arguments)

    async def guide_state(self, experiment_id: int) -> dict[str, Any]:
        """The calibration of the cameras that goes on, if one does."""
        async with self._verbs[experiment_id]:
            return await under_way(await self._runner(experiment_id))

    async def update(self, experiment_id: int, body: ExperimentUpdate) -> Experiment:
        """Change what may change live.

        Raises:
            NotFound: no such experiment. ServiceError: the critic may not approve by itself in this one.
        """
        changed = await self.store.experiment(experiment_id)
        if body.together is not None:
            catalogue.check_together(body.together, teacher=changed.teacher, lockstep=changed.lockstep)
        if body.auto_approval is not None:
            simulated = registry.adapter(changed.adapter).simulated
            auto_approval.check(
                body.auto_approval, adapter=changed.adapter, simulated=simulated, settings=changed.settings
            )
        if runner := self._runners.get(experiment_id):
            if body.mode is Mode.EXECUTE_APPROVED:
                tending.must_not_move_another_s(runner, acting.get())
            async with runner.turn():
                experiment, concluded = await self.store.update_and_conclude(experiment_id, body)
                runner.conclude(concluded)
                if "practice_required" in body.model_fields_set:
                    await self.seats.recount(experiment_id)
            runner.changed(experiment)
        else:
            experiment = await self.store.update_experiment(experiment_id, body)
            await self.seats.recount(experiment_id)
            self._publisher.publish(experiment_id, ExperimentChanged(experiment=experiment))
        return self._live(experiment)

    # --- clicks -------------------------------------------------------------------------------------------------

    async def feedback(
        self, proposal_id: int, body: FeedbackCreate, experiment_id: int | None = None
    ) -> tuple[Feedback, bool]:
        """Store a click; it is committed when this returns. The second value: the same click was stored before.

        Raises:
            NotFound: no such proposal, or not one of `experiment_id`. Conflict: the click id was used for another
                click, or the proposal isn't for people to judge.
        """
        desks = (station.desk for runner in self._runners.values() for station in runner.stations)
        proposal = next((found for desk in desks if (found := desk.find(proposal_id))), None)
        if proposal is None:
            proposal = await self.store.proposal(proposal_id)
        if experiment_id is not None and proposal.experiment_id != experiment_id:
            raise NotFound("proposal of this experiment", proposal_id)
        desk = await self._desk_of(proposal)
        # a click that has come is carried through, even if its sender leaves meanwhile
        submission = await asyncio.shield(asyncio.create_task(desk.feedback(proposal_id, body, "person")))
        return submission.feedback, submission.duplicate

    async def undo(self, feedback_id: int, *, by: str | None = None) -> Feedback:
        """Take a trainer's newest click back, while nothing has moved since. by: who asks, where that is known.

        Raises:
            NotFound: no such feedback. Conflict: it is too late.
        """
        feedback = await self.store.feedback(feedback_id)
        desk = await self._desk_of(await self.store.proposal(feedback.proposal_id))
        return await asyncio.shield(asyncio.create_task(desk.undo(feedback, by=by)))

    async def relabel(
        self, feedback_id: int, body: RelabelCreate, experiment_id: int | None = None, *, anybodys: bool = False
    ) -> tuple[Feedback, bool]:
        """Correct a click on a closed proposal; the learner follows, the verdict and what moved by it stay.

        anybodys: also one that somebody else gave. The second value: the same correction was stored before.

        Raises:
            NotFound: no such feedback, or not one of `experiment_id`. Conflict: it can't be corrected, and why.
        """
        feedback = await self.store.feedback(feedback_id)
        if experiment_id is not None and feedback.experiment_id != experiment_id:
            raise NotFound("feedback of this experiment", feedback_id)
        desk = await self._desk_of(await self.store.proposal(feedback.proposal_id))
        correcting = desk.relabel(feedback_id, body, anybodys=anybodys)
        relabelled = await asyncio.shield(asyncio.create_task(correcting))
        return relabelled.feedback, relabelled.duplicate

    # --- inside -------------------------------------------------------------------------------------------------

    async def _halt(self, experiment_id: int) -> Experiment:
        """Emergency stop: the robot first, then the database, then everyone is told."""
        runner = self._runners.get(experiment_id) or await self._runner(experiment_id)
        halted = runner.experiment.halted
        runner.stop()
        if not halted:  # a stop comes by every way there is
            runner.witness.tell("halt", "emergency stop")
        try:
            experiment = await self.store.halt(experiment_id)
        except StoreError as error:
            # it is stopped all the same, and everyone is told so
            log.error("experiment %d: the emergency stop can't be stored for now: %s", experiment_id, error)  # noqa: TRY400
            runner.standing.owe_halt()
            runner.drop()
        else:
            runner.changed(experiment)
            await runner.withdraw()
        return runner.experiment

    async def _store_verb(
        self, runner: Runner, experiment_id: int, verb: Act | Literal["evaluate"], robot: int | None = None
    ) -> Experiment:
        if verb == "rearm":
            # a stop may be latched here that has not reached the database
            return await self.store.rearm(experiment_id, latched=runner.crew.halted)
        if verb not in MOVING or verb == "reset" or runner.busy:
            return await self.store.transition(experiment_id, verb, robot=robot)
        # nothing of it goes on: what has no end in the database never got it written
        unfinished = await self.store.running_executions(experiment_id)
        experiment = await self.store.transition(experiment_id, verb, settle=True)
        for left in unfinished:
            self._publisher.publish(experiment_id, ExecutionEnded(execution=await self.store.execution(left.id)))
        return experiment

    async def _follow(self, runner: Runner, verb: Act, until: int | None, stops: int, robot: int | None) -> None:
        """What a stored verb means for the runner. A re-arm lifts the stops that were there when it was asked for."""
        if verb in ("start", "resume"):
            runner.go(until=until)
        elif verb == "rearm":
            await runner.rearm(stops)
            if runner.crew.halted:  # by a stop since then, which may have been stored before this verb lifted it
                runner.standing.owe_halt()
        elif verb == "reset":
            await runner.reset(robot)
        elif verb in ("pause", "finish"):
            await runner.withdraw()
        if verb in ("finish", "archive"):
            runner.dismiss()

    async def _close(self, experiment_id: int, runner: Runner) -> None:
        async with self._verbs[experiment_id]:
            runner.leave()
            try:
                if (await self.store.experiment(experiment_id)).lifecycle is Lifecycle.RUNNING:
                    runner.changed(await self.store.transition(experiment_id, "pause"))
            finally:
                await runner.close(grace=CLOSE_GRACE)

    async def _desk_of(self, proposal: Proposal) -> Desk:
        return (await self._runner(proposal.experiment_id)).stations[proposal.robot].desk

    async def _runner(self, experiment_id: int) -> Runner:
        if experiment_id not in self._runners:
            experiment = await self.store.experiment(experiment_id)
            if experiment_id not in self._runners:  # else another caller was quicker
                seating = self.seats.of(experiment_id)
                self._runners[experiment_id] = Runner(experiment, self.store, self._settings, self._publisher, seating)
        return self._runners[experiment_id]

    def _attending(self, experiment_id: int) -> str | None:
        runner = self._runners.get(experiment_id)
        return None if runner is None or runner.attendance is None else runner.attendance.operator

    def _live(self, experiment: Experiment) -> Experiment:
        runner = self._runners.get(experiment.id)
        return experiment if runner is None else runner.standing.live(experiment)
