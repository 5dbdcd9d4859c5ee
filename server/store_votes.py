"""Clicks on proposals, and what they add up to. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from sqlalchemy import Row, and_, bindparam, insert, select
from sqlalchemy.orm import Session

from server import aggregation, schemas, schemas_trust, store_practice, store_quality
from server.models import COUNTING, ExperimentRow, FeedbackRow, ObservationRow, ProposalRow, TrainerRow
from server.models_base import table
from server.schemas_labels import answer_of
from server.schemas_together import Together
from server.store_audit import record
from server.store_closing import close, count
from server.store_errors import Conflict, NotFound
from server.store_experiments import now
from server.store_labels import labels_of, labels_of_click, trainer
from server.store_proposals import load_proposal
from server.store_rows import save
from server.store_values import Submission
from server.store_wire import feedback as feedback_wire
from server.store_wire import proposal as proposal_wire

_FOUND = (
    select(
        ProposalRow.experiment_id,
        ProposalRow.purpose,
        ProposalRow.closed_at,
        ProposalRow.close_reason,
        ProposalRow.verdict,
        ProposalRow.superseded_by,
        ProposalRow.policy_version,
        ObservationRow.uid,
        ExperimentRow.practice_required,
        ExperimentRow.lifecycle,
        ExperimentRow.halted,
        TrainerRow.id.label("trainer_id"),
        FeedbackRow.id.label("known"),
    )
    .join(ObservationRow, ObservationRow.id == ProposalRow.observation_id)
    .join(ExperimentRow, ExperimentRow.id == ProposalRow.experiment_id)
    .outerjoin(TrainerRow, and_(TrainerRow.name == bindparam("trainer"), TrainerRow.kind == bindparam("kind")))
    .outerjoin(FeedbackRow, FeedbackRow.click_id == bindparam("click_id"))
    .where(ProposalRow.id == bindparam("proposal"))
)
"""What has to be known of a click before it is stored. Most clicks of a crowd are late, and need no more than this."""
_JUDGED = (
    select(ProposalRow, ExperimentRow)
    .join(ExperimentRow, ExperimentRow.id == ProposalRow.experiment_id)
    .where(ProposalRow.id == bindparam("proposal"))
)
_VOTES = (
    select(TrainerRow.name, FeedbackRow.value)
    .join(TrainerRow, TrainerRow.id == FeedbackRow.trainer_id)
    .where(
        FeedbackRow.proposal_id == bindparam("proposal"),
        FeedbackRow.status == "stored",
        FeedbackRow.undone_at.is_(None),
    )
    .order_by(FeedbackRow.id)
)
_KEEP = insert(table(FeedbackRow))
_EXPERIMENT = table(ExperimentRow)
_COUNT_LATE = (
    _EXPERIMENT.update()
    .where(_EXPERIMENT.c.id == bindparam("experiment"))
    .values(late=_EXPERIMENT.c.late + 1, updated_at=bindparam("at"))
)


def submit(
    session: Session,
    proposal_id: int,
    click: schemas.FeedbackCreate,
    kind: str,
    refused: str | None = None,
    *,
    had: bool = False,
) -> Submission:
    """Store a click; the one that completes a verdict closes the proposal with it, as does the last abstention.

    refused: why it can't count, in words, although the proposal may be open: it is kept as late.
    had: its trainer has the proposal before them. Where another one's approval has closed it meanwhile, what they say
        of it trains, and decides nothing.

    Raises:
        Conflict: the click id was used for something else, the proposal is an evaluation's, or this trainer has
            judged it already or has no vote on it.
    """
    asked = {"proposal": proposal_id, "click_id": click.click_id, "trainer": click.trainer, "kind": kind}
    found = session.connection().execute(_FOUND, asked).one_or_none()
    if found is None or found.known is not None:
        return _again(session, proposal_id, click, found)
    if found.purpose != "training":
        raise Conflict("this proposal belongs to an evaluation", remedy="judge the proposals of a running experiment")
    late_because = _why_late(session, found, click, refused)
    by = found.trainer_id or trainer(session, click.trainer, kind).id
    experiment_id, required = found.experiment_id, found.practice_required
    counts = kind != "person" or store_practice.may_count(session, experiment_id, required, click.trainer)
    status = "practice" if not counts else "stored" if late_because is None else "late"
    if status == "late" and had and _may_finish(session, proposal_id, found, click, by):
        status = "overtaken"
    if status == "stored":
        proposal, experiment = _judged(session, proposal_id)
        cast = _must_have_vote(session, experiment, proposal, click.trainer)
    feedback = _store(session, experiment_id, proposal_id, by, click, status=status)
    record(session, "clicked", experiment_id, by=click.trainer, proposal=proposal_id, value=click.label, status=status)
    if status == "practice":
        return Submission(feedback, duplicate=False)
    if status == "overtaken":
        proposal, experiment = _judged(session, proposal_id)
        count(experiment, click.label, 1)
        experiment.updated_at = feedback.received_at
        save(session, experiment)
        labels = labels_of_click(session, feedback.id)
        return Submission(_why(feedback, late_because), duplicate=False, heard=told(session, proposal), labels=labels)
    if status == "late":
        session.connection().execute(_COUNT_LATE, {"experiment": experiment_id, "at": feedback.received_at})
        return Submission(_why(feedback, late_because), duplicate=False)
    cast[click.trainer] = click.label
    conclude(session, experiment, proposal, cast)
    experiment.updated_at = now()
    save(session, proposal)
    save(session, experiment)
    answer = proposal_wire(proposal, cast)
    if proposal.closed_at is None:
        return Submission(feedback, duplicate=False, heard=answer)
    return Submission(feedback, duplicate=False, heard=answer, closed=answer, labels=labels_of(session, proposal_id))


def approve_evaluation(session: Session, proposal_id: int) -> ProposalRow:
    """The verdict +1 of an evaluation's own proposal, as a row like any other; it is no label."""
    proposal = load_proposal(session, proposal_id)
    if proposal.purpose != "evaluation" or proposal.closed_at is not None:
        raise Conflict("only an open proposal of an evaluation can be approved by it", remedy="submit feedback instead")
    by = trainer(session, "evaluation", "evaluation")
    click = schemas.FeedbackCreate(click_id=f"evaluation-{proposal_id}", value=1, trainer=by.name)
    _store(session, proposal.experiment_id, proposal_id, by.id, click, status="stored")
    judge(session, proposal, schemas.Verdict.GOOD, schemas_trust.VerdictSource.EVALUATION)
    session.flush()
    return proposal


def votes(session: Session, proposal_id: int) -> dict[str, int | None]:
    """Counted votes, trainer -> value as it was clicked, in the order they came; None: can't tell."""
    return dict(session.connection().execute(_VOTES, {"proposal": proposal_id}).all())


def verdict_of(
    session: Session, experiment: ExperimentRow, proposal: ProposalRow, cast: Mapping[str, int | None]
) -> schemas.Verdict | None:
    """What these votes on a proposal add up to by the rule of now."""
    rule, together = schemas.Aggregation(experiment.aggregation), Together.model_validate(experiment.together)
    return aggregation.verdict(
        rule,
        cast,
        proposal.electorate,
        weights=store_quality.weights(session, experiment.id) if rule is schemas.Aggregation.WEIGHTED else None,
        alone=together.weighted_approves,
        least=together.least,
    )


def stands(session: Session, experiment: ExperimentRow, proposal: ProposalRow) -> bool:
    """Whether the votes on a proposal that trainers approved still add up to good, by the rule of now."""
    return verdict_of(session, experiment, proposal, votes(session, proposal.id)) is schemas.Verdict.GOOD


def judge(
    session: Session,
    proposal: ProposalRow,
    verdict: schemas.Verdict,
    source: schemas_trust.VerdictSource,
    said: Iterable[int | None] | None = None,
) -> None:
    """Close it with a verdict. said: the votes on it, where they are known already."""
    proposal.verdict, proposal.verdict_source = verdict.value, source.value
    close(session, proposal, schemas.CloseReason.JUDGED, said)


def conclude(
    session: Session, experiment: ExperimentRow, proposal: ProposalRow, cast: Mapping[str, int | None]
) -> None:
    """Close it if the votes have come to an end: with their verdict, or because nobody could tell."""
    verdict = verdict_of(session, experiment, proposal, cast)
    if verdict is not None:
        proposal.rule = experiment.aggregation
        judge(session, proposal, verdict, schemas_trust.VerdictSource.TRAINERS, cast.values())
    elif aggregation.nobody_could_tell(cast, proposal.electorate):
        close(session, proposal, schemas.CloseReason.CANT_TELL, cast.values())


def told(session: Session, proposal: ProposalRow) -> schemas.Proposal:
    """As everyone is told of it, with what this transaction has changed."""
    session.flush()
    return proposal_wire(proposal)


def least(experiment: ExperimentRow) -> int:
    """How many have to say good."""
    return Together.model_validate(experiment.together).least


def _again(session: Session, proposal_id: int, click: schemas.FeedbackCreate, found: Row[Any] | None) -> Submission:
    """The answer to a click that is stored already."""
    known = session.scalars(select(FeedbackRow).where(FeedbackRow.click_id == click.click_id)).one_or_none()
    if known is None:
        raise NotFound("proposal", proposal_id)
    if found is None or (known.proposal_id, known.value, known.trainer.name) != (
        proposal_id,
        click.label,
        click.trainer,
    ):
        raise Conflict(
            f"click {click.click_id} was stored with another content", remedy="make a new click id for every click"
        )
    idle = known.status in ("late", "overtaken")
    return Submission(_why(feedback_wire(known), _why_late(session, found, click, None) if idle else None), True)


def _judged(session: Session, proposal_id: int) -> tuple[ProposalRow, ExperimentRow]:
    return session.execute(_JUDGED, {"proposal": proposal_id}).one()


def _why(feedback: schemas.Feedback, why: str | None) -> schemas.Feedback:
    return feedback.model_copy(update={"late_because": why})


def _why_late(session: Session, found: Row[Any], click: schemas.FeedbackCreate, refused: str | None) -> str | None:
    """What keeps this click from counting, in words; None where it counts. found: by `_FOUND`."""
    if found.closed_at is not None:
        return _why_closed(session, found)
    return _why_not_this(found, click) or refused


def _why_not_this(found: Row[Any], click: schemas.FeedbackCreate) -> str | None:
    """Why it isn't the proposal that its trainer saw; None where it is, or where they don't say what they saw."""
    looked = click.looked
    if looked is not None and looked.observation_id != found.uid:
        return "it was made for another view of the scene than the proposal is drawn on"
    if looked is not None and looked.policy_version != found.policy_version:
        return "it was made for a proposal of another policy"
    return None


def _may_finish(
    session: Session, proposal_id: int, found: Row[Any], click: schemas.FeedbackCreate, trainer_id: int
) -> bool:
    """Whether what this trainer says of a proposal that another's approval has closed is learned from."""
    if found.close_reason != schemas.CloseReason.SUPERSEDED or found.lifecycle != "running" or found.halted:
        return False
    row = FeedbackRow
    said = select(row.id).where(row.proposal_id == proposal_id, row.trainer_id == trainer_id)
    counts = said.where(row.status.in_(COUNTING), row.undone_at.is_(None))
    return _why_not_this(found, click) is None and session.scalar(counts) is None


def _why_closed(session: Session, found: Row[Any]) -> str:
    reason = schemas.CloseReason(str(found.close_reason))
    if reason is schemas.CloseReason.SUPERSEDED:
        other = session.scalar(select(ProposalRow.number).where(ProposalRow.id == found.superseded_by))
        return "another proposal" + (f", number {other}," if other else "") + " was approved first"
    return {
        schemas.CloseReason.JUDGED: f"it was judged {found.verdict} before this click came",
        schemas.CloseReason.CANT_TELL: "nobody could tell, and it was closed before this click came",
        schemas.CloseReason.TIMED_OUT: "its time was over before this click came",
        schemas.CloseReason.WITHDRAWN: "it was withdrawn before this click came",
        schemas.CloseReason.INTERRUPTED: "it was broken off before this click came",
    }[reason]


def _must_have_vote(
    session: Session, experiment: ExperimentRow, proposal: ProposalRow, trainer: str
) -> dict[str, int | None]:
    """The votes so far."""
    joins = trainer not in proposal.electorate and aggregation.may_join(proposal.electorate, least(experiment))
    if joins:  # too few were there when it opened, or have stayed: it is for whoever comes
        proposal.electorate = [*proposal.electorate, trainer]
    cast = votes(session, proposal.id)
    if trainer in cast:
        raise Conflict(f"{trainer} has judged this proposal", remedy="undo that feedback first, or wait for the others")
    if experiment.aggregation != "first" and trainer not in proposal.electorate:
        raise Conflict(
            f"{trainer} was not there when this proposal opened, or has been away since, and has no vote on it",
            remedy="judge the next proposal",
        )
    return cast


def _store(
    session: Session,
    experiment_id: int,
    proposal_id: int,
    trainer_id: int,
    click: schemas.FeedbackCreate,
    *,
    status: str,
) -> schemas.Feedback:
    at = now()
    entry = {
        "click_id": click.click_id,
        "experiment_id": experiment_id,
        "proposal_id": proposal_id,
        "trainer_id": trainer_id,
        "value": click.label,
        "status": status,
        "received_at": at,
        "estimate_shown": click.estimate_shown,
    }
    made = session.connection().execute(_KEEP, entry).inserted_primary_key
    assert made is not None
    return schemas.Feedback(
        id=made[0],
        click_id=click.click_id,
        proposal_id=proposal_id,
        experiment_id=experiment_id,
        trainer=click.trainer,
        value=answer_of(click.label),
        label=answer_of(click.label),
        relabels=[],
        status=schemas.FeedbackStatus(status),
        received_at=at,
        estimate_shown=click.estimate_shown,
    )
