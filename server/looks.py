"""Where an experiment stands, read once for all who ask during the look before: after a restart everybody comes."""

from __future__ import annotations

import asyncio

from server.store import Store
from server.store_values import Outlook


class Looks:
    """Shared reads. A look begins after it was asked for, so nobody misses what happened in between."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._asked: dict[int, dict[str | None, asyncio.Future[Outlook]]] = {}
        self._looking: dict[int, asyncio.Task[None]] = {}

    async def at(self, experiment_id: int, trainer: str | None) -> Outlook:
        """The experiment as it is stored. trainer: whose undo is wanted.

        Raises:
            NotFound: no such experiment.
        """
        asked = self._asked.setdefault(experiment_id, {})
        if trainer not in asked:
            asked[trainer] = asyncio.get_running_loop().create_future()
        if experiment_id not in self._looking:
            looking = asyncio.create_task(self._look(experiment_id), name=f"looks at experiment {experiment_id}")
            self._looking[experiment_id] = looking
        return await asyncio.shield(asked[trainer])

    async def _look(self, experiment_id: int) -> None:
        while asked := self._asked.pop(experiment_id, None):
            try:
                found = await self._store.outlooks(experiment_id, list(asked))
            except Exception as error:  # noqa: BLE001 - handed to everyone who asked
                for future in asked.values():
                    future.set_exception(error)
            else:
                for trainer, future in asked.items():
                    future.set_result(found[trainer])
        del self._looking[experiment_id]
