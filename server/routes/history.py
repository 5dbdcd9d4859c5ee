"""What happened in an experiment, proposal by proposal and episode by episode: from the database alone."""

from __future__ import annotations

from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query

from server import store_history, store_timeline
from server.privacy import veiled
from server.routes.dependencies import LARGEST_ID, Cursor, Id, Limit, Running, Who, errors
from server.schemas_history import Episode, EpisodePage, HistoryFilter, HistoryPage, Label, Timeline

router = APIRouter(prefix="/experiments/{experiment_id}", tags=["history"])

Number = Annotated[int, Path(ge=1, le=LARGEST_ID, description="the episode's number in its experiment")]


@router.get("/history", responses=errors(404, 422))
async def list_history(  # noqa: PLR0917  FastAPI makes a query parameter of each
    service: Running,
    who: Who,
    experiment_id: Id,
    skill: Annotated[str | None, Query(max_length=120)] = None,
    verdict: Literal["good", "neutral", "bad", "none"] | None = None,
    label: Annotated[Label | None, Query(description="somebody says so by now")] = None,
    executed: bool | None = None,
    violation: bool | None = None,
    episode: Annotated[int | None, Query(ge=1, le=LARGEST_ID, description="its number")] = None,
    purpose: Literal["training", "evaluation"] | None = None,
    order: Literal["asc", "desc"] = "desc",
    cursor: Cursor = None,
    limit: Limit = 50,
) -> HistoryPage:
    """Closed proposals, each with its clicks and its execution."""
    wanted = HistoryFilter(
        skill=skill,
        verdict=verdict,
        label=label,
        executed=executed,
        violation=violation,
        episode=episode,
        purpose=purpose,
        order=order,
    )
    found = await service.store.read(lambda s: store_history.history(s, experiment_id, wanted, cursor, limit))
    return veiled(who, found)


@router.get("/timeline", responses=errors(404, 422))
async def get_timeline(
    service: Running,
    experiment_id: Id,
    stretches: Annotated[int, Query(ge=10, le=200, description="into at most how many the time is divided")] = 60,
) -> Timeline:
    """Labels on closed proposals over time, and the motions among them: counted, whoever gave them."""
    return await service.store.read(lambda s: store_timeline.timeline(s, experiment_id, stretches))


@router.get("/episodes", responses=errors(404, 422))
async def list_episodes(service: Running, experiment_id: Id, cursor: Cursor = None, limit: Limit = 50) -> EpisodePage:
    """Episodes with what happened in each, counted; newest first."""
    return await service.store.read(lambda s: store_history.episodes(s, experiment_id, cursor, limit))


@router.get("/episodes/{number}", responses=errors(404, 422))
async def get_episode(service: Running, experiment_id: Id, number: Number) -> Episode:
    """One episode; its steps are the history with `episode` and `order=asc`."""
    return await service.store.read(lambda s: store_history.episode(s, experiment_id, number))
