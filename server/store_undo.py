"""Taking a click back while nothing has moved. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Collection

from sqlalchemy import or_, select
from sqlalchemy.orm import Session

from server.models import COUNTING, ExecutionRow, FeedbackRow, ProposalRow, TrainerRow
from server.schemas import CloseReason
from server.store_closing import close, count, reopen
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_labels import labels_of
from server.store_proposals import load_proposal
from server.store_values import Undone
from server.store_votes import verdict_of, votes
from server.store_wire import feedback as feedback_wire
from server.store_wire import proposal as proposal_wire


def newest_counted(session: Session, experiment_id: int, trainer: str | None = None) -> FeedbackRow | None:
    """The newest feedback of a training proposal that isn't late and isn't undone; of one trainer, or of all."""
    query = (
        select(FeedbackRow)
        .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
        .where(
            FeedbackRow.experiment_id == experiment_id,
            FeedbackRow.status.in_(COUNTING),
            FeedbackRow.undone_at.is_(None),
            ProposalRow.purpose == "training",
        )
        .order_by(FeedbackRow.id.desc())
        .limit(1)
    )
    if trainer is not None:
        query = query.join(TrainerRow, TrainerRow.id == FeedbackRow.trainer_id).where(TrainerRow.name == trainer)
    return session.scalars(query).one_or_none()


def why_not_undoable(session: Session, row: FeedbackRow) -> str | None:
    """What forbids taking this feedback back, in words; None where nothing does."""
    experiment = load(session, row.experiment_id)
    if row.undone_at is not None:
        return "it is undone already"
    if row.status == "late":
        return "it came late and decided nothing"
    newest = newest_counted(session, row.experiment_id, row.trainer.name)
    if newest is None or newest.id != row.id:
        return f"it isn't the newest feedback of {row.trainer.name}"
    if experiment.halted or experiment.lifecycle != "running":
        return "the experiment is " + ("halted" if experiment.halted else experiment.lifecycle)
    if row.status == "overtaken":  # nothing has come of it
        return None
    judged = load_proposal(session, row.proposal_id)
    if judged.episode.ended_at is not None:
        return "its episode has ended"
    of_robot = select(ProposalRow.id).where(
        ProposalRow.experiment_id == row.experiment_id, ProposalRow.robot == judged.robot
    )
    since = of_robot.where(ProposalRow.number >= judged.number)
    # by this proposal, by a later one, or by one that was open beside it
    moved = select(ExecutionRow.id).where(
        or_(
            ExecutionRow.proposal_id.in_(since),
            ExecutionRow.proposal_id.in_(of_robot) & (ExecutionRow.started_at >= judged.opened_at),
        )
    )
    if session.scalar(moved.limit(1)) is not None:
        return "the robot has moved since"
    # a gold one may show an earlier scene again, without anything being looked at
    other = since.where(ProposalRow.observation_id != judged.observation_id, ProposalRow.gold_of.is_(None))
    if judged.gold_of is not None:
        return None
    if session.scalar(other.limit(1)) is not None:
        return "the scene was observed anew since"
    return None


def undo(session: Session, feedback_id: int, *, keep: Collection[int] = (), by: str | None = None) -> Undone:
    """Take a click back while nothing has moved: its proposal is open again, in a slot that is free.

    Where the others' votes lead to the same verdict without it, the proposal stays closed. What was opened in its place
    meanwhile is withdrawn, unless somebody has voted on it, or it is one of `keep`: another trainer is at it.
    by: who asks, where that is known.

    Raises:
        Conflict: why it can't be undone, in words.
    """
    row = session.get(FeedbackRow, feedback_id)
    if row is None:
        raise NotFound("feedback", feedback_id)
    if by is not None and row.trainer.name != by:
        raise Conflict(f"this click is somebody else's, not {by}'s", remedy="take your own clicks back")
    reason = why_not_undoable(session, row)
    if reason is not None:
        raise Conflict(f"this feedback can't be undone: {reason}", remedy="go on with the open proposal")
    judged = load_proposal(session, row.proposal_id)
    experiment = load(session, row.experiment_id)
    left = {name: value for name, value in votes(session, judged.id).items() if name != row.trainer.name}
    decided = row.status == "overtaken" or (
        judged.verdict is not None and verdict_of(session, experiment, judged, left) == judged.verdict
    )
    unlearned: list[int] = []
    again = judged.closed_at is not None and not decided
    withdrawn = None if decided else _make_room(session, judged, keep)
    if judged.closed_at is not None and decided:
        count(experiment, row.label, -1)
    elif again:
        unlearned = [label.feedback_id for label in labels_of(session, judged.id) if label.feedback_id != row.id]
        reopen(session, judged)
    row.undone_at = now()
    experiment.updated_at = now()
    session.flush()
    journal(session, row.experiment_id, "undone", feedback=row.id, proposal=judged.id, by=row.trainer.name)
    session.refresh(judged, ["heard"])
    told = proposal_wire(withdrawn) if withdrawn else None
    return Undone(feedback_wire(row), proposal_wire(judged), told, unlearned, again)


def _make_room(session: Session, judged: ProposalRow, keep: Collection[int]) -> ProposalRow | None:
    """Have a slot for a proposal that opens again; what is withdrawn for that."""
    if judged.closed_at is None:
        return None
    query = select(ProposalRow).where(
        ProposalRow.experiment_id == judged.experiment_id,
        ProposalRow.robot == judged.robot,
        ProposalRow.closed_at.is_(None),
    )
    taken = {other.slot: other for other in session.scalars(query)}
    meanwhile = taken.get(judged.slot)
    if meanwhile is None:
        return None
    voted = select(FeedbackRow.id).where(
        FeedbackRow.proposal_id == meanwhile.id, FeedbackRow.status == "stored", FeedbackRow.undone_at.is_(None)
    )
    older = meanwhile.number < judged.number  # opened again as well
    if older or meanwhile.id in keep or session.scalar(voted.limit(1)) is not None:
        judged.slot = next(slot for slot in range(len(taken) + 1) if slot not in taken)
        return None
    close(session, meanwhile, CloseReason.WITHDRAWN)
    session.flush()  # before the other opens: a slot has at most one open
    return meanwhile
