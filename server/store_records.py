"""Metrics, evaluations, checkpoints and idempotency: what is written beside the loop of proposals."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from datetime import timedelta
from typing import Any

from sqlalchemy import delete, insert, select
from sqlalchemy.orm import Session

from server.models import (
    CheckpointRow,
    EvaluationRow,
    ExperimentRow,
    IdempotencyRow,
    MetricRow,
)
from server.models_base import table
from server.schemas import MetricPoint
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_values import StoredResponse

REMEMBERED = timedelta(hours=24)
"""How long a retried write gets its first answer again."""

_MEASURE = insert(table(MetricRow))


def add_metrics(
    session: Session, experiment_id: int, points: Sequence[tuple[int, Mapping[str, float]]]
) -> tuple[list[MetricPoint], ExperimentRow]:
    """Points of the charts: an amount of feedback and values, to which the counters of now are added.

    A value that isn't finite can't be drawn, nor written as JSON, and is left out. violation_ratio: violations over
    decision steps, which are proposals that were judged; one feedback judges one proposal as long as one trainer
    decides. The critic's count once they move.
    """
    row = load(session, experiment_id)
    counted = {name: float(getattr(row, name)) for name in ("successes", "executions", "violations")}
    written = []
    for feedback, values in points:
        ratio = {"violation_ratio": row.violations / max(1, feedback + row.auto_approved)}
        finite = {
            name: float(value) for name, value in ({**counted, **ratio, **values}).items() if math.isfinite(value)
        }
        written.append(MetricPoint(feedback=feedback, at=now(), values=finite))
    session.connection().execute(
        _MEASURE,
        [{"experiment_id": experiment_id, "feedback": p.feedback, "at": p.at, "data": p.values} for p in written],
    )
    return written, row


def metric_names(session: Session, experiment_id: int) -> list[str]:
    """What any of the points measures, by the alphabet."""
    names: set[str] = set()
    rows = select(MetricRow.data).where(MetricRow.experiment_id == experiment_id).order_by(MetricRow.id)
    for data in session.scalars(rows.execution_options(yield_per=1000)):
        names.update(data)
    return sorted(names)


def create_evaluation(
    session: Session, experiment_id: int, rollouts: int, seed: int, policy_version: int
) -> EvaluationRow:
    """An evaluation that has begun, at the amount of feedback stored now."""
    experiment = load(session, experiment_id)
    row = EvaluationRow(
        experiment_id=experiment_id,
        feedback=experiment.feedback,
        policy_version=policy_version,
        rollouts=rollouts,
        done=0,
        successes=0,
        low_level_steps=0,
        seed=seed,
        started_at=now(),
    )
    session.add(row)
    session.flush()
    journal(session, experiment_id, "evaluation_started", evaluation=row.id, rollouts=rollouts, seed=seed)
    return row


def update_evaluation(
    session: Session, evaluation_id: int, *, done: int, successes: int, low_level_steps: int, ended: bool
) -> EvaluationRow:
    """Running totals. `ended` before all rollouts are done cuts `rollouts` down to those that happened.

    Raises:
        Conflict: it has ended.
    """
    row = session.get(EvaluationRow, evaluation_id)
    if row is None:
        raise NotFound("evaluation", evaluation_id)
    if row.ended_at is not None:
        raise Conflict(f"evaluation {evaluation_id} has ended", remedy="start another one")
    row.done, row.successes, row.low_level_steps = done, successes, low_level_steps
    if ended:
        row.ended_at, row.rollouts = now(), done
        journal(session, row.experiment_id, "evaluation_ended", evaluation=row.id, successes=successes, rollouts=done)
    session.flush()
    return row


def add_checkpoint(
    session: Session, experiment_id: int, policy_version: int, last_feedback_id: int, sha256: str
) -> CheckpointRow:
    """A learner that lies on the disk by now."""
    load(session, experiment_id)
    row = CheckpointRow(
        experiment_id=experiment_id,
        policy_version=policy_version,
        last_feedback_id=last_feedback_id,
        sha256=sha256,
        created_at=now(),
    )
    session.add(row)
    session.flush()
    return row


def idempotent(session: Session, key: str, route: str, body_digest: str) -> StoredResponse | None:
    """The answer given before to this key on this route, if any.

    Raises:
        Conflict: the key was used with another body.
    """
    row = session.get(IdempotencyRow, (key, route))
    if row is None or row.created_at < now() - REMEMBERED:
        return None
    if row.body_digest != body_digest:
        raise Conflict("this Idempotency-Key was used with another body", remedy="make a new key for every request")
    return StoredResponse(row.status, json.loads(row.body))


def remember(session: Session, key: str, route: str, body_digest: str, *, status: int, body: Any) -> None:
    """Keep an answer for a retry; answers older than a day go. The first answer to a key stays."""
    session.execute(delete(IdempotencyRow).where(IdempotencyRow.created_at < now() - REMEMBERED))
    if idempotent(session, key, route, body_digest) is None:
        session.add(
            IdempotencyRow(
                key=key,
                route=route,
                body_digest=body_digest,
                status=status,
                body=json.dumps(body),
                created_at=now(),
            )
        )
