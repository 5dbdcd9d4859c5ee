"""Rows as the wire models of `server.schemas`."""

from __future__ import annotations

from collections.abc import Iterable

from server import models, schemas, schemas_records
from server.models_incidents import IncidentRow
from server.schemas_catalogue import Trainer
from server.schemas_incidents import Incident, Report, Violation
from server.schemas_labels import Relabel, answer_of
from server.schemas_quality import PracticeRequired
from server.schemas_together import Together
from server.schemas_trust import AutoApproval, VerdictSource
from server.schemas_views import View


def experiment(row: models.ExperimentRow) -> schemas.Experiment:
    """The live phase isn't stored: the hub fills it in."""
    counters = {name: getattr(row, name) for name in schemas.Counters.model_fields}
    return schemas.Experiment(
        id=row.id,
        name=row.name,
        task=row.task,
        adapter=row.adapter,
        algorithm=row.algorithm,
        preset=row.preset,
        settings=row.settings,
        adapter_settings=row.adapter_settings,
        seed=row.seed,
        mode=schemas.Mode(row.mode),
        aggregation=schemas.Aggregation(row.aggregation),
        feedback_timeout=row.feedback_timeout,
        teacher=row.teacher,
        teacher_settings=row.teacher_settings,
        lockstep=row.lockstep,
        num_envs=row.num_envs,
        lifecycle=schemas.Lifecycle(row.lifecycle),
        phase=schemas.Phase.IDLE,
        halted=row.halted,
        failure=row.failure,
        auto_approval=AutoApproval.model_validate(row.auto_approval) if row.auto_approval else None,
        auto_approval_suspended=row.auto_approval_suspended,
        gold_rate=row.gold_rate,
        together=Together.model_validate(row.together),
        practice_required=PracticeRequired.model_validate(row.practice_required) if row.practice_required else None,
        tags=[each.tag for each in row.tags],
        counters=schemas.Counters(**counters),
        created_at=row.created_at,
        updated_at=row.updated_at,
    )


def proposal(row: models.ProposalRow, heard: Iterable[str] | None = None) -> schemas.Proposal:
    """With the address of each picture. heard: whose votes count, where that is known already."""
    gate = None
    if row.gate_allowed is not None and row.gate_reason is not None:
        gate = schemas.GateDecision(allowed=row.gate_allowed, reason=row.gate_reason)
    return schemas.Proposal(
        id=row.id,
        experiment_id=row.experiment_id,
        robot=row.robot,
        slot=row.slot,
        episode=row.episode.number,
        number=row.number,
        observation_id=row.observation.uid,
        state=row.observation.state,
        skill=row.skill,
        parameters=_named(row),
        digest=row.digest,
        predicted_feedback=row.predicted_feedback,
        uncertainty=row.uncertainty,
        skill_probabilities=row.skill_probabilities,
        policy_version=row.policy_version,
        subgoal=row.subgoal,
        views=[
            View.model_validate({**view, "url": f"/api/v1/proposals/{row.id}/images/{view['camera']}"})
            for view in row.views
        ],
        opened_at=row.opened_at,
        closed_at=row.closed_at,
        close_reason=schemas.CloseReason(row.close_reason) if row.close_reason else None,
        verdict=schemas.Verdict(row.verdict) if row.verdict else None,
        verdict_source=VerdictSource(row.verdict_source) if row.verdict_source else None,
        rule=schemas.Aggregation(row.rule) if row.rule else None,
        superseded_by=row.superseded_by,
        electorate=row.electorate,
        heard=[trainer.name for trainer in row.heard] if heard is None else list(heard),
        audit=row.audit,
        gate=gate,
        purpose="evaluation" if row.purpose == "evaluation" else "training",
    )


def feedback(row: models.FeedbackRow) -> schemas.Feedback:
    """With the trainer's name, and every correction."""
    return schemas.Feedback(
        id=row.id,
        click_id=row.click_id,
        proposal_id=row.proposal_id,
        experiment_id=row.experiment_id,
        trainer=row.trainer.name,
        value=answer_of(row.value),
        label=answer_of(row.label),
        relabels=[
            Relabel(id=r.id, click_id=r.click_id, trainer=r.trainer.name, value=answer_of(r.value), at=r.at)
            for r in row.relabels
        ],
        status=schemas.FeedbackStatus(row.status),
        received_at=row.received_at,
        undone_at=row.undone_at,
        estimate_shown=row.estimate_shown,
    )


def execution(row: models.ExecutionRow) -> schemas.Execution:
    """With the call of its proposal: an execution has no parameters of its own."""
    return schemas.Execution(
        id=row.id,
        experiment_id=row.experiment_id,
        proposal_id=row.proposal_id,
        robot=row.robot,
        skill=row.proposal.skill,
        parameters=_named(row.proposal),
        started_at=row.started_at,
        ended_at=row.ended_at,
        outcome=schemas.ExecutionOutcome(row.outcome) if row.outcome else None,
        end_reason=row.end_reason,
        low_level_steps=row.low_level_steps,
        task_success=row.task_success,
        violations=[Violation.model_validate({"kind": v.kind, "detail": v.detail}) for v in row.violations],
        reports=[
            Report.model_validate(
                {
                    "report_id": r.report_id,
                    "outcome": r.outcome,
                    "note": r.note,
                    "trainer": r.trainer.name,
                    "at": r.at,
                }
            )
            for r in row.reports
        ],
    )


def incident(row: IncidentRow) -> Incident:
    """Each picture with the path under which it can be had."""
    frames = [{**frame, "url": f"/api/v1/incidents/{row.id}/frames/{index}"} for index, frame in enumerate(row.frames)]
    return Incident.model_validate(
        {
            "id": row.id,
            "experiment_id": row.experiment_id,
            "execution_id": row.execution_id,
            "kind": row.kind,
            "detail": row.detail,
            "at": row.at,
            "frames": frames,
        }
    )


def evaluation(row: models.EvaluationRow) -> schemas.Evaluation:
    """The success rate is over the rollouts that are done."""
    return schemas.Evaluation(
        id=row.id,
        experiment_id=row.experiment_id,
        feedback=row.feedback,
        policy_version=row.policy_version,
        rollouts=row.rollouts,
        successes=row.successes,
        success_rate=row.successes / row.done if row.done else 0.0,
        low_level_steps=row.low_level_steps,
        seed=row.seed,
        started_at=row.started_at,
        ended_at=row.ended_at,
    )


def metric(row: models.MetricRow) -> schemas.MetricPoint:
    """One point of a chart."""
    return schemas.MetricPoint(feedback=row.feedback, at=row.at, values=row.data)


def checkpoint(row: models.CheckpointRow) -> schemas_records.Checkpoint:
    """A saved learner."""
    return schemas_records.Checkpoint(
        id=row.id,
        experiment_id=row.experiment_id,
        policy_version=row.policy_version,
        last_feedback_id=row.last_feedback_id,
        sha256=row.sha256,
        created_at=row.created_at,
    )


def trainer(row: models.TrainerRow) -> Trainer:
    """Someone who judges."""
    return Trainer.model_validate({"id": row.id, "name": row.name, "kind": row.kind, "created_at": row.created_at})


def event(row: models.EventRow) -> schemas_records.StoredEvent:
    """A line of the journal."""
    return schemas_records.StoredEvent(id=row.id, kind=row.kind, payload=row.payload, at=row.at)


def _named(row: models.ProposalRow) -> dict[str, float]:
    return dict(zip(row.parameter_names, row.parameters, strict=True))
