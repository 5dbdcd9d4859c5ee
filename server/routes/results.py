"""What a researcher looks at: curves of one experiment, of several beside each other, the paper's, and the tags."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import StreamingResponse

from server import comparing, export, store_curves, store_listing
from server.routes.dependencies import LARGEST_ID, Id, Running, Who, errors
from server.routes.tables import TABLE, table
from server.schemas_curves import Comparison, Curves, Grouping, Measure, PaperFigures
from server.schemas_listing import TagInfo

router = APIRouter(tags=["results"])


Points = Annotated[int, Query(ge=10, le=2000, description="about the most points of a curve")]
Experiments = Annotated[
    list[Annotated[int, Query(ge=1, le=LARGEST_ID)]],
    Query(alias="experiment", min_length=1, max_length=50, description="which, again for each one", examples=[[1, 2]]),
]
By = Annotated[
    list[Grouping],
    Query(max_length=6, description="experiments that agree in all of these are one curve; none: one each"),
]


@router.get("/experiments/{experiment_id}/curves", responses=errors(404, 422))
async def get_curves(service: Running, experiment_id: Id, points: Points = 400) -> Curves:
    """Everything that changed in an experiment, as charts."""
    return await service.store.read(lambda s: store_curves.curves(s, experiment_id, points))


@router.get(
    "/experiments/{experiment_id}/exports/metrics",
    response_class=StreamingResponse,
    responses={**errors(404, 422), **TABLE},
)
async def export_metrics(
    service: Running,
    experiment_id: Id,
    who: Who,
    form: Annotated[export.Form, Query(alias="format", description="csv, or jsonl: one JSON object a line")] = "csv",
) -> StreamingResponse:
    """Every metric point, one a label: what the learner reported and what was counted by then."""
    await service.store.experiment(experiment_id)
    pieces = export.metrics(service.store, experiment_id, form)
    return table(pieces, form, f"experiment-{experiment_id}-metrics", to=who, among=service.hub.presence)


@router.get("/comparison", responses=errors(404, 422))
async def compare_experiments(
    service: Running,
    experiment: Experiments,
    measure: Measure = "successes",
    by: By = [],  # noqa: B006  FastAPI copies it
) -> Comparison:
    """One measure of several experiments: a curve each, or mean and standard error of those that are alike."""
    return await service.store.read(lambda s: comparing.compare(s, experiment, measure, by))


@router.get("/paper-figures", responses=errors())
def get_paper_figures() -> PaperFigures:
    """What the paper's own figures and its safety table show."""
    return comparing.paper_figures()


@router.get("/tags", responses=errors())
async def list_tags(service: Running, who: Who) -> list[TagInfo]:
    """Every tag in use; for those invited to one experiment, its own."""
    return await service.store.read(lambda s: store_listing.tags(s, who.experiment_id))
