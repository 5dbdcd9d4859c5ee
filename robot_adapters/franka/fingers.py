"""Commands to a hand whose driver waits until they are carried out: given from a thread of their own, one at a time."""

from __future__ import annotations

import logging
import queue
import threading
from collections.abc import Callable
from typing import Protocol

from robot_adapters.franka.backend import HandState

log = logging.getLogger(__name__)

IDLE_LOOK = 0.1
"""s between two looks at the width while nothing is asked."""
SPEED = 0.1
"""m/s of the fingers; the hand's own limit."""
GRASP_FORCE = 20.0
"""N: holds half a kilogram with rubber tips, and crushes no toy."""
WIDEST = 0.08
"""m: what fingers open to, and what a grasp may end at: the width tells what was taken, not the hand's own verdict."""


class Hand(Protocol):
    """A driver's hand; each call waits for its end and raises what its driver raises."""

    def width(self) -> float:
        """M between the fingers."""

    def grasp(self) -> None:
        """Close on what is there."""

    def open(self) -> None:
        """Open all the way."""

    def stop(self) -> None:
        """Let the fingers stand still; may come from another thread."""


class Fingers:
    """One hand. The newest command wins over one that hasn't begun."""

    def __init__(self, connect: Callable[[], Hand], failures: tuple[type[Exception], ...]) -> None:
        """Connect to the hand; without one, every question is answered by `there=False`.

        Args:
            connect: makes the driver's connection.
            failures: what the driver raises.
        """
        self._failures = failures
        self._asked: queue.Queue[str] = queue.Queue()
        self._pending = 0
        self._lock = threading.Lock()
        self._hand: Hand | None = None
        self._width = 0.0
        try:
            self._hand = connect()
            self._width = self._hand.width()
        except failures as error:
            log.warning("no hand: %s", error)
            return
        self._thread = threading.Thread(target=self._serve, name="fingers", daemon=True)
        self._thread.start()

    @property
    def state(self) -> HandState:
        """What was seen last."""
        return HandState(self._width, self._pending > 0, there=self._hand is not None)

    def ask(self, what: str) -> None:
        """Begin to `grasp` or `open`."""
        if self._hand is None:
            return
        with self._lock:
            self._pending += 1
        self._asked.put(what)

    def stop(self) -> None:
        """Let the fingers stand still, if they move."""
        if self._hand is not None and self._pending:
            try:
                self._hand.stop()
            except self._failures as error:
                log.warning("the hand didn't stop: %s", error)

    def close(self) -> None:
        """End the thread and the connection; a command that doesn't end isn't waited for."""
        self._asked.put("")
        if self._hand is not None:
            self._thread.join(1.0)
        self._hand = None

    def _serve(self) -> None:
        hand = self._hand
        assert hand is not None
        while True:
            try:
                what = self._asked.get(timeout=IDLE_LOOK)
            except queue.Empty:
                what = "look"
            if not what:
                return
            try:
                if what != "look":
                    {"grasp": hand.grasp, "open": hand.open}[what]()
                self._width = hand.width()
            except self._failures as error:
                if what == "look":
                    log.warning("the hand is gone: %s", error)
                    self._hand = None
                    return
                log.warning("the hand didn't %s: %s", what, error)
            finally:
                if what != "look":
                    with self._lock:
                        self._pending -= 1
