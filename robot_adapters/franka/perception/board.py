"""The ChArUco board that a camera is calibrated with: what it looks like, and its corners in a picture."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array

COLUMNS, ROWS = 7, 5
SQUARE = 0.036
"""m. With markers of 28 mm (7 modules) everything lies on a grid of 4 mm, and 252 x 180 mm fit A4 and Letter."""
MODULE = SQUARE / 9
MARKER = 7 * MODULE
ENOUGH = 8
"""Corners, of 24, with which a picture of the board is worth something."""


@dataclass(frozen=True)
class Corners:
    """Corners of the board in a picture. points: (n, 3) m, board frame. pixels: (n, 2), OpenCV's."""

    points: Array
    pixels: Array


class Board:
    """The board, as printed; `square` is the edge of a chess square as measured on the paper, m."""

    def __init__(self, square: float = SQUARE) -> None:
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_50)
        self.square = square
        self._board = cv2.aruco.CharucoBoard((COLUMNS, ROWS), square, square * MARKER / SQUARE, dictionary)
        self._detector = cv2.aruco.CharucoDetector(self._board)

    def find(self, colour: NDArray[np.uint8]) -> Corners | None:
        """The corners in a picture (h, w, 3) RGB; None where there are fewer than `ENOUGH`."""
        grey = np.asarray(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
        pixels, numbers, _, _ = self._detector.detectBoard(grey)
        if pixels is None or numbers is None or len(numbers) < ENOUGH:
            return None
        points = np.asarray(self._board.getChessboardCorners(), dtype=np.float64)[numbers.ravel()]
        if np.ptp(points[:, 0]) < self.square / 2 or np.ptp(points[:, 1]) < self.square / 2:
            return None  # all on one line: says nothing of how the board is turned
        coarse = np.asarray(pixels, dtype=np.float32).reshape(-1, 1, 2)
        return Corners(points, _refined(grey, coarse, points, self.square / 9))


def _refined(grey: NDArray[np.uint8], pixels: NDArray[np.float32], points: Array, module: float) -> Array:
    """(n, 2) the corners to a fraction of a pixel; what the detector of OpenCV 4.11 gives is half a pixel off.

    The window stays clear of the markers, which begin one `module` (m) from a corner.
    """
    distances = np.linalg.norm(points[1:] - points[0], axis=1)
    spans = np.linalg.norm((pixels[1:] - pixels[0]).reshape(-1, 2), axis=1)
    half = int(np.clip(round(0.8 * module * float(np.median(spans / distances))), 2, 5))
    until = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_COUNT, 40, 0.001)
    return np.asarray(cv2.cornerSubPix(grey, pixels, (half, half), (-1, -1), until), dtype=np.float64).reshape(-1, 2)


def modules() -> NDArray[np.bool_]:
    """(45, 63) the board as a grid of `MODULE`: True where it is black, top row first."""
    scale = 10
    size = (COLUMNS * 9 * scale, ROWS * 9 * scale)
    drawn = np.asarray(Board()._board.generateImage(size))
    black: NDArray[np.bool_] = drawn[scale // 2 :: scale, scale // 2 :: scale] < 128
    return black
