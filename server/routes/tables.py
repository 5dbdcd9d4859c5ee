"""Tables to take away, written piece by piece: the answer, and how OpenAPI describes it."""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Any

from fastapi.responses import StreamingResponse

from server import export

TABLE: dict[int | str, dict[str, Any]] = {
    200: {"content": {media: {} for media in export.MEDIA_TYPES.values()}, "description": "The table"}
}
"""The answer of a route that writes any form of `export`."""


def table(pieces: AsyncIterator[str], form: export.Form, name: str) -> StreamingResponse:
    """The answer; a browser keeps it as the file `name` with the form's ending."""
    return StreamingResponse(
        pieces,
        media_type=export.MEDIA_TYPES[form],
        headers={"Content-Disposition": f'attachment; filename="{name}.{form}"'},
    )
