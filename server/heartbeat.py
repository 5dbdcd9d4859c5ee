"""Whether a viewer's network still lives: told by what its page says again and again.

A network that dies without a word closes nothing, and the protocol's own pings take 20 to 40 s to find that out: too
long where others wait for the vote of somebody who is gone.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

BEAT = 2.0
"""Seconds between two looks; a page of ours says something every 3 s."""
ASKED_AFTER, GONE_AFTER = 2, 5
"""Looks in a row without a word until a viewer is asked whether it is there (a hidden page's timers sleep, and a
message wakes it), and until it counts as gone. Looks are counted, not seconds: what the service has slept through is
nobody's silence."""


async def beat() -> None:
    """Wait for the next look."""
    await asyncio.sleep(BEAT)


class Heartbeat:
    """One viewer's."""

    def __init__(self, ask: Callable[[], None]) -> None:
        """ask: asks the viewer to say something."""
        self._ask = ask
        self._regular = False
        self._silent = 0

    def heard(self, *, regular: bool = False) -> None:
        """It has said something. regular: and that it goes on; who never does is left to the protocol's pings."""
        self._silent = 0
        self._regular |= regular

    async def lost(self) -> float:
        """Wait until it counts as gone; for how long nothing was heard of it, s."""
        while self._silent < GONE_AFTER:
            await beat()
            self._silent += self._regular
            if self._silent == ASKED_AFTER:
                self._ask()
        return GONE_AFTER * BEAT
