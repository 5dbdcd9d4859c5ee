"""What is known of the scene over time: what was measured, what moves with hand or drawer, and what is lost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.eyes import Hand, Sight
from robot_adapters.franka.perception.locating import Found
from robot_adapters.franka.perception.tagging import Tagging
from robot_adapters.skills import GRASPED_WIDTH
from robot_adapters.tasks.base import ObjectSpec, Task

HELD_WITHIN = 0.04
"""m from the grip site to where an object is gripped, while the fingers hold it."""
WANDERED = 0.03
"""m from where the hand should have it at which an object that is seen isn't in the hand any more."""
ON_TOP = 0.012
"""m by which an object that lies on another may be higher or lower than it should."""
CARRIED = 0.05
"""m above a drawer's floor to which what is in it reaches with its origin."""


@dataclass
class _Known:
    """An object: where it was last, when that was measured, and how it lies in the hand (offset, yaw) if it does."""

    position: Array
    yaw: float
    seen_at: float
    tilt: float = 0.0
    held: tuple[Array, float] | None = None


class Tracker:
    """The state of one task's scene. Give it every look; it says what is known and what isn't."""

    def __init__(self, task: Task, tagging: Tagging, *, lost_after: float) -> None:
        self._specs = {spec.name: spec for spec in task.objects}
        self._tagging = tagging
        self._lost_after = lost_after
        self._known: dict[str, _Known] = {}

    def last(self, name: str) -> Array | None:
        """(3,) m, base frame, where it was last."""
        return self._known[name].position if name in self._known else None

    def update(self, found: Mapping[str, Found], hand: Hand, now: float) -> Sight:
        """The scene, after a look at time `now` (seconds since the epoch) that measured `found`."""
        slid = self._slid(found)
        for name, seen in found.items():
            known = self._known.get(name)
            held = known.held if known is not None else None
            if held is not None and np.linalg.norm(seen.position - _in_hand(hand, held)[0]) > WANDERED:
                held = None
            tilt = seen.tilt if seen.tilt is not None else 0.0
            self._known[name] = _Known(seen.position, seen.yaw, now, tilt, held)
        self._grip(hand)
        for name, known in self._known.items():
            if name in found:
                continue
            if known.held is not None:
                known.position, known.yaw = _in_hand(hand, known.held)
                known.seen_at = now
            elif (by := self._carrier(known, name)) in slid:
                known.position = known.position + np.array([slid[by], 0.0, 0.0])
                known.seen_at = now
            elif self._covered(name, known, found):
                known.seen_at = now
        return self._sight(now)

    def _slid(self, found: Mapping[str, Found]) -> dict[str, float]:
        """Sliders that are seen: m along x since they were seen last."""
        return {
            name: float(found[name].position[0] - self._known[name].position[0])
            for name in self._tagging.sliding
            if name in found and name in self._known
        }

    def _grip(self, hand: Hand) -> None:
        """Put the nearest object into a hand that has closed on something; take it out of one that is open."""
        holds = hand.closed and hand.width >= GRASPED_WIDTH
        held = [name for name, known in self._known.items() if known.held is not None]
        if not holds:
            for name in held:
                self._known[name].held = None
            return
        if held:
            return
        movable = {n: k for n, k in self._known.items() if self._specs[n].movable}
        distances = {n: float(np.linalg.norm(self._grip_of(n, k) - hand.grip_site)) for n, k in movable.items()}
        nearest = min(distances, key=lambda n: distances[n], default=None)
        if nearest is not None and distances[nearest] <= HELD_WITHIN:
            known = movable[nearest]
            offset = _turned(-hand.yaw, known.position - hand.grip_site)
            known.held = offset, known.yaw - hand.yaw

    def _grip_of(self, name: str, known: _Known) -> Array:
        grip = self._specs[name].grip
        return known.position + (_turned(known.yaw, np.array(grip.at)) if grip is not None else 0.0)

    def _carrier(self, known: _Known, name: str) -> str | None:
        """The slider in whose tray it lies."""
        for slider in self._tagging.sliding:
            seat, at = self._specs[slider].seat, self._known.get(slider)
            if name == slider or seat is None or at is None:
                continue
            middle = at.position + np.array(seat.at)
            away = np.abs(known.position[:2] - middle[:2])
            if bool((away <= np.array(seat.half) + 0.01).all()) and 0 <= known.position[2] - middle[2] <= CARRIED:
                return slider
        return None

    def _covered(self, name: str, known: _Known, found: Mapping[str, Found]) -> bool:
        """Whether something that is seen lies right on top of it: then it is still there."""
        top = known.position[2] + _half_height(self._specs[name])
        for other, seen in found.items():
            level = float(np.linalg.norm(seen.position[:2] - known.position[:2]))
            bottom = float(seen.position[2]) - _half_height(self._specs[other])
            if self._specs[other].movable and level <= _reach(self._specs[name]) and abs(bottom - top) <= ON_TOP:
                return True
        return False

    def _sight(self, now: float) -> Sight:
        sliding = self._tagging.sliding
        missing = {}
        for name in self._tagging.objects:
            known = self._known.get(name)
            if known is None:
                missing[name] = "not seen yet"
            elif now - known.seen_at > self._lost_after:
                missing[name] = f"not seen for {now - known.seen_at:.0f} s"
        return Sight(
            objects={n: k.position.copy() for n, k in self._known.items() if n not in sliding},
            taken_at={n: k.seen_at for n, k in self._known.items()},
            joints={
                n: max(0.0, float(closed - self._known[n].position[0]))
                for n, closed in sliding.items()
                if n in self._known
            },
            tilts={n: k.tilt for n, k in self._known.items() if n not in sliding},
            missing=missing,
        )


def _in_hand(hand: Hand, held: tuple[Array, float]) -> tuple[Array, float]:
    """Where an object is that lies so in the hand, and its yaw."""
    offset, yaw = held
    return hand.grip_site + _turned(hand.yaw, offset), yaw + hand.yaw


def _turned(yaw: float, vector: Array) -> Array:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]])


def _half_height(spec: ObjectSpec) -> float:
    return spec.half_size or spec.half[2]


def _reach(spec: ObjectSpec) -> float:
    return spec.half_size or max(spec.half[:2])
