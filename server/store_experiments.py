"""Experiments, episodes and the recovery after a crash. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any, TypeVar

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server import lifecycle, schemas, store_audit
from server.models import EpisodeRow, EvaluationRow, EventRow, ExecutionRow, ExperimentRow, ProposalRow
from server.models_tags import TagRow
from server.store_closing import close
from server.store_errors import Conflict, NotFound
from server.store_values import EpisodeOutcome, Purpose

LEAVING: dict[str, schemas.CloseReason] = {
    "pause": schemas.CloseReason.WITHDRAWN,
    "finish": schemas.CloseReason.WITHDRAWN,
    "fail": schemas.CloseReason.INTERRUPTED,
    "reset": schemas.CloseReason.WITHDRAWN,
    "halt": schemas.CloseReason.WITHDRAWN,
}
"""Verbs after which an open proposal can't be answered any more: it is closed in the same transaction."""


R = TypeVar("R", ExecutionRow, ProposalRow, EvaluationRow)


def now() -> datetime:
    """The time that is stored."""
    return datetime.now(UTC)


def load(session: Session, experiment_id: int) -> ExperimentRow:
    """The row.

    Raises:
        NotFound: there is none.
    """
    row = session.get(ExperimentRow, experiment_id)
    if row is None:
        raise NotFound("experiment", experiment_id)
    return row


def journal(session: Session, experiment_id: int, kind: str, **payload: Any) -> EventRow:
    """Write a line of the experiment's journal; a decision goes into the audit too."""
    row = EventRow(experiment_id=experiment_id, kind=kind, payload=payload, at=now())
    session.add(row)
    if kind in store_audit.DECISIONS:
        store_audit.record(session, kind, experiment_id, **payload)
    return row


def state(row: ExperimentRow) -> lifecycle.State:
    """Lifecycle and emergency stop."""
    return lifecycle.State(schemas.Lifecycle(row.lifecycle), row.halted)


def create(session: Session, body: schemas.ExperimentCreate, *, lockstep: bool) -> ExperimentRow:
    """A new experiment, in `created`."""
    at = now()
    fields = body.model_dump(mode="json", exclude={"lockstep", "tags"})
    fields["mode"] = fields["mode"] or schemas.Mode.EXECUTE_APPROVED
    row = ExperimentRow(**fields, lockstep=lockstep, lifecycle="created", failure=None, created_at=at, updated_at=at)
    row.tags = [TagRow(tag=tag) for tag in body.tags]
    session.add(row)
    session.flush()
    journal(session, row.id, "created", name=row.name)
    return row


def update(session: Session, experiment_id: int, change: schemas.ExperimentUpdate) -> ExperimentRow:
    """Change what the body names; a field left out stays, a null time-out means never."""
    row = load(session, experiment_id)
    fields = change.model_dump(mode="json", exclude_unset=True)
    for required in ("name", "mode", "aggregation", "together", "gold_rate", "tags"):
        if fields.get(required, "") is None:
            del fields[required]
    if "auto_approval" in fields:
        # what the body leaves out of a rule is its default; audits count from here on
        fields["auto_approval"] = change.auto_approval.model_dump() if change.auto_approval else None
        newest = select(func.max(ProposalRow.number)).where(ProposalRow.experiment_id == experiment_id)
        row.auto_approval_since, row.auto_approval_suspended = session.scalar(newest) or 0, None
    if change.together is not None and "together" in fields:
        # of these each stays by itself
        fields["together"] = row.together | change.together.model_dump(mode="json", exclude_none=True)
    for name, value in fields.items():
        if name == "tags":
            kept = {each.tag: each for each in row.tags}
            row.tags = [kept.get(tag) or TagRow(tag=tag) for tag in value]
        else:
            setattr(row, name, value)
    if fields:
        row.updated_at = now()
        journal(session, experiment_id, "updated", **fields)
    return row


def transition(
    session: Session,
    experiment_id: int,
    verb: lifecycle.Verb,
    failure: str | None = None,
    *,
    unfinished: bool = False,
    robot: int | None = None,
) -> ExperimentRow:
    """Apply a verb of the lifecycle. `unfinished`: end what never got its end written, because none of it goes on.

    robot: a reset is of this one only.

    Raises:
        Conflict: it is illegal now; a second `halt` isn't, it changes nothing.
    """
    row = load(session, experiment_id)
    before = state(row)
    after = lifecycle.apply(before, verb)
    if verb == "halt" and before.halted:
        return row
    row.lifecycle, row.halted, row.updated_at = after.lifecycle.value, after.halted, now()
    if verb == "fail":
        row.failure = failure or "unknown"
    elif verb in ("start", "resume"):
        row.failure = None
    if unfinished:
        settle(session, experiment_id)
    if verb in LEAVING:
        close_open(session, experiment_id, LEAVING[verb], robot)
    payload = {"from": before.lifecycle.value, "to": after.lifecycle.value}
    if verb == "fail":
        payload["failure"] = str(row.failure)
    journal(session, experiment_id, verb, **payload)
    return row


def rearm(session: Session, experiment_id: int, *, latched: bool) -> ExperimentRow:
    """Lift the emergency stop. `latched`: there is one, even if it never got here."""
    if latched:
        transition(session, experiment_id, "halt")
    return transition(session, experiment_id, "rearm")


def close_open(session: Session, experiment_id: int, reason: schemas.CloseReason, robot: int | None = None) -> None:
    """Close the open proposals, of one robot or of all, without a verdict."""
    query = select(ProposalRow).where(ProposalRow.experiment_id == experiment_id, ProposalRow.closed_at.is_(None))
    if robot is not None:
        query = query.where(ProposalRow.robot == robot)
    for row in session.scalars(query):
        close(session, row, reason)
    session.flush()


def open_episode(session: Session, experiment_id: int, robot: int) -> EpisodeRow | None:
    """The episode that goes on with this robot."""
    query = select(EpisodeRow).where(
        EpisodeRow.experiment_id == experiment_id, EpisodeRow.robot == robot, EpisodeRow.ended_at.is_(None)
    )
    return session.scalars(query).one_or_none()


def begin_episode(
    session: Session, experiment_id: int, seed: int, purpose: Purpose = "training", robot: int = 0
) -> EpisodeRow:
    """Begin a robot's episode; one that still goes on ends with it, by reset. Only training ones are counted."""
    row = load(session, experiment_id)
    if open_episode(session, experiment_id, robot) is not None:
        end_episode(session, experiment_id, "reset", robot)
    newest = session.scalar(select(func.max(EpisodeRow.number)).where(EpisodeRow.experiment_id == experiment_id))
    episode = EpisodeRow(
        experiment_id=experiment_id,
        robot=robot,
        number=(newest or 0) + 1,
        purpose=purpose,
        seed=seed,
        started_at=now(),
    )
    session.add(episode)
    if purpose == "training":
        row.episodes += 1
        row.updated_at = now()
    session.flush()
    journal(session, experiment_id, "episode_started", episode=episode.number, robot=robot, seed=seed, purpose=purpose)
    return episode


def end_episode(session: Session, experiment_id: int, outcome: EpisodeOutcome, robot: int = 0) -> None:
    """End the episode that goes on with a robot; without one nothing happens. A training success is counted."""
    row = load(session, experiment_id)
    episode = open_episode(session, experiment_id, robot)
    if episode is None:
        return
    episode.outcome, episode.ended_at = outcome, now()
    if outcome == "success" and episode.purpose == "training":
        row.successes += 1
        row.updated_at = now()
    session.flush()
    journal(session, experiment_id, "episode_ended", episode=episode.number, robot=robot, outcome=outcome)


def settle(session: Session, experiment_id: int | None = None) -> set[int]:
    """End what nobody will end any more, of one experiment or of all. Nothing is rerun (DESIGN.md section 5, 3)."""
    touched: set[int] = set()

    def unended(row: type[R], ended_at: Any) -> Sequence[R]:
        query = select(row).where(ended_at.is_(None))
        if experiment_id is not None:
            query = query.where(row.experiment_id == experiment_id)
        rows = session.scalars(query).all()
        touched.update(r.experiment_id for r in rows)
        return rows

    for execution in unended(ExecutionRow, ExecutionRow.ended_at):
        execution.outcome, execution.end_reason, execution.ended_at = "interrupted", "interrupted", now()
        journal(session, execution.experiment_id, "execution_ended", execution=execution.id, outcome="interrupted")
    for proposal in unended(ProposalRow, ProposalRow.closed_at):
        close(session, proposal, schemas.CloseReason.INTERRUPTED)
    for evaluation in unended(EvaluationRow, EvaluationRow.ended_at):
        # what is done is a result; the rest never happened
        evaluation.rollouts, evaluation.ended_at = evaluation.done, now()
    session.flush()
    return touched


def recover(session: Session) -> list[int]:
    """Settle what a process left behind that ended without warning."""
    touched = settle(session)
    for episode in session.scalars(select(EpisodeRow).where(EpisodeRow.ended_at.is_(None))):
        episode.outcome, episode.ended_at = "interrupted", now()
        touched.add(episode.experiment_id)
    for row in session.scalars(select(ExperimentRow).where(ExperimentRow.lifecycle == "running")):
        row.lifecycle = "paused"
        touched.add(row.id)
    for experiment_id in sorted(touched):
        row = load(session, experiment_id)
        row.updated_at = now()
        journal(session, experiment_id, "recovered", lifecycle=row.lifecycle)
    session.flush()
    return sorted(touched)


def must_be_running(row: ExperimentRow, what: str) -> None:
    """Only a running experiment that isn't halted may do `what`.

    Raises:
        Conflict: with the state and the verbs that are legal.
    """
    current = state(row)
    if current.halted or current.lifecycle is not schemas.Lifecycle.RUNNING:
        why = "halted" if current.halted else current.lifecycle.value
        raise Conflict(
            f"can't {what}: the experiment is {why}",
            remedy="re-arm it first" if current.halted else "start or resume it first",
            current=current.lifecycle.value,
            allowed=lifecycle.allowed(current),
        )
