"""How every backend drives the arm: where it is, how fast, how stiff, and how hard it may be pushed."""

from __future__ import annotations

from dataclasses import dataclass

from robot_adapters.base import Unavailable
from robot_adapters.franka.backend import WORDS, Mode

REFLEX_TORQUE = 40.0
"""Nm at each joint, upper threshold: forces at the hand are to be the tighter limit."""


@dataclass(frozen=True)
class Driving:
    """Bounds and manners of a motion, in m, s, N.

    host: of the control box (deoxys: of the arm's computer). bind: address of this PC that Deoxys listens to. realtime:
    refuse to run without a real-time kernel. stiffness: N/m. force: N at the hand at which a motion ends. reflex: N at
    the hand at which the robot stops itself. leash: m that the goal may be ahead. homing_fraction: of each joint's own
    limits, on the way home. silence: s without a new state after which the arm counts as gone. dead_man: s without a
    sign of life of whoever drives, after which a backend that repeats goals stops by itself.
    """

    host: str
    bind: str = "*"
    realtime: bool = False
    speed: float = 0.25
    acceleration: float = 0.8
    turning: float = 1.0
    stiffness: float = 1000.0
    leash: float = 0.03
    force: float = 25.0
    reflex: float = 45.0
    homing_fraction: float = 0.15
    silence: float = 0.5
    dead_man: float = 0.6

    def collision_behaviour(self) -> tuple[list[float], list[float], list[float], list[float]]:
        """Lower and upper torques (7,) Nm, lower and upper forces (6,) N and Nm."""
        torques, forces = [REFLEX_TORQUE] * 7, [self.reflex] * 6
        return [t / 2 for t in torques], torques, [f / 2 for f in forces], forces

    def unreachable(self, error: Exception) -> Unavailable:
        """The error to raise where the arm can't be connected to."""
        return Unavailable(f"the arm at {self.host} can't be reached: {error}", remedy=WORDS[Mode.DISCONNECTED])
