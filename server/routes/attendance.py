"""At a real robot: who attends it, and what an operator may ask of the arm itself."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query

from server.names import must_be_a_persons
from server.principal import Principal
from server.routes.dependencies import Id, Running, Who, errors
from server.schemas import Experiment
from server.schemas_attendance import Attending, OperatorName

EXAMPLES: dict[str, Any] = {"for five seconds": {"value": {"operator": "anna", "seconds": 5}}}

Ordering = Annotated[OperatorName | None, Query(description="who orders it, where nobody signs in")]

router = APIRouter(prefix="/experiments/{experiment_id}", tags=["experiments"])


@router.put("/attendance", responses=errors(404, 409, 413, 422))
async def attend(
    service: Running, who: Who, experiment_id: Id, body: Annotated[Attending, Body(openapi_examples=EXAMPLES)]
) -> Attending:
    """Say that you stand at the robot and watch it. Say it again before the time is over: else whatever moves stops."""
    if who.local:
        must_be_a_persons(body.operator, "operator")
    operator = who.called(body.operator)
    await service.hub.attend(experiment_id, operator, body.seconds)
    return body.model_copy(update={"operator": operator.name})


@router.delete("/attendance", status_code=204, responses=errors(404, 422))
async def leave(service: Running, who: Who, experiment_id: Id, operator: Annotated[OperatorName, Query()]) -> None:
    """Leave the robot: what moves stops, and nothing moves until somebody attends it again."""
    await service.hub.leave(experiment_id, who.called(operator).name)


@router.post("/recover", responses=errors(404, 409, 422))
async def recover(service: Running, who: Who, experiment_id: Id, operator: Ordering = None) -> Experiment:
    """Clear a collision reflex, once who attends it has looked. After a user stop only releasing the button helps."""
    return await service.hub.tend(experiment_id, "recover", _ordering(who, operator))


@router.post("/home", responses=errors(404, 409, 422))
async def home(service: Running, who: Who, experiment_id: Id, operator: Ordering = None) -> Experiment:
    """Bring the arm slowly to where it is out of the way: at once, by no proposal, for who attends it only."""
    return await service.hub.tend(experiment_id, "home", _ordering(who, operator))


def _ordering(who: Principal, operator: str | None) -> Principal:
    return who if operator is None else who.called(operator)
