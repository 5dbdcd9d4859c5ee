"""What was said of a skill's calls, for a look at what the critic expects of others."""

from __future__ import annotations

from collections.abc import Mapping

from sqlalchemy import select
from sqlalchemy.orm import Session

from server.models import COUNTING, FeedbackRow, ProposalRow
from server.schemas_critic import NearbyLabel
from server.store_proposals import load_proposal

NEWEST = 300
"""Labels that are shown at most."""
ALIKE = 0.02
"""How far an entry of the state may be from another's for both to be one situation: 2 cm, or as many radians."""


def nearby(session: Session, proposal_id: int, skill: str) -> list[NearbyLabel]:
    """The newest labels of this skill in the proposal's experiment, oldest first; can't tell says nothing here."""
    proposal = load_proposal(session, proposal_id)
    value = FeedbackRow.label
    query = (
        select(ProposalRow, value)
        .join(FeedbackRow, FeedbackRow.proposal_id == ProposalRow.id)
        .where(
            ProposalRow.experiment_id == proposal.experiment_id,
            ProposalRow.skill == skill,
            ProposalRow.purpose == "training",
            ProposalRow.closed_at.is_not(None),
            FeedbackRow.status.in_(COUNTING),
            FeedbackRow.undone_at.is_(None),
            value.is_not(None),
        )
        .order_by(FeedbackRow.id.desc())
        .limit(NEWEST)
    )
    here = proposal.observation.state
    found = []
    for row, label in session.execute(query):
        named = dict(zip(row.parameter_names, row.parameters, strict=True))
        there = row.observation.state
        alike = len(there) == len(here) and all(abs(a - b) <= ALIKE for a, b in zip(here, there, strict=True))
        found.append(
            NearbyLabel(
                proposal_id=row.id,
                number=row.number,
                x=named["x"],
                y=named["y"],
                value=label,
                predicted_feedback=row.predicted_feedback,
                alike=alike,
            )
        )
    return found[::-1]


def newest_good(session: Session, experiment_id: int, skill: str) -> Mapping[str, float]:
    """The parameters of the newest call of this skill that was judged good; none where there is no such call."""
    row = ProposalRow
    query = (
        select(row)
        .where(row.experiment_id == experiment_id, row.skill == skill, row.verdict == "good", row.purpose == "training")
        .order_by(row.id.desc())
        .limit(1)
    )
    found = session.scalars(query).one_or_none()
    return {} if found is None else dict(zip(found.parameter_names, found.parameters, strict=True))
