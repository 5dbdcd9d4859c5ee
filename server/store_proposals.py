"""Proposals, opened and closed. Every function runs inside one write transaction."""

from __future__ import annotations

import dataclasses
from typing import Any
from uuid import uuid4

from sqlalchemy import and_, bindparam, func, select
from sqlalchemy.orm import Session
from sqlalchemy.orm.attributes import set_committed_value

from server import lifecycle, schemas, store_gold
from server.models import EpisodeRow, EvaluationRow, ExecutionRow, ExperimentRow, ObservationRow, ProposalRow
from server.store_closing import close
from server.store_errors import Conflict, NotFound
from server.store_experiments import begin_episode, journal, must_be_running, now, state
from server.store_practice import may_count
from server.store_rows import add, save
from server.store_values import NewProposal, NewView

CONTENT = (
    *("skill", "parameters", "parameter_names", "digest", "views", "subgoal"),
    *("predicted_feedback", "uncertainty", "skill_probabilities"),
)
"""Columns of what is proposed, and of its pictures: a marked proposal is shown again with the same."""

_NEWEST = select(func.max(ProposalRow.number)).where(ProposalRow.experiment_id == ExperimentRow.id)
_MOVING = select(ExecutionRow.id).where(
    ExecutionRow.experiment_id == ExperimentRow.id,
    ExecutionRow.robot == bindparam("robot"),
    ExecutionRow.ended_at.is_(None),
)
_SCENE = (
    select(ExperimentRow, EpisodeRow, _NEWEST.scalar_subquery(), _MOVING.scalar_subquery())
    .outerjoin(
        EpisodeRow,
        and_(
            EpisodeRow.experiment_id == ExperimentRow.id,
            EpisodeRow.robot == bindparam("robot"),
            EpisodeRow.ended_at.is_(None),
        ),
    )
    .where(ExperimentRow.id == bindparam("experiment"))
)
"""The experiment, the episode that goes on, its highest number of a proposal, and what moves the robot."""
_OPEN = (
    select(ProposalRow.id, ProposalRow.slot, ProposalRow.gold_of, ObservationRow.uid)
    .join(ObservationRow, ObservationRow.id == ProposalRow.observation_id)
    .where(
        ProposalRow.experiment_id == bindparam("experiment"),
        ProposalRow.robot == bindparam("robot"),
        ProposalRow.closed_at.is_(None),
    )
)
_ENDED = (
    select(ProposalRow.close_reason, ProposalRow.verdict, EpisodeRow.ended_at)
    .join(EpisodeRow, EpisodeRow.id == ProposalRow.episode_id)
    .where(ProposalRow.id == bindparam("proposal"))
)
_OBSERVATION = select(ObservationRow).where(
    ObservationRow.experiment_id == bindparam("experiment"), ObservationRow.uid == bindparam("uid")
)


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
        Conflict: not running (an evaluation: not idle), halted, its robot has another one open in this slot or of
            another view of the scene, or still moves.
    """
    where = {"experiment": new.experiment_id, "robot": new.robot}
    found = session.execute(_SCENE, where).one_or_none()
    if found is None:
        raise NotFound("experiment", new.experiment_id)
    experiment, episode, newest, moving = found
    if new.purpose == "training":
        must_be_running(experiment, "open a proposal")
    else:
        lifecycle.apply(state(experiment), "evaluate")
    _must_stand_still(session, new, moving)
    if episode is None or episode.purpose != new.purpose:
        if new.purpose == "training":
            raise Conflict("no episode has begun", remedy="reset the robot first")
        episode = begin_episode(session, new.experiment_id, 0, "evaluation", new.robot)
    number = (newest or 0) + 1
    known = store_gold.drawn(session, experiment, new, number)
    again = known.again if known is not None else None
    content = _content(session, new) if again is None else _once_more(session, new, again)
    observation = content.pop("observation")
    row = ProposalRow(
        experiment_id=new.experiment_id,
        robot=new.robot,
        slot=new.slot,
        episode_id=episode.id,
        observation_id=observation.id,
        number=number,
        purpose=new.purpose,
        # who has to practise first has no vote that anybody could wait for
        electorate=[
            name for name in new.electorate if may_count(session, experiment.id, experiment.practice_required, name)
        ],
        opened_at=now(),
        known_answer=known.answer if known is not None else None,
        gold_of=again.id if again is not None else None,
        audit=False,
        # today's also where it is shown again: an old one would give that away
        policy_version=new.policy_version,
        **content,
    )
    add(session, row)
    for name, value in {"episode": episode, "observation": observation, "heard": []}.items():
        set_committed_value(row, name, value)
    if new.purpose == "training":
        experiment.proposals += 1
        experiment.updated_at = now()
        save(session, experiment)
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
    found = session.connection().execute(_ENDED, {"proposal": proposal_id}).one_or_none()
    if found is None:
        raise NotFound("proposal", proposal_id)
    close_reason, verdict, ended_at = found
    if close_reason not in ("judged", "cant_tell") or verdict == schemas.Verdict.GOOD.value:
        raise Conflict(f"proposal {proposal_id} was not judged bad or neutral", remedy="propose anew")
    if ended_at is not None:
        raise Conflict(f"the episode of proposal {proposal_id} has ended", remedy="observe, then propose anew")


def close_proposal(session: Session, proposal_id: int, reason: schemas.CloseReason) -> ProposalRow:
    """Close without a verdict; one that is closed already stays as it is."""
    row = load_proposal(session, proposal_id)
    if reason in (schemas.CloseReason.JUDGED, schemas.CloseReason.CANT_TELL, schemas.CloseReason.SUPERSEDED):
        raise Conflict("only feedback judges a proposal", remedy="submit feedback")
    if row.closed_at is None:
        close(session, row, reason)
        session.flush()
        journal(session, row.experiment_id, "proposal_closed", proposal=row.id, reason=reason.value)
    return row


def _must_stand_still(session: Session, new: NewProposal, moving: int | None) -> None:
    """The slot is free, what else is open is of the same scene, and the robot doesn't move."""
    where = {"experiment": new.experiment_id, "robot": new.robot}
    for other, slot, gold_of, uid in session.connection().execute(_OPEN, where):
        if slot == new.slot:
            raise Conflict(f"proposal {other} is open", remedy="wait until it is judged, or close it")
        # a gold one may show an earlier scene again
        if gold_of is None and uid != new.observation_id:
            raise Conflict(f"proposal {other} is open for another view of the scene", remedy="close it first")
    if moving is not None:
        raise Conflict(f"execution {moving} still moves the robot", remedy="wait until it has ended")


def _observation(session: Session, new: NewProposal) -> ObservationRow:
    query = _OBSERVATION.params(experiment=new.experiment_id, uid=new.observation_id)
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
    add(session, row)
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
        "subgoal": new.subgoal,
        "views": [_view(view) for view in new.views],
    }


def _once_more(session: Session, new: NewProposal, old: ProposalRow) -> dict[str, Any]:
    """What was proposed earlier, under an observation of its own: the id of that one would tell it from all others."""
    seen = ObservationRow(
        experiment_id=new.experiment_id, uid=uuid4().hex, state=old.observation.state, taken_at=float(new.taken_at)
    )
    add(session, seen)
    return {"observation": seen} | {name: getattr(old, name) for name in CONTENT}


def _view(view: NewView) -> dict[str, object]:
    return {
        **{f.name: getattr(view, f.name) for f in dataclasses.fields(view)},
        "overlay": view.overlay.model_dump(mode="json"),
    }
