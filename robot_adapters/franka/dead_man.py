"""Stops the arm when nobody drives it any more: what moves it hasn't asked whether to stop for too long."""

from __future__ import annotations

import logging
import threading
import time

from robot_adapters.base import StopCheck
from robot_adapters.franka.arm import FrankaArm

log = logging.getLogger(__name__)

LOOK = 0.05
"""s between two looks."""


class DeadMan:
    """Watches that a motion lives, from a thread of its own. It can only stop."""

    def __init__(self, arm: FrankaArm, patience: float) -> None:
        """Watch `arm`. patience: s without a look at `should_stop`, by which a motion that lives is known."""
        self._arm = arm
        self._patience = patience
        self._alive = 0.0
        self._moving = False
        self._fired = False
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="dead man", daemon=True)
        self._thread.start()

    def guarding(self, should_stop: StopCheck) -> StopCheck:
        """Watch a motion that asks `should_stop` again and again; the answer to ask for instead."""
        self._alive, self._fired, self._moving = time.monotonic(), False, True

        def asked() -> bool:
            self._check()  # the watching thread may have been as frozen as the motion: on a busy machine it was
            self._alive = time.monotonic()
            return self._fired or should_stop()

        return asked

    def rest(self) -> None:
        """The motion has ended."""
        self._moving = False

    def close(self) -> None:
        """End the watch."""
        self._closed.set()
        self._thread.join()

    def _watch(self) -> None:
        while not self._closed.wait(LOOK):
            self._check()

    def _check(self) -> None:
        if self._moving and not self._fired and time.monotonic() - self._alive > self._patience:
            log.error("the motion hasn't asked whether to stop for %.1f s: the arm is stopped", self._patience)
            self._fired = True
            self._arm.backend.halt()
