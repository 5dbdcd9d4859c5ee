"""Who is asked about what is open: electorates that shrink and grow, and what the votes add up to by that.

Every function runs inside one write transaction.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

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
        if _shrink(session, proposal, names, cast):
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
    """Change what may change live. A new rule adds up the votes on open proposals anew; closed ones stay.

    Where practice is required from now on, whoever has to practise first leaves what is open.
    """
    experiment = load(session, experiment_id)
    rule, required = (experiment.aggregation, experiment.together), experiment.practice_required
    row = store_experiments.update(session, experiment_id, change)
    anew, stricter = (row.aggregation, row.together) != rule, row.practice_required != required
    concluded = []
    for proposal in _open(session, experiment_id) if anew or stricter else ():
        cast = votes(session, proposal.id)
        left = stricter and _shrink(session, proposal, _unpractised(session, row, proposal), cast)
        if cast and (anew or left):
            conclude(session, row, proposal, cast)
        if left or proposal.closed_at is not None:
            concluded.append(_concluded(session, proposal))
    return row, concluded


def _shrink(
    session: Session, proposal: ProposalRow, names: Collection[str], cast: Mapping[str, int | None]
) -> list[str]:
    """Ask these no more, unless they have voted; who it is."""
    left = [name for name in proposal.electorate if name in names and name not in cast]
    if left:
        proposal.electorate = [name for name in proposal.electorate if name not in left]
        journal(session, proposal.experiment_id, "electorate_left", proposal=proposal.id, trainers=left)
    return left


def _unpractised(session: Session, experiment: ExperimentRow, proposal: ProposalRow) -> list[str]:
    """Those who are asked, and whose clicks don't count before they have practised."""
    required = experiment.practice_required
    return [n for n in proposal.electorate if not store_practice.may_count(session, experiment.id, required, n)]


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
