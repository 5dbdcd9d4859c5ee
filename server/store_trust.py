"""What the database says of the critic: its calibration, its own approvals, and their audits. One transaction each."""

from __future__ import annotations

from dataclasses import dataclass

from sqlalchemy import func, or_, select
from sqlalchemy.orm import Session, aliased

from agent.trust import reliability, wilson
from server import auto_approval, lifecycle
from server.auto_approval import Decision
from server.models import ExperimentRow, FeedbackRow, ProposalRow
from server.schemas import Lifecycle, Mode, Proposal, Verdict
from server.schemas_trust import AutoApproval, AutoApprovalRecord, Calibration, CalibrationBin, VerdictSource
from server.store_experiments import journal, load, now, state
from server.store_proposals import load_proposal
from server.store_votes import judge
from server.store_wire import proposal as proposal_wire

NEEDED = 20
"""Labels before which a calibration is told: two a bin on average; with fewer the error is mostly chance."""


@dataclass(frozen=True)
class Considered:
    """What became of a proposal. suspended: auto-approval has just suspended itself."""

    decision: Decision
    proposal: Proposal
    suspended: bool = False


def calibration(session: Session, experiment_id: int, newest: int) -> Calibration:
    """The reliability curve over the `newest` judged proposals; several trainers' labels of one count as their mean.

    What was predicted when the proposal was made, not what today's critic says of it: that one was trained on the
    answer. For the same reason a call that was judged before in the same situation counts the first time only.
    """
    load(session, experiment_id)
    earlier = aliased(ProposalRow)
    known = select(earlier.id).where(
        earlier.observation_id == ProposalRow.observation_id,
        earlier.digest == ProposalRow.digest,
        earlier.number < ProposalRow.number,
        earlier.verdict.is_not(None),
    )
    label = select(func.avg(FeedbackRow.label)).where(
        FeedbackRow.proposal_id == ProposalRow.id, FeedbackRow.status == "stored", FeedbackRow.undone_at.is_(None)
    )
    query = (
        select(ProposalRow.predicted_feedback, label.scalar_subquery())
        .where(
            ProposalRow.experiment_id == experiment_id,
            ProposalRow.verdict_source == VerdictSource.TRAINERS.value,
            ~known.exists(),
        )
        .order_by(ProposalRow.number.desc())
        .limit(newest)
    )
    told = reliability([(predicted, float(mean)) for predicted, mean in session.execute(query) if mean is not None])
    return Calibration(
        experiment_id=experiment_id,
        labels=told.count,
        needed=NEEDED,
        error=told.error if told.count >= NEEDED else None,
        bins=[
            CalibrationBin(low=b.low, high=b.high, count=b.count, predicted=b.predicted, label=b.label)
            for b in told.bins
        ],
    )


def record(session: Session, experiment_id: int) -> AutoApprovalRecord:
    """What the critic approved by itself, and how far trainers agreed where it was checked."""
    experiment = load(session, experiment_id)
    audited, agreed = _audits(session, experiment)
    return AutoApprovalRecord(
        experiment_id=experiment_id,
        rule=_rule(experiment),
        suspended=experiment.auto_approval_suspended,
        approved=experiment.auto_approved,
        audited=audited,
        agreed=agreed,
        agreement=agreed / audited if audited else None,
        interval=wilson(agreed, audited),
    )


def consider(session: Session, proposal_id: int, *, simulated: bool) -> Considered:
    """Decide on the open proposal by the experiment's rule; an approval is its verdict, with the critic as its source.

    A proposal that a trainer has had a say on, also one that was taken back, stays the trainers'. So does one whose
    answer is known: where the critic would have approved it, it looks like an audit, and isn't counted as one.
    """
    proposal = load_proposal(session, proposal_id)
    experiment = load(session, proposal.experiment_id)
    rule = _rule(experiment) if holds(experiment, proposal) else None
    asked = Considered(Decision.ASK, proposal_wire(proposal))
    touched = select(FeedbackRow.id).where(FeedbackRow.proposal_id == proposal_id).limit(1)
    if (
        rule is None
        or state(experiment) != lifecycle.State(Lifecycle.RUNNING)
        or proposal.closed_at is not None
        or proposal.purpose != "training"
        or proposal.audit
        or session.scalar(touched) is not None
    ):
        return asked
    audited, agreed = _audits(session, experiment)
    if auto_approval.too_low(rule, audited, agreed):
        _suspend(session, experiment, rule, audited, agreed)
        return Considered(Decision.ASK, asked.proposal, suspended=True)
    case = auto_approval.Case(
        predicted=proposal.predicted_feedback,
        uncertainty=proposal.uncertainty,
        simulated=simulated,
        mode=Mode(experiment.mode),
        feedback=experiment.feedback,
        qualified=_qualified(session, experiment),
        seed=experiment.seed,
    )
    decision = auto_approval.decide(rule, case)
    if decision is Decision.ASK:
        return asked
    if proposal.known_answer is not None:
        decision = Decision.AUDIT
    if decision is Decision.AUDIT:
        proposal.audit = True
    else:
        judge(session, proposal, Verdict.GOOD, VerdictSource.CRITIC)
    session.flush()
    journal(
        session,
        experiment.id,
        "auto_approved" if decision is Decision.APPROVE else "auto_approval_audit",
        proposal=proposal_id,
        digest=proposal.digest,
        predicted_feedback=proposal.predicted_feedback,
        uncertainty=proposal.uncertainty,
        policy_version=proposal.policy_version,
        feedback=experiment.feedback,
        rule=rule.model_dump(),
    )
    return Considered(decision, proposal_wire(proposal))


def holds(experiment: ExperimentRow, proposal: ProposalRow) -> bool:
    """Whether the experiment's rule covers this proposal: it is on, and was set before the proposal was opened."""
    on = experiment.auto_approval is not None and experiment.auto_approval_suspended is None
    return on and proposal.number > experiment.auto_approval_since


def _rule(experiment: ExperimentRow) -> AutoApproval | None:
    return None if experiment.auto_approval is None else AutoApproval.model_validate(experiment.auto_approval)


def _qualified(session: Session, experiment: ExperimentRow) -> int:
    query = select(func.count(ProposalRow.id)).where(
        ProposalRow.experiment_id == experiment.id,
        ProposalRow.number > experiment.auto_approval_since,
        or_(ProposalRow.audit, ProposalRow.verdict_source == VerdictSource.CRITIC.value),
    )
    return session.scalar(query) or 0


def _audits(session: Session, experiment: ExperimentRow) -> tuple[int, int]:
    """The newest audits that trainers judged since the rule was set, and how many of them were called good."""
    query = (
        select(ProposalRow.verdict)
        .where(
            ProposalRow.experiment_id == experiment.id,
            ProposalRow.number > experiment.auto_approval_since,
            ProposalRow.audit,
            ProposalRow.known_answer.is_(None),
            ProposalRow.verdict.is_not(None),
        )
        .order_by(ProposalRow.number.desc())
        .limit(auto_approval.WINDOW)
    )
    verdicts = session.scalars(query).all()
    return len(verdicts), verdicts.count(Verdict.GOOD.value)


def _suspend(session: Session, experiment: ExperimentRow, rule: AutoApproval, audited: int, agreed: int) -> None:
    low, high = wilson(agreed, audited)
    experiment.auto_approval_suspended = (
        f"trainers called {agreed} of {audited} audited proposals good: the 95 % interval of that share,"
        f" {low:.0%} to {high:.0%}, lies below {rule.agreement_at_least:.0%}"
    )
    experiment.updated_at = now()
    session.flush()
    journal(
        session,
        experiment.id,
        "auto_approval_suspended",
        audited=audited,
        agreed=agreed,
        interval=[low, high],
        agreement_at_least=rule.agreement_at_least,
    )
