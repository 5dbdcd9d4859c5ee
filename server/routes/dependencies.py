"""What the routes ask for: the running service, identifiers, cursors, and the errors they document."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Path, Query, Request

from server.access import principal
from server.errors import MEDIA_TYPE
from server.principal import Principal
from server.schemas_problems import Problem
from server.service import Service

LARGEST_ID = 2**63 - 1
"""Of an SQL BIGINT; a larger number would fail in the database instead of not being found."""

_DESCRIPTIONS = {
    400: "The body is no JSON, or nested too deeply",
    401: "Nobody is signed in",
    403: "The role doesn't allow it; or a foreign page, or a foreign host name",
    404: "Nothing has this id or name",
    409: "The state of things doesn't allow it; `current` and `allowed` say what does",
    413: "The body is too large",
    422: "A field is wrong; `fields` names it",
    429: "Too many requests; `Retry-After` says when to come again",
    500: "An error of the service's own",
    503: "Storage or a worker can't be had right now",
}


def service(request: Request) -> Service:
    """The running service."""
    running: Service = request.app.state.service
    return running


Who = Annotated[Principal, Depends(principal)]
"""Whoever calls; the role was checked before."""
Running = Annotated[Service, Depends(service)]
Id = Annotated[int, Path(ge=1, le=LARGEST_ID, examples=[1])]
Cursor = Annotated[str | None, Query(max_length=64, description="`next_cursor` of the page before; none: first page")]
Limit = Annotated[int, Query(ge=1, le=200, description="most items of a page")]


def errors(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The `responses` of a route: these, and those that any route can answer, all as problem details."""
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    return {
        status: {"model": Problem, "description": _DESCRIPTIONS[status], "content": content}
        for status in sorted({401, 403, 429, 500, 503, *statuses})
    }
