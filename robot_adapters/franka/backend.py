"""What every way of driving a Franka must offer: `FrankaBackend`, and the values that cross that boundary.

Poses are of the end-effector frame that Franka's Desk is set to with the hand mounted, robot base frame: its origin is
the grip site of `skills.py`, 9 mm above the fingertips; at yaw 0 the fingers close along y and it points down.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import numpy as np

from robot_adapters.base import AdapterError, Array

READY: Array = np.array([0.0, -math.pi / 4, 0.0, -3 * math.pi / 4, 0.0, math.pi / 2, math.pi / 4])
"""(7,) rad: Franka's "ready" pose, the fingers pointing down half a metre before the base."""


class Mode(StrEnum):
    """What the arm is doing, as far as anybody needs to know."""

    IDLE = "idle"
    MOVING = "moving"
    REFLEX = "reflex"
    USER_STOPPED = "user_stopped"
    DISCONNECTED = "disconnected"


WORDS = {
    Mode.IDLE: "The arm stands still and can be used.",
    Mode.MOVING: "The arm is moving.",
    Mode.REFLEX: "The arm stopped itself because something pushed against it. An operator must look, then recover it.",
    Mode.USER_STOPPED: "The stop button is pressed, or somebody guides the arm by hand. Release the button first.",
    Mode.DISCONNECTED: "The arm can't be reached. Check its power, the network cable and that FCI is active in Desk.",
}
"""Each mode in words that a trainer understands."""


class ArmFault(AdapterError):
    """The arm can't go on: `mode` says in which state it is."""

    def __init__(self, message: str, *, mode: Mode, remedy: str = "") -> None:
        super().__init__(message, remedy=remedy or WORDS[mode])
        self.mode = mode


class FingersFault(ArmFault):
    """The fingers didn't do what they were told. The arm itself is well; somebody has to look at the hand."""


@dataclass(frozen=True)
class ArmState:
    """The arm at one moment of its own clock.

    time: s, the robot's clock. position: (3,) m. rotation: (3, 3) of the end-effector frame. joints, velocities: (7,)
    rad, rad/s. force: (3,) N, the robot's estimate of what it exerts at the hand. errors: names of active errors.
    """

    time: float
    position: Array
    rotation: Array
    joints: Array
    velocities: Array
    force: Array
    mode: Mode
    errors: tuple[str, ...] = ()

    @property
    def yaw(self) -> float:
        """Angle of the gripper about z, rad; 0 where the fingers close along y."""
        return math.atan2(self.rotation[1, 0], self.rotation[0, 0])

    @property
    def newtons(self) -> float:
        """How hard the hand pushes against something, N."""
        return float(np.linalg.norm(self.force))


@dataclass(frozen=True)
class HandState:
    """The hand: width in m between the fingers; busy while they move; `there` False where no hand answers."""

    width: float
    busy: bool
    there: bool = True


@dataclass(frozen=True)
class Goal:
    """Where the arm is to be now, and how fast it passes there.

    position: (3,) m. velocity: (3,) m/s. braked: (3,) m, where it comes to rest if it brakes from now on, for a
    backend that plans its own way there. yaw: rad, pointing down.
    """

    position: Array
    velocity: Array
    braked: Array
    yaw: float

    @property
    def quaternion(self) -> Array:
        """(4,) x, y, z, w of the end-effector frame: half a turn about an axis at half the yaw."""
        return np.array([math.cos(self.yaw / 2), math.sin(self.yaw / 2), 0.0, 0.0])


@dataclass(frozen=True)
class Facts:
    """What the control box tells of itself. fci: version of the interface, 5 (Panda) or 10 (FR3)."""

    backend: str
    fci: int | None
    firmware: str
    hand_firmware: str | None


class FrankaBackend(Protocol):
    """One connection to an arm and its hand, with the 1 kHz loop outside of Python.

    Used from one thread, but for `halt`. Every method raises ArmFault where the arm isn't able or isn't there.
    """

    def facts(self) -> Facts:
        """What was learned when connecting."""

    def state(self) -> ArmState:
        """The newest state; waits for a millisecond or two at most while all is well."""

    def hand(self) -> HandState:
        """The newest state of the hand."""

    def begin(self) -> None:
        """Take control: hold the present pose, and be ready for `track`."""

    def track(self, goal: Goal) -> None:
        """Go there within the limits that the backend was made with; returns at once."""

    def end(self) -> None:
        """Give control back: come to rest where the last goal is."""

    def halt(self) -> None:
        """Stop at once, wherever that is. Never raises, may be called from any thread and at any time."""

    def start_joints(self, joints: Array) -> None:
        """Begin to move to (7,) joint angles, rad, slowly; returns at once, `joints_arrived` tells."""

    def joints_arrived(self) -> bool:
        """Whether that has ended, and control is given back."""

    def grasp(self) -> None:
        """Begin to close the fingers on whatever is there: width 0 with a wide tolerance; `hand` tells what came."""

    def open(self) -> None:
        """Begin to open the fingers."""

    def recover(self) -> None:
        """Clear a reflex, because an operator said so; what comes of it is told by the next states.

        Raises:
            ArmFault: it can't be cleared; after a user stop only releasing the button helps.
        """

    def close(self) -> None:
        """Halt, and let go of the connection."""
