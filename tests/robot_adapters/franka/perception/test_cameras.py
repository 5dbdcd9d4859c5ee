"""Cameras of every kind give pictures; a dead one, a frozen one and a bad file are told apart and told clearly."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from robot_adapters.base import Unavailable
from robot_adapters.franka.perception.camera import Camera, CameraLost, Lens, Picture, open_camera
from robot_adapters.franka.perception.watching import SILENT, Watch
from tests.robot_adapters.franka.perception.recording import record

LENS = Lens(160, 120, np.array([[150.0, 0.0, 79.5], [0.0, 150.0, 59.5], [0.0, 0.0, 1.0]]), np.zeros(5))


def pictures(count: int) -> list[NDArray[np.uint8]]:
    rng = np.random.default_rng(0)
    coarse = rng.integers(0, 255, (count, 12, 16, 3), dtype=np.uint8)
    return [np.kron(c, np.ones((10, 10, 1), dtype=np.uint8)) for c in coarse]


def test_a_realsense_recording_gives_the_very_pictures_with_their_depth_and_lens(tmp_path: Path) -> None:
    shot = pictures(3)
    depths = [np.full((120, 160), 0.5 + 0.1 * i, dtype=np.float32) for i in range(3)]
    camera = open_camera(record(tmp_path / "a.db3", LENS, shot, depths))
    assert camera.lens is not None
    assert np.allclose(camera.lens.matrix, LENS.matrix)
    assert not camera.live
    for colour, depth in zip(shot, depths, strict=True):
        picture = camera.read()
        assert np.array_equal(picture.colour, colour)
        assert picture.depth is not None
        # the SDK's alignment of depth to colour leaves holes, as real depth has them
        assert np.mean(np.abs(picture.depth - depth) < 0.002) > 0.9
        assert (picture.depth[np.abs(picture.depth - depth) >= 0.002] == 0).all()
    with pytest.raises(CameraLost, match="come to its end"):
        camera.read()
    camera.close()


def test_a_folder_and_a_video_give_their_pictures_in_order(tmp_path: Path) -> None:
    shot = pictures(3)
    folder = tmp_path / "stills"
    folder.mkdir()
    writer = cv2.VideoWriter(str(tmp_path / "a.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 15, (160, 120))
    for i, picture in enumerate(shot):
        cv2.imwrite(str(folder / f"{i}.png"), picture[..., ::-1])
        writer.write(np.ascontiguousarray(picture[..., ::-1]))
    writer.release()
    for source, tolerance in ((str(folder), 0), (str(tmp_path / "a.avi"), 25)):
        camera = open_camera(source)
        for colour in shot:
            off = np.abs(camera.read().colour.astype(int) - colour)
            assert np.median(off) <= tolerance
        with pytest.raises(CameraLost):
            camera.read()
        camera.close()


@pytest.mark.parametrize(
    ("source", "says"),
    [
        ("webcam", "names no camera"),
        ("nowhere.db3", "there is no recording"),
        ("opencv:97", "no camera opencv:97"),
        ("realsense:123", "no RealSense 123"),
    ],
)
def test_a_camera_that_is_not_there_is_told_with_what_to_do(source: str, says: str) -> None:
    with pytest.raises(Unavailable, match=says) as told:
        open_camera(source)
    assert told.value.remedy


@pytest.mark.parametrize("ending", [".db3", ".bag", ".mp4"])
def test_a_damaged_recording_is_told(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"no recording")
    with pytest.raises(Unavailable) as told:
        open_camera(str(path))
    assert str(path) in str(told.value)
    (tmp_path / "empty").mkdir()
    with pytest.raises(Unavailable, match="no pictures"):
        open_camera(str(tmp_path / "empty"))


class FakeDevice:
    """A device whose cable a test can pull; there is no real one here."""

    lens: Lens | None = None
    live = True

    def __init__(self) -> None:
        self.plugged = threading.Event()
        self.plugged.set()
        self.frozen = False
        self.openings = 0
        self._last = 0.0

    def read(self) -> Picture:
        if not self.plugged.wait(0.01):
            raise CameraLost("the cable is out", remedy="put it in")
        if not self.frozen:
            self._last = time.time()
        threading.Event().wait(0.005)
        return Picture(np.zeros((4, 4, 3), dtype=np.uint8), self._last)

    def close(self) -> None:
        """Nothing to release."""


@pytest.fixture
def device() -> FakeDevice:
    return FakeDevice()


@pytest.fixture
def watch(device: FakeDevice) -> Iterator[Watch]:
    def opener() -> Camera:
        if not device.plugged.is_set():
            raise Unavailable("no camera", remedy="plug it in")
        device.openings += 1
        return device

    made = Watch("left", opener)
    yield made
    made.close()


def test_the_newest_picture_is_given_and_never_an_older_one(watch: Watch) -> None:
    asked = time.time()
    picture = watch.latest(after=asked)
    assert picture.taken_at > asked
    assert watch.trouble() is None


def test_a_pulled_cable_is_noticed_and_so_is_its_return(watch: Watch, device: FakeDevice) -> None:
    watch.latest()
    device.plugged.clear()
    with pytest.raises(CameraLost, match="left: the cable is out"):
        watch.latest(after=time.time() + 1)
    assert watch.trouble() == "the cable is out"
    with pytest.raises(CameraLost, match="the cable is out"):
        watch.latest()  # not the last one before it went
    device.plugged.set()
    while watch.trouble() is not None:
        threading.Event().wait(0.01)
    assert watch.latest(after=time.time())
    assert device.openings == 2


def test_a_frozen_driver_is_noticed_by_its_stamps(watch: Watch, device: FakeDevice) -> None:
    watch.latest()
    device.frozen = True
    deadline = time.monotonic() + 10 * SILENT
    while watch.trouble() is None and time.monotonic() < deadline:
        threading.Event().wait(0.02)
    assert "no picture for" in str(watch.trouble())
    with pytest.raises(CameraLost, match="no picture for"):
        watch.latest()
