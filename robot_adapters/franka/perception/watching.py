"""The newest picture of each camera: every device is read on a thread of its own, a recording step by step."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable

from robot_adapters.base import AdapterError
from robot_adapters.franka.perception.camera import Camera, CameraLost, Lens, Picture

SILENT = 2.0
"""s without a new picture after which a camera counts as dead, unless told otherwise."""
FIRST = 8.0
"""s that the first picture may take: exposure settles, USB is set up."""
AGAIN = 1.0
"""s between two attempts to open a camera that was lost."""


class Watch:
    """One camera that is being read. One that is lost is opened again, as soon as it is there again."""

    def __init__(self, name: str, opener: Callable[[], Camera], *, silence: float = SILENT) -> None:
        """Open it, and begin to read. silence: s without a new picture after which it counts as dead.

        Raises:
            Unavailable: it can't be had.
        """
        self.name = name
        self._silence = silence
        self._open = opener
        self._camera = opener()
        self.lens: Lens | None = self._camera.lens
        self._changed = threading.Condition()
        self._newest: Picture | None = None
        self._failure: str | None = None
        self._closing = threading.Event()
        self._heard = time.monotonic()
        self._thread: threading.Thread | None = None
        if self._camera.live:
            self._thread = threading.Thread(target=self._read, name=f"camera {name}", daemon=True)
            self._thread.start()

    def latest(self, *, after: float = 0.0) -> Picture:
        """The newest picture that was taken after `after` (seconds since the epoch); waits until the camera is dead.

        A recording gives its next picture instead if an `after` is asked for.

        Raises:
            CameraLost: there is none.
        """
        if self._thread is None:
            return self._next(after)
        with self._changed:
            self._changed.wait_for(lambda: self._failure is not None or self._fresh(after), self._patience())
            # an old picture of a camera that is gone would be taken for what is there now
            if self._newest is not None and self._fresh(after) and self.trouble() is None:
                return self._newest
        raise CameraLost(f"camera {self.name}: {self.trouble() or 'no new picture'}", remedy="check its cable")

    def trouble(self) -> str | None:
        """Why it can't be relied on now, in words; None while pictures come."""
        if self._failure is not None:
            return self._failure
        if self._thread is None:
            return None
        silence = time.monotonic() - self._heard
        if silence > self._patience():
            return f"no picture for {silence:.0f} s"
        return None

    def close(self) -> None:
        """Stop reading, and release the camera."""
        self._closing.set()
        if self._thread is not None:
            self._thread.join(8.0)
        else:
            self._camera.close()

    def _patience(self) -> float:
        return self._silence if self._newest is not None else max(self._silence, FIRST)

    def _fresh(self, after: float) -> bool:
        return self._newest is not None and self._newest.taken_at > after

    def _next(self, after: float) -> Picture:
        """Of a recording."""
        if self._newest is None or after > 0:
            try:
                self._newest = self._camera.read()
            except CameraLost as lost:
                self._failure = str(lost)
                raise
        return self._newest

    def _read(self) -> None:
        while not self._closing.is_set():
            try:
                self._note(self._camera.read())
            except (AdapterError, RuntimeError, OSError) as error:  # drivers raise RuntimeError for whatever is wrong
                with self._changed:
                    self._failure = str(error)
                    self._changed.notify_all()
                self._reopen()
        self._camera.close()

    def _note(self, picture: Picture) -> None:
        with self._changed:
            # a stamp that doesn't move is a picture that was seen before: a frozen driver
            if self._newest is None or picture.taken_at != self._newest.taken_at:
                self._heard = time.monotonic()
            self._newest = picture
            self._failure = None
            self._changed.notify_all()

    def _reopen(self) -> None:
        with contextlib.suppress(RuntimeError, OSError):
            self._camera.close()
        while not self._closing.wait(AGAIN):
            with contextlib.suppress(AdapterError, RuntimeError, OSError):
                self._camera = self._open()
                return
