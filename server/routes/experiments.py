"""Experiments: create, read, change, and the verbs of their lifecycle."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Query, Request, Response

from server.idempotency import IdempotencyKey, once
from server.routes.dependencies import Id, Limit, Running, Who, errors
from server.schemas import (
    Evaluation,
    EvaluationCreate,
    Experiment,
    ExperimentCreate,
    ExperimentPage,
    ExperimentUpdate,
    Lifecycle,
    NoFields,
)
from server.schemas_listing import MOST_TAGS, Listing, Order, Sort, Tag

router = APIRouter(prefix="/experiments", tags=["experiments"])

Exact = Annotated[str | None, Query(max_length=120, description="of this one only")]
ListCursor = Annotated[str | None, Query(max_length=2500, description="`next_cursor` of the page before")]

EXAMPLES: dict[str, Any] = {
    "simulated arm, a person judges": {
        "value": {"name": "Stacking", "task": "stacking", "adapter": "robosuite", "preset": "paper_sim"}
    },
    "no physics, a synthetic teacher judges": {
        "value": {
            "name": "Reaching, dry run",
            "task": "reaching",
            "adapter": "kinematic",
            "preset": "paper_sim",
            "settings": {},
            "seed": 1,
            "teacher": "noisy",
            "teacher_settings": {"noise": 0.05},
        }
    },
}


@router.get("", responses=errors(422))
async def list_experiments(  # noqa: PLR0917  FastAPI makes a query parameter of each
    service: Running,
    who: Who,
    task: Exact = None,
    adapter: Exact = None,
    algorithm: Exact = None,
    lifecycle: Annotated[Lifecycle | Literal["halted"] | None, Query(description="where it is")] = None,
    tag: Annotated[list[Tag], Query(max_length=MOST_TAGS, description="carries every one of these")] = [],  # noqa: B006
    text: Annotated[str | None, Query(max_length=120, description="part of the name or of a tag")] = None,
    sort: Sort = "created",
    order: Order = "desc",
    cursor: ListCursor = None,
    limit: Limit = 50,
) -> ExperimentPage:
    """Experiments, newest first unless told otherwise. A cursor goes on in the order that it came from."""
    listing = Listing(
        only=who.experiment_id,
        task=task,
        adapter=adapter,
        algorithm=algorithm,
        lifecycle=lifecycle,
        tags=tuple(tag),
        text=text,
        sort=sort,
        order=order,
    )
    return await service.hub.views(cursor, limit, listing)


@router.post("", status_code=201, response_model=Experiment, responses=errors(400, 409, 413, 422))
async def create_experiment(
    service: Running,
    request: Request,
    body: Annotated[ExperimentCreate, Body(openapi_examples=EXAMPLES)],
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Create an experiment. It stays `created` until it is started."""
    response = await once(service.store, request, idempotency_key, 201, lambda receipt: service.create(body, receipt))
    return response


@router.get("/{experiment_id}", responses=errors(404, 422))
async def get_experiment(service: Running, experiment_id: Id) -> Experiment:
    """An experiment as it is now."""
    return await service.hub.view(experiment_id)


@router.patch("/{experiment_id}", responses=errors(400, 404, 409, 413, 422))
async def update_experiment(
    service: Running,
    experiment_id: Id,
    body: Annotated[ExperimentUpdate, Body(openapi_examples={"look, don't move": {"value": {"mode": "propose_only"}}})],
) -> Experiment:
    """Change the name, the tags, the mode or the time-out, also while it runs."""
    return await service.hub.update(experiment_id, body)


VERBS = errors(404, 409, 422)
VERBS_WITH_BODY = errors(400, 404, 409, 413, 422)
Nothing = Annotated[
    NoFields | None,
    Body(description="none is needed; a field is refused with 422", openapi_examples={"nothing": {"value": {}}}),
]


@router.post("/{experiment_id}/start", responses=VERBS_WITH_BODY)
async def start_experiment(service: Running, experiment_id: Id, body: Nothing = None) -> Experiment:  # noqa: ARG001
    """Start a created experiment: its workers start, and the first proposal follows. It runs until it is paused."""
    return await service.hub.act(experiment_id, "start")


@router.post("/{experiment_id}/pause", responses=VERBS)
async def pause_experiment(service: Running, experiment_id: Id) -> Experiment:
    """Pause: a skill that runs comes to its end, an open proposal is withdrawn."""
    return await service.hub.act(experiment_id, "pause")


@router.post("/{experiment_id}/resume", responses=VERBS_WITH_BODY)
async def resume_experiment(service: Running, experiment_id: Id, body: Nothing = None) -> Experiment:  # noqa: ARG001
    """Go on, also after a failure or a restart of the service."""
    return await service.hub.act(experiment_id, "resume")


@router.post("/{experiment_id}/finish", responses=VERBS)
async def finish_experiment(service: Running, experiment_id: Id) -> Experiment:
    """End the training for good. Evaluations stay possible."""
    return await service.hub.act(experiment_id, "finish")


@router.post("/{experiment_id}/reset", responses=VERBS)
async def reset_episode(
    service: Running,
    experiment_id: Id,
    robot: Annotated[int | None, Query(ge=0, description="which robot, from 0; left out: every one")] = None,
) -> Experiment:
    """End the episode of one robot, or of every one, and begin a new one from a fresh start of the task."""
    return await service.hub.act(experiment_id, "reset", robot=robot)


@router.post("/{experiment_id}/halt", responses=VERBS)
async def halt_experiment(service: Running, experiment_id: Id) -> Experiment:
    """Emergency stop: whatever moves stops at once, and nothing moves until someone re-arms. Always allowed."""
    return await service.hub.act(experiment_id, "halt")


@router.post("/{experiment_id}/rearm", responses=VERBS)
async def rearm_experiment(service: Running, experiment_id: Id) -> Experiment:
    """Lift the emergency stop."""
    return await service.hub.act(experiment_id, "rearm")


@router.post("/{experiment_id}/archive", responses=VERBS)
async def archive_experiment(service: Running, experiment_id: Id) -> Experiment:
    """Put an ended experiment away. Its rows stay."""
    return await service.hub.act(experiment_id, "archive")


@router.post(
    "/{experiment_id}/evaluate",
    status_code=202,
    response_model=Evaluation,
    responses=errors(400, 404, 409, 413, 422),
)
async def evaluate_experiment(
    service: Running,
    request: Request,
    experiment_id: Id,
    body: Annotated[EvaluationCreate, Body(openapi_examples={"as in the paper": {"value": {"rollouts": 10}}})],
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Run the deterministic policy; it goes on in the background (see the evaluations, or the stream)."""
    return await once(
        service.store, request, idempotency_key, 202, lambda receipt: service.hub.evaluate(experiment_id, body, receipt)
    )
