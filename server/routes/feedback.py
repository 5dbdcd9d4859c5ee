"""Feedback: click, take back, read."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query, Response

from server.errors import ServiceError, late_feedback
from server.privacy import veiled
from server.routes.dependencies import Cursor, Id, Limit, Running, Who, errors
from server.schemas import Feedback, FeedbackCreate, FeedbackPage, FeedbackStatus
from server.schemas_labels import RelabelCreate

router = APIRouter(tags=["feedback"])

CLICK = {"good": {"value": {"click_id": "9f1c2a77-3b1e", "value": 1}}}

CORRECTION = {"bad after all": {"value": {"click_id": "77ab3f02-9c1d", "value": -1}}}


Asker = Annotated[
    str | None,
    Query(max_length=64, description="who asks, where nobody signs in: another's click is nobody's to take or to see"),
]

Whose = Annotated[
    str | None,
    Query(min_length=1, max_length=64, description="only this trainer's; another's than one's own: operators only"),
]


@router.post(
    "/proposals/{proposal_id}/feedback",
    status_code=201,
    responses={
        200: {"model": Feedback, "description": "This very click is stored already"},
        **errors(400, 404, 409, 413, 422),
    },
)
async def give_feedback(
    service: Running,
    who: Who,
    response: Response,
    proposal_id: Id,
    body: Annotated[FeedbackCreate, Body(openapi_examples=CLICK)],
) -> Feedback:
    """One click. It is answered after it is stored; a late one is kept, decides nothing, and is answered 409.

    One on a proposal that another's approval closed while its trainer had it before them is `overtaken`: it trains.
    """
    feedback, duplicate = await service.hub.feedback(proposal_id, who.named(body))
    if feedback.status is FeedbackStatus.LATE:
        raise late_feedback(feedback)
    if duplicate:
        response.status_code = 200
    return feedback


@router.get("/proposals/{proposal_id}/feedback", responses=errors(404, 422))
async def list_feedback_of_proposal(
    service: Running, who: Who, proposal_id: Id, *, cursor: Cursor = None, limit: Limit = 50, trainer: Asker = None
) -> FeedbackPage:
    """Feedback on one proposal, newest first; others' only once it is closed. Whose it is: to operators."""
    told_to = (who.called(trainer) if trainer else who).name
    return veiled(who, await service.store.feedback_of_proposal(proposal_id, cursor, limit, told_to=told_to))


@router.get("/experiments/{experiment_id}/feedback", responses=errors(404, 422))
async def list_feedback(
    service: Running, who: Who, experiment_id: Id, *, cursor: Cursor = None, limit: Limit = 50, trainer: Whose = None
) -> FeedbackPage:
    """Feedback of an experiment, newest first, late and undone included; without others' on what is still open.

    One trainer's alone with `trainer`: one's own, or anybody's where an operator asks.
    """
    if trainer is not None and who.speaking_for(trainer) != trainer:
        raise ServiceError(403, f"what {trainer} said is told to operators", remedy=f"ask for your own, {who.name}'s")
    told_to = (who.called(trainer) if trainer else who).name
    found = await service.store.feedback_of_experiment(experiment_id, cursor, limit, trainer=trainer, told_to=told_to)
    return veiled(who, found)


@router.get("/feedback/{feedback_id}", responses=errors(404, 409, 422))
async def get_feedback(service: Running, who: Who, feedback_id: Id, trainer: Asker = None) -> Feedback:
    """One click as it is stored; somebody else's on an open proposal only once that is closed."""
    return veiled(who, await service.store.told(feedback_id, (who.called(trainer) if trainer else who).name))


@router.post(
    "/feedback/{feedback_id}/relabels",
    status_code=201,
    responses={
        200: {"model": Feedback, "description": "This very correction is stored already"},
        **errors(400, 404, 409, 413, 422),
    },
)
async def relabel_feedback(
    service: Running,
    who: Who,
    response: Response,
    feedback_id: Id,
    body: Annotated[RelabelCreate, Body(openapi_examples=CORRECTION)],
) -> Feedback:
    """Correct one's own click on a closed proposal, however old. The learner follows; no verdict or motion changes."""
    feedback, duplicate = await service.hub.relabel(feedback_id, who.named(body))
    if duplicate:
        response.status_code = 200
    return feedback


@router.delete("/feedback/{feedback_id}", responses=errors(404, 409, 422))
async def undo_feedback(service: Running, who: Who, feedback_id: Id, trainer: Asker = None) -> Feedback:
    """Take back a trainer's newest click, while nothing has moved; its proposal is open again."""
    return await service.hub.undo(feedback_id, by=who.asking(trainer))
