"""What has happened and could not be stored: it is tried again until the store takes it."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Awaitable, Callable

from server.store_errors import Conflict, NotFound, StoreError

log = logging.getLogger(__name__)

RETRY = 1.0
"""Seconds between two attempts. A full disk stays full for minutes, and an attempt on it costs milliseconds."""

Write = Callable[[], Awaitable[None]]


class Owed:
    """Writes of one experiment that the store still has to take, in the order in which they came up."""

    def __init__(self, experiment_id: int) -> None:
        self._id = experiment_id
        self._writes: dict[str, Write] = {}
        self._turn = asyncio.Lock()
        self._task: asyncio.Task[None] | None = None

    def __bool__(self) -> bool:
        """Whether anything isn't stored yet."""
        return bool(self._writes)

    def add(self, what: str, write: Write) -> None:
        """Have `write` done as soon as it can be; one of the same name that still waits is done only once."""
        log.error("experiment %d: can't be stored for now: %s", self._id, what)
        self._writes.setdefault(what, write)
        if self._task is None or self._task.done():
            self._task = asyncio.create_task(self._insist(), name=f"owed writes of experiment {self._id}")

    async def settle(self) -> None:
        """Write it all now.

        Raises:
            StoreError: the store still can't; the background goes on trying.
        """
        async with self._turn:
            while self._writes:
                what, write = next(iter(self._writes.items()))
                try:
                    await write()
                except (Conflict, NotFound) as moot:
                    log.warning("experiment %d: no longer to be stored: %s: %s", self._id, what, moot)
                del self._writes[what]

    async def close(self) -> None:
        """A last attempt; what it can't write, the log has."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task
        with contextlib.suppress(StoreError):
            await self.settle()

    async def _insist(self) -> None:
        while self._writes:
            await asyncio.sleep(RETRY)
            with contextlib.suppress(StoreError):
                await self.settle()
        log.info("experiment %d: everything is stored again", self._id)
