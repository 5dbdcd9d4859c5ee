"""A test double for cameras: knows from the simulated Franka where everything is, and draws plain pictures of it."""

from __future__ import annotations

import io
import time
from collections.abc import Mapping

import numpy as np
from PIL import Image, ImageDraw

from robot_adapters.base import Array, CameraCalibration, CameraFrame, Unavailable
from robot_adapters.franka.eyes import Hand, Sight
from robot_adapters.projection import project
from tests.simulators.franka import ask, connect

WIDTH, HEIGHT = 640, 480
LOOKS = {"left": np.array([0.9, 0.55, 0.35]), "right": np.array([0.9, -0.55, 0.35])}
AT = np.array([0.55, 0.0, -0.1])


class Onlooker:
    """`Eyes` that need no cameras.

    Settings: `host` of the simulator; `lost`, objects that it can't see; `joints`, what it says of what slides.
    """

    cameras = tuple(LOOKS)
    image_size = (WIDTH, HEIGHT)

    def __init__(self, task: str, settings: Mapping[str, object]) -> None:
        try:
            self._line = connect(str(settings["host"]))
        except OSError as error:
            raise Unavailable(f"the simulator doesn't answer: {error}", remedy="start it") from error
        lost = settings.get("lost", [])
        assert isinstance(lost, list)
        self._lost = dict.fromkeys([str(name) for name in lost], "hidden for 3 s")
        joints = settings.get("joints", {})
        assert isinstance(joints, dict)
        self._joints = {str(name): float(at) for name, at in joints.items()}
        self._calibrations = {name: _looking(eye) for name, eye in LOOKS.items()}

    def calibrations(self) -> Mapping[str, CameraCalibration]:
        return self._calibrations

    def refusal(self) -> str | None:
        return None

    def look(self, hand: Hand) -> Sight:
        objects = self._objects()
        now = time.time()
        return Sight(objects, dict.fromkeys(objects, now), self._joints, missing=self._lost)

    def frame(self, camera: str, *, still: bool) -> CameraFrame:
        image = Image.new("RGB", (WIDTH, HEIGHT), (210, 205, 195))
        pen = ImageDraw.Draw(image)
        for i, at in enumerate(self._objects().values()):
            ((u, v),), _ = project(self._calibrations[camera], at[None])
            pen.rectangle((u - 14, v - 14, u + 14, v + 14), fill=((214, 46, 41), (46, 158, 71))[i % 2])
        data = io.BytesIO()
        image.save(data, "JPEG", quality=80)
        return CameraFrame(camera, data.getvalue(), WIDTH, HEIGHT, time.time())

    def close(self) -> None:
        self._line.close()

    def _objects(self) -> dict[str, Array]:
        return {name: np.array(at) for name, at in ask(self._line)["blocks"].items()}


def _looking(eye: Array) -> CameraCalibration:
    """A camera at `eye` (3,) m that looks at the table's middle."""
    forward = (AT - eye) / np.linalg.norm(AT - eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([right, np.cross(forward, right), forward])
    pose[:3, 3] = -pose[:3, :3] @ eye
    lens = np.array([[600.0, 0.0, WIDTH / 2], [0.0, 600.0, HEIGHT / 2], [0.0, 0.0, 1.0]])
    return CameraCalibration(WIDTH, HEIGHT, lens, pose)
