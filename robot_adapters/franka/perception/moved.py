"""Whether a camera still stands where it was calibrated: fixed tags if there are any, else what it saw then."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array
from robot_adapters.franka.perception.tags import Tag

FIXED_FROM = 500
"""Tags with this number and above are glued to the table or the wall and never move."""
SHIFT = 1.5
"""Pixels at full size that count as moved: 1.5 mm at 0.9 m with a D415 at 1280 pixels."""
IN_PLACE = 0.4
"""Share of what is recognised that must be where it was; the rest may be arm, objects and people."""
ENOUGH = 25
"""Details recognised, below which nothing can be said."""
HALF = 0.5
"""Details are followed in a picture of this scale: four times as fast, and a tenth of a pixel is still seen."""
ALIKE = 0.7
"""Correlation of the surroundings of a detail, then and now, that counts as the same."""
PATCH = 9


@dataclass(frozen=True)
class Standing:
    """What was found. shift: pixels by which the picture has moved, None if that can't be told."""

    moved: bool
    shift: float | None
    detail: str


class Reference:
    """What a camera saw when it was calibrated. Compare later pictures of it with `compare`."""

    def __init__(self, grey: NDArray[np.uint8], fixed_tags: Mapping[int, Array]) -> None:
        self._tags = dict(fixed_tags)
        self._picture = _even(grey)
        found = cv2.goodFeaturesToTrack(self._picture, 400, 0.01, 10, blockSize=5)
        self._details = np.zeros((0, 1, 2), np.float32) if found is None else np.asarray(found, dtype=np.float32)

    def compare(self, colour: NDArray[np.uint8], tags: tuple[Tag, ...]) -> Standing:
        """Whether the camera has moved, from a picture (h, w, 3) RGB and the tags found in it."""
        seen = {tag.number: tag.centre for tag in tags}
        shifts = [float(np.linalg.norm(seen[n] - at)) for n, at in self._tags.items() if n in seen]
        if shifts:
            shift = float(np.median(shifts))
            return Standing(shift > SHIFT, shift, f"{len(shifts)} fixed tags are {shift:.1f} pixels off")
        return self._follow(_even(np.asarray(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), dtype=np.uint8)))

    def _follow(self, now: NDArray[np.uint8]) -> Standing:
        if now.shape != self._picture.shape:
            return Standing(True, None, "its pictures have another size than when it was calibrated")
        if len(self._details) < ENOUGH:
            return Standing(True, None, "there is too little to see to tell whether it moved; glue fixed tags")
        there, found = _followed(self._picture, now, self._details)
        back, found_back = _followed(now, self._picture, there)
        steady = np.linalg.norm((back - self._details).reshape(-1, 2), axis=1) < 0.5
        good = found & found_back & steady
        good &= _alike(self._picture, self._details.reshape(-1, 2), now, there.reshape(-1, 2))
        if good.sum() < ENOUGH:
            return Standing(True, None, "too little of what it saw then is recognised: moved, covered or dark")
        shifts = np.linalg.norm((there - self._details).reshape(-1, 2)[good], axis=1) / HALF
        in_place = float(np.mean(shifts <= SHIFT))
        shift = float(np.median(shifts))
        return Standing(in_place < IN_PLACE, shift, f"{in_place:.0%} of {int(good.sum())} details are in place")


def _even(grey: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Half size, with local contrast evened out: lamps and daylight change, edges stay."""
    small = cv2.resize(np.asarray(grey), None, fx=HALF, fy=HALF, interpolation=cv2.INTER_AREA).astype(np.float32)
    mean = cv2.GaussianBlur(small, (0, 0), 12)
    spread = np.sqrt(np.maximum(cv2.GaussianBlur((small - mean) ** 2, (0, 0), 12), 16.0))
    even: NDArray[np.uint8] = np.clip((small - mean) / spread * 40 + 128, 0, 255).astype(np.uint8)
    return even


def _followed(
    then: NDArray[np.uint8], now: NDArray[np.uint8], details: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """(n, 1, 2) where details of one picture are in another, and (n,) whether they were found there."""
    start = np.empty_like(details)
    there, found, _ = cv2.calcOpticalFlowPyrLK(then, now, details, start, winSize=(15, 15), maxLevel=4)
    return np.asarray(there, dtype=np.float32), np.asarray(found).ravel() == 1


def _alike(
    then: NDArray[np.uint8], at: NDArray[np.float32], now: NDArray[np.uint8], there: NDArray[np.float32]
) -> NDArray[np.bool_]:
    """(n,) whether the surroundings of each detail correlate."""
    result = np.zeros(len(at), dtype=bool)
    for i, (p, q) in enumerate(zip(at, there, strict=True)):
        if not np.isfinite(q).all():
            continue
        a = cv2.getRectSubPix(then, (PATCH, PATCH), (float(p[0]), float(p[1]))).astype(np.float32)
        b = cv2.getRectSubPix(now, (PATCH, PATCH), (float(q[0]), float(q[1]))).astype(np.float32)
        a, b = a - a.mean(), b - b.mean()
        norm = float(np.linalg.norm(a) * np.linalg.norm(b))
        result[i] = norm > 0 and float((a * b).sum()) / norm > ALIKE
    return result
