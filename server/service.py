"""Store, stream and hub opened together and closed in order; the HTTP app and the command line both stand on it."""

from __future__ import annotations

import asyncio
import fcntl
import logging
import os
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from server import catalogue, privacy, store_names
from server.critic import Critics
from server.database import Elsewhere
from server.doors import Doors
from server.errors import ServiceError
from server.hub import Hub
from server.measuring import Measuring
from server.publisher import Publisher
from server.schemas import Experiment, ExperimentCreate, Lifecycle
from server.schemas_problems import Readiness
from server.settings import Settings
from server.store import Receipt, Store
from server.store_errors import StoreError
from server.stream import Rooms

log = logging.getLogger("seed")

# real time, so that a person can follow the arm and has time to stop it; few clicks, so that they see it learn
FIRST_EXPERIMENT = ExperimentCreate(
    name="Stacking", task="stacking", adapter="robosuite", adapter_settings={"speed": 1.0}, preset="recommended"
)


class DataDirInUse(ServiceError):
    """Another process of the service owns the data directory."""


@dataclass(frozen=True)
class Service:
    """What a running service consists of."""

    settings: Settings
    store: Store
    rooms: Rooms
    hub: Hub
    doors: Doors
    critics: Critics

    async def create(self, body: ExperimentCreate, receipt: Receipt | None = None) -> Experiment:
        """Check a new experiment and store it, with the answer that a retry gets.

        Raises:
            ServiceError: 422, naming the wrong fields.
        """
        resolved = catalogue.check(body)
        lockstep = resolved.lockstep if resolved.lockstep is not None else resolved.teacher is not None
        return await self.store.create_experiment(resolved, lockstep=lockstep, receipt=receipt)

    async def readiness(self) -> Readiness:
        """Whether the database answers, and whether every experiment that should run still does."""
        checks = {"store": "ok", "workers": "ok"}
        troubles: dict[int, str] = {}
        try:
            failed = [e for e in (await self.hub.views(limit=200)).items if e.lifecycle is Lifecycle.FAILED]
            troubles = await self.hub.troubles()
        except StoreError as error:
            checks["store"] = f"{error}; {error.remedy}"
        else:
            # one that has failed waits for a person: the service is well
            told = {e.id: str(e.failure) for e in failed} | troubles
            if told:
                checks["workers"] = "; ".join(f"experiment {number}: {why}" for number, why in sorted(told.items()))
        return Readiness(ready=checks["store"] == "ok" and not troubles, checks=checks)


@asynccontextmanager
async def opened(
    settings: Settings, listener: Publisher | None = None, *, elsewhere: Elsewhere | None = None
) -> AsyncIterator[Service]:
    """A running service; on leaving, its workers end and its database closes. `listener` hears instead of viewers.

    elsewhere: a process that does the writes.

    Raises:
        DataDirInUse: another process serves from this directory; two hubs on one store would run a robot twice.
        StoreError: the database can't be used; the remedy says what to do.
    """
    with _owned(settings.data_dir):
        store = await Store.open(settings.database_url, settings.data_dir, elsewhere=elsewhere)
        try:
            # a first write: a database that can't be written fails here, and not at somebody's first click
            await store.remember("start", "start", "", 200, None)
            privacy.learn(await store.read(store_names.misnamed))
            rooms = Rooms(queue_limit=settings.viewer_queue)
            measuring = Measuring(listener or rooms, store)
            hub = Hub(store, settings, measuring)
            await hub.start()
            critics = Critics(store, settings, hub)
            doors = Doors(settings, store)
            watching = asyncio.create_task(doors.watch(hub), name="doors")
            try:
                yield Service(settings, store, rooms, hub, doors, critics)
            finally:
                watching.cancel()
                await critics.close()
                await measuring.close()
                try:
                    await hub.close()
                except StoreError as error:
                    log.warning("experiments could not be paused, the next start does it: %s. %s", error, error.remedy)
        finally:
            await store.close()


async def create_first(service: Service) -> Experiment | None:
    """The *Stacking* experiment on robosuite, so that a fresh start has something to open; None where there is one."""
    if not service.settings.create_first_experiment:
        return None
    if (await service.store.experiments(limit=1)).items:
        return None
    try:
        return await service.create(FIRST_EXPERIMENT)
    except ServiceError as error:
        log.warning("there is no first experiment: %s. %s", error, error.remedy)
        return None


@contextmanager
def _owned(directory: Path) -> Iterator[None]:
    """Hold the directory's lock; the kernel lets go of it when the process ends, however it ends."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        lock = os.open(directory / ".lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
    except OSError as error:
        raise ServiceError(
            503,
            f"the data directory {directory} can't be written: {error.strerror}",
            remedy="make it writable for this user, or choose another with --data-dir or SEED_DATA_DIR",
            slug="read-only",
        ) from error
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise DataDirInUse(
                503,
                f"another process is using the data directory {directory}",
                remedy="stop that one first, or choose another directory with --data-dir",
                slug="data-dir-in-use",
            ) from error
        yield
    finally:
        os.close(lock)
