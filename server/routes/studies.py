"""Studies: read only. They are run from the command line, and watched here."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path
from fastapi.responses import FileResponse

from server.routes.dependencies import Running, errors
from server.schemas_studies import Study, StudySummary
from server.studies import Studies

router = APIRouter(tags=["studies"])
Name = Annotated[str, Path(max_length=100, examples=["paper-sim"], description="name of the study's folder")]


# plain functions, which run beside the event loop: they read many small files
@router.get("/studies", responses=errors())
def list_studies(service: Running) -> list[StudySummary]:
    """Every study in the data directory, newest first, as far as it is now."""
    return Studies(service.settings.data_dir).summaries()


@router.get("/studies/{name}", responses=errors(404, 422))
def get_study(service: Running, name: Name) -> Study:
    """One study with its runs and its curves so far, the paper's beside them."""
    return Studies(service.settings.data_dir).study(name)


@router.get(
    "/studies/{name}/files/{file}",
    responses=errors(404) | {200: {"content": {"application/octet-stream": {}}, "description": "The file"}},
    response_class=FileResponse,
)
def get_study_file(
    service: Running, name: Name, file: Annotated[str, Path(max_length=200, examples=["reaching.png"])]
) -> FileResponse:
    """A figure (PNG or SVG) or table of a study; `files` of the study names them."""
    path = Studies(service.settings.data_dir).file(name, file)
    return FileResponse(path, headers={"Cache-Control": "no-cache"})
