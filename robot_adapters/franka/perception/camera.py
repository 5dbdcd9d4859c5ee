"""The `Camera` protocol: something that gives one picture after the other, and what is known of its lens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import AdapterError, Array, Unavailable

WIDTH, HEIGHT = 1280, 720
"""Pixels asked of a device: a tag of 2 cm is 20 pixels wide at 0.9 m, enough for its 8 modules."""

KINDS = {
    "realsense": "realsense:open_device",
    "opencv": "opencv:open_device",
    ".db3": "realsense:open_recording",
    ".bag": "realsense:open_recording",
    ".mp4": "opencv:open_video",
    ".avi": "opencv:open_video",
    ".mkv": "opencv:open_video",
}
"""Kind of device before the colon of a source, or ending of a file, and what opens it."""


class CameraLost(AdapterError):
    """A camera that was there gives no pictures any more; a recording has come to its end."""


@dataclass(frozen=True)
class Lens:
    """How a camera maps directions to pixels: OpenCV's model, in which a pixel's centre has whole coordinates.

    matrix: (3, 3) in pixels. distortion: (5,) k1 k2 p1 p2 k3, all zero for a pinhole.
    """

    width: int
    height: int
    matrix: Array
    distortion: Array


@dataclass(frozen=True)
class Picture:
    """One picture. colour: (h, w, 3) RGB. depth: (h, w) m along the optical axis, aligned with it, 0 where unknown.

    taken_at: seconds since the epoch.
    """

    colour: NDArray[np.uint8]
    taken_at: float
    depth: NDArray[np.float32] | None = None


class Camera(Protocol):
    """A source of pictures. Opened by `open_camera`, read from one thread."""

    lens: Lens | None
    """What the device tells of its lens; None where it knows nothing, or in a model that isn't OpenCV's."""
    live: bool
    """False for a recording, which waits for its reader."""

    def read(self) -> Picture:
        """Wait for the next picture.

        Raises:
            CameraLost: there is none: the device is gone, or the recording is over.
        """

    def close(self) -> None:
        """Release it."""


def open_camera(source: str) -> Camera:
    """Open what `source` names.

    `realsense` or `realsense:SERIAL`; `opencv:0` or `opencv:/dev/video2`; a RealSense recording (.db3, .bag), a video
    (.mp4, .avi, .mkv), or a folder of pictures, which are read in the order of their names.

    Raises:
        Unavailable: it can't be had; the remedy says what to do.
    """
    kind, _, rest = source.partition(":")
    if kind in {"realsense", "opencv"}:
        return _opener(kind)(rest)
    path = Path(source)
    if path.is_dir():
        return cast("Callable[[str], Camera]", import_module(f"{__package__}.opencv").open_folder)(source)
    if path.suffix not in KINDS:
        endings = ", ".join(sorted(k for k in KINDS if k.startswith(".")))
        raise Unavailable(
            f"{source!r} names no camera",
            remedy=f"write realsense:SERIAL, opencv:0, a file ({endings}) or a folder of pictures",
        )
    if not path.is_file():
        raise Unavailable(f"there is no recording {source}", remedy="check the path")
    return _opener(path.suffix)(source)


def _opener(kind: str) -> Callable[[str], Camera]:
    module, name = KINDS[kind].split(":")
    return cast("Callable[[str], Camera]", getattr(import_module(f"{__package__}.{module}"), name))
