"""The reading half of the store: each method is one snapshot of what is committed, as wire models."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from sqlalchemy import ColumnElement, Select, bindparam, exists, or_, select
from sqlalchemy.orm import Session, selectinload

from server import (
    models,
    schemas,
    schemas_incidents,
    schemas_records,
    store_executions,
    store_experiments,
    store_labels,
    store_listing,
    store_pages,
    store_records,
    store_trust,
    store_undo,
)
from server import store_wire as wire
from server.database import Database
from server.models_incidents import IncidentRow
from server.models_quality import PracticeRow
from server.schemas_catalogue import TrainerPage
from server.schemas_listing import Listing
from server.schemas_trust import AutoApprovalRecord, Calibration
from server.store_errors import Conflict, NotFound
from server.store_people import PeopleStore
from server.store_quality import QualityStore
from server.store_values import Outlook, StoredLabel, StoredResponse

T = TypeVar("T")
W = TypeVar("W")

_OF_EXPERIMENT = {
    "proposal": models.ProposalRow,
    "feedback": models.FeedbackRow,
    "execution": models.ExecutionRow,
    "incident": IncidentRow,
    "practice": PracticeRow,
}

_PROPOSALS = select(models.ProposalRow).options(selectinload(models.ProposalRow.heard))
_OPEN = _PROPOSALS.where(
    models.ProposalRow.experiment_id == bindparam("experiment"), models.ProposalRow.closed_at.is_(None)
).order_by(models.ProposalRow.number)
_RUNNING = (
    select(models.ExecutionRow)
    .where(models.ExecutionRow.experiment_id == bindparam("experiment"), models.ExecutionRow.ended_at.is_(None))
    .order_by(models.ExecutionRow.id)
)
_CLICKS = select(models.FeedbackRow).options(selectinload(models.FeedbackRow.relabels))


class Reads:
    """Every read of the service; `server.store.Store` adds the writes."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self.quality = QualityStore(database)
        self.people = PeopleStore(database)

    async def experiment(self, experiment_id: int) -> schemas.Experiment:
        """One experiment."""
        return await self._one(models.ExperimentRow, experiment_id, "experiment", wire.experiment)

    async def experiments(
        self, cursor: str | None = None, limit: int = 50, listing: Listing | None = None
    ) -> schemas.ExperimentPage:
        """Newest first, unless the listing says otherwise."""
        return await self.read(lambda s: store_listing.experiments(s, listing or Listing(), cursor, limit))

    async def running(self) -> list[int]:
        """Ids of the experiments that run."""
        row = models.ExperimentRow
        query = select(row.id).where(row.lifecycle == schemas.Lifecycle.RUNNING.value).order_by(row.id)
        return await self._database.read(lambda session: list(session.scalars(query)))

    async def experiment_of(self, kind: str, row_id: int) -> int | None:
        """The experiment that a proposal, feedback, execution, incident or practice belongs to, if there is one."""
        row: Any = _OF_EXPERIMENT[kind]
        query = select(row.experiment_id).where(row.id == row_id)
        return await self._database.read(lambda session: session.scalar(query))

    async def proposal(self, proposal_id: int) -> schemas.Proposal:
        """One proposal."""
        return await self._one(models.ProposalRow, proposal_id, "proposal", wire.proposal)

    async def proposals(self, experiment_id: int, cursor: str | None = None, limit: int = 50) -> schemas.ProposalPage:
        """Newest first."""
        query = _PROPOSALS.where(models.ProposalRow.experiment_id == experiment_id)
        items, after = await self._page(query, models.ProposalRow.id, wire.proposal, cursor, limit, of=experiment_id)
        return schemas.ProposalPage(items=items, next_cursor=after)

    async def open_proposals(self, experiment_id: int) -> list[schemas.Proposal]:
        """The proposals that wait for feedback, at most one in each slot of a robot, oldest first."""
        return await self._database.read(lambda session: _opened(session, experiment_id))

    async def superseded_by(self, proposal_id: int) -> tuple[list[schemas.Proposal], list[StoredLabel]]:
        """What the approval of a proposal has closed or overtaken, and what was said of that and trains by it."""
        return await self._database.read(lambda s: store_executions.superseded_by(s, proposal_id))

    async def undoable(self, experiment_id: int, trainer: str | None = None) -> schemas.Feedback | None:
        """The newest feedback, of this trainer or of all, if `undo_feedback` would take it back now."""
        return await self._database.read(lambda session: _undoable(session, experiment_id, trainer))

    async def outlooks(self, experiment_id: int, trainers: Sequence[str | None]) -> dict[str | None, Outlook]:
        """Where an experiment stands for each of these trainers; None: for nobody in particular.

        Raises:
            NotFound: no such experiment.
        """

        def look(session: Session) -> dict[str | None, Outlook]:
            experiment = wire.experiment(store_experiments.load(session, experiment_id))
            proposals, executions = _opened(session, experiment_id), _executing(session, experiment_id)
            return {
                trainer: Outlook(experiment, proposals, executions, _undoable(session, experiment_id, trainer))
                for trainer in trainers
            }

        return await self._database.read(look)

    async def told(self, feedback_id: int, asker: str) -> schemas.Feedback:
        """One click, as far as somebody may know of it: what others say of an open proposal is told at its end.

        Raises:
            NotFound: there is none. Conflict: it isn't told yet.
        """

        def find(session: Session) -> schemas.Feedback:
            row = session.get(models.FeedbackRow, feedback_id)
            if row is None:
                raise NotFound("feedback", feedback_id)
            of = session.get_one(models.ProposalRow, row.proposal_id)
            if of.closed_at is None and row.trainer.name != asker:
                raise Conflict(
                    f"what others said of proposal {of.id} is told once it is closed",
                    remedy="ask again then: others are still to judge it",
                )
            return wire.feedback(row)

        return await self._database.read(find)

    async def feedback(self, feedback_id: int) -> schemas.Feedback:
        """One click."""
        return await self._one(models.FeedbackRow, feedback_id, "feedback", wire.feedback)

    async def feedback_of_proposal(
        self, proposal_id: int, cursor: str | None = None, limit: int = 50, *, told_to: str | None = None
    ) -> schemas.FeedbackPage:
        """Clicks on a proposal, late and undone ones too, newest first.

        told_to: without what anybody else has said of it while it is open; None: all.
        """
        await self.proposal(proposal_id)
        query = _CLICKS.where(models.FeedbackRow.proposal_id == proposal_id)
        if told_to is not None:
            query = query.where(or_(_told(), _by(told_to)))
        items, after = await self._page(query, models.FeedbackRow.id, wire.feedback, cursor, limit)
        return schemas.FeedbackPage(items=items, next_cursor=after)

    async def feedback_of_experiment(
        self,
        experiment_id: int,
        cursor: str | None = None,
        limit: int = 50,
        *,
        trainer: str | None = None,
        told_to: str | None = None,
    ) -> schemas.FeedbackPage:
        """Clicks of an experiment, late and undone ones too, newest first.

        trainer: only theirs. told_to: without what anybody else has said of a proposal that is still open; None: all.
        """
        query = _CLICKS.where(models.FeedbackRow.experiment_id == experiment_id)
        if trainer is not None:
            query = query.where(_by(trainer))
        if told_to is not None:
            query = query.where(or_(_told(), _by(told_to)))
        items, after = await self._page(query, models.FeedbackRow.id, wire.feedback, cursor, limit, of=experiment_id)
        return schemas.FeedbackPage(items=items, next_cursor=after)

    async def labels(self, experiment_id: int, after_id: int = 0, limit: int | None = None) -> list[StoredLabel]:
        """What the learner trains from, ascending by feedback id: the first `limit` after that one."""
        return await self._database.read(lambda s: store_labels.labels(s, experiment_id, after_id, limit))

    async def labels_before(self, experiment_id: int, before_id: int | None, limit: int) -> list[StoredLabel]:
        """What the learner trains from, ascending by feedback id: the last `limit` before that one, or of all."""
        return await self._database.read(lambda s: store_labels.labels_before(s, experiment_id, before_id, limit))

    async def calibration(self, experiment_id: int, newest: int) -> Calibration:
        """The critic's reliability curve over its newest judged proposals."""
        return await self._database.read(lambda s: store_trust.calibration(s, experiment_id, newest))

    async def auto_approvals(self, experiment_id: int) -> AutoApprovalRecord:
        """What the critic approved by itself, and what audits said of it."""
        return await self._database.read(lambda s: store_trust.record(s, experiment_id))

    async def execution(self, execution_id: int) -> schemas.Execution:
        """One execution."""
        return await self._one(models.ExecutionRow, execution_id, "execution", wire.execution)

    async def executions(self, experiment_id: int, cursor: str | None = None, limit: int = 50) -> schemas.ExecutionPage:
        """Newest first."""
        query = select(models.ExecutionRow).where(models.ExecutionRow.experiment_id == experiment_id)
        items, after = await self._page(query, models.ExecutionRow.id, wire.execution, cursor, limit, of=experiment_id)
        return schemas.ExecutionPage(items=items, next_cursor=after)

    async def incident(self, incident_id: int) -> schemas_incidents.Incident:
        """One incident."""
        return await self._one(IncidentRow, incident_id, "incident", wire.incident)

    async def incidents(
        self, experiment_id: int, cursor: str | None = None, limit: int = 20
    ) -> schemas_incidents.IncidentPage:
        """Newest first."""
        query = select(IncidentRow).where(IncidentRow.experiment_id == experiment_id)
        items, after = await self._page(query, IncidentRow.id, wire.incident, cursor, limit, of=experiment_id)
        return schemas_incidents.IncidentPage(items=items, next_cursor=after)

    async def running_executions(self, experiment_id: int) -> list[schemas.Execution]:
        """The executions without an outcome, at most one a robot, oldest first."""
        return await self._database.read(lambda session: _executing(session, experiment_id))

    async def metrics(
        self, experiment_id: int, cursor: str | None = None, limit: int = 50
    ) -> schemas_records.MetricPage:
        """Oldest first."""
        row = models.MetricRow
        query = select(row).where(row.experiment_id == experiment_id)
        items, after = await self._page(query, row.id, wire.metric, cursor, limit, of=experiment_id, newest_first=False)
        return schemas_records.MetricPage(items=items, next_cursor=after)

    async def evaluation(self, evaluation_id: int) -> schemas.Evaluation:
        """One evaluation."""
        return await self._one(models.EvaluationRow, evaluation_id, "evaluation", wire.evaluation)

    async def evaluations(
        self, experiment_id: int, cursor: str | None = None, limit: int = 50
    ) -> schemas_records.EvaluationPage:
        """Newest first."""
        row = models.EvaluationRow
        query = select(row).where(row.experiment_id == experiment_id)
        items, after = await self._page(query, row.id, wire.evaluation, cursor, limit, of=experiment_id)
        return schemas_records.EvaluationPage(items=items, next_cursor=after)

    async def latest_checkpoint(self, experiment_id: int) -> schemas_records.Checkpoint | None:
        """The newest one."""
        items = (await self.checkpoints(experiment_id, limit=1)).items
        return items[0] if items else None

    async def checkpoints(
        self, experiment_id: int, cursor: str | None = None, limit: int = 50
    ) -> schemas_records.CheckpointPage:
        """Newest first."""
        row = models.CheckpointRow
        query = select(row).where(row.experiment_id == experiment_id)
        items, after = await self._page(query, row.id, wire.checkpoint, cursor, limit, of=experiment_id)
        return schemas_records.CheckpointPage(items=items, next_cursor=after)

    async def trainers(self, cursor: str | None = None, limit: int = 50) -> TrainerPage:
        """By id."""
        row = models.TrainerRow
        items, after = await self._page(select(row), row.id, wire.trainer, cursor, limit, newest_first=False)
        return TrainerPage(items=items, next_cursor=after)

    async def events(
        self, experiment_id: int, cursor: str | None = None, limit: int = 50, *, answers: bool = True
    ) -> schemas_records.EventPage:
        """The journal, oldest first. answers: also the lines that tell which answers are known, and what they are."""
        row = models.EventRow
        query = select(row).where(row.experiment_id == experiment_id)
        if not answers:
            query = query.where(row.kind.not_in(("gold_marked", "gold_unmarked")))
        items, after = await self._page(query, row.id, wire.event, cursor, limit, of=experiment_id, newest_first=False)
        return schemas_records.EventPage(items=items, next_cursor=after)

    async def idempotent(self, key: str, route: str, body_digest: str) -> StoredResponse | None:
        """The answer that this key got before on this route; Conflict where the body was another."""
        return await self._database.read(lambda s: store_records.idempotent(s, key, route, body_digest))

    async def read(self, run: Callable[[Session], T]) -> T:
        """Run a query of another module of the store's on a snapshot."""
        return await self._database.read(run)

    async def _one(self, kind: type[T], row_id: int, what: str, convert: Callable[[T], W]) -> W:
        def find(session: Session) -> W:
            row = session.get(kind, row_id)
            if row is None:
                raise NotFound(what, row_id)
            return convert(row)

        return await self._database.read(find)

    async def _page(
        self,
        query: Select[T],
        key: Any,
        convert: Callable[[T], W],
        cursor: str | None,
        limit: int,
        *,
        of: int | None = None,
        newest_first: bool = True,
    ) -> tuple[list[W], str | None]:
        def find(session: Session) -> tuple[list[W], str | None]:
            if of is not None:
                store_experiments.load(session, of)
            return store_pages.page(session, query, key, convert, cursor=cursor, limit=limit, newest_first=newest_first)

        return await self._database.read(find)


def _opened(session: Session, experiment_id: int) -> list[schemas.Proposal]:
    return [wire.proposal(row) for row in session.scalars(_OPEN, {"experiment": experiment_id})]


def _executing(session: Session, experiment_id: int) -> list[schemas.Execution]:
    return [wire.execution(row) for row in session.scalars(_RUNNING, {"experiment": experiment_id})]


def _undoable(session: Session, experiment_id: int, trainer: str | None) -> schemas.Feedback | None:
    row = store_undo.newest_counted(session, experiment_id, trainer)
    if row and trainer is None and session.get_one(models.ProposalRow, row.proposal_id).closed_at is None:
        return None  # what somebody has said of it is theirs until it is closed
    return wire.feedback(row) if row and store_undo.why_not_undoable(session, row) is None else None


def _by(trainer: str) -> ColumnElement[bool]:
    """A click of this trainer's."""
    row = models.TrainerRow
    # a person and a teacher may have the same name
    return models.FeedbackRow.trainer_id.in_(select(row.id).where(row.name == trainer))


def _told() -> ColumnElement[bool]:
    """Not what somebody has said of a proposal on which others are still asked, whether it counts or not."""
    of = models.ProposalRow
    return ~exists().where(of.id == models.FeedbackRow.proposal_id, of.closed_at.is_(None))
