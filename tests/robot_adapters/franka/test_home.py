"""On the way home, the one motion that nobody judges: slow from the table on, and stopped at once.

The arm is a double without physics, and so are the cameras; the robot worker and the adapter are real.
"""

from __future__ import annotations

import json
import socket
import struct
import time
from collections.abc import Iterator
from typing import Any
from unittest import mock

import numpy as np
import pytest

from robot_adapters.franka import FrankaSettings, adapter, arm, connecting
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.franka.arm import HOMING_LIFT, HOMING_SPEED, PERIOD
from server.workers.channel import FrameSender, StopLatch
from server.workers.robot import REFRESH, Robot
from tests.robot_adapters.franka.conftest import TABLE, never, nothing
from tests.simulators.still_arm import StillArm

STOP = struct.pack(">I", 1)


class SlowlyHoming(StillArm):
    """Arrives only after so many looks, has something happen at each, and keeps what happens in its order."""

    def __init__(self) -> None:
        super().__init__()
        self.events: list[str] = []
        self.looks, self.happens = 10, nothing

    def start_joints(self, joints: Any) -> None:
        self.events.append("sent home")
        super().start_joints(joints)

    def joints_arrived(self) -> bool:
        self.looks -= 1
        self.happens()
        return self.looks <= 0 and super().joints_arrived()

    def halt(self) -> None:
        self.events.append("halted")
        super().halt()


@pytest.fixture
def still() -> SlowlyHoming:
    return SlowlyHoming()


@pytest.fixture
def seeing() -> mock.Mock:
    """Cameras; a test says what a look for whether they have moved does."""
    return mock.Mock(cameras=(), image_size=(640, 480), refusal=mock.Mock(return_value=None))


@pytest.fixture
def real(still: SlowlyHoming, seeing: mock.Mock) -> Iterator[FrankaAdapter]:
    with (
        mock.patch.object(connecting, "backend", return_value=still),
        mock.patch.object(adapter, "find_eyes", return_value=mock.Mock(return_value=seeing)),
        mock.patch.object(arm, "POLL", 0.0),
        mock.patch.object(arm, "HOMING_PATIENCE", 1e9),
    ):
        made = FrankaAdapter("stacking", FrankaSettings(dead_man=10.0))
        yield made
        made.close()


def test_the_way_up_from_the_table_is_slow(real: FrankaAdapter, still: SlowlyHoming) -> None:
    still.position = np.array([0.5, 0.1, TABLE + 0.02])
    assert real.home(should_stop=never, on_step=nothing)
    way = np.array([order.place for order in still.orders if order.place is not None])
    assert way[-1][2] > TABLE + HOMING_LIFT - 0.01
    assert np.linalg.norm(np.diff(way, axis=0), axis=1).max() <= HOMING_SPEED * PERIOD + 1e-6
    assert [order.what for order in still.orders][-1] == "start_joints"


def test_a_stop_waits_for_no_camera(real: FrankaAdapter, still: SlowlyHoming, seeing: mock.Mock) -> None:
    ours, theirs = socket.socketpair()
    frames, shown = socket.socketpair()
    worker = Robot(StopLatch(theirs), FrameSender(frames))
    worker._adapter = real  # `build` would connect to an arm
    seeing.refusal.side_effect = lambda: still.events.append("looked with the cameras")
    told_by = time.monotonic() + 3 * REFRESH
    still.looks = 10_000_000

    def step() -> None:
        """Somebody stops it, once there was time for looks on the way."""
        if time.monotonic() > told_by and "stop sent" not in still.events:
            still.events.append("stop sent")
            ours.send(STOP)

    still.happens = step
    began = time.monotonic()
    assert worker.home()["arrived"] is False
    took = time.monotonic() - began
    assert still.events == ["sent home", "stop sent", "halted", "halted"]
    told = _messages(shown)
    assert 1 <= len(told) <= 1 + took / REFRESH
    assert all(message["telemetry"]["mode"] for message in told)
    for line in (ours, theirs, frames, shown):
        line.close()


def _messages(line: socket.socket) -> list[dict[str, Any]]:
    """The headers of what lies in it."""
    line.setblocking(False)
    data, found = line.recv(1 << 20), []
    while data:
        size, head = struct.unpack(">II", data[:8])
        found.append(json.loads(data[8 : 8 + head]))
        data = data[4 + size :]
    return found
