"""How far the critic may be trusted: its calibration, and what it approved by itself."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from server.routes.dependencies import Id, Running, errors
from server.schemas_trust import AutoApprovalRecord, Calibration

router = APIRouter(prefix="/experiments", tags=["trust"])

Newest = Annotated[int, Query(ge=20, le=100_000, description="newest judged proposals that count: the critic changes")]


@router.get("/{experiment_id}/calibration", responses=errors(404, 422))
async def get_calibration(service: Running, experiment_id: Id, newest: Newest = 200) -> Calibration:
    """Reliability curve of the predicted feedback, as it was predicted when each proposal was made."""
    return await service.store.calibration(experiment_id, newest)


@router.get("/{experiment_id}/auto-approval", responses=errors(404, 422))
async def get_auto_approval(service: Running, experiment_id: Id) -> AutoApprovalRecord:
    """What the critic approved by itself, and how often trainers agreed where it was checked."""
    return await service.store.auto_approvals(experiment_id)
