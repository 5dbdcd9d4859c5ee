"""What an experiment leaves behind: executions, metrics, journal, evaluations, checkpoints; and who judged."""

from __future__ import annotations

from fastapi import APIRouter

from server.principal import Role
from server.privacy import veiled
from server.routes.dependencies import Cursor, Id, Limit, Running, Who, errors
from server.schemas import ExecutionPage
from server.schemas_catalogue import TrainerPage
from server.schemas_records import CheckpointPage, EvaluationPage, EventPage, MetricPage

router = APIRouter(tags=["records"])
LISTED = errors(404, 422)


@router.get("/experiments/{experiment_id}/executions", responses=LISTED)
async def list_executions(
    service: Running, who: Who, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50
) -> ExecutionPage:
    """Executions, newest first."""
    return veiled(who, await service.store.executions(experiment_id, cursor, limit))


@router.get("/experiments/{experiment_id}/metrics", responses=LISTED)
async def list_metrics(service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 200) -> MetricPage:
    """Metric points by amount of feedback, oldest first."""
    return await service.store.metrics(experiment_id, cursor, limit)


@router.get("/experiments/{experiment_id}/events", responses=LISTED)
async def list_events(
    service: Running, who: Who, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50
) -> EventPage:
    """The journal, oldest first. Which answers are known is told to operators only."""
    answers = who.role.covers(Role.OPERATOR)
    return veiled(who, await service.store.events(experiment_id, cursor, limit, answers=answers))


@router.get("/experiments/{experiment_id}/evaluations", responses=LISTED)
async def list_evaluations(
    service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50
) -> EvaluationPage:
    """Evaluations, newest first."""
    return await service.store.evaluations(experiment_id, cursor, limit)


@router.get("/experiments/{experiment_id}/checkpoints", responses=LISTED)
async def list_checkpoints(
    service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50
) -> CheckpointPage:
    """Saved learners, newest first."""
    return await service.store.checkpoints(experiment_id, cursor, limit)


@router.get("/trainers", responses=errors(422))
async def list_trainers(service: Running, cursor: Cursor = None, limit: Limit = 50) -> TrainerPage:
    """Everyone who has judged: people and teachers."""
    return await service.store.trainers(cursor, limit)
