"""The seats of every experiment, for whoever comes by the stream or by REST."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from server.presence import Visit
from server.publisher import Publisher
from server.schemas import Next
from server.seating import Seating
from server.store import Store


class Seats:
    """Who is there, by experiment. Used from one event loop."""

    def __init__(self, store: Store, publisher: Publisher) -> None:
        self._store = store
        self._publisher = publisher
        self._seatings: dict[int, Seating] = {}

    def of(self, experiment_id: int) -> Seating:
        """Who is there to judge an experiment, and what each has before them."""
        if experiment_id not in self._seatings:
            self._seatings[experiment_id] = Seating(lambda event: self._publisher.publish(experiment_id, event))
        return self._seatings[experiment_id]

    @asynccontextmanager
    async def seated(self, experiment_id: int, trainer: str | None, visit: Visit) -> AsyncIterator[None]:
        """A page of this trainer's is open; None: somebody only watches.

        Raises:
            NotFound: no such experiment.
        """
        if trainer is None:
            yield
            return
        counts = await self._counts(experiment_id, trainer)
        seating = self.of(experiment_id)
        seating.arrive(trainer, counts=counts)
        try:
            yield
        finally:
            seating.depart(trainer, ago=visit.silence)

    async def look(self, experiment_id: int, trainer: str) -> Next:
        """They look at what they have before them, or want something to look at.

        Raises:
            NotFound: no such experiment.
        """
        counts = await self._counts(experiment_id, trainer)
        seating = self.of(experiment_id)
        seating.look(trainer, counts=counts)
        mine = seating.proposal_of(trainer)
        proposal = seating.finishing(trainer) or next((p for p in seating.opened() if p.id == mine), None)
        return Next(proposal=proposal, judge=next(judge for judge in seating.judges if judge.trainer == trainer))

    async def recount(self, experiment_id: int) -> None:
        """Another practice is required, or none: look whose clicks count now."""
        seating = self.of(experiment_id)
        names = [judge.trainer for judge in seating.judges]
        told = await asyncio.gather(*(self._counts(experiment_id, name) for name in names))
        seating.recount(dict(zip(names, told, strict=True)))

    async def _counts(self, experiment_id: int, trainer: str) -> bool:
        return (await self._store.quality.practice_progress(experiment_id, trainer)).counts
