"""Gold proposals: their answer is known beforehand, and they measure whoever judges them. One transaction each.

They look like all others on the wire. Nothing moves by one, and nothing is learned from it.
"""

from __future__ import annotations

from dataclasses import dataclass

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server.models import ExperimentRow, FeedbackRow, ProposalRow
from server.models_quality import GoldMarkRow
from server.schemas_labels import answer_of
from server.schemas_quality import Gold, GoldAnswer, GoldMark
from server.schemas_together import Together
from server.seeds import gold as lot
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, now
from server.store_labels import trainer
from server.store_values import NewProposal

AGAIN = 0.5
"""Share of gold proposals that are marked ones shown again, where there are any; the others go by the task's rule."""


@dataclass(frozen=True)
class Known:
    """What a proposal is to be called, +1 or -1; `again`: it is this earlier one once more."""

    answer: int
    again: ProposalRow | None = None


def drawn(session: Session, experiment: ExperimentRow, new: NewProposal, number: int) -> Known | None:
    """Whether the proposal of this number is gold, by a lot that depends on the experiment's seed and the number only.

    None: it is one like all others. Without a rate no lot is drawn at all. In parallel, where the open ones of a robot
    show one scene, one of another scene would stand out: there the rule knows the answers, wherever it can.
    """
    if not experiment.gold_rate or new.purpose != "training":
        return None
    random = lot(experiment.seed, number)
    chance, kind = random.random(), random.random()
    if chance >= experiment.gold_rate:
        return None
    again = kind < AGAIN and not Together.model_validate(experiment.together).parallel
    mark = _least_shown(session, experiment.id) if again or new.rule_answer is None else None
    if mark is not None:
        return Known(mark.answer, mark.proposal)
    return None if new.rule_answer is None else Known(new.rule_answer)


def mark(session: Session, proposal_id: int, body: GoldMark) -> GoldMarkRow:
    """Know the answer to a closed proposal. Marked again, the newest answer counts.

    Raises:
        NotFound: no such proposal. Conflict: it is open, an evaluation's, or a gold one itself.
    """
    proposal = session.get(ProposalRow, proposal_id)
    if proposal is None:
        raise NotFound("proposal", proposal_id)
    if proposal.closed_at is None or proposal.purpose != "training":
        raise Conflict(
            f"proposal {proposal_id} is open, or belongs to an evaluation", remedy="mark a closed proposal of training"
        )
    if proposal.known_answer is not None:
        raise Conflict(f"the answer to proposal {proposal_id} is known already", remedy="mark another one")
    row = session.scalars(select(GoldMarkRow).where(GoldMarkRow.proposal_id == proposal_id)).one_or_none()
    by = trainer(session, body.trainer, "person")
    if row is None:
        row = GoldMarkRow(proposal=proposal, answer=body.answer, trainer=by, at=now())
        session.add(row)
    else:
        row.answer, row.trainer, row.at = body.answer, by, now()
    session.flush()
    journal(session, proposal.experiment_id, "gold_marked", proposal=proposal_id, answer=body.answer, by=by.name)
    return row


def unmark(session: Session, proposal_id: int) -> None:
    """Show it no more.

    Raises:
        NotFound: it isn't marked.
    """
    row = session.scalars(select(GoldMarkRow).where(GoldMarkRow.proposal_id == proposal_id)).one_or_none()
    if row is None:
        raise NotFound("mark of proposal", proposal_id)
    journal(session, row.proposal.experiment_id, "gold_unmarked", proposal=proposal_id)
    session.delete(row)


def gold(session: Session, row: ProposalRow) -> Gold:
    """A closed gold proposal with everybody's answer, as it was clicked; late ones measure as well."""
    clicks = session.scalars(
        select(FeedbackRow)
        .where(FeedbackRow.proposal_id == row.id, FeedbackRow.status != "practice", FeedbackRow.undone_at.is_(None))
        .order_by(FeedbackRow.id)
    )
    known = row.known_answer or 0
    return Gold(
        proposal_id=row.id,
        number=row.number,
        skill=row.skill,
        known_answer=known,
        source="rule" if row.gold_of is None else "operator",
        answers=[GoldAnswer(trainer=c.trainer.name, value=answer_of(c.value), right=c.value == known) for c in clicks],
    )


def _least_shown(session: Session, experiment_id: int) -> GoldMarkRow | None:
    shown = (
        select(func.count(ProposalRow.id))
        .where(ProposalRow.gold_of == GoldMarkRow.proposal_id)
        .correlate(GoldMarkRow)
        .scalar_subquery()
    )
    query = (
        select(GoldMarkRow)
        .join(ProposalRow, ProposalRow.id == GoldMarkRow.proposal_id)
        .where(ProposalRow.experiment_id == experiment_id)
        .order_by(shown, GoldMarkRow.id)
        .limit(1)
    )
    return session.scalars(query).first()
