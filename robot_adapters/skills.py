"""The primitive skills as closed-loop straight-line waypoints over a small `Arm`: simulation and real robots share it.

Numbers marked *measured* were tuned on robosuite's Panda under OSC at 20 Hz.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Protocol

import numpy as np

from robot_adapters.base import Array, EndReason, SkillCall, SkillSpec, StepHook, StopCheck
from robot_adapters.projection import closing_direction, push_vector

STEP_CAP = 0.10  # m from the present pose to a set-point; measured: 0.6 m/s at most under kp 150
DESCENT_CAP = 0.06  # m, likewise on the way down, where something may be met before the target
PUSH_CAP = 0.013  # m, likewise while pushing: 0.08 m/s, and what blocks the way meets less than 100 N. Measured
OFF_LINE = 0.012  # m aside of the line at which the arm waits until it is back on it: a fast descent drags it aside
YAW_CAP = 0.5  # rad, likewise
TRANSIT_TOLERANCE = 0.03  # m; a waypoint that is only passed. Measured
FINE_TOLERANCE = 0.003  # m; a waypoint where the fingers act. Measured
YAW_TOLERANCE = 0.05  # rad, before a descent
SEGMENT_LIMIT = 120  # set-points to one waypoint (6 s at 20 Hz)
STALL_STEPS = 10  # set-points without progress, the arm at rest, before the skill gives up
PROGRESS = 0.0005  # m nearer (or as many rad times 0.1 m of lever) that count as progress
AT_REST = 0.001  # m in one set-point; the elbow's slow swing may take the hand aside and back. Measured
CONTACT = 0.02  # m; stalling this near where the fingers act means something is touched: they act all the same
CLOSING_DWELL = 5  # set-points until the fingers hold. Measured
OPENING_DWELL = 3  # set-points until a block is free. Measured
BRAKING = 4  # set-points that hold still after an overload: 0.6 m/s is gone in 0.2 s
LOWEST = 0.010  # m above the table for the grip site: the fingertips hang 9 mm lower
TRANSIT_CLEARANCE = 0.17  # m above the table: a held block passes over a stack of two
DIRECT = 0.05  # m to the side: a shorter reach needs no detour over the transit height
GRASPED_WIDTH = 0.005  # m between the fingers, below which they hold nothing
FINGER_REACH = 0.045  # m from the grip site to the outside of an open finger


class Arm(Protocol):
    """What a skill needs of a robot: where the gripper is, and one set-point after the other."""

    table_height: float
    """z of the table, m, robot base frame."""

    def pose(self) -> tuple[Array, float]:
        """Grip site (3,) m in the robot base frame, and the gripper's yaw about z in rad (0: fingers close along y)."""

    def gripper_width(self) -> float:
        """Distance between the fingers, m."""

    def gripper_closed(self) -> bool:
        """Whether the fingers were last commanded to close."""

    def step(self, target: Array, yaw: float, gripper_closed: bool) -> None:
        """Hold the set-point (3,) m, base frame, for one control period, then return."""

    def overload(self) -> str | None:
        """A force or joint that was beyond its limit in the last control period, in words; None if all was well."""


class _Ended(Exception):
    """Leaves the nested segments of a skill at once."""

    def __init__(self, reason: EndReason) -> None:
        super().__init__(reason)
        self.reason = reason


def run_skill(
    arm: Arm,
    call: SkillCall,
    spec: SkillSpec,
    *,
    should_stop: StopCheck,
    on_step: StepHook,
    yaw: float | None = None,
) -> tuple[EndReason, int]:
    """Run one checked skill call to its end; returns why it ended and how many set-points it sent.

    `should_stop` is polled before every set-point. Once it says True, one last set-point (the present pose, so the arm
    holds still) is sent and the reason is `stopped`. A skill that times out or stalls leaves the arm where it is.

    Args:
        arm: the robot.
        call: the skill and its parameters; checked against the task by the caller.
        spec: its spec, which names the parameters.
        should_stop: True as soon as the motion must end.
        on_step: called after every set-point.
        yaw: the gripper's angle where `spec` neither has a parameter `yaw` nor fixes it; None keeps the present angle.
    """
    motion = _Motion(arm, should_stop, on_step)
    values = call.named(spec)
    angle = values.get("yaw", yaw if spec.yaw is None else spec.yaw)
    try:
        if call.skill == "release":
            motion.fingers(closed=False)
            return EndReason.ARRIVED, motion.steps
        target = np.array([values["x"], values["y"], max(values["z"], arm.table_height + LOWEST)])
        if angle is not None:
            motion.yaw = float(angle)
        match call.skill:
            case "reach":
                motion.reach(target)
            case "pick":
                motion.pick(target)
            case "place":
                motion.place(target)
            case "push":
                motion.push(target, push_vector(values["direction"], values["delta"]))
            case _:
                raise ValueError(f"no such primitive: {call.skill!r}")
    except _Ended as ended:
        return ended.reason, motion.steps
    return EndReason.ARRIVED, motion.steps


def clear_yaw(target: Array, neighbours: Iterable[Array]) -> float:
    """The yaw (0 or a quarter turn, rad) whose open fingers come down farther from any of the (3,) neighbours.

    A block beside the target would be hit by a finger that descends between the two: measured, turning the fingers
    away lifted stacking from 92 to 100 of 100.
    """
    beside = [np.asarray(n)[:2] - target[:2] for n in neighbours]

    def clearance(yaw: float) -> float:
        finger = closing_direction(yaw)[:2] * FINGER_REACH
        return min((min(_norm(n - finger), _norm(n + finger)) for n in beside), default=math.inf)

    turned = math.pi / 2
    # 0.08 m: a block's half diagonal plus half a finger's width and some; beyond, nothing is in the way
    return 0.0 if clearance(0.0) >= min(clearance(turned), 0.08) else turned


class _Motion:
    """One skill in progress: the yaw and fingers to command, and the set-points sent so far."""

    def __init__(self, arm: Arm, should_stop: StopCheck, on_step: StepHook) -> None:
        self.arm = arm
        self.should_stop = should_stop
        self.on_step = on_step
        self.steps = 0
        self.yaw = arm.pose()[1]
        self.closed = arm.gripper_closed()

    # the skills

    def reach(self, target: Array) -> None:
        """Go to `target`, over the transit height unless it is near."""
        here, _ = self.arm.pose()
        if _norm((target - here)[:2]) > DIRECT:
            self._above(target)
        self._line(target, FINE_TOLERANCE)

    def pick(self, target: Array) -> None:
        """Open above `target`, descend, close, lift."""
        self.closed = False
        self._above(target)
        self._line(target, FINE_TOLERANCE, cap=DESCENT_CAP, contact=True)
        self.fingers(closed=True)
        self._lift()
        if self.arm.gripper_width() < GRASPED_WIDTH:
            raise _Ended(EndReason.NOTHING_GRASPED)

    def place(self, target: Array) -> None:
        """Carry to above `target`, descend, open, lift."""
        self._above(target)
        self._line(target, FINE_TOLERANCE, cap=DESCENT_CAP, contact=True)
        self.fingers(closed=False)
        self._lift()

    def push(self, start: Array, by: Array) -> None:
        """Descend with closed fingers at `start`, move along `by`, lift."""
        self.closed = True
        self._above(start)
        # a tool in the hand may stand on the table before the grip site is where it should be
        self._line(start, FINE_TOLERANCE, cap=DESCENT_CAP, contact=True)
        self._line(start + by, FINE_TOLERANCE, cap=PUSH_CAP, contact=True, level=True)
        self._lift()

    def fingers(self, *, closed: bool) -> None:
        """Open or close where the gripper is, and wait until that has happened."""
        self.closed = closed
        here, _ = self.arm.pose()
        for _ in range(CLOSING_DWELL if closed else OPENING_DWELL):
            self._set_point(here, self.yaw)

    # their parts

    def _above(self, target: Array) -> None:
        """Up, then across to above `target` at the transit height, turning on the way."""
        here, _ = self.arm.pose()
        height = max(self.arm.table_height + TRANSIT_CLEARANCE, target[2])
        if here[2] < height - TRANSIT_TOLERANCE:
            self._line(np.array([here[0], here[1], height]), TRANSIT_TOLERANCE)
        self._line(np.array([target[0], target[1], height]), TRANSIT_TOLERANCE / 3, turned=True)

    def _lift(self) -> None:
        """Straight up to the transit height."""
        here, _ = self.arm.pose()
        height = max(self.arm.table_height + TRANSIT_CLEARANCE, float(here[2]))
        self._line(np.array([here[0], here[1], height]), TRANSIT_TOLERANCE)

    def _line(
        self,
        target: Array,
        tolerance: float,
        *,
        cap: float = STEP_CAP,
        turned: bool = False,
        contact: bool = False,
        level: bool = False,
    ) -> None:
        """Move straight to `target` (3,) until within `tolerance` m (and the yaw's, if `turned`).

        With `level`, what is missing in height counts only beyond `CONTACT`: something may hold the arm up.

        Raises:
            _Ended: stopped, timed out, or stalled (with `contact`: farther than `CONTACT` from the target).
        """
        best, since = math.inf, 0
        start, _ = self.arm.pose()
        before = start
        length = max(_norm(target - start), 1e-9)
        along = (target - start) / length
        for _ in range(SEGMENT_LIMIT):
            here, yaw = self.arm.pose()
            away, turn = target - here, _wrap(self.yaw - yaw)
            if level and abs(away[2]) <= CONTACT:
                away[2] = 0.0
            distance = _norm(away)
            if distance <= tolerance and not (turned and abs(turn) > YAW_TOLERANCE):
                return
            left = distance + (0.1 * abs(turn) if turned else 0.0)
            if left < best - PROGRESS:
                best, since = left, 0
            elif _norm(here - before) < AT_REST:
                since += 1
            before = here
            if since >= STALL_STEPS:
                if contact and distance <= CONTACT:
                    return
                raise _Ended(EndReason.STALLED)
            # on the line and not from here towards the target, so that whatever drives the arm aside is corrected
            done = max(0.0, float((here - start) @ along))
            aside = _norm(here - start - done * along)
            ahead = min(length, done + cap * max(0.0, 1.0 - aside / OFF_LINE))
            self._set_point(start + ahead * along, yaw + min(max(turn, -YAW_CAP), YAW_CAP))
        raise _Ended(EndReason.TIMEOUT)

    def _set_point(self, target: Array, yaw: float) -> None:
        """One set-point, or the one that holds still where the motion must stop."""
        stop = self.should_stop()
        if stop:
            target, yaw = self.arm.pose()
        self.arm.step(target, yaw, self.arm.gripper_closed() if stop else self.closed)
        self.steps += 1
        self.on_step()
        if stop:
            raise _Ended(EndReason.STOPPED)
        if self.arm.overload() is not None:
            self._brake()
            raise _Ended(EndReason.FORCE_LIMIT)

    def _brake(self) -> None:
        """Hold still until the arm has stopped and presses against nothing."""
        here, yaw = self.arm.pose()
        for _ in range(BRAKING):
            self.arm.step(here, yaw, self.closed)
            self.steps += 1
            self.on_step()


def _norm(vector: Array) -> float:
    return math.sqrt(vector.dot(vector))


def _wrap(angle: float) -> float:
    """The same angle within (-pi, pi]."""
    return math.remainder(angle, 2 * math.pi)
