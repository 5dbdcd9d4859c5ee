"""AprilTags in a picture: which ones there are, and where their centres and corners are, to a tenth of a pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array, Unavailable

FAMILY = "tag36h11"
"""587 tags that differ in at least 11 of 36 bits; what most robotics labs print."""
MARGIN = 20.0
"""Contrast between a tag's dark and light modules (of 255) below which a reading isn't trusted."""


@dataclass(frozen=True)
class Tag:
    """A tag in a picture. centre: (2,) and corners: (4, 2), in pixels of OpenCV (whole numbers at pixels' centres).

    The corners are those of the black square, in the order of `square`.
    """

    number: int
    centre: Array
    corners: Array


def square(size: float) -> Array:
    """(4, 3) m, corners of a tag of this size in its own frame: x right, y up as it is read, z towards the reader."""
    h = size / 2
    return np.array([[-h, -h, 0.0], [h, -h, 0.0], [h, h, 0.0], [-h, h, 0.0]])


def modules(number: int) -> NDArray[np.bool_]:
    """(8, 8) a tag as its family draws it, True where it is black, top row first; around it goes a white rim."""
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    drawn = np.asarray(cv2.aruco.generateImageMarker(dictionary, number, 8))
    # OpenCV draws them upside down
    black: NDArray[np.bool_] = drawn[::-1, ::-1] < 128
    return black


class TagDetector:
    """Finds tags of `FAMILY`. Keep one: it is costly to make."""

    def __init__(self, *, threads: int = 1) -> None:
        """Load the detector.

        Raises:
            Unavailable: it isn't installed.
        """
        try:
            from pyapriltags import Detector  # noqa: PLC0415  only who looks for tags needs it
        except ImportError as error:
            raise Unavailable(
                f"pyapriltags can't be imported: {error}", remedy="pip install 'seed-robot[franka]'"
            ) from error
        # decimated to half the size, tags of 3 cm are missed at a metre
        self._detector: Any = Detector(families=FAMILY, nthreads=threads, quad_decimate=1.0)

    def find(self, colour: NDArray[np.uint8]) -> tuple[Tag, ...]:
        """The tags in a picture (h, w, 3) RGB. A number that appears twice is left out: which of them is ours?"""
        grey = cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY)
        found = [
            # this library counts pixels from their corners, OpenCV from their centres
            Tag(int(d.tag_id), np.array(d.center, dtype=np.float64) - 0.5, np.array(d.corners, dtype=np.float64) - 0.5)
            for d in cast("list[Any]", self._detector.detect(grey))
            if d.hamming == 0 and d.decision_margin >= MARGIN
        ]
        numbers = [tag.number for tag in found]
        return tuple(tag for tag in found if numbers.count(tag.number) == 1)
