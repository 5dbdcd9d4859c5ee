"""Proposals and the pictures they are drawn on."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from email.utils import format_datetime
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request, Response
from fastapi.responses import FileResponse

from server.errors import ServiceError
from server.images import Images
from server.privacy import veiled
from server.routes.dependencies import Cursor, Id, Limit, Running, Who, errors
from server.schemas import Next, Proposal, ProposalPage
from server.schemas_together import NextCreate
from server.service import Service
from server.store_errors import NotFound

router = APIRouter(tags=["proposals"])

IMAGE: dict[int | str, dict[str, Any]] = {
    200: {"content": {"image/jpeg": {"schema": {"type": "string", "format": "binary"}}}, "description": "The JPEG"},
    304: {"description": "The client has it already"},
}


@router.get("/experiments/{experiment_id}/proposals", responses=errors(404, 422))
async def list_proposals(
    service: Running, who: Who, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50
) -> ProposalPage:
    """Proposals of an experiment, newest first."""
    return veiled(who, await service.store.proposals(experiment_id, cursor, limit))


@router.post("/experiments/{experiment_id}/next", responses=errors(400, 404, 413, 422))
async def next_proposal(
    service: Running,
    who: Who,
    experiment_id: Id,
    body: Annotated[NextCreate, Body(openapi_examples={"ann": {"value": {"trainer": "ann"}}})],
) -> Next:
    """The proposal that this trainer is to judge: of all robots and slots, theirs for a while; asked again, renewed.

    A page hears of it by the stream; this is for clients without one. Whoever asks is there, as long as they go on.
    """
    return veiled(who, await service.hub.seats.look(experiment_id, who.named(body).trainer))


@router.get("/proposals/{proposal_id}", responses=errors(404, 422))
async def get_proposal(service: Running, who: Who, proposal_id: Id) -> Proposal:
    """One proposal."""
    return veiled(who, await service.store.proposal(proposal_id))


@router.get(
    "/proposals/{proposal_id}/images/{camera}",
    response_class=FileResponse,
    responses={**errors(404, 422), **IMAGE},
)
async def get_image(service: Running, request: Request, proposal_id: Id, camera: str) -> Response:
    """The very still image that a proposal's overlay was computed on. It never changes: cache it for good."""
    proposal = await service.store.proposal(proposal_id)
    since = proposal.opened_at  # the file of one that is shown again may be old
    return picture(service, request, {view.camera: view.image for view in proposal.views}, camera, since)


def picture(
    service: Service, request: Request, images: Mapping[str, str], camera: str, since: datetime | None = None
) -> Response:
    """The still image of one camera, given its hash by camera. since: when it is said to be made; None: the file's.

    Raises:
        ServiceError: 404, there is no such camera, or its file is gone.
    """
    image = images.get(camera)
    if image is None:
        cameras = ", ".join(images)
        raise ServiceError(404, f"the proposal has no camera {camera!r}", remedy=f"use one of: {cameras}")
    headers = {"ETag": f'"{image}"', "Cache-Control": "private, max-age=31536000, immutable"}
    if since is not None:
        headers["Last-Modified"] = format_datetime(since, usegmt=True)
    if headers["ETag"] in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    try:
        path = Images(service.settings.data_dir).path(image)
    except NotFound as error:
        raise ServiceError(
            404,
            f"the picture of {camera} is missing on disk",
            remedy="put the images directory of the data directory back from a backup",
        ) from error
    return FileResponse(path, media_type="image/jpeg", headers=headers)
