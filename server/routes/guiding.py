"""Calibrating a real robot's cameras: an operator guides the arm with a printed board in its hand."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body

from server.routes.dependencies import Id, Running, errors
from server.schemas_guiding import GuideBegin, GuideOutcome, GuideState, GuideStep, GuideTake

BEGIN: dict[str, Any] = {"the board as it comes": {"value": {"square_mm": 36, "wanted": 15}}}
TAKE: dict[str, Any] = {"take the pose": {"value": {"take": True}}}

router = APIRouter(prefix="/experiments/{experiment_id}/camera-calibration", tags=["experiments"])


@router.get("", responses=errors(404, 409, 422))
async def get_camera_calibration(service: Running, experiment_id: Id) -> GuideState:
    """What a calibration that goes on has so far, so that a page that was loaded anew goes on with it."""
    return GuideState.model_validate(await service.hub.guide_state(experiment_id))


@router.post("", responses=errors(404, 409, 413, 422))
async def begin_camera_calibration(
    service: Running, experiment_id: Id, body: Annotated[GuideBegin, Body(openapi_examples=BEGIN)]
) -> GuideStep:
    """Begin to calibrate the cameras, anew if need be, while the experiment doesn't run. Nothing moves."""
    told = await service.hub.guide(experiment_id, "guide", square=body.square_mm / 1000, wanted=body.wanted)
    return GuideStep.model_validate(told)


@router.post("/looks", responses=errors(404, 409, 413, 422))
async def look_for_the_board(
    service: Running, experiment_id: Id, body: Annotated[GuideTake, Body(openapi_examples=TAKE)]
) -> GuideStep:
    """See the board through every camera, and keep the pose if asked to and it is worth it."""
    return GuideStep.model_validate(await service.hub.guide(experiment_id, "guide_look", take=body.take))


@router.post("/solution", responses=errors(404, 409, 422))
async def solve_camera_calibration(service: Running, experiment_id: Id) -> GuideOutcome:
    """Calculate where the cameras are, and what that is worth. Nothing is stored yet."""
    return GuideOutcome.model_validate(await service.hub.guide(experiment_id, "guide_solve"))


@router.put("", responses=errors(404, 409, 422))
async def store_camera_calibration(service: Running, experiment_id: Id) -> GuideOutcome:
    """Keep the result, with what the cameras see now to notice by when one is moved: take board and arm away before."""
    return GuideOutcome.model_validate(await service.hub.guide(experiment_id, "guide_store"))
