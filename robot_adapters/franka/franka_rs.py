"""The default backend: franka-rs, whose Cartesian impedance runs on a Rust thread that never waits for Python."""

from __future__ import annotations

import contextlib
import logging
import math
import threading
from typing import Any

import numpy as np

from robot_adapters.base import Array, Unavailable
from robot_adapters.franka.backend import ArmFault, ArmState, Facts, Goal, HandState, Mode
from robot_adapters.franka.driving import Driving
from robot_adapters.franka.fingers import GRASP_FORCE, SPEED, WIDEST, Fingers
from robot_adapters.franka.scheduling import as_before, ordinary

log = logging.getLogger(__name__)

MODES = {"idle": Mode.IDLE, "move": Mode.MOVING, "reflex": Mode.REFLEX, "other": Mode.IDLE}
"""The rest (user stop, guiding by hand, recovery under way) isn't ours to move in."""
JERK = 20.0
"""m/s^3 and, turning, rad/s^3 times ten: a fiftieth of what the arm can (Franka's limits: 6500 m/s^3)."""


class FrankaRs:
    """`FrankaBackend` by franka-rs 0.4."""

    def __init__(self, driving: Driving) -> None:
        """Connect.

        Raises:
            Unavailable: the package or the arm can't be had.
        """
        try:
            import franka  # noqa: PLC0415  the server lists adapters without loading a driver
        except ImportError as error:
            raise Unavailable(
                f"franka-rs can't be imported: {error}", remedy="pip install seed-robot[franka]"
            ) from error
        self._driver = franka
        self._driving = driving
        self._session: Any = None
        self._ending = threading.Lock()
        """A halt may come from another thread; the arm isn't read before its session is let go of."""
        self._joints: Array | None = None
        realtime = "enforce" if driving.realtime else "ignore"
        try:
            with as_before():  # its loops at 1 kHz see to their own priority
                self._robot = franka.Robot(driving.host, realtime=realtime)
            self._robot.set_collision_behavior_simple(*driving.collision_behaviour())
        except franka.FrankaError as error:
            raise driving.unreachable(error) from error
        self._fingers = Fingers(lambda: _Hand(self._robot.gripper()), (franka.FrankaError,))

    def facts(self) -> Facts:
        """See `FrankaBackend`."""
        return Facts("franka-rs", self._robot.fci_version, str(self._robot.server_version), None)

    def state(self) -> ArmState:
        """See `FrankaBackend`."""
        session = self._session
        try:
            raw = session.state() if session is not None else self._fresh()
        except self._driver.FrankaError as error:
            if session is not self._session:  # halted meanwhile, from another thread
                return self.state()
            raise ArmFault(f"the arm doesn't answer: {error}", mode=Mode.DISCONNECTED) from error
        mode = MODES.get(raw.robot_mode, Mode.USER_STOPPED)
        if session is not None and not session.running:
            mode = self._why_ended(session, mode)
        pose = raw.O_T_EE
        return ArmState(
            raw.time,
            pose[:3, 3].copy(),
            pose[:3, :3].copy(),
            raw.q,
            raw.dq,
            raw.O_F_ext_hat_K[:3],
            mode,
            tuple(raw.current_errors) or tuple(raw.last_motion_errors if mode is Mode.REFLEX else ()),
        )

    def hand(self) -> HandState:
        """See `FrankaBackend`."""
        return self._fingers.state

    def begin(self) -> None:
        """See `FrankaBackend`."""
        driving = self._driving
        self._start(
            self._robot.cartesian_targets,
            max_velocity=driving.speed * 1.2,  # the pacer sets the pace: its goals are to be kept up with
            max_acceleration=driving.acceleration * 1.5,
            max_jerk=JERK,
            max_angular_velocity=driving.turning * 1.5,
            max_angular_acceleration=5.0,
            max_angular_jerk=100.0,
            max_deviation=2.0,
            max_angular_deviation=math.pi,
            cartesian_stiffness=driving.stiffness,
            leash=(driving.leash, 0.2),
        )

    def track(self, goal: Goal) -> None:
        """See `FrankaBackend`. Its own profile needs to know where to come to rest."""
        self._go([*goal.braked, *goal.quaternion])

    def end(self) -> None:
        """See `FrankaBackend`."""
        with self._ending:
            session, self._session = self._session, None
            if session is not None:
                with contextlib.suppress(self._driver.FrankaError):  # the state tells what is wrong, if anything is
                    session.stop()

    def halt(self) -> None:
        """See `FrankaBackend`."""
        try:
            self._robot.stop()
        except self._driver.FrankaError as error:
            log.warning("the arm was told to stop: %s", error)
        self._fingers.stop()
        self.end()

    def start_joints(self, joints: Array) -> None:
        """See `FrankaBackend`."""
        self._start(self._robot.joint_targets, fraction=self._driving.homing_fraction, max_deviation=math.pi)
        self._joints = joints
        self._go(joints)

    def joints_arrived(self) -> bool:
        """See `FrankaBackend`."""
        session, joints = self._session, self._joints
        if session is None or joints is None:
            return True
        try:
            state = session.state()
        except self._driver.FrankaError:  # the next state tells why, or that it was halted
            return False
        if session.running and (
            np.abs(state.q - joints).max() > 0.01 or np.abs(state.dq).max() > 0.01  # rad, rad/s
        ):
            return False
        self._joints = None
        self.end()
        return True

    def grasp(self) -> None:
        """See `FrankaBackend`."""
        self._fingers.ask("grasp")

    def open(self) -> None:
        """See `FrankaBackend`."""
        self._fingers.ask("open")

    def recover(self) -> None:
        """See `FrankaBackend`."""
        self.end()
        try:
            self._robot.automatic_error_recovery()
        except self._driver.FrankaError as error:
            raise ArmFault(f"the arm doesn't recover: {error}", mode=self.state().mode) from error

    def close(self) -> None:
        """See `FrankaBackend`."""
        self.halt()
        self._fingers.close()
        del self._robot  # the box serves one client: the connection ends with its last reference

    def _fresh(self) -> Any:
        """A state of now: the first may have waited in the socket, where newer ones found no room."""
        with self._ending:
            self._robot.read_once()
            return self._robot.read_once()

    def _start(self, kind: Any, **settings: Any) -> None:
        self.end()
        try:
            self._session = kind(**settings).__enter__()
            if not self._driving.realtime:
                ordinary("franka-")  # it takes the highest priority whether asked to or not
        except self._driver.FrankaError as error:
            raise ArmFault(f"the arm doesn't start: {error}", mode=self.state().mode) from error

    def _go(self, target: Any) -> None:
        """Move the target of the loop; where the loop has just ended by itself, the next state tells why."""
        session = self._session
        if session is not None:
            with contextlib.suppress(self._driver.FrankaError):
                session.move_to(target)

    def _why_ended(self, session: Any, told: Mode) -> Mode:
        """The loop has ended: by a reflex, a user stop, or because nothing comes through any more."""
        if told in {Mode.REFLEX, Mode.USER_STOPPED}:
            return told
        with self._ending:
            if self._session is session:  # else a halt from another thread has ended it
                self._session = None
                try:
                    session.stop()
                except self._driver.ControlException as error:
                    log.warning("the motion was aborted: %s", error)
                except self._driver.FrankaError as error:
                    log.warning("the connection broke: %s", error)
                    return Mode.DISCONNECTED
        return self.state().mode


class _Hand:
    """franka-rs's gripper as a `fingers.Hand`."""

    def __init__(self, gripper: Any) -> None:
        self._gripper = gripper

    def width(self) -> float:
        return float(self._gripper.read_once().width)

    def grasp(self) -> None:
        self._gripper.grasp(0.0, SPEED, GRASP_FORCE, WIDEST, WIDEST)

    def open(self) -> None:
        self._gripper.move(WIDEST, SPEED)

    def stop(self) -> None:
        self._gripper.stop()
