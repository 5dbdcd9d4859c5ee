"""Where an untagged object is: what has its colour above the table, by depth. Coarser than tags."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.perception.camera import Picture
from robot_adapters.franka.perception.locating import Found
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.tagging import Tagged

NEAR = 22.0
"""Distance in OpenCV's Lab plane a-b (of 255) that is still the same colour: shade and lamp change it."""
FEWEST = 60
"""Pixels with depth below which nothing was seen."""
LOWEST, HIGHEST = 0.004, 0.40
"""m above the table between which objects are; below is the table, above is the arm."""


def find_by_colour(what: Tagged, pictures: Sequence[tuple[View, Picture]], table: float) -> Found | None:
    """The largest thing of this colour; its yaw isn't known. Needs pictures with depth.

    Args:
        what: with a colour and `half_height`.
        pictures: with where each camera is.
        table: z of the table, m, base frame.
    """
    if what.colour is None:
        return None
    clouds = [points for view, picture in pictures if len(points := _cloud(what.colour, view, picture, table))]
    if sum(map(len, clouds)) < FEWEST:
        return None
    points = np.concatenate(clouds)
    # a side that only one camera sees counts as much as one that both do: the middle of the outline, not of the points
    low, high = np.percentile(points, [1.5, 98.5], axis=0)
    position = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[2] - what.half_height])
    return Found(position, 0.0, len(clouds))


def _cloud(colour: tuple[float, float, float], view: View, picture: Picture, table: float) -> Array:
    """(n, 3) m, base frame, of the largest patch of this colour in one picture; (0, 3) where there is none."""
    if picture.depth is None:
        return np.zeros((0, 3))
    target = cv2.cvtColor(np.array([[colour]], dtype=np.float32), cv2.COLOR_RGB2LAB)[0, 0, 1:]
    lab = cv2.cvtColor(picture.colour.astype(np.float32) / 255, cv2.COLOR_RGB2LAB)[..., 1:]
    # as saturated as it may be by shade, but of this hue
    alike = np.linalg.norm(lab - target, axis=2) < NEAR
    mask = cv2.morphologyEx((alike & (picture.depth > 0)).astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(mask)
    if count < 2:
        return np.zeros((0, 3))
    largest = 1 + int(np.argmax(statistics[1:, cv2.CC_STAT_AREA]))
    v, u = np.nonzero(labels == largest)
    directions = view.rays(np.column_stack((u, v)).astype(np.float64))
    along = directions @ view.camera_from_base[2, :3]  # depth is measured along the optical axis
    points: Array = view.eye + directions * (picture.depth[v, u] / along)[:, None]
    return points[(points[:, 2] > table + LOWEST) & (points[:, 2] < table + HIGHEST)]
