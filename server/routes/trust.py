"""How far the critic may be trusted: its calibration, and what it approved by itself."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from server.errors import invalid
from server.routes.dependencies import Id, Running, errors
from server.schemas_critic import ConsideredList, CriticMap
from server.schemas_problems import FieldProblem
from server.schemas_trust import AutoApprovalRecord, Calibration

router = APIRouter(tags=["trust"])

Newest = Annotated[int, Query(ge=20, le=100_000, description="newest judged proposals that count: the critic changes")]


@router.get("/experiments/{experiment_id}/calibration", responses=errors(404, 422))
async def get_calibration(service: Running, experiment_id: Id, newest: Newest = 200) -> Calibration:
    """Reliability curve of the predicted feedback, as it was predicted when each proposal was made."""
    return await service.store.calibration(experiment_id, newest)


@router.get("/experiments/{experiment_id}/auto-approval", responses=errors(404, 422))
async def get_auto_approval(service: Running, experiment_id: Id) -> AutoApprovalRecord:
    """What the critic approved by itself, and how often trainers agreed where it was checked."""
    return await service.store.auto_approvals(experiment_id)


Held = Annotated[
    list[Annotated[str, Query(max_length=60)]],
    Query(max_length=8, description="a parameter beside x and y, the same everywhere", examples=[["z=-0.09"]]),
]


@router.get("/proposals/{proposal_id}/critic", responses=errors(404, 409, 422))
async def get_critic_map(
    service: Running,
    proposal_id: Id,
    skill: Annotated[str | None, Query(max_length=120, description="left out: the proposal's own")] = None,
    points: Annotated[int, Query(ge=5, le=64, description="of the map's longer side")] = 33,
    other: Held = [],  # noqa: B006  FastAPI copies it
) -> CriticMap:
    """What the critic expects of a skill all over the table, in this proposal's situation, and what was said nearby."""
    return await service.critics.look(proposal_id, skill, points, dict(_pair(each) for each in other))


@router.get("/proposals/{proposal_id}/considered", responses=errors(404, 409, 422))
async def get_considered(service: Running, proposal_id: Id) -> ConsideredList:
    """What the agent would do with each skill in this proposal's situation: with which parameters, and where."""
    return await service.critics.consider(proposal_id)


def _pair(text: str) -> tuple[str, float]:
    name, _, number = text.partition("=")
    try:
        return name, float(number)
    except ValueError:
        raise invalid(
            [FieldProblem(field="other", message=f"{text!r} is no name=number")], remedy="write it as in other=z=-0.09"
        ) from None
