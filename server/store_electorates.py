"""Who is asked about what is open: electorates that shrink and grow, and what the votes add up to by that.

Every function runs inside one write transaction.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session

from server import aggregation, schemas, store_experiments, store_practice
from server.models import ExperimentRow, ProposalRow
from server.store_experiments import journal, load
from server.store_labels import labels_of
from server.store_values import Concluded
from server.store_votes import conclude, least, told, votes


def leave(session: Session, experiment_id: int, names: Collection[str]) -> list[Concluded]:
    """These trainers are gone: no open proposal waits for them any more. What they have said stays and counts.

    The proposals that this concerns; some may be closed by it.
    """
    concluded = []
    experiment = load(session, experiment_id)
    for proposal in _open(session, experiment_id):
        cast = votes(session, proposal.id)
        stay = [name for name in proposal.electorate if name not in names or name in cast]
        if stay == proposal.electorate:
            continue
        journal(
            session,
            experiment_id,
            "electorate_left",
            proposal=proposal.id,
            trainers=[name for name in proposal.electorate if name not in stay],
        )
        proposal.electorate = stay
        if cast:
            conclude(session, experiment, proposal, cast)
        concluded.append(_concluded(session, proposal))
    return concluded


def enter(session: Session, experiment_id: int, names: Sequence[str]) -> list[Concluded]:
    """Those who are there now: open proposals that too few are left to judge are theirs too. Other electorates stay."""
    experiment = load(session, experiment_id)
    entered = []
    may = [n for n in names if store_practice.may_count(session, experiment.id, experiment.practice_required, n)]
    for proposal in _open(session, experiment_id):
        new = [name for name in may if name not in proposal.electorate]
        if new and aggregation.may_join(proposal.electorate, least(experiment)):
            proposal.electorate = [*proposal.electorate, *new]
            entered.append(_concluded(session, proposal))
    return entered


def update(
    session: Session, experiment_id: int, change: schemas.ExperimentUpdate
) -> tuple[ExperimentRow, list[Concluded]]:
    """Change what may change live. A new rule adds up the votes on open proposals anew; closed ones stay."""
    experiment = load(session, experiment_id)
    before = (experiment.aggregation, experiment.together)
    row = store_experiments.update(session, experiment_id, change)
    if (row.aggregation, row.together) == before:
        return row, []
    concluded = []
    for proposal in _open(session, experiment_id):
        if cast := votes(session, proposal.id):
            conclude(session, experiment, proposal, cast)
        if proposal.closed_at is not None:
            concluded.append(_concluded(session, proposal))
    return row, concluded


def _open(session: Session, experiment_id: int) -> Sequence[ProposalRow]:
    query = (
        select(ProposalRow)
        .where(
            ProposalRow.experiment_id == experiment_id,
            ProposalRow.closed_at.is_(None),
            ProposalRow.purpose == "training",
        )
        .order_by(ProposalRow.number)
    )
    return session.scalars(query).all()


def _concluded(session: Session, proposal: ProposalRow) -> Concluded:
    return Concluded(told(session, proposal), labels_of(session, proposal.id) if proposal.closed_at is not None else ())
