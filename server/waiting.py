"""Waits for news that a worker's death breaks off."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

from server.worker import WorkerDied


async def news_or_death(
    news: asyncio.Event, *deaths: Coroutine[Any, Any, WorkerDied], seconds: float | None = None
) -> bool:
    """Wait for news; False if there is none within so many seconds.

    Raises:
        WorkerDied: one of these came first.
    """
    waits: set[asyncio.Future[Any]] = {asyncio.ensure_future(news.wait()), *map(asyncio.ensure_future, deaths)}
    try:
        done, _ = await asyncio.wait(waits, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for wait in waits:
            wait.cancel()
    for wait in done:
        if isinstance(death := wait.result(), WorkerDied):
            raise death
    return bool(done)
