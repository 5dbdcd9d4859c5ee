"""What an adapter offers whose cameras an operator can calibrate by guiding the arm by hand; plain values only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable


@dataclass(frozen=True)
class CameraLook:
    """What one camera sees. found: whether the board is in it. taken: poses so far. jpeg: with its corners drawn."""

    camera: str
    found: bool
    taken: int
    jpeg: bytes


@dataclass(frozen=True)
class GuideLook:
    """One look. advice: a key of what to do next, `said` in words. camera: which one it is about, or empty.

    wanted: poses to take of each camera. fewest: those without which nothing can be calculated.
    """

    cameras: tuple[CameraLook, ...]
    wanted: int
    fewest: int
    advice: str
    camera: str
    said: str
    done: bool


@dataclass(frozen=True)
class CameraResult:
    """What a calibration is worth. error: m, of poses that had no part in it. good: whether that will do."""

    camera: str
    error: float
    poses: int
    left_out: int
    good: bool


@dataclass(frozen=True)
class GuideResult:
    """Of all cameras. apart: m between where two of them place the board; None with one. stored: whether it is kept."""

    cameras: tuple[CameraResult, ...]
    apart: float | None
    stored: bool


class Guide(Protocol):
    """One calibration of a robot's cameras. Nothing in it moves the robot."""

    def look(self, *, take: bool) -> GuideLook:
        """See what there is to see; with `take`, keep the pose if the arm stands still and the board is seen.

        Raises:
            AdapterError: a camera or the arm is gone.
        """

    def solve(self) -> GuideResult:
        """Calculate.

        Raises:
            AdapterError: the poses don't say; the remedy says which are wanting.
        """

    def store(self) -> GuideResult:
        """Keep the result with what the cameras see now: without board and arm.

        Raises:
            AdapterError: it is too far off, or nothing is calculated yet; nothing is stored.
        """


@runtime_checkable
class CalibratesCameras(Protocol):
    """What an adapter has beside `Adapter` if its cameras can be calibrated while it is in use."""

    def guide(self, *, square: float, wanted: int) -> Guide:
        """Begin a calibration.

        Args:
            square: edge of a square of the printed board, m.
            wanted: poses of each camera.

        Raises:
            Unavailable: its cameras aren't calibrated so.
        """
