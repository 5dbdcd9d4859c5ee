"""What the learner trains from, and corrections of it. Every function runs inside one transaction."""

from __future__ import annotations

from typing import Any

from sqlalchemy import Select, bindparam, func, or_, select
from sqlalchemy.orm import Session

from server.models import COUNTING, FeedbackRow, ObservationRow, ProposalRow, RelabelRow, TrainerRow
from server.schemas_labels import RelabelCreate, label_of
from server.store_closing import count
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_values import Relabelled, StoredLabel
from server.store_wire import feedback as feedback_wire

_LABELS = (
    select(
        FeedbackRow.id,
        ObservationRow.state,
        ProposalRow.skill,
        ProposalRow.parameters,
        FeedbackRow.label,
        func.coalesce(RelabelRow.newest(RelabelRow.trainer_id, FeedbackRow), FeedbackRow.trainer_id),
    )
    .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
    .join(ObservationRow, ObservationRow.id == ProposalRow.observation_id)
    .where(
        FeedbackRow.status.in_(COUNTING),
        FeedbackRow.undone_at.is_(None),
        FeedbackRow.label.is_not(None),
        ProposalRow.purpose == "training",
        ProposalRow.known_answer.is_(None),
        # a time-out trains nothing, whoever voted before it; where nobody could tell, a correction does
        # and what was said of a proposal before another one was approved, or just after, is as true as ever
        or_(ProposalRow.verdict.is_not(None), ProposalRow.close_reason.in_(("cant_tell", "superseded"))),
    )
    .order_by(FeedbackRow.id)
)
"""What the learner trains from. Made once, as every deciding click asks for its part of it."""
_OF_EXPERIMENT = _LABELS.where(FeedbackRow.experiment_id == bindparam("experiment"))
_OF_PROPOSAL = _LABELS.where(FeedbackRow.proposal_id == bindparam("proposal"))
_OF_CLICK = _LABELS.where(FeedbackRow.id == bindparam("feedback"))


def labels(session: Session, experiment_id: int, after_id: int = 0, limit: int | None = None) -> list[StoredLabel]:
    """What the learner trains from, by id; no more than `limit`."""
    query = _OF_EXPERIMENT.where(FeedbackRow.id > after_id).limit(limit)
    return _labels(session, query, experiment=experiment_id)


def labels_before(session: Session, experiment_id: int, before_id: int | None, limit: int) -> list[StoredLabel]:
    """The newest of those, by id; older than that one. No more than `limit`."""
    query = _OF_EXPERIMENT.order_by(None).order_by(FeedbackRow.id.desc()).limit(limit)
    if before_id is not None:
        query = query.where(FeedbackRow.id < before_id)
    return _labels(session, query, experiment=experiment_id)[::-1]


def labels_of(session: Session, proposal_id: int) -> list[StoredLabel]:
    """What the learner trains from this proposal."""
    return _labels(session, _OF_PROPOSAL, proposal=proposal_id)


def labels_of_click(session: Session, feedback_id: int) -> list[StoredLabel]:
    """What the learner trains from this click: one label at most."""
    return _labels(session, _OF_CLICK, feedback=feedback_id)


def relabel(session: Session, feedback_id: int, body: RelabelCreate, *, anybodys: bool) -> Relabelled:
    """Correct a click on a closed proposal: its row stays, counters and learner follow, the verdict doesn't.

    anybodys: also one that somebody else gave.

    Raises:
        NotFound: no such feedback. Conflict: the click id was used for something else, it isn't this trainer's, it
            doesn't count, or its proposal is still open.
    """
    row = session.get(FeedbackRow, feedback_id)
    if row is None:
        raise NotFound("feedback", feedback_id)
    value = label_of(body.value)
    known = session.scalars(select(RelabelRow).where(RelabelRow.click_id == body.click_id)).one_or_none()
    if known is not None:
        if (known.feedback_id, known.value, known.trainer.name) != (feedback_id, value, body.trainer):
            raise Conflict(
                f"click {body.click_id} was stored with another content", remedy="make a new click id for every click"
            )
        return Relabelled(feedback_wire(row), duplicate=True, before=row.label, after=row.label)
    proposal = session.get_one(ProposalRow, row.proposal_id)
    _must_be_correctable(row, proposal, body.trainer, anybodys=anybodys)
    before, experiment = row.label, load(session, row.experiment_id)
    by = row.trainer if row.trainer.name == body.trainer else trainer(session, body.trainer, "person")
    row.relabels.append(RelabelRow(click_id=body.click_id, trainer=by, value=value, at=now()))
    count(experiment, before, -1)
    count(experiment, value, 1)
    experiment.relabelled += 1
    experiment.updated_at = now()
    session.flush()
    journal(
        session, row.experiment_id, "relabelled", feedback=row.id, proposal=row.proposal_id, before=before, by=by.name
    )
    learned = labels_of_click(session, feedback_id)
    return Relabelled(
        feedback_wire(row), duplicate=False, before=before, after=value, label=learned[0] if learned else None
    )


def trainer(session: Session, name: str, kind: str) -> TrainerRow:
    """Who judges; made where there is none of this name."""
    row = session.scalars(select(TrainerRow).where(TrainerRow.name == name, TrainerRow.kind == kind)).one_or_none()
    if row is None:
        row = TrainerRow(name=name, kind=kind, created_at=now())
        session.add(row)
        session.flush()
    return row


def _must_be_correctable(row: FeedbackRow, proposal: ProposalRow, by: str, *, anybodys: bool) -> None:
    if row.trainer.name != by and not anybodys:
        raise Conflict(f"this click is somebody else's, not {by}'s", remedy="correct your own clicks")
    if proposal.purpose != "training":
        raise Conflict("an evaluation's approval is no label", remedy="judge the proposals of a running experiment")
    if row.status not in COUNTING:
        why = "it came late" if row.status == "late" else "it was for practice"
        raise Conflict(f"this click counts for nothing: {why}", remedy="correct a click that counts")
    if row.undone_at is not None:
        raise Conflict("this click was taken back", remedy="correct a click that counts")
    if proposal.closed_at is None:
        raise Conflict(
            f"proposal {proposal.id} is still open", remedy="take the click back, and click anew; or wait for its end"
        )


def _labels(session: Session, query: Select[Any], **where: int) -> list[StoredLabel]:
    return [
        StoredLabel(feedback_id, tuple(state), skill, tuple(parameters), label, whose)
        for feedback_id, state, skill, parameters, label, whose in session.connection().execute(query, where)
    ]
