"""A store, a hub and a recorder of what it publishes, on the kinematic adapter: real processes, a real database."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from server import catalogue
from server.hub import Hub
from server.messages import FrameHeader, ProposalOpened, StreamEvent, WorkerChanged
from server.schemas import Experiment, ExperimentCreate, Feedback, FeedbackCreate, Proposal
from server.settings import Settings
from server.store import Store

PATIENCE = 120.0
"""Seconds until a test gives up on an event; generous, because the machine may be busy."""
SMALL = {"hidden_size": 16, "batch_size": 16}
"""Settings of a learner that costs nothing."""

E = TypeVar("E")


@dataclass
class Recorder:
    """A `Publisher` that keeps everything and lets tests wait for what they need."""

    shows_frames: bool = True
    events: list[StreamEvent] = field(default_factory=list)
    frames: list[tuple[FrameHeader, bytes]] = field(default_factory=list)
    _changed: asyncio.Event = field(default_factory=asyncio.Event)

    def publish(self, experiment_id: int, event: StreamEvent) -> None:
        self.events.append(event)
        self._changed.set()

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        self.frames.append((header, jpeg))
        self._changed.set()

    def of(self, kind: type[E]) -> list[E]:
        return [event for event in self.events if isinstance(event, kind)]

    async def until(self, condition: Callable[[], Any]) -> Any:
        """Wait until `condition` holds, looking after each event; returns its value."""
        async with asyncio.timeout(PATIENCE):
            while not (value := condition()):
                self._changed.clear()
                await self._changed.wait()
            return value

    async def next(self, kind: type[E], after: int = 0, *, where: Callable[[E], bool] = lambda _: True) -> E:
        """The first event of a kind at or behind position `after`."""

        def find() -> list[E]:
            return [e for e in self.events[after:] if isinstance(e, kind) and where(e)]

        found: list[E] = await self.until(find)
        return found[0]


@dataclass
class Stage:
    """What a test works with."""

    store: Store
    hub: Hub
    seen: Recorder
    settings: Settings
    _clicks: Any = field(default_factory=lambda: itertools.count(1))

    async def experiment(self, **changes: Any) -> Experiment:
        """A checked and stored experiment; small and kinematic unless told otherwise."""
        fields: dict[str, Any] = {"name": "test", "task": "stacking", "adapter": "kinematic", "settings": SMALL}
        body = catalogue.check(ExperimentCreate(**(fields | changes)))
        lockstep = body.lockstep if body.lockstep is not None else body.teacher is not None
        return await self.store.create_experiment(body, lockstep=lockstep)

    async def proposal(self, after: int = 0, *, number: int | None = None) -> Proposal:
        """The proposal that opens behind position `after`, or the one of this number."""

        def wanted(event: ProposalOpened) -> bool:
            return number is None or event.proposal.number == number

        return (await self.seen.next(ProposalOpened, after, where=wanted)).proposal

    async def worker(self, status: str, after: int = 0) -> str:
        """The first worker that is told to be of this status behind position `after`."""

        def wanted(event: WorkerChanged) -> bool:
            return event.status == status

        return (await self.seen.next(WorkerChanged, after, where=wanted)).worker

    @property
    def now(self) -> int:
        """The position behind the newest event."""
        return len(self.seen.events)

    def click(self, value: int | str, click_id: str | None = None) -> FeedbackCreate:
        return FeedbackCreate(click_id=click_id or f"test-click-{next(self._clicks)}", value=value)

    async def judge(self, proposal: Proposal, value: int) -> Feedback:
        feedback, duplicate = await self.hub.feedback(proposal.id, self.click(value))
        assert not duplicate
        return feedback


@asynccontextmanager
async def stage(data_dir: Path, **settings: Any) -> AsyncIterator[Stage]:
    """Open store and hub in `data_dir`; leaving ends every process."""
    chosen = Settings(data_dir=data_dir, robot_deadline=60, learner_deadline=60, **settings)
    store = await Store.open(None, data_dir, backup=False)
    recorder = Recorder()
    hub = Hub(store, chosen, recorder)
    await hub.start()
    try:
        yield Stage(store, hub, recorder, chosen)
    finally:
        await hub.close()
        await store.close()
