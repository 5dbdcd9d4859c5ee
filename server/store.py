"""The one door to the database: every read and write of the service, as wire models.

A write returns only after its commit. Reads see what is committed. Errors are those of `server.store_errors`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from sqlalchemy.orm import Session

from robot_adapters.base import SafetyViolation
from server import (
    schemas,
    schemas_incidents,
    schemas_labels,
    schemas_records,
    store_executions,
    store_experiments,
    store_incidents,
    store_labels,
    store_proposals,
    store_records,
    store_trust,
    store_undo,
    store_votes,
)
from server import store_wire as wire
from server.database import Database, resolve
from server.lifecycle import Verb
from server.store_errors import BadCursor, Conflict, Full, NewerDatabase, NotFound, ReadOnly, StoreError
from server.store_reads import Reads
from server.store_upgrade import prepare
from server.store_values import (
    Concluded,
    EpisodeOutcome,
    NewProposal,
    NewView,
    Purpose,
    Receipt,
    Relabelled,
    StoredLabel,
    StoredResponse,
    Submission,
    Undone,
)

__all__ = [
    "BadCursor",
    "Conflict",
    "Full",
    "NewProposal",
    "NewView",
    "NewerDatabase",
    "NotFound",
    "ReadOnly",
    "Receipt",
    "Store",
    "StoreError",
    "StoredLabel",
    "StoredResponse",
    "Submission",
    "Undone",
]

T = TypeVar("T")
M = TypeVar("M", schemas.Experiment, schemas.Evaluation)


class Store(Reads):
    """Every query of the service. Open it with `Store.open`."""

    @classmethod
    async def open(cls, url: str | None, data_dir: Path, *, backup: bool = True) -> Store:
        """Create or migrate the database (a SQLite one is backed up before) and open it.

        url: of SQLAlchemy; None is SQLite in `data_dir`.

        Raises:
            NewerDatabase: a newer version wrote it. ReadOnly, Full: a migration is due and can't be written.
        """
        target = resolve(url, data_dir)
        await asyncio.to_thread(_make_directory, data_dir)
        await asyncio.to_thread(prepare, target, data_dir, backup=backup)
        return cls(Database(target))

    async def close(self) -> None:
        """Commit what waits and let go of the database."""
        await self.quality.settle()
        await self._database.close()

    # --- experiments ------------------------------------------------------------------------------------------------

    async def create_experiment(
        self, body: schemas.ExperimentCreate, *, lockstep: bool, receipt: Receipt | None = None
    ) -> schemas.Experiment:
        """Store a checked experiment, and with it the answer that a retry gets."""

        def create(session: Session) -> schemas.Experiment:
            made = wire.experiment(store_experiments.create(session, body, lockstep=lockstep))
            return _receipted(session, made, receipt)

        return await self._write(create)

    async def update_experiment(self, experiment_id: int, change: schemas.ExperimentUpdate) -> schemas.Experiment:
        """Change what may change live; a field left out stays."""
        return (await self.update_and_conclude(experiment_id, change))[0]

    async def update_and_conclude(
        self, experiment_id: int, change: schemas.ExperimentUpdate
    ) -> tuple[schemas.Experiment, list[Concluded]]:
        """The same, and the open proposals that a new rule has closed by the votes they had."""

        def update(session: Session) -> tuple[schemas.Experiment, list[Concluded]]:
            row, concluded = store_votes.update(session, experiment_id, change)
            return wire.experiment(row), concluded

        return await self._write(update)

    async def transition(
        self,
        experiment_id: int,
        verb: Verb,
        failure: str | None = None,
        *,
        settle: bool = False,
        robot: int | None = None,
    ) -> schemas.Experiment:
        """Apply a verb of `server.lifecycle`. Leaving `running` closes the open proposals in the same transaction.

        settle: end in it, as interrupted, what never got its end written; only where nothing of it goes on.
        robot: a reset is of this one only.
        """

        def apply(session: Session) -> schemas.Experiment:
            row = store_experiments.transition(session, experiment_id, verb, failure, unfinished=settle, robot=robot)
            return wire.experiment(row)

        return await self._write(apply)

    async def halt(self, experiment_id: int) -> schemas.Experiment:
        """Latch the emergency stop. Never refused; again, it changes nothing."""
        return await self.transition(experiment_id, "halt")

    async def rearm(self, experiment_id: int, *, latched: bool = False) -> schemas.Experiment:
        """Unlatch the emergency stop. `latched`: there is one, even if it could not be stored."""
        return await self._write(lambda s: wire.experiment(store_experiments.rearm(s, experiment_id, latched=latched)))

    async def recover(self) -> list[int]:
        """Settle what an ended process left behind; the ids of the experiments that it concerned."""
        return await self._write(store_experiments.recover)

    async def begin_episode(
        self, experiment_id: int, seed: int, purpose: Purpose = "training", *, robot: int = 0
    ) -> int:
        """Begin a robot's episode and return its number; one that goes on ends by reset."""
        return await self._write(
            lambda s: store_experiments.begin_episode(s, experiment_id, seed, purpose, robot).number
        )

    async def end_episode(self, experiment_id: int, outcome: EpisodeOutcome, *, robot: int = 0) -> None:
        """End the episode that goes on with a robot, if any."""
        await self._write(lambda s: store_experiments.end_episode(s, experiment_id, outcome, robot))

    # --- proposals and feedback -------------------------------------------------------------------------------------

    async def open_proposal(self, new: NewProposal, *, after: int | None = None) -> schemas.Proposal:
        """Store a proposal with its observation and pictures. Conflict where it must not be open now.

        after: only if this proposal was judged, and nothing will move by that.
        """

        def opened(session: Session) -> schemas.Proposal:
            if after is not None:
                store_proposals.must_have_led_to_nothing(session, after)
            return wire.proposal(store_proposals.open_proposal(session, new))

        return await self._write(opened)

    async def close_proposal(self, proposal_id: int, reason: schemas.CloseReason) -> schemas.Proposal:
        """Close without a verdict; a closed one stays as it is."""
        return await self._write(lambda s: wire.proposal(store_proposals.close_proposal(s, proposal_id, reason)))

    async def submit_feedback(
        self,
        proposal_id: int,
        click: schemas.FeedbackCreate,
        *,
        kind: str = "person",
        refused: str | None = None,
        had: bool = False,
    ) -> Submission:
        """Store a click: counted, late, or known already. See `store_votes.submit`."""
        return await self._write(lambda s: store_votes.submit(s, proposal_id, click, kind, refused, had=had))

    async def leave_electorates(self, experiment_id: int, names: Collection[str]) -> list[Concluded]:
        """Wait for these trainers no longer, on any open proposal. See `store_votes.leave`."""
        return await self._write(lambda s: store_votes.leave(s, experiment_id, names))

    async def enter_electorates(self, experiment_id: int, names: Sequence[str]) -> list[Concluded]:
        """Ask these trainers for the open proposals that nobody is left to judge."""
        return await self._write(lambda s: store_votes.enter(s, experiment_id, names))

    async def relabel(self, feedback_id: int, body: schemas_labels.RelabelCreate, *, anybodys: bool) -> Relabelled:
        """Correct a click on a closed proposal. See `store_labels.relabel`."""
        return await self._write(lambda s: store_labels.relabel(s, feedback_id, body, anybodys=anybodys))

    async def undo_feedback(self, feedback_id: int, *, keep: Collection[int] = (), by: str | None = None) -> Undone:
        """Take a trainer's newest click back while nothing has moved. See `store_undo.undo`."""
        return await self._write(lambda s: store_undo.undo(s, feedback_id, keep=keep, by=by))

    async def consider(self, proposal_id: int, *, simulated: bool) -> store_trust.Considered:
        """Whether the critic approves the open proposal by itself; stored, if it does. See `store_trust.consider`."""
        return await self._write(lambda s: store_trust.consider(s, proposal_id, simulated=simulated))

    # --- gate and executions ----------------------------------------------------------------------------------------

    async def record_evaluation_approval(self, proposal_id: int) -> schemas.Proposal:
        """The verdict +1 of an evaluation for its own proposal."""
        return await self._write(lambda s: wire.proposal(store_votes.approve_evaluation(s, proposal_id)))

    async def begin_execution(
        self,
        proposal_id: int,
        *,
        current_observation_id: str,
        operator_present: bool,
        simulated: bool,
        workspace_ok: bool,
        unclear: str = "",
    ) -> tuple[schemas.GateDecision, schemas.Execution | None]:
        """The gate's decision, stored, and the execution that is `started` by it; nothing may move before this."""

        def begin(session: Session) -> tuple[schemas.GateDecision, schemas.Execution | None]:
            decision, row = store_executions.begin(
                session,
                proposal_id,
                current_observation_id=current_observation_id,
                operator_present=operator_present,
                simulated=simulated,
                workspace_ok=workspace_ok,
                unclear=unclear,
            )
            return decision, wire.execution(row) if row is not None else None

        return await self._write(begin)

    async def report_execution(
        self, execution_id: int, body: schemas_incidents.ReportCreate
    ) -> tuple[schemas.Execution, bool]:
        """Keep what somebody saw an execution do; the second value: this very report was stored before."""

        def report(session: Session) -> tuple[schemas.Execution, bool]:
            row, duplicate = store_incidents.report(session, execution_id, body)
            return wire.execution(row), duplicate

        return await self._write(report)

    async def add_incident(
        self,
        experiment_id: int,
        *,
        execution_id: int | None,
        kind: str,
        detail: str,
        frames: Sequence[dict[str, Any]],
    ) -> schemas_incidents.Incident:
        """Keep an incident with the pictures of the seconds before."""
        return await self._write(
            lambda s: wire.incident(
                store_incidents.add_incident(
                    s, experiment_id, execution_id=execution_id, kind=kind, detail=detail, frames=frames
                )
            )
        )

    async def end_execution(
        self,
        execution_id: int,
        outcome: schemas.ExecutionOutcome,
        *,
        end_reason: str | None,
        low_level_steps: int,
        task_success: bool,
        violations: Sequence[SafetyViolation] = (),
    ) -> schemas.Execution:
        """Write the outcome, once."""
        return await self._write(
            lambda s: wire.execution(
                store_executions.end(
                    s,
                    execution_id,
                    outcome=outcome,
                    end_reason=end_reason,
                    low_level_steps=low_level_steps,
                    task_success=task_success,
                    violations=violations,
                )
            )
        )

    # --- metrics, evaluations, checkpoints, journal -----------------------------------------------------------------

    async def add_metrics(self, experiment_id: int, feedback: int, values: Mapping[str, float]) -> schemas.MetricPoint:
        """A point of the charts at an amount of feedback."""
        return await self._write(lambda s: store_records.add_metrics(s, experiment_id, feedback, values))

    async def create_evaluation(
        self,
        experiment_id: int,
        *,
        rollouts: int,
        seed: int,
        policy_version: int = 0,
        receipt: Receipt | None = None,
    ) -> schemas.Evaluation:
        """An evaluation that has begun, and the answer that a retry gets. Its proposals bring the policy version."""

        def create(session: Session) -> schemas.Evaluation:
            row = store_records.create_evaluation(session, experiment_id, rollouts, seed, policy_version)
            return _receipted(session, wire.evaluation(row), receipt)

        return await self._write(create)

    async def update_evaluation(
        self, evaluation_id: int, *, done: int, successes: int, low_level_steps: int, ended: bool = False
    ) -> schemas.Evaluation:
        """Running totals over the `done` rollouts; `ended` writes the end."""
        return await self._write(
            lambda s: wire.evaluation(
                store_records.update_evaluation(
                    s, evaluation_id, done=done, successes=successes, low_level_steps=low_level_steps, ended=ended
                )
            )
        )

    async def add_checkpoint(
        self, experiment_id: int, *, policy_version: int, last_feedback_id: int, sha256: str
    ) -> schemas_records.Checkpoint:
        """A learner that has been saved."""
        return await self._write(
            lambda s: wire.checkpoint(
                store_records.add_checkpoint(s, experiment_id, policy_version, last_feedback_id, sha256)
            )
        )

    async def add_event(self, experiment_id: int, kind: str, payload: Mapping[str, Any]) -> schemas_records.StoredEvent:
        """A line of the journal that no other write causes, e.g. a worker's death."""

        def add(session: Session) -> schemas_records.StoredEvent:
            store_experiments.load(session, experiment_id)
            row = store_experiments.journal(session, experiment_id, kind, **dict(payload))
            session.flush()
            return wire.event(row)

        return await self._write(add)

    # --- retries ----------------------------------------------------------------------------------------------------

    async def remember(self, key: str, route: str, body_digest: str, status: int, body: Any) -> None:
        """Keep an answer (JSON) for a day."""
        await self._write(lambda s: store_records.remember(s, key, route, body_digest, status=status, body=body))

    # ----------------------------------------------------------------------------------------------------------------

    async def _write(self, run: Callable[[Session], T]) -> T:
        return await self._database.write(run)


def _receipted(session: Session, made: M, receipt: Receipt | None) -> M:
    if receipt is not None:
        body = made.model_dump(mode="json")
        store_records.remember(
            session, receipt.key, receipt.route, receipt.body_digest, status=receipt.status, body=body
        )
    return made


def _make_directory(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ReadOnly(str(error)) from error
