"""How much feedback a run is to have before it pauses itself: no teacher stores more, a person's click may."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from server.schemas import Lifecycle
from server.standing import Standing
from server.store import Store


class Quota:
    """Without `until` there is no end."""

    def __init__(self, store: Store, standing: Standing) -> None:
        self._store = store
        self._standing = standing
        self._turn = asyncio.Lock()
        self.until: int | None = None

    async def left(self) -> int | None:
        """Feedback that is still wanted; None: any amount."""
        if self.until is None:
            return None
        stored = await self._store.experiment(self._standing.experiment.id)
        return max(0, self.until - stored.counters.feedback)

    async def reached(self) -> bool:
        """Whether the wanted amount of feedback is stored; then the experiment pauses itself."""
        if await self.left() != 0:
            return False
        async with self._turn:  # several robots may find it out at once
            stored = await self._store.experiment(self._standing.experiment.id)
            if stored.lifecycle is Lifecycle.RUNNING:
                self._standing.changed(await self._store.transition(stored.id, "pause"))
        return True

    @asynccontextmanager
    async def one_more(self) -> AsyncIterator[bool]:
        """Whether a teacher may click now; nobody else is asked before that click is stored."""
        if self.until is None:
            yield True
            return
        async with self._turn:
            yield await self.left() != 0
