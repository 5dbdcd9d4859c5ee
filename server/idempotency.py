"""`Idempotency-Key`: a write that is sent again gets its first answer again, and happens once."""

from __future__ import annotations

import asyncio
import hashlib
import json
from collections.abc import Awaitable, Callable
from typing import Annotated
from weakref import WeakValueDictionary

from fastapi import Header, Request, Response
from fastapi.responses import JSONResponse
from pydantic import BaseModel

from server.principal import Principal
from server.store import Receipt, Store

IdempotencyKey = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        min_length=8,
        max_length=128,
        pattern=r"^[\x21-\x7e]+$",
        description="made by the client, unique per intention; the same key with the same body gets the same answer "
        "for 24 hours, with another body 409",
    ),
]

_locks: WeakValueDictionary[str, asyncio.Lock] = WeakValueDictionary()


async def once(
    store: Store, request: Request, key: str | None, status: int, act: Callable[[Receipt | None], Awaitable[BaseModel]]
) -> Response:
    """The answer of `act`, or the stored one where this key was used before.

    `act` stores its answer under the receipt in the transaction of what it did: no crash comes between.

    Raises:
        Conflict: the key was used with another body.
    """
    if key is None:
        return JSONResponse((await act(None)).model_dump(mode="json"), status)
    who: Principal | None = request.state.principal
    # the same key of somebody else is another key
    mine = "" if who is None or who.person_id is None else f"person {who.person_id}: "
    route = f"{mine}{request.method} {request.url.path}"
    lock = _locks.setdefault(f"{route} {key}", asyncio.Lock())
    async with lock:  # the same key twice at the same moment: the second waits for the first
        digest = hashlib.sha256(_canonical(await request.body())).hexdigest()
        stored = await store.idempotent(key, route, digest)
        if stored is not None:
            return JSONResponse(stored.body, stored.status)
        made = await act(Receipt(key, route, digest, status))
        return JSONResponse(made.model_dump(mode="json"), status)


def _canonical(body: bytes) -> bytes:
    """The same JSON in another spelling is the same body."""
    return json.dumps(json.loads(body or b"null"), sort_keys=True).encode()
