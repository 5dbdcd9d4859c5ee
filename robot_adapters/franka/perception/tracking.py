"""What is known of the scene over time: what was measured, what moves with hand or drawer, and what is lost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.eyes import Hand, Sight
from robot_adapters.franka.holding import gripped, holds, turned
from robot_adapters.franka.perception.locating import Found
from robot_adapters.franka.perception.tagging import Tagging
from robot_adapters.tasks.base import ObjectSpec, Task

WANDERED = 0.03
"""m from where the hand should have it at which an object that is seen isn't in the hand any more."""
ON_TOP = 0.012
"""m by which an object that lies on another may be higher or lower than it should."""
CARRIED = 0.05
"""m above a drawer's floor to which what is in it reaches with its origin."""


@dataclass
class _Known:
    """An object: where it was last, when that was measured, and how it lies in the hand (offset, yaw) if it does.

    let_go: whether a hand let go of it since it was seen: it may have fallen anywhere.
    """

    position: Array
    yaw: float
    seen_at: float
    tilt: float = 0.0
    held: tuple[Array, float] | None = None
    let_go: bool = False


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
            if held is not None:
                stayed = np.linalg.norm(seen.position - _in_hand(hand, held)[0]) <= WANDERED
                held = _of_hand(hand.grip_site, hand.yaw, seen.position, seen.yaw) if stayed else None
            tilt = seen.tilt if seen.tilt is not None else 0.0
            self._known[name] = _Known(seen.position, seen.yaw, now, tilt, held)
        self._grip(hand, found)
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

    def _grip(self, hand: Hand, found: Mapping[str, Found]) -> None:
        """Put the nearest object into a hand that has closed on something; take it out of one that has let go.

        What is seen has come along with the hand; what isn't was last seen where the hand closed.
        """
        held = [name for name, known in self._known.items() if known.held is not None]
        if not holds(hand.width, closed=hand.closed):
            for name in held:
                self._known[name].held, self._known[name].let_go = None, name not in found
            return
        if held:
            return
        yaws = {name: known.yaw for name, known in self._known.items()}
        seen = {name: known.position for name, known in self._known.items() if name in found}
        if (taken := gripped(self._specs.values(), seen, yaws, hand.grip_site)) is not None:
            known = self._known[taken]
            known.held = _of_hand(hand.grip_site, hand.yaw, known.position, known.yaw)
            return
        unseen = {name: known.position for name, known in self._known.items() if name not in found}
        site, yaw = hand.grasp or (hand.grip_site, hand.yaw)
        if (taken := gripped(self._specs.values(), unseen, yaws, site)) is not None:
            offset, turn = _of_hand(site, yaw, self._known[taken].position, self._known[taken].yaw)
            # the fingers close along their y, and so have its grip in their middle
            grip = self._specs[taken].grip
            offset[1] = -turned(turn, np.array(grip.at))[1] if grip is not None else 0.0
            self._known[taken].held = offset, turn

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
            elif known.let_go:
                missing[name] = "let go of, and not seen since"
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
            yaws={n: k.yaw for n, k in self._known.items() if n not in sliding},
            missing=missing,
        )


def _in_hand(hand: Hand, held: tuple[Array, float]) -> tuple[Array, float]:
    """Where an object is that lies so in the hand, (3,) m, base frame, and its yaw."""
    offset, yaw = held
    return hand.grip_site + turned(hand.yaw, offset), yaw + hand.yaw


def _of_hand(site: Array, yaw: float, position: Array, turn: float) -> tuple[Array, float]:
    """How an object at `position`, turned by `turn`, lies in a hand at `site`: (3,) m in the hand's frame, and rad."""
    return turned(-yaw, position - site), turn - yaw


def _half_height(spec: ObjectSpec) -> float:
    return spec.half_size or spec.half[2]


def _reach(spec: ObjectSpec) -> float:
    return spec.half_size or max(spec.half[:2])
