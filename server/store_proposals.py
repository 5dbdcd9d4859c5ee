"""Proposals, clicks and undo. Every function runs inside one write transaction."""

from __future__ import annotations

import dataclasses
from typing import Any

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server import aggregation, lifecycle, schemas, schemas_trust, store_gold, store_practice
from server.models import (
    EvaluationRow,
    ExecutionRow,
    ExperimentRow,
    FeedbackRow,
    ObservationRow,
    ProposalRow,
    TrainerRow,
)
from server.store_errors import Conflict, NotFound
from server.store_experiments import begin_episode, journal, load, must_be_running, now, open_episode, state
from server.store_labels import count, labels_of, trainer
from server.store_values import NewProposal, NewView, Submission, Undone
from server.store_wire import feedback as feedback_wire
from server.store_wire import proposal as proposal_wire

CONTENT = (
    *("observation", "skill", "parameters", "parameter_names", "digest", "views", "subgoal"),
    *("predicted_feedback", "uncertainty", "skill_probabilities", "policy_version"),
)
"""Columns of what is proposed, and of what it was drawn on: a marked proposal is shown again with the same."""


def load_proposal(session: Session, proposal_id: int) -> ProposalRow:
    """The row.

    Raises:
        NotFound: there is none.
    """
    row = session.get(ProposalRow, proposal_id)
    if row is None:
        raise NotFound("proposal", proposal_id)
    return row


def open_proposal(session: Session, new: NewProposal) -> ProposalRow:
    """Store the observation, if it is new, and open the proposal.

    Raises:
        Conflict: not running (an evaluation: not idle), halted, its robot has another one open, or still moves.
    """
    experiment = load(session, new.experiment_id)
    if new.purpose == "training":
        must_be_running(experiment, "open a proposal")
    else:
        lifecycle.apply(state(experiment), "evaluate")
    _must_stand_still(session, new.experiment_id, new.robot)
    episode = open_episode(session, new.experiment_id, new.robot)
    if episode is None or episode.purpose != new.purpose:
        if new.purpose == "training":
            raise Conflict("no episode has begun", remedy="reset the robot first")
        episode = begin_episode(session, new.experiment_id, 0, "evaluation", new.robot)
    newest = session.scalar(select(func.max(ProposalRow.number)).where(ProposalRow.experiment_id == new.experiment_id))
    number = (newest or 0) + 1
    known = store_gold.drawn(session, experiment, new, number)
    again = known.again if known is not None else None
    row = ProposalRow(
        experiment_id=new.experiment_id,
        robot=new.robot,
        episode=episode,
        number=number,
        purpose=new.purpose,
        # who has to practise first has no vote that anybody could wait for
        electorate=[name for name in new.electorate if store_practice.may_count(session, experiment, name)],
        opened_at=now(),
        known_answer=known.answer if known is not None else None,
        gold_of=again.id if again is not None else None,
        **(_content(session, new) if again is None else {name: getattr(again, name) for name in CONTENT}),
    )
    session.add(row)
    if new.purpose == "training":
        experiment.proposals += 1
        experiment.updated_at = now()
    else:
        running = select(EvaluationRow).where(
            EvaluationRow.experiment_id == new.experiment_id, EvaluationRow.ended_at.is_(None)
        )
        for evaluation in session.scalars(running):
            evaluation.policy_version = new.policy_version
    session.flush()
    return row


def must_have_led_to_nothing(session: Session, proposal_id: int) -> None:
    """What was drawn beside a proposal may follow it only if clicks closed that, not as good, in the same episode.

    Raises:
        Conflict: it is open, closed without a verdict, or good; or its scene isn't there any more.
    """
    row = load_proposal(session, proposal_id)
    if row.close_reason not in ("judged", "cant_tell") or row.verdict == schemas.Verdict.GOOD.value:
        raise Conflict(f"proposal {proposal_id} was not judged bad or neutral", remedy="propose anew")
    if row.episode.ended_at is not None:
        raise Conflict(f"the episode of proposal {proposal_id} has ended", remedy="observe, then propose anew")


def close_proposal(session: Session, proposal_id: int, reason: schemas.CloseReason) -> ProposalRow:
    """Close without a verdict; one that is closed already stays as it is."""
    row = load_proposal(session, proposal_id)
    if reason in (schemas.CloseReason.JUDGED, schemas.CloseReason.CANT_TELL):
        raise Conflict("only feedback judges a proposal", remedy="submit feedback")
    if row.closed_at is None:
        row.closed_at, row.close_reason = now(), reason.value
        session.flush()
        journal(session, row.experiment_id, "proposal_closed", proposal=row.id, reason=reason.value)
    return row


def submit(session: Session, proposal_id: int, click: schemas.FeedbackCreate, kind: str) -> Submission:
    """Store a click; the one that completes a verdict closes the proposal with it, as does the last abstention.

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
        return Submission(feedback_wire(known), duplicate=True)
    proposal = load_proposal(session, proposal_id)
    if proposal.purpose != "training":
        raise Conflict("this proposal belongs to an evaluation", remedy="judge the proposals of a running experiment")
    late = proposal.closed_at is not None
    by = trainer(session, click.trainer, kind)
    experiment = load(session, proposal.experiment_id)
    counts = kind != "person" or store_practice.may_count(session, experiment, by.name)
    if counts and not late:
        _must_have_vote(session, experiment, proposal, by)
    status = "practice" if not counts else "late" if late else "stored"
    shown = click.estimate_shown
    row = _store(session, proposal, by, click.click_id, click.label, status=status, estimate_shown=shown)
    if not counts:
        return Submission(feedback_wire(row), duplicate=False)
    experiment.updated_at = now()
    if late:
        experiment.late += 1
        return Submission(feedback_wire(row), duplicate=False)
    count(experiment, click.label, 1)
    _conclude(session, experiment, proposal)
    session.flush()
    if proposal.closed_at is None:
        return Submission(feedback_wire(row), duplicate=False)
    labels = labels_of(session, proposal_id)
    return Submission(feedback_wire(row), duplicate=False, closed=proposal_wire(proposal), labels=labels)


def _conclude(session: Session, experiment: ExperimentRow, proposal: ProposalRow) -> None:
    """Close it if the votes have come to an end: with their verdict, or because nobody could tell."""
    cast = votes(session, proposal.id)
    verdict = aggregation.verdict(schemas.Aggregation(experiment.aggregation), cast, proposal.electorate)
    if verdict is not None:
        judge(proposal, verdict, schemas_trust.VerdictSource.TRAINERS)
    elif aggregation.nobody_could_tell(cast, proposal.electorate):
        proposal.close_reason, proposal.closed_at = schemas.CloseReason.CANT_TELL.value, now()


def approve_evaluation(session: Session, proposal_id: int) -> ProposalRow:
    """The verdict +1 of an evaluation's own proposal, as a row like any other; it is no label."""
    proposal = load_proposal(session, proposal_id)
    if proposal.purpose != "evaluation" or proposal.closed_at is not None:
        raise Conflict("only an open proposal of an evaluation can be approved by it", remedy="submit feedback instead")
    _store(
        session, proposal, trainer(session, "evaluation", "evaluation"), f"evaluation-{proposal_id}", 1, status="stored"
    )
    judge(proposal, schemas.Verdict.GOOD, schemas_trust.VerdictSource.EVALUATION)
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


def newest_counted(session: Session, experiment_id: int) -> FeedbackRow | None:
    """The newest feedback of a training proposal that isn't late and isn't undone."""
    query = (
        select(FeedbackRow)
        .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
        .where(
            FeedbackRow.experiment_id == experiment_id,
            FeedbackRow.status == "stored",
            FeedbackRow.undone_at.is_(None),
            ProposalRow.purpose == "training",
        )
        .order_by(FeedbackRow.id.desc())
        .limit(1)
    )
    return session.scalars(query).one_or_none()


def why_not_undoable(session: Session, row: FeedbackRow) -> str | None:
    """What forbids taking this feedback back, in words; None where nothing does."""
    experiment = load(session, row.experiment_id)
    if row.undone_at is not None:
        return "it is undone already"
    if row.status == "late":
        return "it came late and decided nothing"
    newest = newest_counted(session, row.experiment_id)
    if newest is None or newest.id != row.id:
        return "it isn't the newest feedback"
    if experiment.halted or experiment.lifecycle != "running":
        return "the experiment is " + ("halted" if experiment.halted else experiment.lifecycle)
    judged = load_proposal(session, row.proposal_id)
    if judged.episode.ended_at is not None:
        return "its episode has ended"
    since = select(ProposalRow.id).where(
        ProposalRow.experiment_id == row.experiment_id,
        ProposalRow.robot == judged.robot,
        ProposalRow.number >= judged.number,
    )
    if session.scalar(select(ExecutionRow.id).where(ExecutionRow.proposal_id.in_(since)).limit(1)) is not None:
        return "the robot has moved since"
    # a gold one may show an earlier scene again, without anything being looked at
    other = since.where(ProposalRow.observation_id != judged.observation_id, ProposalRow.gold_of.is_(None))
    if judged.gold_of is not None:
        return None
    if session.scalar(other.limit(1)) is not None:
        return "the scene was observed anew since"
    return None


def undo(session: Session, feedback_id: int) -> Undone:
    """Take a click back while nothing has moved: its proposal is open again, one opened meanwhile is withdrawn.

    Raises:
        Conflict: why it can't be undone, in words.
    """
    row = session.get(FeedbackRow, feedback_id)
    if row is None:
        raise NotFound("feedback", feedback_id)
    reason = why_not_undoable(session, row)
    if reason is not None:
        raise Conflict(f"this feedback can't be undone: {reason}", remedy="go on with the open proposal")
    judged = load_proposal(session, row.proposal_id)
    query = select(ProposalRow).where(
        ProposalRow.experiment_id == row.experiment_id,
        ProposalRow.robot == judged.robot,
        ProposalRow.closed_at.is_(None),
        ProposalRow.id != judged.id,
    )
    meanwhile = session.scalars(query).one_or_none()
    if meanwhile is not None:
        meanwhile.closed_at, meanwhile.close_reason = now(), "withdrawn"
        session.flush()  # before the other opens: a robot has at most one open
    row.undone_at = now()
    judged.closed_at = judged.close_reason = judged.verdict = judged.gate_allowed = judged.gate_reason = None
    judged.verdict_source = None
    experiment = load(session, row.experiment_id)
    count(experiment, row.value, -1)
    experiment.updated_at = now()
    session.flush()
    journal(session, row.experiment_id, "undone", feedback=row.id, proposal=judged.id, value=row.value)
    withdrawn = proposal_wire(meanwhile) if meanwhile is not None else None
    return Undone(feedback_wire(row), proposal_wire(judged), withdrawn)


def _must_stand_still(session: Session, experiment_id: int, robot: int) -> None:
    opened = select(ProposalRow.id).where(
        ProposalRow.experiment_id == experiment_id, ProposalRow.robot == robot, ProposalRow.closed_at.is_(None)
    )
    if (other := session.scalar(opened)) is not None:
        raise Conflict(f"proposal {other} is open", remedy="wait until it is judged, or close it")
    moving = select(ExecutionRow.id).where(
        ExecutionRow.experiment_id == experiment_id, ExecutionRow.robot == robot, ExecutionRow.ended_at.is_(None)
    )
    if (running := session.scalar(moving)) is not None:
        raise Conflict(f"execution {running} still moves the robot", remedy="wait until it has ended")


def _observation(session: Session, new: NewProposal) -> ObservationRow:
    query = select(ObservationRow).where(
        ObservationRow.experiment_id == new.experiment_id, ObservationRow.uid == new.observation_id
    )
    values = [float(value) for value in new.state]
    known = session.scalars(query).one_or_none()
    if known is not None:
        if known.state != values:
            raise Conflict(
                f"observation {new.observation_id} was stored with another state",
                remedy="give every observation an id of its own",
            )
        return known
    row = ObservationRow(
        experiment_id=new.experiment_id, uid=new.observation_id, state=values, taken_at=float(new.taken_at)
    )
    session.add(row)
    return row


def _content(session: Session, new: NewProposal) -> dict[str, Any]:
    """What is proposed, and what it was drawn on."""
    return {
        "observation": _observation(session, new),
        "skill": new.call.skill,
        "parameters": [float(value) for value in new.call.parameters],
        "parameter_names": list(new.parameter_names),
        "digest": new.call.digest,
        "predicted_feedback": float(new.predicted_feedback),
        "uncertainty": None if new.uncertainty is None else float(new.uncertainty),
        "skill_probabilities": {name: float(value) for name, value in new.skill_probabilities.items()},
        "policy_version": new.policy_version,
        "subgoal": new.subgoal,
        "views": [_view(view) for view in new.views],
    }


def _view(view: NewView) -> dict[str, object]:
    return {
        **{f.name: getattr(view, f.name) for f in dataclasses.fields(view)},
        "overlay": view.overlay.model_dump(mode="json"),
    }


def _must_have_vote(session: Session, experiment: ExperimentRow, proposal: ProposalRow, trainer: TrainerRow) -> None:
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


def judge(proposal: ProposalRow, verdict: schemas.Verdict, source: schemas_trust.VerdictSource) -> None:
    """Close it with a verdict."""
    proposal.verdict, proposal.close_reason, proposal.closed_at = verdict.value, "judged", now()
    proposal.verdict_source = source.value
