"""Practice: proposals with known answers, each corrected at once, before a trainer's clicks count."""

from __future__ import annotations

import asyncio
import dataclasses
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request, Response
from fastapi.responses import FileResponse

from server import practising
from server.models_quality import PracticeRow
from server.routes.dependencies import Id, Running, Who, errors
from server.routes.proposals import IMAGE, picture
from server.routes.quality import Whose
from server.schemas_labels import answer_of
from server.schemas_practice import (
    PracticeAnswer,
    PracticeCard,
    PracticeCreate,
    PracticeProgress,
    PracticeReason,
    PracticeResult,
    PracticeSlip,
)
from server.schemas_views import Overlay, View
from server.service import Service

router = APIRouter(tags=["practice"])

BY_NAME: dict[str, Any] = {"by name": {"value": {"trainer": "local"}}}
ANSWER: dict[str, Any] = {"it is bad": {"value": {"click_id": "44c0b1de-77aa", "value": -1}}}


@router.get("/experiments/{experiment_id}/practice", responses=errors(404, 422))
async def get_practice(service: Running, who: Who, experiment_id: Id, trainer: Whose = None) -> PracticeProgress:
    """How a trainer does in practice, what is required, and whether their clicks count."""
    return await service.store.quality.practice_progress(experiment_id, who.speaking_for(trainer))


@router.post("/experiments/{experiment_id}/practice", responses=errors(400, 404, 409, 413, 422))
async def next_practice(
    service: Running, who: Who, experiment_id: Id, body: Annotated[PracticeCreate, Body(openapi_examples=BY_NAME)]
) -> PracticeCard:
    """The practice proposal that waits for this trainer; a new one where none does. Asked again, it is the same one."""
    body = who.named(body)
    experiment = await service.store.experiment(experiment_id)
    by, number, row = await service.store.quality.practice_place(experiment_id, body.trainer)
    if row is None:
        card = await asyncio.to_thread(practising.card, experiment, by, number, service.settings.data_dir)
        row = await service.store.quality.open_practice(experiment_id, body.trainer, number, card)
    return await _card(service, row, experiment.task, body.trainer)


@router.post("/practice/{practice_id}/answer", responses=errors(400, 404, 409, 413, 422))
async def answer_practice(
    service: Running, who: Who, practice_id: Id, body: Annotated[PracticeAnswer, Body(openapi_examples=ANSWER)]
) -> PracticeResult:
    """Judge it, and hear at once what was right and why. The same answer again gets the same correction."""
    body = who.named(body)
    row = await service.store.quality.answer_practice(practice_id, body)
    why = practising.reason(row.card["reason"])
    return PracticeResult(
        id=row.id,
        value=answer_of(row.value),
        right_answer=1 if row.known_answer > 0 else -1,
        right=row.value == row.known_answer,
        reason=PracticeReason(
            good=why.good,
            skill=why.skill,
            right_skill=why.right_skill,
            aim=why.aim,
            sideways=why.sideways,
            slips=[_slip(slip) for slip in why.slips],
            closest=None if why.closest is None else _slip(why.closest),
            text=why.text,
        ),
        right_overlays={camera: Overlay.model_validate(drawn) for camera, drawn in row.card["right"].items()},
        progress=await service.store.quality.practice_progress(row.experiment_id, body.trainer),
    )


@router.get(
    "/practice/{practice_id}/images/{camera}", response_class=FileResponse, responses={**errors(404, 422), **IMAGE}
)
async def get_practice_image(service: Running, request: Request, practice_id: Id, camera: str) -> Response:
    """The picture that a practice proposal is drawn on."""
    row = await service.store.quality.practice(practice_id)
    images = {view["camera"]: str(view["image"]) for view in row.card["views"]}
    return picture(service, request, images, camera)


async def _card(service: Service, row: PracticeRow, task: str, trainer: str) -> PracticeCard:
    shown = ("instruction", "skill", "parameters", "subgoal")
    views = [
        View.model_validate({**view, "url": f"/api/v1/practice/{row.id}/images/{view['camera']}"})
        for view in row.card["views"]
    ]
    return PracticeCard(
        id=row.id,
        experiment_id=row.experiment_id,
        number=row.number,
        task=task,
        views=views,
        opened_at=row.opened_at,
        progress=await service.store.quality.practice_progress(row.experiment_id, trainer),
        **{name: row.card[name] for name in shown},
    )


def _slip(slip: Any) -> PracticeSlip:
    drawn = dataclasses.asdict(slip)
    return PracticeSlip(axis=drawn["axis"], off_mm=1000 * drawn["off"], limit_mm=1000 * drawn["limit"])
