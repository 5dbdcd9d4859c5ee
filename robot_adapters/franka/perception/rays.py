"""From pixels to places: the ray through a pixel, where it meets a plane, and where two rays meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from robot_adapters.base import Array, CameraCalibration
from robot_adapters.franka.perception.camera import Lens

GRAZING = 0.1
"""Sine of the angle between ray and plane below which their meeting point says nothing (6 degrees)."""


@dataclass(frozen=True)
class View:
    """A calibrated camera: its lens, and (4, 4) from the robot base frame to its own (OpenCV's axes)."""

    lens: Lens
    camera_from_base: Array

    @property
    def eye(self) -> Array:
        """(3,) m, base frame, of the optical centre."""
        rotation = self.camera_from_base[:3, :3]
        return -rotation.T @ self.camera_from_base[:3, 3]

    def rays(self, pixels: Array) -> Array:
        """(n, 2) pixels -> (n, 3) unit directions, base frame."""
        pixels = np.asarray(pixels, dtype=np.float64).reshape(-1, 1, 2)
        flat = cv2.undistortPoints(pixels, self.lens.matrix, self.lens.distortion).reshape(-1, 2)
        directions = np.column_stack((flat, np.ones(len(flat)))) @ self.camera_from_base[:3, :3]
        unit: Array = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        return unit

    def pixels(self, points: Array) -> Array:
        """(n, 3) m, base frame -> (n, 2) pixels with the lens's distortion."""
        rotation, translation = self.camera_from_base[:3, :3], self.camera_from_base[:3, 3]
        seen, _ = cv2.projectPoints(
            np.asarray(points, dtype=np.float64).reshape(-1, 1, 3),
            cv2.Rodrigues(rotation)[0],
            translation,
            self.lens.matrix,
            self.lens.distortion,
        )
        return np.asarray(seen, dtype=np.float64).reshape(-1, 2)

    def calibration(self) -> CameraCalibration:
        """What overlays are drawn with, on pictures that have been straightened: there a pixel's centre is at +0.5."""
        matrix = self.lens.matrix.copy()
        matrix[:2, 2] += 0.5
        return CameraCalibration(self.lens.width, self.lens.height, matrix, self.camera_from_base)


def on_plane(eye: Array, directions: Array, height: float) -> Array | None:
    """(n, 3) m where rays from `eye` (3,) along (n, 3) meet the level plane at z = `height`; None where one doesn't."""
    if bool((np.abs(directions[:, 2]) < GRAZING).any()):
        return None
    lengths = (height - eye[2]) / directions[:, 2]
    if bool((lengths <= 0).any()):
        return None
    at: Array = eye + lengths[:, None] * directions
    return at


def meeting(eyes: Sequence[Array], directions: Sequence[Array]) -> tuple[Array, float] | None:
    """(3,) m, the place nearest to all rays, and the largest distance of a ray from it; None for parallel rays."""
    across = [np.eye(3) - np.outer(d, d) for d in directions]
    matrix = np.sum(across, axis=0)
    if np.linalg.eigvalsh(matrix)[0] < GRAZING**2:
        return None
    at = np.linalg.solve(matrix, np.sum([a @ e for a, e in zip(across, eyes, strict=True)], axis=0))
    return at, max(float(np.linalg.norm(a @ (at - e))) for a, e in zip(across, eyes, strict=True))
