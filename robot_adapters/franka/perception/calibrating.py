"""The guided calibration: the board is in the robot's hand, people guide the arm, and poses are taken as they come.

Nothing here moves the arm. A pose is taken by itself once the arm stands still, the board is seen, and it is new.
"""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

from robot_adapters.base import AdapterError, Array
from robot_adapters.franka.perception import calibration, hand_eye
from robot_adapters.franka.perception.board import Board, Corners
from robot_adapters.franka.perception.calibration import Calibration
from robot_adapters.franka.perception.camera import CameraLost, Picture
from robot_adapters.franka.perception.hand_eye import HandEye, Sighting
from robot_adapters.franka.perception.moved import FIXED_FROM
from robot_adapters.franka.perception.tags import TagDetector
from robot_adapters.franka.perception.watching import Watch

WANTED = 15
"""Poses of each camera: about twice as many as are needed, so that some may be left out."""
MORE = 3
"""Poses to take after those that there are didn't do."""
STILL = (0.0004, np.deg2rad(0.1))
"""m and rad that the hand may move while a picture is taken."""
NEW = (0.04, np.deg2rad(8.0))
"""m or rad from every pose that was taken, for one to be worth taking."""
GOOD = 0.003
BAD = 0.006
"""m of error beyond which a calibration isn't stored: fingers forgive 12 mm, and others need some of them."""

ADVICE = {
    "taken": "Taken. Tilt the board in another way, and somewhere else.",
    "enough": "Enough poses.",
    "unseen": "No camera sees the board: turn it towards them, and keep fingers off the markers.",
    "one_axis": "So far it was turned about one axis only: tilt it about another, by 20 degrees and more.",
    "moving": "Hold the arm still.",
    "unseen_by": "Camera {camera} doesn't see the board: turn it a little more towards it.",
    "ready": "Hold it still.",
    "known": "This pose is taken: tilt the board in another way.",
}
"""What the guide says, by its key."""

HandPose = Callable[[], Array]
"""base_from_hand (4, 4) now."""


class BadPoses(AdapterError):
    """A file of poses that can't be used."""


class TooInaccurate(AdapterError):
    """A result that is too far off to be stored."""


@dataclass(frozen=True)
class Step:
    """One look of the session. corners: camera -> (n, 2) pixels. taken: camera -> poses so far.

    advice: what to do next, a key of `ADVICE`. camera: which one it is about, or empty.
    """

    corners: Mapping[str, Array]
    taken: Mapping[str, int]
    advice: str
    camera: str = ""

    @property
    def said(self) -> str:
        """The advice in words."""
        return ADVICE[self.advice].format(camera=self.camera)

    @property
    def done(self) -> bool:
        """Whether there are poses enough."""
        return self.advice == "enough"


@dataclass
class Session:
    """One calibration of some cameras. wanted: poses of each; more where their lenses need them."""

    watches: Mapping[str, Watch]
    board: Board
    wanted: int = WANTED
    pictures: dict[str, Picture] = field(default_factory=dict)
    results: dict[str, HandEye] = field(default_factory=dict)
    _sightings: dict[str, list[Sighting]] = field(default_factory=dict)
    _hands: list[Array] = field(default_factory=list)
    _recorded: bool = False

    def __post_init__(self) -> None:
        self.wanted = max(self.wanted, self.fewest)

    @property
    def fewest(self) -> int:
        """Poses of each camera without which nothing can be calculated."""
        return max(hand_eye.fewest(watch.lens) for watch in self.watches.values())

    def step(self, hand: HandPose, *, take: bool = True) -> Step:
        """Look once; unless told not to, take the pose if it is worth it.

        Raises:
            CameraLost: a camera gives no pictures.
        """
        before = hand()
        self._look()
        corners = {name: found for name, p in self.pictures.items() if (found := self.board.find(p.colour)) is not None}
        moving = _apart(before, hand(), STILL)
        # a camera that saw the board a moment later than another takes the pose too
        fresh = {name: found for name, found in corners.items() if self._is_new(name, before)}
        wanting = [name for name in self.watches if len(self._sightings.get(name, [])) < self.wanted]
        if take and not moving and any(name in fresh for name in wanting):
            self._take(before, fresh)
            return self._told(corners, "taken")
        return self._told(corners, *self._advice(corners, moving=moving, new=bool(fresh)))

    def replay(self, poses: Sequence[Array], told: Callable[[Step], None] = lambda _: None) -> None:
        """Take a recorded session: the n-th picture of every camera belongs to the n-th pose.

        Raises:
            CameraLost: there are fewer pictures than poses.
        """
        self._recorded = True
        for pose in poses:
            self._look()
            corners = {n: found for n, p in self.pictures.items() if (found := self.board.find(p.colour)) is not None}
            self._take(pose, corners)
            told(self._told(corners, "taken" if corners else "unseen"))

    def solve(self) -> Mapping[str, HandEye]:
        """Where every camera is.

        Raises:
            NotEnough: the poses don't say; the remedy says which are wanting. Some more are wanted from then on.
        """
        self.results, found = {}, {}
        for name, watch in self.watches.items():
            height, width = self.pictures[name].colour.shape[:2] if name in self.pictures else (0, 0)
            try:
                found[name] = hand_eye.solve(self._sightings.get(name, []), watch.lens, (width, height))
            except hand_eye.NotEnough as error:
                self.wanted = max(self.wanted, min(len(self._sightings.get(n, [])) for n in self.watches) + MORE)
                raise hand_eye.NotEnough(f"camera {name}: {error}", remedy=error.remedy) from error
        self.results = found
        return found

    def store(self, sources: Mapping[str, str], where: Path) -> list[Path]:
        """Write the calibrations with what every camera sees now; the files. Take board and arm away before.

        Raises:
            NotEnough: nothing is calculated yet. TooInaccurate: a result is too far off. Nothing is stored then.
            CameraLost: a camera gives no pictures.
        """
        if not self.results:
            raise hand_eye.NotEnough("nothing is calculated yet", remedy="take the poses, then calculate")
        for name, result in self.results.items():
            if result.error > BAD:
                raise TooInaccurate(
                    f"camera {name} would be {result.error * 1000:.1f} mm off; nothing was stored",
                    remedy="check that the board is stiff and doesn't slip in the hand, that its squares measure what "
                    "you said, and that the camera is fixed; then start again",
                )
        with contextlib.suppress(CameraLost) if self._recorded else contextlib.nullcontext():
            self._look()  # a recording may have one picture more than poses; else its last has to do
        detector = TagDetector()
        files = []
        for name, result in self.results.items():
            picture = self.pictures[name]
            grey = np.asarray(cv2.cvtColor(picture.colour, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
            fixed = {tag.number: tag.centre for tag in detector.find(picture.colour) if tag.number >= FIXED_FROM}
            made = Calibration(name, sources[name], result.view, result.error, result.used, grey, fixed)
            files.append(calibration.save(made, where))
        return files

    def disagreement(self) -> float | None:
        """M between where two cameras say that the board is in the hand; None with one camera."""
        at = [result.hand_from_board[:3, 3] for result in self.results.values()]
        return max(float(np.linalg.norm(a - at[0])) for a in at) if len(at) > 1 else None

    def _is_new(self, name: str, hand: Array) -> bool:
        """Whether this camera has no sighting yet from so near a pose of the hand (4, 4)."""
        return all(_apart(hand, seen.base_from_hand, NEW) for seen in self._sightings.get(name, []))

    def _look(self) -> None:
        asked = time.time()
        for name, watch in self.watches.items():
            self.pictures[name] = watch.latest(after=asked)

    def _take(self, hand: Array, corners: Mapping[str, Corners]) -> None:
        if corners:
            self._hands.append(hand)
        for name, found in corners.items():
            self._sightings.setdefault(name, []).append(Sighting(hand, found))

    def _told(self, corners: Mapping[str, Corners], advice: str, camera: str = "") -> Step:
        taken = {name: len(self._sightings.get(name, [])) for name in self.watches}
        if min(taken.values()) >= self.wanted:
            advice, camera = "enough", ""
        return Step({name: c.pixels for name, c in corners.items()}, taken, advice, camera)

    def _advice(self, corners: Mapping[str, Corners], *, moving: bool, new: bool) -> tuple[str, str]:
        if not corners:
            return "unseen", ""
        if len(self._hands) >= 5 and hand_eye.turns(self._hands)[1] < hand_eye.TURNED:
            return "one_axis", ""
        if moving:
            return "moving", ""
        unseen = [n for n in self.watches if n not in corners and len(self._sightings.get(n, [])) < self.wanted]
        if unseen:
            return "unseen_by", unseen[0]
        return ("ready" if new else "known"), ""


def read_poses(path: Path) -> list[Array]:
    """base_from_hand (4, 4) of every picture of a recorded session, from JSON.

    Raises:
        BadPoses: the file isn't a list of rigid transforms.
    """
    remedy = "give a JSON list of 4 x 4 matrices (base from hand, m), one for each picture"
    try:
        raw = json.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise BadPoses(f"{path} can't be read: {error}", remedy=remedy) from error
    poses = []
    for number, entry in enumerate(raw if isinstance(raw, list) else [None]):
        try:
            pose = np.array(entry, dtype=np.float64)
        except (TypeError, ValueError):
            pose = np.zeros(0)
        if pose.shape != (4, 4) or not np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-3):
            raise BadPoses(f"{path}: pose {number + 1} is no rigid transform", remedy=remedy)
        poses.append(pose)
    return poses


def preview(picture: Picture, corners: Array | None, *, width: int = 640) -> bytes:
    """A small JPEG of what a camera sees, with the corners that were found."""
    drawn = picture.colour.copy()
    for u, v in corners if corners is not None else ():
        cv2.circle(drawn, (round(float(u)), round(float(v))), 7, (0, 255, 70), 2, cv2.LINE_AA)
    scale = width / drawn.shape[1]
    small = cv2.resize(drawn, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    return cv2.imencode(".jpg", small[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 75])[1].tobytes()


def _apart(a: Array, b: Array, limits: tuple[float, float]) -> bool:
    """Whether two hands (4, 4) are farther apart, or turned further, than these m and rad."""
    turned = float(np.linalg.norm(cv2.Rodrigues(a[:3, :3].T @ b[:3, :3])[0]))
    return float(np.linalg.norm(a[:3, 3] - b[:3, 3])) > limits[0] or turned > limits[1]
