"""What the fingers hold, from their width and where things are: one rule for the eyes and for the task's flags."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from robot_adapters.base import Array
from robot_adapters.skills import GRASPED_WIDTH
from robot_adapters.tasks.base import ObjectSpec

OPEN = 0.075
"""m between the fingers from which they haven't closed on anything: a hand opens to 80 mm, and 50 mm is grasped."""
WITHIN = 0.04
"""m from the grip site to where an object is gripped, while the fingers hold it."""


def holds(width: float, *, closed: bool) -> bool:
    """Whether fingers that were last commanded to close, or not, and are `width` m apart hold anything."""
    return closed and GRASPED_WIDTH <= width < OPEN


def grip_of(spec: ObjectSpec, position: Array, yaw: float) -> Array:
    """(3,) m where an object at `position` (3,) m is gripped; both in one frame. yaw: rad."""
    return position + turned(yaw, np.array(spec.grip.at)) if spec.grip is not None else position


def gripped(
    specs: Iterable[ObjectSpec], places: Mapping[str, Array], yaws: Mapping[str, float], site: Array
) -> str | None:
    """The movable object whose grip is nearest to the grip site, (3,) m, if it is near enough to be between fingers.

    places: name -> (3,) m, in the frame of `site`. yaws: name -> rad; 0 where none is given.
    """
    away = {
        spec.name: float(np.linalg.norm(grip_of(spec, places[spec.name], yaws.get(spec.name, 0.0)) - site))
        for spec in specs
        if spec.movable and spec.name in places
    }
    nearest = min(away, key=lambda name: away[name], default=None)
    return nearest if nearest is not None and away[nearest] <= WITHIN else None


def turned(yaw: float, vector: Array) -> Array:
    """(3,) turned about z."""
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]])
