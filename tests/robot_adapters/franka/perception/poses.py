"""Poses of the board in the robot's hand, as somebody who guides the arm would choose them, and what the robot says."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from robot_adapters.base import Array
from robot_adapters.franka.perception.board import COLUMNS, ROWS, SQUARE

HAND_NOISE = (0.0002, 0.0005)
"""Standard deviation, m and rad, of what the robot says of its hand: the Panda's repeatability is 0.1 mm."""


def transform(rotation: Array, at: Array | tuple[float, float, float]) -> Array:
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = rotation, at
    return made


BOARD_FROM_MIDDLE = np.linalg.inv(
    transform(np.diag([1.0, -1.0, -1.0]), (-COLUMNS * SQUARE / 2, ROWS * SQUARE / 2, 0.0002))
)
"""The board's own frame (x right, y down, origin in a corner) and that of the solid that is drawn."""
HAND_FROM_BOARD = transform(
    Rotation.from_euler("xyz", [5, -8, 12], degrees=True).as_matrix(), (0.03 - COLUMNS * SQUARE / 2, -0.11, 0.06)
)


def facing(eyes: list[Array], rng: np.random.Generator, *, tilt: float = 0.45) -> Array:
    """base_from_middle (4, 4): the board over the table, turned to between the cameras, then tilted somehow."""
    at = np.array([0.48, 0.0, 0.10]) + rng.uniform(-1, 1, 3) * [0.08, 0.10, 0.10]
    z = np.mean(eyes, axis=0) - at
    z /= np.linalg.norm(z)
    x = np.cross([0.0, 0.0, 1.0], z)
    x /= np.linalg.norm(x)
    turned = np.stack([x, np.cross(z, x), z], axis=1) @ Rotation.from_rotvec(rng.uniform(-tilt, tilt, 3)).as_matrix()
    return transform(turned, at)


def hand(base_from_middle: Array) -> Array:
    """base_from_hand (4, 4) that holds the board there."""
    return base_from_middle @ np.linalg.inv(BOARD_FROM_MIDDLE) @ np.linalg.inv(HAND_FROM_BOARD)


def as_told(base_from_hand: Array, rng: np.random.Generator) -> Array:
    """The same as a robot would say it."""
    slip = Rotation.from_rotvec(rng.normal(0.0, HAND_NOISE[1], 3)).as_matrix()
    return base_from_hand @ transform(slip, rng.normal(0.0, HAND_NOISE[0], 3))
