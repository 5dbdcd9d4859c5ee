"""A robot worker in this process with the real Franka adapter, at the doubles `StillArm` and `StillEyes`."""

from __future__ import annotations

import contextlib
import socket
import struct
import time
from collections.abc import Iterator, Mapping
from unittest import mock

import numpy as np

from robot_adapters.base import CameraCalibration, CameraFrame, Unavailable
from robot_adapters.franka import FrankaSettings, adapter, connecting
from robot_adapters.franka.eyes import Hand, Sight
from server.workers.channel import FrameSender, StopLatch
from server.workers.robot import Robot
from tests.simulators.still_arm import StillArm

LOW, HIGH = (0.28, -0.2, -0.11), (0.75, 0.2, 0.6)
"""The workspace, m."""


class StillEyes:
    """A double for cameras: two blocks that lie where they were put. A test sets what is `lost`, `gone`, `broken`."""

    image_size = (640, 480)

    def __init__(self, cameras: tuple[str, ...] = ()) -> None:
        self.cameras = cameras
        self.lost = False
        """A block isn't seen any more."""
        self.gone = False
        """No camera gives pictures any more."""
        self.broken = False
        """Whatever is asked of what is seen is an error."""

    def calibrations(self) -> Mapping[str, CameraCalibration]:
        """See `Eyes`."""
        return {}

    def refusal(self) -> str | None:
        """See `Eyes`."""
        self._must_work()
        return "camera left is gone: no picture for 3 s" if self.gone else None

    def look(self, hand: Hand) -> Sight:
        """See `Eyes`."""
        self._must_work()
        at = {"block_a": np.array([0.50, 0.08, -0.092]), "block_b": np.array([0.60, -0.06, -0.087])}
        return Sight(at, dict.fromkeys(at, time.time()), missing={"block_a": "hidden for 3 s"} if self.lost else {})

    def frame(self, camera: str, *, still: bool) -> CameraFrame:
        """See `Eyes`."""
        if self.gone:
            raise Unavailable(f"camera {camera} is gone", remedy="check its cable")
        return CameraFrame(camera, b"\xff\xd8", *self.image_size, time.time())

    def close(self) -> None:
        """See `Eyes`."""

    def _must_work(self) -> None:
        if self.broken:
            raise Unavailable("the calibration can't be read", remedy="calibrate the camera again")


class StillWorker:
    """The worker, with what the server's side of its channels says."""

    def __init__(self, robot: Robot, stops: socket.socket, frames: socket.socket) -> None:
        self.robot, self.frames, self._stops = robot, frames, stops
        self.stops = 0
        """How often the stop was pressed."""

    def attend(self) -> None:
        """An operator is there."""
        self._stops.send(struct.pack(">I", 0))

    def stop(self) -> None:
        """The emergency stop is pressed."""
        self.stops += 1
        self._stops.send(struct.pack(">I", self.stops))


@contextlib.contextmanager
def still_worker(arm: StillArm, eyes: StillEyes, *, attended: float, dead_man: float) -> Iterator[StillWorker]:
    """Built at these doubles. attended: s without word of an operator after which a motion ends. dead_man: s."""
    stops, worker_end = socket.socketpair()
    frames, frames_end = socket.socketpair()
    with contextlib.ExitStack() as stack:
        stack.enter_context(mock.patch.object(connecting, "backend", return_value=arm))
        stack.enter_context(mock.patch.object(adapter, "find_eyes", return_value=mock.Mock(return_value=eyes)))
        robot = Robot(StopLatch(worker_end), FrameSender(frames_end))
        settings = FrankaSettings(workspace_low=LOW, workspace_high=HIGH, dead_man=dead_man)
        robot._adapter = adapter.FrankaAdapter("stacking", settings)  # `build` would look for images' place
        robot._attended = attended
        robot._images = mock.Mock(put=mock.Mock(return_value="none"))
        try:
            yield StillWorker(robot, stops, frames)
        finally:
            robot.close()
            for line in (stops, worker_end, frames, frames_end):
                line.close()
