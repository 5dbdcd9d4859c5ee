"""The one door to the database: every read and write of the service, as wire models.

A write returns only after its commit. Reads see what is committed. Errors are those of `server.store_errors`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any, TypeVar

from sqlalchemy.orm import Session

from robot_adapters.base import SafetyViolation
from server import (
    schemas,
    schemas_incidents,
    schemas_labels,
    store_electorates,
    store_executions,
    store_experiments,
    store_incidents,
    store_labels,
    store_proposals,
    store_trust,
    store_undo,
    store_votes,
)
from server import store_wire as wire
from server.database import Database, Elsewhere, resolve, writes
from server.lifecycle import Verb
from server.store_errors import BadCursor, Conflict, Full, NewerDatabase, NotFound, ReadOnly, StoreError
from server.store_recording import Recording, receipted
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


class Store(Recording):
    """Every query of the service. Open it with `Store.open`."""

    @classmethod
    async def open(
        cls,
        url: str | None,
        data_dir: Path,
        *,
        backup: bool = True,
        elsewhere: Elsewhere | None = None,
        alone: bool = False,
    ) -> Store:
        """Create or migrate the database (a SQLite one is backed up before) and open it.

        url: of SQLAlchemy; None is SQLite in `data_dir`.
        elsewhere: a process that does the writes. alone: this is that process.

        Raises:
            NewerDatabase: a newer version wrote it. ReadOnly, Full: a migration is due and can't be written.
        """
        target = resolve(url, data_dir)
        await asyncio.to_thread(_make_directory, data_dir)
        if elsewhere is not None:
            await elsewhere.open(url, data_dir, backup=backup)
            return cls(Database(target, elsewhere))
        await asyncio.to_thread(prepare, target, data_dir, backup=backup)
        return cls(Database(target, alone=alone))

    async def close(self) -> None:
        """Commit what waits and let go of the database."""
        await self.quality.settle()
        await self._database.close()

    # --- experiments ------------------------------------------------------------------------------------------------

    @writes
    async def create_experiment(
        self, body: schemas.ExperimentCreate, *, lockstep: bool, receipt: Receipt | None = None
    ) -> schemas.Experiment:
        """Store a checked experiment, and with it the answer that a retry gets."""

        def create(session: Session) -> schemas.Experiment:
            made = wire.experiment(store_experiments.create(session, body, lockstep=lockstep))
            return receipted(session, made, receipt)

        return await self._database.write(create)

    async def update_experiment(self, experiment_id: int, change: schemas.ExperimentUpdate) -> schemas.Experiment:
        """Change what may change live; a field left out stays."""
        return (await self.update_and_conclude(experiment_id, change))[0]

    @writes
    async def update_and_conclude(
        self, experiment_id: int, change: schemas.ExperimentUpdate
    ) -> tuple[schemas.Experiment, list[Concluded]]:
        """The same, and the open proposals that a new rule has closed by the votes they had."""

        def update(session: Session) -> tuple[schemas.Experiment, list[Concluded]]:
            row, concluded = store_electorates.update(session, experiment_id, change)
            return wire.experiment(row), concluded

        return await self._database.write(update)

    @writes
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

        return await self._database.write(apply)

    async def halt(self, experiment_id: int) -> schemas.Experiment:
        """Latch the emergency stop. Never refused; again, it changes nothing."""
        return await self.transition(experiment_id, "halt")

    @writes
    async def rearm(self, experiment_id: int, *, latched: bool = False) -> schemas.Experiment:
        """Unlatch the emergency stop. `latched`: there is one, even if it could not be stored."""
        return await self._database.write(
            lambda s: wire.experiment(store_experiments.rearm(s, experiment_id, latched=latched))
        )

    @writes
    async def recover(self) -> list[int]:
        """Settle what an ended process left behind; the ids of the experiments that it concerned."""
        return await self._database.write(store_experiments.recover)

    @writes
    async def begin_episode(
        self, experiment_id: int, seed: int, purpose: Purpose = "training", *, robot: int = 0
    ) -> int:
        """Begin a robot's episode and return its number; one that goes on ends by reset."""
        return await self._database.write(
            lambda s: store_experiments.begin_episode(s, experiment_id, seed, purpose, robot).number
        )

    @writes
    async def end_episode(self, experiment_id: int, outcome: EpisodeOutcome, *, robot: int = 0) -> None:
        """End the episode that goes on with a robot, if any."""
        await self._database.write(lambda s: store_experiments.end_episode(s, experiment_id, outcome, robot))

    # --- proposals and feedback -------------------------------------------------------------------------------------

    @writes
    async def open_proposal(self, new: NewProposal, *, after: int | None = None) -> schemas.Proposal:
        """Store a proposal with its observation and pictures. Conflict where it must not be open now.

        after: only if this proposal was judged, and nothing will move by that.
        """

        def opened(session: Session) -> schemas.Proposal:
            if after is not None:
                store_proposals.must_have_led_to_nothing(session, after)
            return wire.proposal(store_proposals.open_proposal(session, new))

        return await self._database.write(opened)

    @writes
    async def close_proposal(self, proposal_id: int, reason: schemas.CloseReason) -> schemas.Proposal:
        """Close without a verdict; a closed one stays as it is."""
        return await self._database.write(
            lambda s: wire.proposal(store_proposals.close_proposal(s, proposal_id, reason))
        )

    @writes
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
        return await self._database.write(lambda s: store_votes.submit(s, proposal_id, click, kind, refused, had=had))

    @writes
    async def leave_electorates(self, experiment_id: int, names: Collection[str]) -> list[Concluded]:
        """Wait for these trainers no longer, on any open proposal. See `store_electorates.leave`."""
        return await self._database.write(lambda s: store_electorates.leave(s, experiment_id, names))

    @writes
    async def enter_electorates(self, experiment_id: int, names: Sequence[str]) -> list[Concluded]:
        """Ask these trainers for the open proposals that nobody is left to judge."""
        return await self._database.write(lambda s: store_electorates.enter(s, experiment_id, names))

    @writes
    async def relabel(self, feedback_id: int, body: schemas_labels.RelabelCreate, *, anybodys: bool) -> Relabelled:
        """Correct a click on a closed proposal. See `store_labels.relabel`."""
        return await self._database.write(lambda s: store_labels.relabel(s, feedback_id, body, anybodys=anybodys))

    @writes
    async def undo_feedback(self, feedback_id: int, *, keep: Collection[int] = (), by: str | None = None) -> Undone:
        """Take a trainer's newest click back while nothing has moved. See `store_undo.undo`."""
        return await self._database.write(lambda s: store_undo.undo(s, feedback_id, keep=keep, by=by))

    @writes
    async def consider(self, proposal_id: int, *, simulated: bool) -> store_trust.Considered:
        """Whether the critic approves the open proposal by itself; stored, if it does. See `store_trust.consider`."""
        return await self._database.write(lambda s: store_trust.consider(s, proposal_id, simulated=simulated))

    # --- gate and executions ----------------------------------------------------------------------------------------

    @writes
    async def record_evaluation_approval(self, proposal_id: int) -> schemas.Proposal:
        """The verdict +1 of an evaluation for its own proposal."""
        return await self._database.write(lambda s: wire.proposal(store_votes.approve_evaluation(s, proposal_id)))

    @writes
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

        return await self._database.write(begin)

    @writes
    async def report_execution(
        self, execution_id: int, body: schemas_incidents.ReportCreate
    ) -> tuple[schemas.Execution, bool]:
        """Keep what somebody saw an execution do; the second value: this very report was stored before."""

        def report(session: Session) -> tuple[schemas.Execution, bool]:
            row, duplicate = store_incidents.report(session, execution_id, body)
            return wire.execution(row), duplicate

        return await self._database.write(report)

    @writes
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
        return await self._database.write(
            lambda s: wire.incident(
                store_incidents.add_incident(
                    s, experiment_id, execution_id=execution_id, kind=kind, detail=detail, frames=frames
                )
            )
        )

    @writes
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
        return await self._database.write(
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


def _make_directory(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ReadOnly(str(error)) from error
