"""`Perception`: the eyes of the real robot, from two cameras to the scene that a task's state is made of."""

from __future__ import annotations

import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import CameraCalibration, CameraFrame, Unavailable
from robot_adapters.franka.eyes import Hand, Sight
from robot_adapters.franka.perception import PerceptionSettings, calibration, tagging
from robot_adapters.franka.perception.board import Board
from robot_adapters.franka.perception.calibrating import HandPose, Session
from robot_adapters.franka.perception.calibration import Calibration
from robot_adapters.franka.perception.camera import HEIGHT, WIDTH, CameraLost, Picture, open_camera
from robot_adapters.franka.perception.colours import find_by_colour
from robot_adapters.franka.perception.guided import Guided
from robot_adapters.franka.perception.locating import Found, locate
from robot_adapters.franka.perception.moved import Reference, Standing
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.tags import Tag, TagDetector
from robot_adapters.franka.perception.tracking import Tracker
from robot_adapters.franka.perception.watching import Watch
from robot_adapters.registry import task as task_by_name

ATTEMPTS = 3
"""Pictures in which an object may be looked for before it counts as not seen: one may be blurred by a knock."""
RECHECK = 1.0
"""s between two looks for whether a camera's trouble is over."""


@dataclass
class _Eye:
    """One camera: what it is read with, how it stands, and its picture of the last look."""

    watch: Watch
    source: str
    calibration: Calibration | None
    """None where it has never been calibrated."""
    reference: Reference | None
    detector: TagDetector
    standing: Standing
    stamp: float
    """When the calibration's file was written."""
    picture: Picture | None = None


class Perception:
    """Cameras with what is read off their pictures (`Eyes`). Each camera is read on a thread of its own."""

    def __init__(self, task: str, settings: PerceptionSettings) -> None:
        """Open the cameras, and see whether they stand where they were calibrated.

        Raises:
            Unavailable: a camera can't be opened, or no camera is named or calibrated.
            BadTags: the tag file doesn't fit the task.
        """
        self._settings = settings
        self._task = task_by_name(task)
        self._tagging = tagging.load(self._task, settings.tags)
        self._table = self._task.table_height if settings.table_height is None else settings.table_height
        self._where = calibration.folder(settings.calibration)
        sources = dict(settings.cameras) or dict.fromkeys(calibration.stored(self._where), "")
        if not sources:
            raise Unavailable(
                f"no camera is calibrated (nothing in {self._where})", remedy=calibration.AGAIN.format("left")
            )
        self._tracker = Tracker(self._task, self._tagging, lost_after=settings.lost_after)
        self._pool = ThreadPoolExecutor(len(sources), thread_name_prefix="eye")
        self._eyes: dict[str, _Eye] = {}
        self._checked = 0.0
        try:
            for name, source in sources.items():
                self._eyes[name] = self._eye(name, source)
            self.recheck()
        except BaseException:
            self.close()
            raise
        self.cameras = tuple(self._eyes)
        pictures = [eye.picture for eye in self._eyes.values() if eye.picture is not None]
        height, width = pictures[0].colour.shape[:2] if pictures else (HEIGHT, WIDTH)
        self.image_size = (width, height)

    def calibrations(self) -> Mapping[str, CameraCalibration]:
        """See `Eyes`."""
        return {name: eye.calibration.view.calibration() for name, eye in self._eyes.items() if eye.calibration}

    def refusal(self) -> str | None:
        """See `Eyes`. Looks once a second how the cameras stand, without waiting for new pictures."""
        if time.monotonic() - self._checked > RECHECK:
            self.recheck()
        return self._trouble()

    def look(self, hand: Hand) -> Sight:
        """See `Eyes`. What two cameras contradict each other about isn't measured; a camera in trouble hides all."""
        found: dict[str, Found] = {}
        wanted = set(self._tagging.objects)
        for attempt in range(ATTEMPTS):
            seen = self._see(after=time.time())
            if self._trouble() is not None:
                break
            for name in sorted(wanted - found.keys()):
                if (at := self._locate(name, seen)) is not None:
                    found[name] = at
            if found.keys() == wanted or attempt == ATTEMPTS - 1:
                break
        taken = [eye.picture.taken_at for eye in self._eyes.values() if eye.picture is not None]
        sight = self._tracker.update(found, hand, min(taken, default=time.time()))
        if (trouble := self._trouble()) is not None:
            return replace(sight, missing=dict.fromkeys(wanted, trouble))
        return sight

    def frame(self, camera: str, *, still: bool) -> CameraFrame:
        """See `Eyes`. The picture is straightened, so that a pinhole draws on it exactly."""
        eye = self._eyes.get(camera)
        if eye is None:
            raise Unavailable(f"there is no camera {camera!r}", remedy="use one of: " + ", ".join(self.cameras))
        try:
            picture = eye.picture if still and eye.picture is not None else eye.watch.latest()
        except CameraLost as lost:
            raise Unavailable(str(lost), remedy=lost.remedy) from lost
        quality = self._settings.jpeg_quality if still else min(self._settings.jpeg_quality, 70)
        straight = _straight(picture.colour, eye.calibration.view) if eye.calibration else picture.colour
        encoded = cv2.imencode(".jpg", straight[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
        height, width = straight.shape[:2]
        return CameraFrame(camera, encoded.tobytes(), width, height, picture.taken_at)

    def recheck(self) -> None:
        """Look whether every camera stands where it was calibrated; one that was calibrated again is read anew."""
        self._checked = time.monotonic()
        for name, eye in self._eyes.items():
            if self._stamp(name) not in {0.0, eye.stamp}:
                self._read_calibration(name, eye)
        self._see(after=0.0)

    def guide(self, hand: HandPose, *, square: float, wanted: int) -> Guided:
        """See `Calibrated`. What is stored counts at once."""
        watches = {name: eye.watch for name, eye in self._eyes.items()}
        sources = {name: eye.source for name, eye in self._eyes.items()}

        def stored() -> None:
            for name, eye in self._eyes.items():
                self._read_calibration(name, eye)
            self.recheck()

        return Guided(Session(watches, Board(square), wanted), hand, sources, self._where, stored)

    def close(self) -> None:
        """See `Eyes`."""
        for eye in self._eyes.values():
            eye.watch.close()
        self._pool.shutdown()

    def _eye(self, name: str, source: str) -> _Eye:
        # a camera that is named may be calibrated from the page; until then it refuses everything
        read = None if source and not self._stamp(name) else calibration.load(name, self._where)
        opened = source or (read.source if read is not None else "")
        reference = None if read is None else Reference(read.reference, read.fixed_tags)
        standing = Standing(True, None, "not looked at yet")
        watch = Watch(name, lambda: open_camera(opened), silence=self._settings.silence)
        return _Eye(watch, opened, read, reference, TagDetector(), standing, self._stamp(name))

    def _stamp(self, name: str) -> float:
        """When the calibration's file was written; 0 where there is none."""
        path = self._where / f"{name}.json"
        return path.stat().st_mtime if path.exists() else 0.0

    def _read_calibration(self, name: str, eye: _Eye) -> None:
        eye.calibration = calibration.load(name, self._where)
        eye.reference = Reference(eye.calibration.reference, eye.calibration.fixed_tags)
        eye.stamp = self._stamp(name)

    def _see(self, *, after: float) -> dict[str, tuple[View, dict[int, Tag]]]:
        """The tags in every camera's newest picture; notes how the cameras stand."""
        waiting = {name: self._pool.submit(_read, eye, after) for name, eye in self._eyes.items()}
        seen = {}
        for name, reading in waiting.items():
            tags, known = reading.result(), self._eyes[name].calibration
            if tags is not None and known is not None:
                seen[name] = (known.view, {tag.number: tag for tag in tags})
        return seen

    def _locate(self, name: str, seen: Mapping[str, tuple[View, dict[int, Tag]]]) -> Found | None:
        what = self._tagging.objects[name]
        if what.tags:
            return locate(what, seen, self._table, self._tracker.last(name))
        pictures = [(e.calibration.view, e.picture) for e in self._eyes.values() if e.picture and e.calibration]
        return find_by_colour(what, pictures, self._table)

    def _trouble(self) -> str | None:
        """The first camera that can't be relied on, in words."""
        for name, eye in self._eyes.items():
            if (silent := eye.watch.trouble()) is not None:
                return f"camera {name} is gone: {silent}"
            if eye.calibration is None:
                return f"camera {name} isn't calibrated"
            if eye.standing.moved:
                return f"camera {name} has moved since it was calibrated, or is covered ({eye.standing.detail})"
        return None


def _read(eye: _Eye, after: float) -> tuple[Tag, ...] | None:
    """The tags in the newest picture, which is kept with how the camera stands; None where there is no picture."""
    try:
        picture = eye.watch.latest(after=after)
    except CameraLost:
        return None
    eye.picture = picture
    if eye.calibration is None or eye.reference is None:
        return None
    lens = eye.calibration.view.lens
    tags = eye.detector.find(picture.colour)
    if picture.colour.shape[:2] != (lens.height, lens.width):
        h, w = picture.colour.shape[:2]
        eye.standing = Standing(True, None, f"its pictures are {w} x {h}, calibrated at {lens.width} x {lens.height}")
    else:
        eye.standing = eye.reference.compare(picture.colour, tags)
    return tags


def _straight(colour: NDArray[np.uint8], view: View) -> NDArray[np.uint8]:
    """The picture as a pinhole with the same matrix would have taken it."""
    if not view.lens.distortion.any():
        return colour
    return np.asarray(cv2.undistort(colour, view.lens.matrix, view.lens.distortion), dtype=np.uint8)
