"""Clicks on proposals, and what they add up to. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session

from server import aggregation, schemas, schemas_trust, store_experiments, store_practice, store_quality
from server.models import ExperimentRow, FeedbackRow, ProposalRow, TrainerRow
from server.schemas_together import Together
from server.store_audit import record
from server.store_closing import close
from server.store_errors import Conflict
from server.store_experiments import journal, load, now
from server.store_labels import labels_of, trainer
from server.store_proposals import load_proposal
from server.store_values import Concluded, Submission
from server.store_wire import feedback as feedback_wire
from server.store_wire import proposal as proposal_wire


def submit(
    session: Session, proposal_id: int, click: schemas.FeedbackCreate, kind: str, refused: str | None = None
) -> Submission:
    """Store a click; the one that completes a verdict closes the proposal with it, as does the last abstention.

    refused: why it can't count, in words, although the proposal may be open: it is kept as late.

    Raises:
        Conflict: the click id was used for something else, the proposal is an evaluation's, or this trainer has
            judged it already or has no vote on it.
    """
    known = session.scalars(select(FeedbackRow).where(FeedbackRow.click_id == click.click_id)).one_or_none()
    if known is not None:
        if (known.proposal_id, known.value, known.trainer.name) != (proposal_id, click.label, click.trainer):
            raise Conflict(
                f"click {click.click_id} was stored with another content", remedy="make a new click id for every click"
            )
        late = known.status == schemas.FeedbackStatus.LATE
        why = _why_late(session, load_proposal(session, proposal_id), click, None) if late else None
        return Submission(_late(known, why), duplicate=True)
    proposal = load_proposal(session, proposal_id)
    if proposal.purpose != "training":
        raise Conflict("this proposal belongs to an evaluation", remedy="judge the proposals of a running experiment")
    late_because = _why_late(session, proposal, click, refused)
    late = late_because is not None
    by = trainer(session, click.trainer, kind)
    experiment = load(session, proposal.experiment_id)
    counts = kind != "person" or store_practice.may_count(session, experiment, by.name)
    if counts and not late:
        _must_have_vote(session, experiment, proposal, by)
    status = "practice" if not counts else "late" if late else "stored"
    shown = click.estimate_shown
    row = _store(session, proposal, by, click.click_id, click.label, status=status, estimate_shown=shown)
    record(session, "clicked", experiment.id, by=by.name, proposal=proposal_id, value=click.label, status=status)
    if not counts:
        return Submission(feedback_wire(row), duplicate=False)
    experiment.updated_at = now()
    if late:
        experiment.late += 1
        return Submission(_late(row, late_because), duplicate=False)
    _conclude(session, experiment, proposal)
    told = _told(session, proposal)
    if proposal.closed_at is None:
        return Submission(feedback_wire(row), duplicate=False, heard=told)
    labels = labels_of(session, proposal_id)
    return Submission(feedback_wire(row), duplicate=False, heard=told, closed=told, labels=labels)


def approve_evaluation(session: Session, proposal_id: int) -> ProposalRow:
    """The verdict +1 of an evaluation's own proposal, as a row like any other; it is no label."""
    proposal = load_proposal(session, proposal_id)
    if proposal.purpose != "evaluation" or proposal.closed_at is not None:
        raise Conflict("only an open proposal of an evaluation can be approved by it", remedy="submit feedback instead")
    _store(
        session, proposal, trainer(session, "evaluation", "evaluation"), f"evaluation-{proposal_id}", 1, status="stored"
    )
    judge(session, proposal, schemas.Verdict.GOOD, schemas_trust.VerdictSource.EVALUATION)
    session.flush()
    return proposal


def votes(session: Session, proposal_id: int) -> dict[str, int | None]:
    """Counted votes, trainer -> value as it was clicked, in the order they came; None: can't tell."""
    query = (
        select(FeedbackRow)
        .where(FeedbackRow.proposal_id == proposal_id, FeedbackRow.status == "stored", FeedbackRow.undone_at.is_(None))
        .order_by(FeedbackRow.id)
    )
    return {row.trainer.name: row.value for row in session.scalars(query)}


def verdict_of(
    session: Session, experiment: ExperimentRow, proposal: ProposalRow, cast: Mapping[str, int | None]
) -> schemas.Verdict | None:
    """What these votes on a proposal add up to by the rule of now."""
    rule = schemas.Aggregation(experiment.aggregation)
    return aggregation.verdict(
        rule,
        cast,
        proposal.electorate,
        weights=store_quality.weights(session, experiment.id) if rule is schemas.Aggregation.WEIGHTED else None,
        alone=Together.model_validate(experiment.together).weighted_approves,
    )


def stands(session: Session, experiment: ExperimentRow, proposal: ProposalRow) -> bool:
    """Whether the votes on a proposal that trainers approved still add up to good, by the rule of now."""
    return verdict_of(session, experiment, proposal, votes(session, proposal.id)) is schemas.Verdict.GOOD


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
            _conclude(session, experiment, proposal)
        concluded.append(_concluded(session, proposal))
    return concluded


def enter(session: Session, experiment_id: int, names: Sequence[str]) -> list[Concluded]:
    """Somebody is there again: open proposals that nobody is left to judge are theirs. The others' electorates stay."""
    experiment = load(session, experiment_id)
    entered = []
    may = [name for name in names if store_practice.may_count(session, experiment, name)]
    for proposal in _open(session, experiment_id):
        if may and not proposal.electorate:
            proposal.electorate = may
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
        if votes(session, proposal.id):
            _conclude(session, experiment, proposal)
        if proposal.closed_at is not None:
            concluded.append(_concluded(session, proposal))
    return row, concluded


def judge(
    session: Session, proposal: ProposalRow, verdict: schemas.Verdict, source: schemas_trust.VerdictSource
) -> None:
    """Close it with a verdict."""
    proposal.verdict, proposal.verdict_source = verdict.value, source.value
    close(session, proposal, schemas.CloseReason.JUDGED)


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


def _conclude(session: Session, experiment: ExperimentRow, proposal: ProposalRow) -> None:
    """Close it if the votes have come to an end: with their verdict, or because nobody could tell."""
    cast = votes(session, proposal.id)
    verdict = verdict_of(session, experiment, proposal, cast)
    if verdict is not None:
        judge(session, proposal, verdict, schemas_trust.VerdictSource.TRAINERS)
        proposal.rule = experiment.aggregation
    elif aggregation.nobody_could_tell(cast, proposal.electorate):
        close(session, proposal, schemas.CloseReason.CANT_TELL)


def _concluded(session: Session, proposal: ProposalRow) -> Concluded:
    told = _told(session, proposal)
    return Concluded(told, labels_of(session, proposal.id) if proposal.closed_at is not None else ())


def _told(session: Session, proposal: ProposalRow) -> schemas.Proposal:
    session.flush()
    session.refresh(proposal, ["votes"])
    return proposal_wire(proposal)


def _late(row: FeedbackRow, why: str | None) -> schemas.Feedback:
    return feedback_wire(row).model_copy(update={"late_because": why})


def _why_late(
    session: Session, proposal: ProposalRow, click: schemas.FeedbackCreate, refused: str | None
) -> str | None:
    """What keeps this click from counting, in words; None where it counts."""
    if proposal.closed_at is not None:
        return _why_closed(session, proposal)
    looked = click.looked
    if looked is not None and looked.observation_id != proposal.observation.uid:
        return "it was made for another view of the scene than the proposal is drawn on"
    if looked is not None and looked.policy_version != proposal.policy_version:
        return "it was made for a proposal of another policy"
    return refused


def _why_closed(session: Session, proposal: ProposalRow) -> str:
    reason = schemas.CloseReason(str(proposal.close_reason))
    if reason is schemas.CloseReason.SUPERSEDED:
        other = session.get(ProposalRow, proposal.superseded_by) if proposal.superseded_by else None
        return "another proposal" + (f", number {other.number}," if other else "") + " was approved first"
    return {
        schemas.CloseReason.JUDGED: f"it was judged {proposal.verdict} before this click came",
        schemas.CloseReason.CANT_TELL: "nobody could tell, and it was closed before this click came",
        schemas.CloseReason.TIMED_OUT: "its time was over before this click came",
        schemas.CloseReason.WITHDRAWN: "it was withdrawn before this click came",
        schemas.CloseReason.INTERRUPTED: "it was broken off before this click came",
    }[reason]


def _must_have_vote(session: Session, experiment: ExperimentRow, proposal: ProposalRow, trainer: TrainerRow) -> None:
    if not proposal.electorate:  # nobody was there when it opened, or all have gone: it is for whoever comes
        proposal.electorate = [trainer.name]
    if trainer.name in votes(session, proposal.id):
        raise Conflict(
            f"{trainer.name} has judged this proposal", remedy="undo that feedback first, or wait for the others"
        )
    if experiment.aggregation != "first" and trainer.name not in proposal.electorate:
        raise Conflict(
            f"{trainer.name} was not there when this proposal opened and has no vote on it",
            remedy="judge the next proposal",
        )


def _store(
    session: Session,
    proposal: ProposalRow,
    trainer: TrainerRow,
    click_id: str,
    value: int | None,
    *,
    status: str,
    estimate_shown: bool | None = None,
) -> FeedbackRow:
    row = FeedbackRow(
        click_id=click_id,
        experiment_id=proposal.experiment_id,
        proposal_id=proposal.id,
        trainer=trainer,
        value=value,
        status=status,
        received_at=now(),
        relabels=[],
        estimate_shown=estimate_shown,
    )
    session.add(row)
    session.flush()
    return row
