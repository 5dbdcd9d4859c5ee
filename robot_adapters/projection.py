"""Pinhole camera: base-frame points to pixels, and the overlay of a skill call that a trainer judges."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array, CameraCalibration, CameraOverlay, Pixel, SkillCall, SkillSpec, workspace

BAR_LENGTH = 0.08  # m; the Panda's fingers open this far, so the bar is as wide as what fits between them
NEAREST = 0.01  # m in front of the lens; a point nearer (or behind) has no pixel


@dataclass(frozen=True)
class Box:
    """Part of the gripper: `centre` from the grip site and half sizes, (3,) m, where the fingers close along y."""

    centre: tuple[float, float, float]
    half: tuple[float, float, float]


# the Franka hand's outlines (franka_description): 0.204 x 0.063 x 0.066 m above fingers of 0.02 x 0.02 x 0.058 m
HAND = Box((0.0, 0.0, 0.078), (0.0315, 0.102, 0.033))
FINGER_HALF = (0.01, 0.008, 0.029)
CORNERS = np.array([(x, y, z) for z in (-1.0, 1.0) for x, y in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))])
"""(8, 3) of a box, in half sizes from its middle: the lower four in turn, then the upper four."""
FINGER_MIDDLE = 0.018  # m: the fingertips reach 1.1 cm below the grip site


def project(calibration: CameraCalibration, points: Array) -> tuple[Array, Array]:
    """(n, 3) points, m, robot base frame -> ((n, 2) pixels, (n,) depths in m along the optical axis).

    Pixels are (u right, v down), the origin at the top-left corner of the top-left pixel, so a pixel's centre is at
    +0.5. A point behind the lens has a depth below zero and NaN pixels.
    """
    points = np.atleast_2d(np.asarray(points, dtype=np.float64))
    camera = points @ calibration.camera_from_base[:3, :3].T + calibration.camera_from_base[:3, 3]
    depth = camera[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        homogeneous = (camera / depth[:, None]) @ calibration.intrinsics.T
    pixels = np.where(depth[:, None] > NEAREST, homogeneous[:, :2], np.nan)
    return pixels, depth


def closing_direction(yaw: float) -> Array:
    """(3,) unit vector, base frame, along which the fingers close. At yaw 0 that is the base's y axis."""
    return np.array([-math.sin(yaw), math.cos(yaw), 0.0])


def push_vector(direction: float, delta: float) -> Array:
    """(3,) m, base frame: where a push goes. `direction` below 0 is along x, otherwise along y (`SkillSpec`)."""
    return np.array([delta, 0.0, 0.0]) if direction < 0 else np.array([0.0, delta, 0.0])


def overlay(
    calibration: CameraCalibration,
    call: SkillCall,
    spec: SkillSpec,
    table_height: float,
    *,
    yaw: float = 0.0,
    skills: tuple[SkillSpec, ...] = (),
) -> CameraOverlay:
    """The call drawn for one camera: dot, line, gripper bar and ring, in pixels of its full-size image.

    Args:
        calibration: of the camera whose image is drawn on.
        call: the skill with its parameters.
        spec: its spec, which names the parameters.
        table_height: z of the table, m, base frame; where the drop line ends.
        yaw: the gripper's angle about z, rad, where `spec` neither has a parameter `yaw` nor fixes it.
        skills: all of the task's; together their bounds are the workspace that is drawn.
    """
    values = call.named(spec)
    around = room(calibration, skills)
    if not {"x", "y", "z"} <= values.keys():
        return CameraOverlay(workspace=around)
    dot = np.array([values["x"], values["y"], values["z"]])
    turned = values.get("yaw", yaw if spec.yaw is None else spec.yaw)
    half_bar = closing_direction(turned) * BAR_LENGTH / 2
    pushes = "delta" in values
    if pushes:
        end = dot + push_vector(values.get("direction", 0.0), values["delta"])
    else:
        end = np.array([dot[0], dot[1], table_height])
    pixels, depth = project(calibration, np.stack([dot, end, dot - half_bar, dot + half_bar]))
    if bool((depth <= NEAREST).any()):
        return CameraOverlay(in_view=False, workspace=around)
    opening = 0.0 if spec.name in {"push", "reach"} else BAR_LENGTH
    at = [(float(u), float(v)) for u, v in pixels]
    return CameraOverlay(
        dot=at[0],
        line=(at[0], at[1]),
        arrow=pushes,
        bar=(at[2], at[3]),
        ring=None if pushes else at[1],
        in_view=0 <= at[0][0] <= calibration.width and 0 <= at[0][1] <= calibration.height,
        ghost=silhouette(calibration, end if pushes else dot, turned, opening),
        yaw=float(turned),
        workspace=around,
    )


def silhouette(
    calibration: CameraCalibration, site: Array, yaw: float, opening: float
) -> tuple[tuple[Pixel, ...], ...]:
    """Outlines, in pixels, of both fingers and of the hand above them, as convex polygons; none behind the lens.

    Args:
        calibration: of the camera.
        site: (3,) m, base frame, where the grip site is.
        yaw: the gripper's angle about z, rad.
        opening: m between the fingers.
    """
    reach = opening / 2 + FINGER_HALF[1]
    fingers = [Box((0.0, side * reach, FINGER_MIDDLE), FINGER_HALF) for side in (-1, 1)]
    turn = np.array([[math.cos(yaw), -math.sin(yaw), 0.0], [math.sin(yaw), math.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
    outlines = []
    for box in (*fingers, HAND):
        corners = np.array(box.centre) + CORNERS * np.array(box.half)
        pixels, depth = project(calibration, site + corners @ turn.T)
        if bool((depth <= NEAREST).any()):
            return ()
        outlines.append(hull(pixels))
    return tuple(outlines)


def room(calibration: CameraCalibration, skills: tuple[SkillSpec, ...]) -> tuple[Pixel, ...]:
    """The eight corners, in pixels, of the skills' workspace (`CameraOverlay`); () if it has none or isn't in front."""
    box = workspace(skills)
    if box is None:
        return ()
    low, high = box
    pixels, depth = project(calibration, low + (CORNERS + 1) / 2 * (high - low))
    if bool((depth <= NEAREST).any()):
        return ()
    return tuple((float(u), float(v)) for u, v in pixels)


def hull(points: Array) -> tuple[Pixel, ...]:
    """The convex outline of (n, 2) points, by Andrew's monotone chain."""
    ordered = sorted((float(u), float(v)) for u, v in points)

    def chain(side: list[Pixel]) -> list[Pixel]:
        kept: list[Pixel] = []
        for point in side:
            while len(kept) > 1 and _turn(kept[-2], kept[-1], point) <= 0:
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return tuple(chain(ordered) + chain(ordered[::-1]))


def _turn(a: Pixel, b: Pixel, c: Pixel) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def look_at(eye: Array, target: Array, *, vertical_field_of_view: float, width: int, height: int) -> CameraCalibration:
    """An ideal camera at `eye` (3,) that looks at `target` (3,), both m in the base frame, with z up in its image.

    `vertical_field_of_view` is in radians. For adapters without a calibrated or simulated camera.
    """
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(forward, right), forward])
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = -rotation @ eye
    return CameraCalibration(width, height, intrinsics(vertical_field_of_view, width, height), transform)


def intrinsics(vertical_field_of_view: float, width: int, height: int) -> Array:
    """(3, 3) in pixels of an ideal camera with square pixels; `vertical_field_of_view` in radians."""
    focal = height / 2 / math.tan(vertical_field_of_view / 2)
    return np.array([[focal, 0.0, width / 2], [0.0, focal, height / 2], [0.0, 0.0, 1.0]])
