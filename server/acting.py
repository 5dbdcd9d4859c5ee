"""One proposal's two ends: drawn from an observation, and, once approved, run through the gate.

Training and evaluation use the same two functions, so that there is one way to the robot.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from robot_adapters import registry
from robot_adapters.base import InvalidCall, SafetyViolation, SkillCall, check_call
from robot_adapters.tasks.base import Task
from server.crew import Crew
from server.crew_values import Done, Idea, Seen
from server.messages import ExecutionEnded, ExecutionStarted, ProposalClosed, StreamEvent
from server.owed import Owed
from server.robots import Robot
from server.schemas import Execution, ExecutionOutcome, Experiment, Proposal
from server.store import Conflict, Store, StoreError
from server.store_values import NewProposal, NewView, Purpose
from server.worker import CommandFailed, WorkerDied

log = logging.getLogger(__name__)

Publish = Callable[[StreamEvent], None]

CLEAR = 0.005
"""m from the border of what is good: nearer, nobody is measured by an answer. As the teacher `skipping` sees it."""


class Acting:
    """Draws proposals for one robot of an experiment, and moves it by approved ones."""

    def __init__(
        self,
        experiment: Experiment,
        store: Store,
        crew: Crew,
        robot: Robot,
        *,
        publish: Publish,
        owed: Owed,
        gold_rate: Callable[[], float],
    ) -> None:
        self._experiment = experiment
        self._experiment_id = experiment.id
        self._store = store
        self._crew = crew
        self._robot = robot
        self._publish = publish
        self._owed = owed
        self._gold_rate = gold_rate

    # looked up when they are needed: an experiment whose plug-in is gone can still be halted and archived

    @cached_property
    def task(self) -> Task:
        """The experiment's task."""
        return registry.task(self._experiment.task)

    @cached_property
    def simulated(self) -> bool:
        """Whether the robot is a simulated one."""
        return registry.adapter(self._experiment.adapter).simulated

    async def draw(self, seen: Seen, *, purpose: Purpose = "training", deterministic: bool = False) -> NewProposal:
        """Sample a ~ pi_phi(.|s), x ~ pi_psi(.|s, a), and draw the call on the images of the observation."""
        idea = await self._crew.propose(seen.state, deterministic=deterministic)
        return await self._drawn(idea, seen, purpose)

    async def draw_batch(self, seen: Seen, count: int, pending: Sequence[SkillCall]) -> list[NewProposal]:
        """At most so many that differ from each other and from the pending calls, for trainers who judge in parallel.

        One beside nothing is drawn as ever, so that a run with one trainer can be repeated.
        """
        if count == 1 and not pending:
            return [await self.draw(seen)]
        ideas = await self._crew.propose_batch(seen.state, count, pending)
        return [await self._drawn(idea, seen, "training") for idea in ideas]

    async def _drawn(self, idea: Idea, seen: Seen, purpose: Purpose) -> NewProposal:
        overlays = await self._robot.overlay(idea.call)
        spec = check_call(idea.call, self.task.skills)
        return NewProposal(
            experiment_id=self._experiment_id,
            observation_id=seen.id,
            state=seen.state,
            taken_at=seen.taken_at,
            call=idea.call,
            parameter_names=tuple(p.name for p in spec.parameters),
            predicted_feedback=idea.predicted_feedback,
            uncertainty=idea.uncertainty,
            skill_probabilities=idea.skill_probabilities,
            policy_version=idea.policy_version,
            subgoal=self._subgoal(seen),
            views=[NewView(p.camera, p.width, p.height, p.image, overlays[p.camera]) for p in seen.pictures],
            purpose=purpose,
            robot=self._robot.index,
            rule_answer=self._rule_answer(seen, idea.call) if self._gold_rate() else None,
        )

    async def decide(self, proposal: Proposal, seen: Seen) -> Execution | None:
        """Ask the gate whether the judged proposal may run now; if so, it is stored as started when this returns."""
        decision, execution = await self._store.begin_execution(
            proposal.id,
            current_observation_id=seen.id,
            operator_present=self._crew.operator_present,
            simulated=self.simulated,
            workspace_ok=self._inside(self.call_of(proposal)),
            unclear=self._robot.unclear,
        )
        self._publish(ProposalClosed(proposal=proposal.model_copy(update={"gate": decision})))
        return execution

    async def move(
        self,
        proposal: Proposal,
        execution: Execution,
        *,
        heed: Callable[[Done], None] = lambda _: None,
        before: asyncio.Task[None] | None = None,
    ) -> Done:
        """Run exactly the approved call, have `heed` told of it, and store what came of it once `before` has ended.

        Raises:
            WorkerDied: the robot worker went away in the middle; the execution is stored as interrupted.
            StoreError: what came of it can't be stored now; it will be as soon as it can.
        """
        self._publish(ExecutionStarted(execution=execution))
        try:
            done = await self._robot.execute(proposal, execution.id, self.call_of(proposal))
        except CommandFailed as refusal:
            log.warning("execution %d was refused by the robot worker: %s", execution.id, refusal)
            done = Done.nothing(str(refusal), stopped=refusal.kind == "Latched")
        except WorkerDied:
            await _ended(before)
            await self._end(execution.id, ExecutionOutcome.INTERRUPTED, None)
            raise
        heed(done)
        await _ended(before)
        outcome = ExecutionOutcome.SUCCEEDED if done.arrived else ExecutionOutcome.FAILED
        await self._end(execution.id, ExecutionOutcome.STOPPED if done.stopped else outcome, done)
        return done

    def call_of(self, proposal: Proposal) -> SkillCall:
        """The proposed call; its digest is the proposal's, or the robot worker refuses it."""
        return SkillCall(proposal.skill, tuple(proposal.parameters.values()))

    async def _end(self, execution_id: int, outcome: ExecutionOutcome, done: Done | None) -> None:
        violations = [] if done is None else [SafetyViolation(kind, detail) for kind, detail in done.violations]

        async def store() -> None:
            execution = await self._store.end_execution(
                execution_id,
                outcome,
                end_reason="worker_died" if done is None else done.end,
                low_level_steps=0 if done is None else done.low_level_steps,
                task_success=done is not None and done.task_success,
                violations=violations,
            )
            self._publish(ExecutionEnded(execution=execution, violations=[f"{v.kind}: {v.detail}" for v in violations]))

        try:
            await store()
        except Conflict:  # it has an outcome
            raise
        except StoreError:
            self._owed.add(f"what came of execution {execution_id}: {outcome}", store)
            raise

    def _inside(self, call: SkillCall) -> bool:
        try:
            check_call(call, self.task.skills)
        except InvalidCall:
            return False
        return True

    def _rule_answer(self, seen: Seen, call: SkillCall) -> int | None:
        """What the task's rule says of the call; None so near the border that a trainer may well see it otherwise."""
        state = np.array(seen.state)
        return self.task.judge(state, call) if abs(self.task.margin(state, call)) >= CLEAR else None

    def _subgoal(self, seen: Seen) -> str:
        return self.task.subgoals[self.task.subgoal(np.array(seen.state))].description


async def _ended(task: asyncio.Task[None] | None) -> None:
    """Wait for its end, whatever that is."""
    if task is not None:
        await asyncio.wait({task})
