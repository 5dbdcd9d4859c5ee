"""The gate and the executions behind it. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session

from robot_adapters.base import SafetyViolation
from server import gate, schemas, schemas_trust, store_trust, store_votes
from server.models import ExecutionRow, ExperimentRow, FeedbackRow, ProposalRow, TrainerRow
from server.models_incidents import ViolationRow
from server.store_closing import close
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_labels import labels_of
from server.store_proposals import load_proposal
from server.store_values import StoredLabel
from server.store_wire import proposal as proposal_wire


def begin(
    session: Session,
    proposal_id: int,
    *,
    current_observation_id: str,
    operator_present: bool,
    simulated: bool,
    workspace_ok: bool,
    unclear: str,
) -> tuple[schemas.GateDecision, ExecutionRow | None]:
    """Ask the gate with everything re-read, store its answer, and `started` where it is open.

    A proposal is decided once: asked again, it is answered as before and nothing more is started.
    """
    proposal = load_proposal(session, proposal_id)
    if proposal.closed_at is None:
        # an undo was quicker: this isn't the proposal's decision, that one comes with its next verdict
        return schemas.GateDecision(allowed=False, reason="it is open again"), None
    if proposal.gate_allowed is not None:
        reason = "it was executed already" if proposal.gate_allowed else str(proposal.gate_reason)
        return schemas.GateDecision(allowed=False, reason=reason), None
    moving = select(ExecutionRow.id).where(
        ExecutionRow.experiment_id == proposal.experiment_id,
        ExecutionRow.robot == proposal.robot,
        ExecutionRow.ended_at.is_(None),
    )
    if (running := session.scalar(moving)) is not None:
        raise Conflict(f"execution {running} still moves the robot", remedy="wait until it has ended")
    experiment = load(session, proposal.experiment_id)
    decision = _decide(
        session,
        experiment,
        proposal,
        simulated=simulated,
        operator_present=operator_present,
        workspace_ok=workspace_ok,
        observation_current=current_observation_id == proposal.observation.uid,
        unclear=unclear,
    )
    proposal.gate_allowed, proposal.gate_reason = decision.allowed, decision.reason
    journal(session, experiment.id, "gate", proposal=proposal_id, allowed=decision.allowed, reason=decision.reason)
    if not decision.allowed:
        session.flush()
        return decision, None
    if proposal.purpose == "training":
        _supersede(session, proposal)
    row = ExecutionRow(experiment_id=experiment.id, robot=proposal.robot, proposal=proposal, started_at=now())
    session.add(row)
    if proposal.purpose == "training":
        experiment.executions += 1
        experiment.auto_approved += _by_critic(proposal)
        experiment.updated_at = now()
    session.flush()
    journal(
        session,
        experiment.id,
        "execution_started",
        execution=row.id,
        proposal=proposal_id,
        digest=proposal.digest,
        approved_by=_approvers(session, proposal),
    )
    return decision, row


def _approvers(session: Session, proposal: ProposalRow) -> list[str]:
    """Whose judgement lets it move: those who said good, or what stands in for them."""
    if proposal.verdict_source != schemas_trust.VerdictSource.TRAINERS:
        return [str(proposal.verdict_source)]
    query = (
        select(TrainerRow.name)
        .join(FeedbackRow, FeedbackRow.trainer_id == TrainerRow.id)
        .where(FeedbackRow.proposal_id == proposal.id, FeedbackRow.status == "stored", FeedbackRow.value == 1)
        .where(FeedbackRow.undone_at.is_(None))
        .order_by(FeedbackRow.id)
    )
    return list(session.scalars(query))


def superseded_by(session: Session, proposal_id: int) -> tuple[list[schemas.Proposal], list[StoredLabel]]:
    """The proposals that this one's approval has closed or overtaken, oldest first, and the labels that train by it."""
    query = select(ProposalRow).where(ProposalRow.superseded_by == proposal_id).order_by(ProposalRow.number)
    rows = session.scalars(query).all()
    closed = [row for row in rows if row.close_reason == schemas.CloseReason.SUPERSEDED]
    return [proposal_wire(row) for row in rows], [label for row in closed for label in labels_of(session, row.id)]


def end(
    session: Session,
    execution_id: int,
    *,
    outcome: schemas.ExecutionOutcome,
    end_reason: str | None,
    low_level_steps: int,
    task_success: bool,
    violations: Sequence[SafetyViolation],
) -> ExecutionRow:
    """Write the outcome, once. Steps and violations of training are counted.

    Raises:
        Conflict: it has an outcome already, e.g. `interrupted`.
    """
    row = session.get(ExecutionRow, execution_id)
    if row is None:
        raise NotFound("execution", execution_id)
    if row.outcome is not None:
        raise Conflict(f"execution {execution_id} has ended: {row.outcome}", remedy="read it; an outcome never changes")
    at = now()
    row.outcome, row.end_reason, row.ended_at = outcome.value, end_reason, at
    row.low_level_steps, row.task_success = low_level_steps, task_success
    for violation in violations:
        session.add(
            ViolationRow(
                experiment_id=row.experiment_id,
                execution_id=row.id,
                kind=violation.kind,
                detail=violation.detail,
                at=at,
            )
        )
    if row.proposal.purpose == "training":
        experiment = load(session, row.experiment_id)
        experiment.low_level_steps += low_level_steps
        experiment.violations += len(violations)
        experiment.updated_at = at
    session.flush()
    session.refresh(row, ["violations"])
    journal(
        session,
        row.experiment_id,
        "execution_ended",
        execution=row.id,
        outcome=outcome.value,
        end_reason=end_reason,
        violations=[violation.kind for violation in violations],
    )
    for violation in violations:
        if violation.kind == "damage":
            journal(
                session,
                row.experiment_id,
                "incident",
                execution=row.id,
                proposal=row.proposal_id,
                detail=violation.detail,
            )
    return row


def _supersede(session: Session, approved: ProposalRow) -> None:
    """The robot moves by this one: its other proposals for the same scene are closed, those approved too late are shut.

    Votes on them still train.
    """
    others = select(ProposalRow).where(
        ProposalRow.experiment_id == approved.experiment_id,
        ProposalRow.robot == approved.robot,
        ProposalRow.id != approved.id,
        ProposalRow.purpose == "training",
    )
    for row in session.scalars(others.where(ProposalRow.closed_at.is_(None))):
        close(session, row, schemas.CloseReason.SUPERSEDED)
        row.superseded_by = approved.id
        journal(session, row.experiment_id, "proposal_closed", proposal=row.id, reason=row.close_reason)
    late = others.where(
        ProposalRow.episode_id == approved.episode_id,
        ProposalRow.verdict == schemas.Verdict.GOOD.value,
        ProposalRow.gate_allowed.is_(None),
    )
    for row in session.scalars(late):
        row.gate_allowed, row.gate_reason, row.superseded_by = False, "another proposal was approved first", approved.id
        journal(session, row.experiment_id, "gate", proposal=row.id, allowed=False, reason=row.gate_reason)


def _decide(
    session: Session,
    experiment: ExperimentRow,
    proposal: ProposalRow,
    *,
    simulated: bool,
    operator_present: bool,
    workspace_ok: bool,
    observation_current: bool,
    unclear: str,
) -> schemas.GateDecision:
    verdict = schemas.Verdict(proposal.verdict) if proposal.verdict else None
    lifecycle = schemas.Lifecycle(experiment.lifecycle)
    if proposal.purpose == "evaluation":
        return gate.decide_evaluation(
            verdict=verdict,
            lifecycle=lifecycle,
            halted=experiment.halted,
            simulated=simulated,
            workspace_ok=workspace_ok,
            observation_current=observation_current,
        )
    return gate.decide(
        mode=schemas.Mode(experiment.mode),
        by_critic=_by_critic(proposal),
        auto_approval=store_trust.holds(experiment, proposal),
        gold=proposal.known_answer is not None,
        verdict=verdict,
        rule_stands=verdict is schemas.Verdict.GOOD and store_votes.stands(session, experiment, proposal),
        lifecycle=lifecycle,
        halted=experiment.halted,
        simulated=simulated,
        operator_present=operator_present,
        workspace_ok=workspace_ok,
        observation_current=observation_current,
        unclear=unclear,
    )


def _by_critic(proposal: ProposalRow) -> bool:
    return proposal.verdict_source == schemas_trust.VerdictSource.CRITIC.value
