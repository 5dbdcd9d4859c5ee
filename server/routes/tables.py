"""Tables to take away, written piece by piece to those who may still have them; and how OpenAPI describes that."""

from __future__ import annotations

import logging
from collections.abc import AsyncIterator
from typing import Any

from fastapi.responses import StreamingResponse
from starlette.types import Receive, Scope, Send

from server import export
from server.presence import Presence
from server.principal import Principal

TABLE: dict[int | str, dict[str, Any]] = {
    200: {"content": {media: {} for media in export.MEDIA_TYPES.values()}, "description": "The table"}
}
"""The answer of a route that writes any form of `export`."""

log = logging.getLogger("seed.tables")


class _LetOut(Exception):
    """Whoever takes the table away may no longer."""


class Table(StreamingResponse):
    """An answer that breaks off, without the end that it would have, where its reader's access ends meanwhile."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it. Where this returns before the end, the connection is closed: what came is known to be a part."""
        try:
            await super().__call__(scope, receive, send)
        except _LetOut as let_out:
            log.info("a download of %s breaks off: they were let out", let_out)


def table(pieces: AsyncIterator[str], form: export.Form, name: str, *, to: Principal, among: Presence) -> Table:
    """The answer; a browser keeps it as the file `name` with the form's ending.

    among: who is here, and is told of there when somebody is let out.
    """
    return Table(
        _while_let_in(pieces, to, among),
        media_type=export.MEDIA_TYPES[form],
        headers={"Content-Disposition": f'attachment; filename="{name}.{form}"'},
    )


async def _while_let_in(pieces: AsyncIterator[str], who: Principal, presence: Presence) -> AsyncIterator[str]:
    with presence.download(who) as download:
        async for piece in pieces:
            if download.cut:
                raise _LetOut(who.name)
            yield piece
