"""Estimates trainers anew in the background while clicks come, seldom enough that nobody waits for it."""

from __future__ import annotations

import asyncio
import logging
import time

from server.messages import FeedbackStored, FeedbackUndone, FrameHeader, StreamEvent
from server.publisher import Publisher
from server.store import Store, StoreError

log = logging.getLogger(__name__)

EVERY = 5.0
"""Seconds between two estimates at least; one over thousands of labels takes a fraction of one, on another thread."""
SHARE = 10
"""Those over a million take seconds: estimates are computed no more than about a tenth of the time."""


class Measuring:
    """A `Publisher` that hands everything on, and has an experiment's trainers measured after their clicks."""

    def __init__(self, publisher: Publisher, store: Store, *, every: float = EVERY) -> None:
        self.shows_frames = publisher.shows_frames
        self._publisher = publisher
        self._store = store
        self._every = every
        self._due: set[int] = set()
        self._task: asyncio.Task[None] | None = None
        self._closed = False

    def publish(self, experiment_id: int, event: StreamEvent) -> None:
        """Hand it on first."""
        self._publisher.publish(experiment_id, event)
        if not self._closed and isinstance(event, FeedbackStored | FeedbackUndone):
            self._due.add(experiment_id)
            if self._task is None or self._task.done():
                self._task = asyncio.create_task(self._measure(), name="measuring trainers")

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        """Hand it on."""
        self._publisher.publish_frame(experiment_id, header, jpeg)

    async def close(self) -> None:
        """Measure no more; what isn't estimated yet will be after the next click."""
        self._closed = True
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})

    async def _measure(self) -> None:
        while self._due:
            began = time.monotonic()
            for experiment_id in tuple(self._due):
                self._due.discard(experiment_id)
                try:
                    await self._store.quality.measure(experiment_id)
                except StoreError as error:
                    log.warning("experiment %d: its trainers could not be measured: %s", experiment_id, error)
            await asyncio.sleep(max(self._every, SHARE * (time.monotonic() - began)))
