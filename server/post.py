"""The place of one worker process of an experiment: filled, cleared after a death, filled again."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from typing import Literal

from server.messages import WorkerChanged
from server.worker import OnFrame, Worker, WorkerDied

QUICK = 10.0
"""Seconds for commands that are answered within milliseconds on a machine that is well, where no deadline is shorter.

A learner looks at them between any two gradient steps, so they wait for one at most.
"""
DEATH_WINDOW = 60.0
"""Seconds for which a death is remembered."""

OnChange = Callable[[WorkerChanged], None]
Role = Literal["robot", "learner"]


class Post:
    """Holds one worker. Several loops may ask for it at once; it is started, and noted as dead, once."""

    def __init__(
        self,
        role: Role,
        prepare: Callable[[Worker], Awaitable[None]],
        on_change: OnChange,
        *,
        name: str | None = None,
        robot: int | None = None,
        on_frame: OnFrame | None = None,
    ) -> None:
        self.role: Role = role
        self.name = name or role
        self.robot = robot
        """Which robot's; None for the learner's."""
        self._prepare = prepare
        self._on_change = on_change
        self._on_frame = on_frame
        self._worker: Worker | None = None
        self._prepared = False
        self._started = False
        self._deaths: list[float] = []
        self._turn = asyncio.Lock()

    @property
    def worker(self) -> Worker:
        """Whoever is there, perhaps dead by now.

        Raises:
            WorkerDied: nobody is; it was cleared after a death.
        """
        if self._worker is None:
            raise WorkerDied(self.name, f"the {self.name} worker is not there")
        return self._worker

    @property
    def pid(self) -> int | None:
        """Process id of the living worker."""
        return self._worker.pid if self._worker is not None and self._worker.alive else None

    @property
    def ready(self) -> bool:
        """Whether a living worker is there that can be asked."""
        return self._prepared and self._worker is not None and self._worker.alive

    async def fill(self) -> None:
        """Start a worker and prepare it, unless one is there.

        Raises:
            WorkerDied: it died while it started.
            CommandFailed: it can't do its work on this machine or with these settings.
        """
        async with self._turn:
            if self.ready:
                return
            self._tell("starting", f"the {self.name} worker is starting")
            await self.clear(grace=0)  # of one whose start failed half-way
            self._worker = await Worker.spawn(self.name, f"server.workers.{self.role}", on_frame=self._on_frame)
            await self._prepare(self._worker)
            self._prepared = True
            again, self._started = self._started, True
            self._tell("restarted" if again else "ready", f"the {self.name} worker is ready")

    async def death(self) -> WorkerDied:
        """Wait for the worker to die.

        Raises:
            WorkerDied: nobody is there.
        """
        return await self.worker.death()

    async def unnoticed_death(self) -> WorkerDied | None:
        """The death of a worker that died while nobody asked it anything."""
        if self._worker is None or not self._prepared or self._worker.alive:
            return None
        return await self._worker.death()

    async def bury(self, death: WorkerDied) -> bool:
        """Tell of this death and clear the place; False where that is done already."""
        async with self._turn:
            if self._worker is None or self._worker.pid != death.pid:
                return False
            now = time.monotonic()
            self._deaths = [t for t in self._deaths if now - t < DEATH_WINDOW] + [now]
            self._tell("died", str(death))
            await self.clear(grace=0)
            return True

    @property
    def deaths(self) -> int:
        """How many there were lately."""
        return len(self._deaths)

    def forgive(self) -> None:
        """Forget earlier deaths."""
        self._deaths = []

    async def clear(self, *, grace: float = 1.0) -> None:
        """End whoever is there, if anybody."""
        worker, self._worker, self._prepared = self._worker, None, False
        if worker is not None:
            await worker.close(grace=grace)

    def stop(self, number: int) -> None:
        """Tell whoever is there to stop moving: at once, latched."""
        if self._worker is not None:
            self._worker.stop(number)

    def keep_alive(self) -> None:
        """Tell whoever is there that the robot is attended."""
        if self._worker is not None:
            self._worker.keep_alive()

    def forsake(self) -> None:
        """Tell whoever is there that nobody attends the robot any more."""
        if self._worker is not None:
            self._worker.forsake()

    def kill(self) -> None:
        """End whoever is there at once."""
        if self._worker is not None:
            self._worker.kill()

    def _tell(self, status: Literal["starting", "ready", "died", "restarted"], detail: str) -> None:
        """Tell everyone how it is with this worker."""
        self._on_change(WorkerChanged(worker=self.role, robot=self.robot, status=status, detail=detail))
