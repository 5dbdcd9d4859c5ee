"""The end of a proposal, whichever way it comes, and its opening again. Each function runs in a write transaction.

What was said of a proposal is counted once it is closed: an experiment's counters must not tell what somebody has
answered while others are still asked.
"""

from __future__ import annotations

from collections.abc import Iterable
from datetime import UTC, datetime

from sqlalchemy import bindparam, select
from sqlalchemy.orm import Session

from server.models import ExperimentRow, FeedbackRow, ProposalRow
from server.schemas import CloseReason

_LABELS = select(FeedbackRow.label).where(
    FeedbackRow.proposal_id == bindparam("proposal"), FeedbackRow.status == "stored", FeedbackRow.undone_at.is_(None)
)
COUNTER_OF = {1: "good", 0: "neutral", -1: "bad", None: "cant_tell"}


def close(
    session: Session, proposal: ProposalRow, reason: CloseReason, said: Iterable[int | None] | None = None
) -> None:
    """It waits for no more answers; those that it has are counted. said: these, where they are known already."""
    proposal.close_reason, proposal.closed_at = reason.value, datetime.now(UTC)
    _count_votes(session, proposal, 1, said)


def reopen(session: Session, proposal: ProposalRow) -> None:
    """As if it had never been closed: its answers are its trainers' own again."""
    _count_votes(session, proposal, -1)
    proposal.closed_at = proposal.close_reason = proposal.verdict = proposal.gate_allowed = proposal.gate_reason = None
    proposal.verdict_source = proposal.rule = None


def count(experiment: ExperimentRow, value: int | None, by: int) -> None:
    """Count an answer; one that says nothing is no feedback."""
    experiment.feedback += by if value is not None else 0
    counter = COUNTER_OF[value]
    setattr(experiment, counter, getattr(experiment, counter) + by)


def _count_votes(session: Session, proposal: ProposalRow, by: int, said: Iterable[int | None] | None = None) -> None:
    if proposal.purpose != "training":  # an evaluation's approval is no feedback
        return
    experiment = session.get_one(ExperimentRow, proposal.experiment_id)
    for value in session.scalars(_LABELS, {"proposal": proposal.id}) if said is None else said:
        count(experiment, value, by)
