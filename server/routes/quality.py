"""Label quality: known answers, everybody's figures, one's own, and the feedback as a table."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Response
from fastapi.responses import StreamingResponse

from server import export
from server.routes.dependencies import Cursor, Id, Limit, Running, Who, errors
from server.routes.tables import TABLE, table
from server.schemas_labels import TrainerName
from server.schemas_quality import GoldMark, GoldPage, LabelQuality, TrainerFigures
from server.trainer_figures import nothing_yet

router = APIRouter(tags=["quality"])

Whose = Annotated[TrainerName | None, Query(description="whose, for operators; left out: one's own")]
MARK: dict[str, Any] = {"it is bad": {"value": {"answer": -1}}}


@router.get("/experiments/{experiment_id}/quality", responses=errors(404, 422))
async def get_quality(service: Running, experiment_id: Id) -> LabelQuality:
    """Everybody's figures, and how far trainers agree."""
    return await service.store.quality.quality(experiment_id)


@router.get("/experiments/{experiment_id}/quality/mine", responses=errors(404, 422))
async def get_own_figures(service: Running, who: Who, experiment_id: Id, trainer: Whose = None) -> TrainerFigures:
    """One's own figures. Known answers are told after each fifty clicks, so that none is given away."""
    name = who.speaking_for(trainer)
    found = await service.store.quality.figures_of(experiment_id, name)
    return found or nothing_yet(name)


@router.get("/experiments/{experiment_id}/gold", responses=errors(404, 422))
async def list_gold(service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50) -> GoldPage:
    """Closed proposals whose answer was known before they were shown, with everybody's answer; newest first."""
    return await service.store.quality.gold(experiment_id, cursor, limit)


@router.put("/proposals/{proposal_id}/gold", status_code=204, responses=errors(400, 404, 409, 413, 422))
async def mark_gold(
    service: Running, who: Who, proposal_id: Id, body: Annotated[GoldMark, Body(openapi_examples=MARK)]
) -> Response:
    """Know the answer to a closed proposal: at the experiment's `gold_rate` it is shown again, among the others."""
    await service.store.quality.mark_gold(proposal_id, who.named(body))
    return Response(status_code=204)


@router.delete("/proposals/{proposal_id}/gold", status_code=204, responses=errors(404, 422))
async def unmark_gold(service: Running, proposal_id: Id) -> Response:
    """Show a marked proposal no more."""
    await service.store.quality.unmark_gold(proposal_id)
    return Response(status_code=204)


@router.get(
    "/experiments/{experiment_id}/exports/feedback",
    response_class=StreamingResponse,
    responses={**errors(404, 422), **TABLE},
)
async def export_feedback(
    service: Running,
    experiment_id: Id,
    who: Who,
    form: Annotated[export.Form, Query(alias="format", description="csv, or jsonl: one JSON object a line")] = "csv",
) -> StreamingResponse:
    """Every click with its history: corrections, late ones, those taken back, can't tell, gold, practice."""
    await service.store.experiment(experiment_id)
    pieces = export.feedback(service.store, experiment_id, form)
    return table(pieces, form, f"experiment-{experiment_id}-feedback", to=who, among=service.hub.presence)
