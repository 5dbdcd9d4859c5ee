"""What an experiment leaves behind on the wire: metrics, evaluations, checkpoints and the journal."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from server.schemas import Evaluation, MetricPoint, Page, Wire


class Checkpoint(Wire):
    """A saved learner."""

    id: int
    experiment_id: int
    policy_version: int
    last_feedback_id: int
    sha256: str
    created_at: datetime


class CheckpointPage(Page):
    """Checkpoints, newest first."""

    items: list[Checkpoint]


class StoredEvent(Wire):
    """One line of the experiment's journal."""

    id: int
    kind: str
    payload: dict[str, Any]
    at: datetime


class EventPage(Page):
    """Journal lines, oldest first."""

    items: list[StoredEvent]


class MetricPage(Page):
    """Metric points, oldest first."""

    items: list[MetricPoint]


class EvaluationPage(Page):
    """Evaluations, newest first."""

    items: list[Evaluation]
