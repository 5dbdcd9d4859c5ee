"""Who stands at a real robot and watches it: a lease that is taken anew every few seconds, or is over."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

from server.principal import Principal
from server.store import Conflict

ANYBODY = "nobody attends the robot"


class Attendance:
    """One experiment's. Used from one event loop."""

    def __init__(
        self,
        told: Callable[[str | None], None],
        *,
        lapsed: Callable[[str], None] = lambda _: None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Begin with nobody. told: is called with the name of whoever attends from now on, None for nobody.

        lapsed: is called with the name of whoever hasn't said in time that they are still there.
        """
        self._told = told
        self._lapsed = lapsed
        self._clock = clock
        self._who: Principal | None = None
        self._until = 0.0
        self._lapse: asyncio.TimerHandle | None = None

    @property
    def who(self) -> Principal | None:
        """Who attends now."""
        return self._who if self._clock() < self._until else None

    @property
    def operator(self) -> str | None:
        """The name of who attends now."""
        return None if self.who is None else self.who.name

    @property
    def present(self) -> bool:
        """Whether anybody does."""
        return self.operator is not None

    def must_be_free_for(self, name: str) -> None:
        """Nobody else may attend it.

        Raises:
            Conflict: somebody else does.
        """
        holder = self.operator
        if holder is not None and holder != name:
            raise Conflict(f"{holder} attends the robot", remedy=f"wait until {holder} has left, or ask them to")

    def must_be(self, who: Principal) -> None:
        """What sets the arm in motion is for who stands at it, and for nobody by their leave.

        Raises:
            Conflict: nobody attends it, or somebody else does.
        """
        operator = self.operator
        if operator is None:
            raise Conflict(ANYBODY, remedy="attend it first: stand where you see it and can reach its stop button")
        if operator != who.name:
            raise Conflict(f"{operator} attends the robot, and you are {who.name}", remedy=f"leave it to {operator}")

    def take(self, who: Principal, seconds: float) -> None:
        """They attend for so long from now.

        Raises:
            Conflict: somebody else does.
        """
        self.must_be_free_for(who.name)
        holder = self.operator
        self._who, self._until = who, self._clock() + seconds
        if self._lapse is not None:
            self._lapse.cancel()
        self._lapse = asyncio.get_running_loop().call_later(seconds + 0.01, self._look)
        if holder != who.name:
            self._told(who.name)

    def leave(self, name: str) -> bool:
        """`name` attends no longer; False where they didn't."""
        if self._who is None or self._who.name != name:
            return False
        self._until, self._who = 0.0, None
        self._told(None)
        return True

    def _look(self) -> None:
        """Tell that it is over, once."""
        if self._who is not None and not self.present:
            gone, self._who = self._who, None
            self._told(None)
            self._lapsed(gone.name)
