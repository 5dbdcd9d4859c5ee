"""Where a fixed camera is, from a board in the robot's hand: `cv2.calibrateHandEye`, then refined on the pixels.

The chain is pixel <- camera <- base <- hand <- board. The robot tells base <- hand; camera <- base and hand <- board
are sought.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from robot_adapters.base import AdapterError, Array
from robot_adapters.franka.perception.board import Corners
from robot_adapters.franka.perception.camera import Lens
from robot_adapters.franka.perception.rays import View

FEWEST = 8
"""Poses. Three are enough in theory; with eight, one can be left out and the rest still be checked by it."""
FEWEST_FOR_LENS = 12
"""Poses, where the lens has to be measured too."""
TURNED = np.deg2rad(12.0)
"""How far, about each of two axes, the hand must have turned: translation is found only through rotation."""
SLIPPED = 3.0
"""A pose whose error is this many times the median (and more than `SLIPPED_PIXELS`) is left out."""
SLIPPED_PIXELS = 2.0
METHODS = (cv2.CALIB_HAND_EYE_PARK, cv2.CALIB_HAND_EYE_DANIILIDIS, cv2.CALIB_HAND_EYE_TSAI)


class NotEnough(AdapterError):
    """The poses don't determine where the camera is; the remedy says which ones are wanting."""


@dataclass(frozen=True)
class Sighting:
    """The board as a camera saw it, and base_from_hand (4, 4), where the robot's hand was then."""

    base_from_hand: Array
    corners: Corners


@dataclass(frozen=True)
class HandEye:
    """Where the camera is. error: m, what the corners of a pose are off (median) that the others foretell.

    hand_from_board: (4, 4). used, left_out: numbers of poses; those left out contradict the rest.
    """

    view: View
    hand_from_board: Array
    error: float
    used: int
    left_out: int


def solve(sightings: Sequence[Sighting], lens: Lens | None, size: tuple[int, int]) -> HandEye:
    """The camera's place in the robot base frame.

    Args:
        sightings: of poses that differ in how the board is tilted.
        lens: of the camera; None to find it from the same pictures.
        size: (width, height) of the pictures, pixels.

    Raises:
        NotEnough: too few poses, or poses that are too much alike.
    """
    require(sightings, fewest(lens))
    lens = lens or _lens(sightings, size)
    camera, board = _start(sightings, lens)
    camera, board = _refine(sightings, lens, camera, board)
    errors = np.array([_pixels_off(s, lens, camera, board) for s in sightings])
    kept = [s for s, e in zip(sightings, errors, strict=True) if e <= max(SLIPPED * np.median(errors), SLIPPED_PIXELS)]
    if len(kept) < len(sightings):
        require(kept, FEWEST)
        camera, board = _refine(kept, lens, camera, board)
    held_out = []
    for i, sighting in enumerate(kept):
        others = _refine([*kept[:i], *kept[i + 1 :]], lens, camera, board)
        held_out.append(_metres_off(sighting, lens, *others))
    return HandEye(View(lens, camera), board, float(np.median(held_out)), len(kept), len(sightings) - len(kept))


def fewest(lens: Lens | None) -> int:
    """Poses without which a camera with this lens, or with one that nobody knows, can't be calibrated."""
    return FEWEST if lens is not None else FEWEST_FOR_LENS


def require(sightings: Sequence[Sighting], at_least: int) -> None:
    """Whether the poses determine the camera's place.

    Raises:
        NotEnough: they don't; the remedy says which are wanting.
    """
    if len(sightings) < at_least:
        raise NotEnough(
            f"{len(sightings)} poses of the board, of {at_least} at least",
            remedy="take more, each tilted in another way, all over what the camera sees of the table",
        )
    axes = turns([s.base_from_hand for s in sightings])
    if axes[1] < TURNED:
        about = "at all" if axes[0] < TURNED else "about more than one axis"
        raise NotEnough(
            f"the board was hardly turned {about} ({np.rad2deg(axes[1]):.0f} degrees)",
            remedy="tilt the hand by 20 degrees and more to the left and right, towards the robot and away from it, "
            "and turn it",
        )


def turns(hands: Sequence[Array]) -> Array:
    """(3,) rad, how far the hands (4, 4) are turned against each other about their main axes, largest first."""
    if len(hands) < 2:
        return np.zeros(3)
    first = Rotation.from_matrix(np.array([h[:3, :3] for h in hands])).mean()
    away = (first.inv() * Rotation.from_matrix(np.array([h[:3, :3] for h in hands]))).as_rotvec()
    spread: Array = np.sqrt(np.maximum(np.linalg.eigvalsh(away.T @ away / len(hands))[::-1], 0.0)) * 2
    return spread


def _lens(sightings: Sequence[Sighting], size: tuple[int, int]) -> Lens:
    """From the board alone (Zhang's method); five coefficients would follow the noise at the edges."""
    _, matrix, distortion, _, _ = cv2.calibrateCamera(
        [s.corners.points.astype(np.float32) for s in sightings],
        [s.corners.pixels.astype(np.float32) for s in sightings],
        size,
        np.eye(3),
        np.zeros(5),
        flags=cv2.CALIB_FIX_K3,
    )
    return Lens(
        size[0], size[1], np.asarray(matrix, dtype=np.float64), np.asarray(distortion, dtype=np.float64).ravel()
    )


def _start(sightings: Sequence[Sighting], lens: Lens) -> tuple[Array, Array]:
    """camera_from_base and hand_from_board (4, 4) by the best of OpenCV's closed forms."""
    boards = [_board_pose(s.corners, lens) for s in sightings]
    # OpenCV's names are those of a camera in the hand. Ours stands and the board moves: what it calls gripper_from_base
    # goes in as base_from_hand inverted, and what comes out as camera_from_gripper is base_from_camera
    hands = [np.linalg.inv(s.base_from_hand) for s in sightings]
    best: tuple[float, Array, Array] | None = None
    for method in METHODS:
        rotation, translation = cv2.calibrateHandEye(
            [h[:3, :3] for h in hands],
            [h[:3, 3] for h in hands],
            [b[:3, :3] for b in boards],
            [b[:3, 3] for b in boards],
            method=method,
        )
        if not np.isfinite(rotation).all() or not np.isfinite(translation).all():
            continue
        base_from_camera = np.eye(4)
        base_from_camera[:3, :3], base_from_camera[:3, 3] = rotation, np.asarray(translation).ravel()
        held = [h @ base_from_camera @ b for h, b in zip(hands, boards, strict=True)]
        board = np.eye(4)
        board[:3, :3] = Rotation.from_matrix(np.array([h[:3, :3] for h in held])).mean().as_matrix()
        board[:3, 3] = np.median([h[:3, 3] for h in held], axis=0)
        camera = np.linalg.inv(base_from_camera)
        off = float(np.median([_pixels_off(s, lens, camera, board) for s in sightings]))
        if best is None or off < best[0]:
            best = off, camera, board
    if best is None:
        raise NotEnough("no place of the camera fits these poses", remedy="start again, with other tilts")
    return best[1], best[2]


def _board_pose(corners: Corners, lens: Lens) -> Array:
    """camera_from_board (4, 4); of a flat board's two likely tilts, the one that fits."""
    _, rotation, translation = cv2.solvePnP(
        corners.points, corners.pixels, lens.matrix, lens.distortion, flags=cv2.SOLVEPNP_IPPE
    )
    rotation, translation = cv2.solvePnPRefineLM(
        corners.points, corners.pixels, lens.matrix, lens.distortion, rotation, translation
    )
    return _matrix(np.concatenate((np.ravel(rotation), np.ravel(translation))))


def _refine(sightings: Sequence[Sighting], lens: Lens, camera: Array, board: Array) -> tuple[Array, Array]:
    """Both transforms so that the corners fit the pixels best; single bad corners count little."""

    def residuals(x: Array) -> Array:
        parts = [_offsets(s, lens, _matrix(x[:6]), _matrix(x[6:])).ravel() for s in sightings]
        return np.concatenate(parts)

    fitted = least_squares(residuals, np.concatenate((_vector(camera), _vector(board))), loss="soft_l1", x_scale="jac")
    return _matrix(fitted.x[:6]), _matrix(fitted.x[6:])


def _offsets(sighting: Sighting, lens: Lens, camera: Array, board: Array) -> Array:
    """(n, 2) pixels from where the corners are seen to where they should be."""
    chain = camera @ sighting.base_from_hand @ board
    expected = View(lens, chain).pixels(sighting.corners.points)
    off: Array = expected - sighting.corners.pixels
    return off


def _pixels_off(sighting: Sighting, lens: Lens, camera: Array, board: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(_offsets(sighting, lens, camera, board) ** 2, axis=1))))


def _metres_off(sighting: Sighting, lens: Lens, camera: Array, board: Array) -> float:
    """Across the line of sight, at the board's distance."""
    distance = float((camera @ sighting.base_from_hand @ board)[2, 3])
    return _pixels_off(sighting, lens, camera, board) * distance / float(lens.matrix[0, 0])


def _vector(transform: Array) -> Array:
    return np.concatenate((Rotation.from_matrix(transform[:3, :3]).as_rotvec(), transform[:3, 3]))


def _matrix(vector: Array) -> Array:
    transform = np.eye(4)
    transform[:3, :3] = cv2.Rodrigues(np.asarray(vector[:3], dtype=np.float64))[0]
    transform[:3, 3] = vector[3:]
    return transform
