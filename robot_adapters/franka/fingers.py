"""Commands to a hand whose driver waits until they are carried out: given from a thread of their own, one at a time."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Protocol

from robot_adapters.franka.backend import HandState

log = logging.getLogger(__name__)

IDLE_LOOK = 0.1
"""s between two looks at the width while nothing is asked."""
MISSES = 3
"""Looks in a row that fail until the hand counts as gone: one does where this process has been paused."""
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
    """One hand. A command that hasn't begun is replaced by a newer one, and taken back by a stop."""

    def __init__(self, connect: Callable[[], Hand], failures: tuple[type[Exception], ...]) -> None:
        """Connect to the hand; without one, every question is answered by `there=False`.

        Args:
            connect: makes the driver's connection.
            failures: what the driver raises.
        """
        self._failures = failures
        self._changed = threading.Condition()
        self._asked: str | None = None
        """What is to be done next."""
        self._doing = False
        self._closing = False
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
        with self._changed:
            return HandState(self._width, self._doing or self._asked is not None, there=self._hand is not None)

    def ask(self, what: str) -> None:
        """Begin to `grasp` or `open`."""
        if self._hand is None:
            return
        with self._changed:
            self._asked = what
            self._changed.notify()

    def stop(self) -> None:
        """Let the fingers stand still, if they move; what hasn't begun never does. What is held stays held."""
        hand = self._hand
        with self._changed:
            self._asked = None
            moving = self._doing
        if hand is not None and moving:
            try:
                hand.stop()
            except self._failures as error:
                log.warning("the hand didn't stop: %s", error)

    def close(self) -> None:
        """End the thread and the connection; a command that doesn't end isn't waited for."""
        with self._changed:
            self._closing, self._asked = True, None
            self._changed.notify()
        if self._hand is not None:
            self._thread.join(1.0)
        self._hand = None

    def _serve(self) -> None:
        hand = self._hand
        assert hand is not None
        missed = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closing or self._asked is not None, IDLE_LOOK)
                if self._closing:
                    return
                # taken and begun in one: nothing that waits, such as a look at the width, lies between
                what, self._asked = self._asked, None
                self._doing = self._doing or what is not None
            if what is not None:
                try:
                    {"grasp": hand.grasp, "open": hand.open}[what]()
                except self._failures as error:
                    log.warning("the hand didn't %s: %s", what, error)
            try:
                self._width = hand.width()  # also after a failure: the width tells what came of it
                missed = 0
            except self._failures as error:
                missed += 1
                if missed < MISSES:
                    continue  # what was done isn't over before its width is seen
                log.warning("the hand is gone: %s", error)
                self._hand = None
            with self._changed:
                self._doing = False
            if self._hand is None:
                return
