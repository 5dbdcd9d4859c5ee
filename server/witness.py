"""What the cameras saw in the seconds before a safety violation or an emergency stop, kept beside the database."""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Callable
from typing import Any

from server.images import Images
from server.messages import FrameHeader, IncidentKept
from server.store import Store, StoreError

log = logging.getLogger(__name__)

SECONDS = 8.0
"""How much of the live video is remembered, by the pictures' own clock."""


class Witness:
    """Remembers the newest live pictures of one experiment, and writes them down when something goes wrong."""

    def __init__(
        self, experiment_id: int, store: Store, images: Images, publish: Callable[[IncidentKept], None]
    ) -> None:
        self._id = experiment_id
        self._store = store
        self._images = images
        self._publish = publish
        self._recent: deque[tuple[FrameHeader, bytes]] = deque()
        self._writing: set[asyncio.Task[None]] = set()

    def see(self, header: FrameHeader, jpeg: bytes) -> None:
        """Remember a picture, and forget those that are too old by now."""
        self._recent.append((header, jpeg))
        while self._recent[0][0].taken_at < header.taken_at - SECONDS:
            self._recent.popleft()

    def tell(self, kind: str, detail: str, *, execution_id: int | None = None, robot: int | None = None) -> None:
        """Write an incident down with what is remembered, soon: nobody waits for it, a stop least of all."""
        seen = [(header, jpeg) for header, jpeg in self._recent if robot is None or header.robot == robot]
        task = asyncio.create_task(self._write(kind, detail, execution_id, seen), name=f"incident of {self._id}")
        self._writing.add(task)
        task.add_done_callback(self._writing.discard)

    async def settled(self) -> None:
        """Wait until everything is written."""
        while self._writing:
            await asyncio.wait(self._writing)

    async def _write(
        self, kind: str, detail: str, execution_id: int | None, seen: list[tuple[FrameHeader, bytes]]
    ) -> None:
        try:
            hashes = await asyncio.to_thread(lambda: [self._images.put(jpeg) for _, jpeg in seen])
            frames: list[dict[str, Any]] = [
                {
                    "camera": header.camera,
                    "robot": header.robot,
                    "width": header.width,
                    "height": header.height,
                    "taken_at": header.taken_at,
                    "image": image,
                }
                for (header, _), image in zip(seen, hashes, strict=True)
            ]
            kept = await self._store.add_incident(
                self._id, execution_id=execution_id, kind=kind, detail=detail, frames=frames
            )
            self._publish(IncidentKept(incident_id=kept.id, kind=kept.kind))
        except StoreError:
            # the violation itself is stored with its execution, and the halt with its experiment
            log.exception("experiment %d: an incident's video could not be stored", self._id)
