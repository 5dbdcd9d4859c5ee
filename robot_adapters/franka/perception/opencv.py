"""Cameras that OpenCV reads: any video device, a video file, and a folder of pictures."""

from __future__ import annotations

import time
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Unavailable
from robot_adapters.franka.perception.camera import HEIGHT, WIDTH, CameraLost, Lens, Picture

PICTURES = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"}


class Captured:
    """A device or a video (`Camera`)."""

    lens: Lens | None = None

    def __init__(self, capture: cv2.VideoCapture, source: str, *, live: bool) -> None:
        self.live = live
        self._capture = capture
        self._source = source

    def read(self) -> Picture:
        """See `Camera`."""
        # what was taken while nobody read waits in the driver: it is no newer than this. It may well be older where it
        # came over a network, through buffers that nobody here knows: docs/franka-cameras.md
        taken_at = time.time()
        there, image = self._capture.read()
        if not there:
            what = "gives no more pictures" if self.live else "has come to its end"
            raise CameraLost(f"{self._source} {what}", remedy="check its cable, then resume")
        return Picture(_rgb(image), taken_at)

    def close(self) -> None:
        """See `Camera`."""
        self._capture.release()


class Folder:
    """Pictures in the order of their names (`Camera`)."""

    lens: Lens | None = None
    live = False

    def __init__(self, files: list[Path]) -> None:
        self._files = iter(files)

    def read(self) -> Picture:
        """See `Camera`."""
        path = next(self._files, None)
        if path is None:
            raise CameraLost("the folder of pictures has come to its end", remedy="play it again")
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if image is None:
            raise CameraLost(f"{path} is no picture that can be read", remedy="remove it, or save it anew as PNG")
        return Picture(_rgb(image), time.time())

    def close(self) -> None:
        """See `Camera`."""


def open_device(name: str) -> Captured:
    """The device with this number or path; without one, the first.

    Raises:
        Unavailable: there is none.
    """
    device: int | str = int(name or 0) if (name or "0").isdigit() else name
    capture = cv2.VideoCapture(device)
    if not capture.isOpened():
        raise Unavailable(f"no camera opencv:{device}", remedy="`ls /dev/video*` lists what Linux knows; plug it in")
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, WIDTH)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, HEIGHT)
    # what is asked for is to be new, not what waited in a queue
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return Captured(capture, f"opencv:{device}", live=True)


def open_video(path: str) -> Captured:
    """A video file.

    Raises:
        Unavailable: it can't be read.
    """
    capture = cv2.VideoCapture(path)
    if not capture.isOpened():
        raise Unavailable(f"{path} is no video that can be read", remedy="save it anew, e.g. as .mp4 (H.264)")
    return Captured(capture, path, live=False)


def open_folder(path: str) -> Folder:
    """A folder of pictures.

    Raises:
        Unavailable: there is none in it.
    """
    files = sorted(p for p in Path(path).iterdir() if p.suffix.lower() in PICTURES)
    if not files:
        raise Unavailable(f"no pictures in {path}", remedy="put .png or .jpg files there")
    return Folder(files)


def _rgb(image: object) -> NDArray[np.uint8]:
    found: NDArray[np.uint8] = np.ascontiguousarray(np.asarray(image, dtype=np.uint8)[..., ::-1])
    return found
