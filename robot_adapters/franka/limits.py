"""What the arm may do, held before every set-point: workspace, speed, acceleration, force."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import AdapterError, Array
from robot_adapters.franka.backend import ArmState, Goal

SLACK = 0.02
"""m beyond the workspace that is clipped; farther is refused: nobody asks for that by accident."""
OUT_OF_REACH = 0.855
"""m from the shoulder (Franka's datasheet): beyond, the arm can't follow."""
SHOULDER = np.array([0.0, 0.0, 0.333])
"""(3,) m, robot base frame."""
JointLimits = tuple[tuple[float, float], ...]
"""Lowest and highest of each of the seven joints, rad."""
PANDA: JointLimits = (
    (-2.8973, 2.8973), (-1.7628, 1.7628), (-2.8973, 2.8973), (-3.0718, -0.0698),
    (-2.8973, 2.8973), (-0.0175, 3.7525), (-2.8973, 2.8973),
)  # fmt: skip
"""Franka's documentation of its control parameters, as is the next."""
FR3: JointLimits = (
    (-2.7437, 2.7437), (-1.7837, 1.7837), (-2.9007, 2.9007), (-3.0421, -0.1518),
    (-2.8065, 2.8065), (0.5445, 4.5169), (-3.0159, 3.0159),
)  # fmt: skip
SIDEWAYS = 0.004
"""m to the side per set-point below which a motion downwards counts as an approach."""


def joint_limits(fci: int | None) -> JointLimits:
    """Of the arm that speaks this version of the interface: 5 is a Panda, 10 an FR3. Else what is free for both."""
    known = {5: PANDA, 10: FR3}
    if fci in known:
        return known[fci]
    return tuple((max(a[0], b[0]), min(a[1], b[1])) for a, b in zip(PANDA, FR3, strict=True))


class Refused(AdapterError):
    """A set-point that lies outside of the limits. It wasn't sent."""


@dataclass(frozen=True)
class Limits:
    """Bounds of every set-point; m, s, N, robot base frame.

    low, high: (3,) corners of the box for the grip site. approach: m above `table`, below which a descent is slow.
    leash: m that a goal may be ahead of where the arm really is, beside the way that it needs to brake.
    """

    low: Array
    high: Array
    table: float
    speed: float = 0.25
    acceleration: float = 0.8
    approach_speed: float = 0.04
    approach: float = 0.07
    turning: float = 1.0
    force: float = 25.0
    leash: float = 0.03


class Pacer:
    """Turns set-points, some of them far, into goals that a moving arm can follow within its limits.

    The goal moves along its way like a point with the limits' speed and acceleration; it slows down before its end and,
    on the way down, before the height at which something may be met.
    """

    def __init__(self, limits: Limits, state: ArmState, period: float) -> None:
        """Begin at rest where the arm is. period: s between two set-points."""
        self._limits = limits
        self._period = period
        self.position = state.position.copy()
        self.yaw = state.yaw
        self.speed = 0.0

    def next(self, state: ArmState, target: Array, yaw: float) -> Goal:
        """The goal for the next period.

        Args:
            state: the arm now.
            target: (3,) m, the set-point.
            yaw: rad, likewise.

        Raises:
            Refused: not finite, or too far outside of the workspace.
        """
        aim = self._inside(target, yaw, state.position)
        way = aim - self.position
        distance = float(np.linalg.norm(way))
        limits, period = self._limits, self._period
        along = way / distance if distance > 1e-9 else np.zeros(3)
        fastest = self._allowed(along)
        brakes = math.sqrt(2.0 * limits.acceleration * max(0.0, distance - self.speed * period / 2))
        self.speed = min(fastest, brakes, self.speed + limits.acceleration * period)
        stride = min(distance, self.speed * period)
        position = self._leashed(self.position + stride * along, state.position)
        velocity = along * self.speed if stride < distance else np.zeros(3)
        ahead = self.speed**2 / (2.0 * limits.acceleration)
        braked = position + min(ahead, float(np.linalg.norm(aim - position))) * along
        turn = math.remainder(yaw - self.yaw, 2 * math.pi)
        self.yaw += min(max(turn, -limits.turning * period), limits.turning * period)
        self.position = position
        return Goal(position, velocity, braked, self.yaw)

    def rest(self, state: ArmState) -> None:
        """Begin anew where the arm is, at rest."""
        self.position, self.speed = state.position.copy(), 0.0

    def _inside(self, target: Array, yaw: float, here: Array) -> Array:
        """The set-point within the workspace; from outside of it, only the way back is free."""
        limits = self._limits
        if not (np.isfinite(target).all() and math.isfinite(yaw)):
            raise Refused("a set-point isn't a number", remedy="report this: no skill may ask for it")
        clipped = np.clip(target, limits.low, limits.high)
        off = float(np.abs(clipped - target).max())
        outside = float(np.abs(np.clip(here, limits.low, limits.high) - here).max())
        if off > max(SLACK, outside):
            where = ", ".join(f"{v:.3f}" for v in target)
            raise Refused(
                f"a set-point at ({where}) m lies {100 * off:.0f} cm outside of the arm's workspace",
                remedy="widen workspace_low and workspace_high in the adapter's settings if the arm may go there",
            )
        if float(np.linalg.norm(clipped - SHOULDER)) > OUT_OF_REACH:
            raise Refused("a set-point is farther than the arm can reach", remedy="keep the workspace within 0.85 m")
        return clipped

    def _allowed(self, along: Array) -> float:
        """m/s in this direction here: on the way down less and less, until it is the approach's."""
        limits = self._limits
        if along[2] > -0.3:  # rather to the side than down: what is there has been passed over
            return limits.speed
        left = max(0.0, float(self.position[2]) - limits.table - limits.approach) / -float(along[2])
        return min(limits.speed, math.sqrt(limits.approach_speed**2 + 2.0 * limits.acceleration * left))

    def _leashed(self, goal: Array, here: Array) -> Array:
        """The goal, no farther from the arm than its leash and its speed allow: an arm that is held isn't pushed on."""
        longest = self._limits.leash + 0.12 * self.speed  # s: how far an impedance controller trails behind, measured
        away = goal - here
        distance = float(np.linalg.norm(away))
        if distance <= longest:
            return goal
        self.speed = min(self.speed, self._limits.approach_speed)
        leashed: Array = here + away * (longest / distance)
        return leashed
