"""What an experiment does in the background: one piece of work at a time, each of which can be told to leave."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable, Coroutine
from typing import Any

from server.principal import SERVICE, acting

Work = Callable[[asyncio.Event], Coroutine[Any, Any, None]]
"""Takes the event that tells it to end at its next step. It deals with its own errors."""


class Course:
    """Runs one piece of work after another."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._leave = asyncio.Event()
        self.task: asyncio.Task[None] | None = None
        """The newest piece of work."""

    @property
    def busy(self) -> bool:
        """Whether something goes on."""
        return self.task is not None and not self.task.done()

    def follow(self, work: Work) -> None:
        """Start `work` once what goes on has ended. Each has a leave event of its own."""
        previous, self._leave = self.task, asyncio.Event()
        leave = self._leave

        async def follow() -> None:
            # whoever started it is not who decides what comes of it
            acting.set(SERVICE)
            if previous is not None:
                await asyncio.wait({previous})
            await work(leave)

        self.task = asyncio.create_task(follow(), name=self._name)

    def leave(self) -> None:
        """Tell what goes on to end at its next step."""
        self._leave.set()

    async def idle(self) -> None:
        """Wait until nothing goes on."""
        while self.task is not None and not self.task.done():
            await asyncio.wait({self.task})

    async def end(self, grace: float) -> None:
        """Wait until nothing goes on; what still does after `grace` seconds is cut off."""
        if self.task is None or self.task.done():
            return
        _, late = await asyncio.wait({self.task}, timeout=grace)
        for task in late:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
