"""What went wrong: reports on executions, and incidents with the video of the seconds before."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Response
from fastapi import Path as InPath
from fastapi.responses import FileResponse

from server.errors import ServiceError
from server.images import Images
from server.privacy import veiled
from server.routes.dependencies import Cursor, Id, Limit, Running, Who, errors
from server.schemas import Execution
from server.schemas_incidents import Incident, IncidentPage, ReportCreate

router = APIRouter(tags=["incidents"])

SEEN: dict[str, Any] = {"it slipped": {"value": {"report_id": "5b1de0a4-report", "outcome": "failed"}}}
JPEG: dict[int | str, dict[str, Any]] = {200: {"content": {"image/jpeg": {}}, "description": "The picture"}}


@router.post(
    "/executions/{execution_id}/reports",
    status_code=201,
    responses={
        200: {"model": Execution, "description": "This very report is stored already"},
        **errors(400, 404, 409, 413, 422),
    },
)
async def report_execution(
    service: Running,
    who: Who,
    response: Response,
    execution_id: Id,
    body: Annotated[ReportCreate, Body(openapi_examples=SEEN)],
) -> Execution:
    """Say what an execution did, where the robot can't tell by itself. Its own outcome and the counters stay."""
    execution, duplicate = await service.store.report_execution(execution_id, who.named(body))
    if duplicate:
        response.status_code = 200
    return execution


@router.get("/executions/{execution_id}", responses=errors(404, 422))
async def get_execution(service: Running, who: Who, execution_id: Id) -> Execution:
    """One execution."""
    return veiled(who, await service.store.execution(execution_id))


@router.get("/experiments/{experiment_id}/incidents", responses=errors(404, 422))
async def list_incidents(service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 20) -> IncidentPage:
    """Safety violations and emergency stops, newest first, each with its video."""
    return await service.store.incidents(experiment_id, cursor, limit)


@router.get("/incidents/{incident_id}", responses=errors(404, 422))
async def get_incident(service: Running, incident_id: Id) -> Incident:
    """One incident."""
    return await service.store.incident(incident_id)


@router.get(
    "/incidents/{incident_id}/frames/{index}", response_class=FileResponse, responses={**errors(404, 422), **JPEG}
)
async def get_incident_frame(service: Running, incident_id: Id, index: Annotated[int, InPath(ge=0)]) -> Response:
    """One picture of an incident's video. It never changes: cache it for good."""
    incident = await service.store.incident(incident_id)
    if index >= len(incident.frames):
        raise ServiceError(
            404, f"the incident has no picture {index}", remedy=f"it has {len(incident.frames)}, counted from 0"
        )
    path = Images(service.settings.data_dir).path(incident.frames[index].image)
    return FileResponse(
        path, media_type="image/jpeg", headers={"Cache-Control": "private, max-age=31536000, immutable"}
    )
