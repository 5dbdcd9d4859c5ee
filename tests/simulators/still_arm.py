"""A double for a Franka backend, without physics or protocol: it follows its goals at once, and lists them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.backend import READY, ArmFault, ArmState, Facts, Goal, HandState, Mode

TICK = 0.05 / 3  # s of the robot's clock from one look to the next: three looks a set-point
WAY_HOME = 20  # looks that the way home lasts
HOME = np.array([0.307, 0.0, 0.487])


@dataclass(frozen=True)
class Order:
    """Something that moves arm or fingers. place: (3,) m, where a goal is."""

    what: str
    place: Array | None = None


class StillArm:
    """`FrankaBackend` for what rests on the order of things only. A test sets what its comments name."""

    def __init__(self) -> None:
        self.orders: list[Order] = []
        """Everything that would have moved a real arm, in order."""
        self.position, self.yaw, self.joints = HOME.copy(), 0.0, READY.copy()
        self.width, self.found, self.stuck = 0.08, 0.04, False  # m; m that they find; whether they don't move
        self.mode, self.there, self.frozen, self.newtons = Mode.IDLE, True, False, 0.0
        self._controlled, self._time, self._homing = False, 0.0, 0

    @property
    def driven(self) -> bool:
        """Whether somebody has control of it."""
        return self._controlled or self._homing > 0

    def facts(self) -> Facts:
        """See `FrankaBackend`."""
        return Facts("still", None, "none", None)

    def state(self) -> ArmState:
        """See `FrankaBackend`."""
        if self.mode is Mode.DISCONNECTED:
            raise ArmFault("the arm doesn't answer", mode=Mode.DISCONNECTED)
        self._time += 0.0 if self.frozen else TICK
        cos, sin = np.cos(self.yaw), np.sin(self.yaw)
        rotation = np.array([[cos, sin, 0.0], [sin, -cos, 0.0], [0.0, 0.0, -1.0]])
        mode = Mode.MOVING if self.driven and self.mode is Mode.IDLE else self.mode
        force, still = np.array([0.0, 0.0, self.newtons]), np.zeros(7)
        return ArmState(self._time, self.position.copy(), rotation, self.joints.copy(), still, force, mode)

    def hand(self) -> HandState:
        """See `FrankaBackend`."""
        return HandState(self.width, busy=False, there=self.there)

    def begin(self) -> None:
        """See `FrankaBackend`."""
        self._must_be_able()
        self.orders.append(Order("begin"))
        self._controlled = True

    def track(self, goal: Goal) -> None:
        """See `FrankaBackend`."""
        self.orders.append(Order("track", goal.position))
        if self._controlled and self.mode is Mode.IDLE:
            self.position, self.yaw = goal.position.copy(), goal.yaw

    def end(self) -> None:
        """See `FrankaBackend`."""
        self._controlled = False

    def halt(self) -> None:
        """See `FrankaBackend`."""
        self._controlled, self._homing = False, 0

    def start_joints(self, joints: Array) -> None:
        """See `FrankaBackend`."""
        self._must_be_able()
        self.orders.append(Order("start_joints"))
        self._homing = WAY_HOME

    def joints_arrived(self) -> bool:
        """See `FrankaBackend`."""
        if self._homing and self.mode is Mode.IDLE and not self.frozen:
            self._homing -= 1
            if not self._homing:
                self.position, self.joints = HOME.copy(), READY.copy()
        return not self._homing

    def grasp(self) -> None:
        """See `FrankaBackend`."""
        self.orders.append(Order("grasp"))
        self.width = self.width if self.stuck else self.found

    def open(self) -> None:
        """See `FrankaBackend`."""
        self.orders.append(Order("open"))
        self.width = self.width if self.stuck else 0.08

    def recover(self) -> None:
        """See `FrankaBackend`."""
        if self.mode is Mode.REFLEX:
            self.mode = Mode.IDLE

    def close(self) -> None:
        """See `FrankaBackend`."""

    def _must_be_able(self) -> None:
        if self.mode is not Mode.IDLE:
            raise ArmFault(f"the arm is in state {self.mode}", mode=self.mode)
