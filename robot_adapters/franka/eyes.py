"""What the Franka adapter needs to see: where objects are, how fresh that is, and pictures with their calibration.

`perception` sees with cameras; tests know the truth from a simulator. Everything is in the robot base frame.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.metadata import entry_points
from typing import Protocol, cast, runtime_checkable

import numpy as np

from robot_adapters.base import (
    AdapterError,
    Array,
    CameraCalibration,
    CameraFrame,
    SceneChanged,
    SceneUnclear,
    Unavailable,
)
from robot_adapters.guiding import Guide

EYES = "seed.eyes"
STIRRED = 0.010
"""m by which nothing may have moved between the picture that was judged and the motion: fingers forgive 12 mm."""
TURNED = 0.05
"""rad, likewise, of the hand: as exact as a skill turns it before a descent."""


@dataclass(frozen=True)
class Hand:
    """What the arm knows that helps seeing: a held object is where the grip site is, and hidden by fingers.

    grip_site: (3,) m, robot base frame. yaw: rad, 0 where the fingers close along y. width: m between the fingers.
    closed: whether they were last commanded to close. grasp: where they did, (3,) m and rad as above; None if nobody
    watched: what they took there has moved with them since.
    """

    grip_site: Array
    yaw: float
    width: float
    closed: bool
    grasp: tuple[Array, float] | None = None


@dataclass(frozen=True)
class Sight:
    """What is known of the scene, as one snapshot.

    objects: name -> (3,) m, base frame, of every movable object that is known. joints: name -> m from closed, of what
    slides. tilts: name -> rad from upright. yaws: name -> rad about z, if known. taken_at: name -> seconds since the
    epoch at which each was last measured.
    missing: name -> why it isn't known well enough to act on, in words for the trainer: `hidden for 3 s`. An object
    may be in `objects` (where it was last) and in `missing`: then nothing may be proposed.
    """

    objects: Mapping[str, Array]
    taken_at: Mapping[str, float]
    joints: Mapping[str, float] = field(default_factory=dict)
    tilts: Mapping[str, float] = field(default_factory=dict)
    yaws: Mapping[str, float] = field(default_factory=dict)
    missing: Mapping[str, str] = field(default_factory=dict)


def must_be_known(sight: Sight) -> None:
    """See that nothing is missing.

    Raises:
        SceneUnclear: something is; it says what, and why.
    """
    if sight.missing:
        lost = "; ".join(f"{name}: {why}" for name, why in sorted(sight.missing.items()))
        raise SceneUnclear(f"not everything is in sight: {lost}", remedy="make it visible")


def must_be_unmoved(then: Sight, now: Sight) -> None:
    """See that everything is where it was.

    Raises:
        SceneChanged: something was moved; it says what, and how far.
    """
    away = {n: float(np.linalg.norm(now.objects[n] - at)) for n, at in then.objects.items() if n in now.objects}
    away |= {n: abs(now.joints[n] - at) for n, at in then.joints.items() if n in now.joints}
    farthest = max(away, key=lambda name: away[name], default="")
    if farthest and away[farthest] > STIRRED:
        raise SceneChanged(
            f"{farthest} was moved by {away[farthest] * 1000:.0f} mm since the picture was taken",
            remedy="judge a new proposal",
        )


def must_stand_still(then: tuple[Array, float], now: tuple[Array, float]) -> None:
    """See that the arm is where it was: the way that was judged begins there, and may keep the hand's angle.

    then, now: its grip site, (3,) m, and its yaw, rad.

    Raises:
        SceneChanged: somebody has guided it elsewhere.
    """
    away, turned = float(np.linalg.norm(now[0] - then[0])), abs(math.remainder(now[1] - then[1], 2 * math.pi))
    if away > STIRRED or turned > TURNED:
        raise SceneChanged(
            f"the arm was moved by {away * 1000:.0f} mm and turned by {math.degrees(turned):.0f} degrees since the "
            "picture was taken",
            remedy="judge a new proposal",
        )


class Eyes(Protocol):
    """Cameras with what is read off their pictures. Used from the thread that made it."""

    cameras: tuple[str, ...]
    image_size: tuple[int, int]
    """(width, height) of a still, pixels."""

    def calibrations(self) -> Mapping[str, CameraCalibration]:
        """How each camera maps the robot base frame to its full-size stills."""

    def refusal(self) -> str | None:
        """Why nothing may be proposed whatever is seen, in words (a camera has moved, is gone); None if all is well.

        Not between two set-points: it may look for that at the newest pictures.
        """

    def look(self, hand: Hand) -> Sight:
        """The scene now; new pictures are taken where the last are old."""

    def frame(self, camera: str, *, still: bool) -> CameraFrame:
        """The newest picture; a still is one that `look` has read last, so that both tell of the same moment.

        Raises:
            Unavailable: there is no such camera, or it is gone.
        """

    def close(self) -> None:
        """Release the cameras."""


def why_not(eyes: Eyes) -> str | None:
    """Their refusal; eyes that can't even say are a reason too."""
    try:
        return eyes.refusal()
    except AdapterError as error:
        return str(error)


@runtime_checkable
class Calibrated(Protocol):
    """What eyes have beside `Eyes` if an operator can calibrate them."""

    def guide(self, hand: Callable[[], Array], *, square: float, wanted: int) -> Guide:
        """Begin a calibration. hand: base_from_hand (4, 4) now. square: m, of the board. wanted: poses a camera."""


class EyesFactory(Protocol):
    """Builds the eyes of a task, as `FrankaSettings.eyes` names them (entry points of the group `seed.eyes`)."""

    def __call__(self, task: str, settings: Mapping[str, object]) -> Eyes:
        """Open the cameras.

        Args:
            task: name of the task, whose objects are to be seen.
            settings: what the adapter's setting `eyes_settings` says; checked here.

        Raises:
            Unavailable: a camera or its calibration is missing; the remedy says what to do.
        """


def find_eyes(name: str) -> EyesFactory:
    """What sees, by its name among the entry points.

    Raises:
        Unavailable: none is installed under this name.
    """
    points = {point.name: point for point in entry_points(group=EYES)}
    if name not in points:
        known = ", ".join(sorted(points)) or "none"
        raise Unavailable(f"nothing called {name!r} sees", remedy=f"installed are: {known}")
    return cast("EyesFactory", points[name].load())
