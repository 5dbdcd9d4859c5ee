"""The second backend: franky over libfranka, with an impedance in C++ that reacts to force within a millisecond.

franky and pylibfranka can't share a process; this one imports neither before it is asked for.
"""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from typing import Any

import numpy as np

from robot_adapters.base import Array, Unavailable
from robot_adapters.franka.backend import READY, ArmFault, ArmState, Facts, Goal, HandState, Mode
from robot_adapters.franka.driving import Driving
from robot_adapters.franka.fingers import GRASP_FORCE, SPEED, WIDEST, Fingers
from robot_adapters.franka.scheduling import as_before, inherited

log = logging.getLogger(__name__)

ROTATIONAL = 40.0
"""Nm/rad that hold the hand upright."""
POSTURE = 8.0
"""Nm/rad that draw the elbow back to where it is at home, where that doesn't move the hand."""


class Franky:
    """`FrankaBackend` by franky-control 2."""

    def __init__(self, driving: Driving) -> None:
        """Connect.

        Raises:
            Unavailable: the package or the arm can't be had.
        """
        try:
            import franky  # noqa: PLC0415  the server lists adapters without loading a driver
        except ImportError as error:
            raise Unavailable(f"franky can't be imported: {error}", remedy="pip install seed-robot[franka]") from error
        self._driver = franky
        self._driving = driving
        self._motion: Any = None
        realtime = franky.RealtimeConfig.Enforce if driving.realtime else franky.RealtimeConfig.Ignore
        modes = franky.RobotMode
        self._modes = {
            int(modes.Other): Mode.IDLE,
            int(modes.Idle): Mode.IDLE,
            int(modes.Move): Mode.MOVING,
            int(modes.Reflex): Mode.REFLEX,
        }
        try:
            with as_before():
                self._robot = franky.Robot(driving.host, realtime_config=realtime)
            self._robot.set_collision_behavior(*driving.collision_behaviour())
        except franky.Exception as error:
            raise driving.unreachable(error) from error
        self._fingers = Fingers(
            lambda: _Hand(franky.Gripper(driving.host)), (franky.Exception, franky.GripperException)
        )

    def facts(self) -> Facts:
        """See `FrankaBackend`. libfranka 0.21 speaks version 10 only, and keeps the firmware's number to itself."""
        return Facts("franky", 10, "not told by franky", None)

    def state(self) -> ArmState:
        """See `FrankaBackend`."""
        try:
            if self._motion is not None and not self._robot.is_in_control:
                self._join()
            raw = self._robot.state
            if self._motion is None:  # that one may have waited in the socket, where newer ones found no room
                raw = self._robot.state
        except self._driver.Exception as error:
            raise ArmFault(f"the arm doesn't answer: {error}", mode=Mode.DISCONNECTED) from error
        pose = raw.O_T_EE.matrix
        mode = self._modes.get(int(raw.robot_mode), Mode.USER_STOPPED)
        return ArmState(
            raw.time.to_sec(),
            pose[:3, 3].copy(),
            pose[:3, :3].copy(),
            np.asarray(raw.q).ravel(),
            np.asarray(raw.dq).ravel(),
            np.asarray(raw.O_F_ext_hat_K).ravel()[:3],
            mode,
            tuple(_names(raw.current_errors) if mode is Mode.REFLEX else ()),
        )

    def hand(self) -> HandState:
        """See `FrankaBackend`."""
        return self._fingers.state

    def begin(self) -> None:
        """See `FrankaBackend`."""
        franky, driving = self._driver, self._driving
        self._join()
        with self._starting():
            motion = franky.CartesianImpedanceTrackingMotion(
                translational_stiffness=driving.stiffness,
                rotational_stiffness=ROTATIONAL,
                translational_error_clip=np.full(3, driving.leash),
                posture_task=franky.PostureTask(target=READY, stiffness=np.full(7, POSTURE)),
            )
            measure = franky.Measure
            force = measure.FORCE_X**2 + measure.FORCE_Y**2 + measure.FORCE_Z**2
            motion.add_reaction(franky.Reaction(force > driving.force**2, franky.TorqueStopMotion()))
            motion.set_reference(franky.CartesianReference(target=self._robot.current_pose.end_effector_pose))
            self._robot.move(motion, asynchronous=True)
            self._motion = motion

    def track(self, goal: Goal) -> None:
        """See `FrankaBackend`. It has no profile of its own: the goal's velocity is what it damps towards."""
        franky = self._driver
        motion = self._motion  # a halt from another thread takes it away
        if motion is None or not self._robot.is_in_control:
            if motion is not None:  # by its own reaction; whoever asks for the force hears why
                self._join()
            return
        target = franky.Affine(goal.position, goal.quaternion)
        twist = franky.Twist(goal.velocity, np.zeros(3))
        motion.set_reference(franky.CartesianReference(target=target, target_twist=twist))

    def end(self) -> None:
        """See `FrankaBackend`."""
        if self._motion is not None and self._robot.is_in_control:
            with contextlib.suppress(self._driver.Exception), inherited(realtime=self._driving.realtime):
                self._robot.move(self._driver.TorqueStopMotion(), asynchronous=True)
        self._join()

    def halt(self) -> None:
        """See `FrankaBackend`."""
        try:
            self._robot.stop()
        except self._driver.Exception as error:
            log.warning("the arm was told to stop: %s", error)
        self._fingers.stop()
        self._join()

    def start_joints(self, joints: Array) -> None:
        """See `FrankaBackend`."""
        self._join()
        with self._starting():
            motion = self._driver.JointMotion(joints, relative_dynamics_factor=self._driving.homing_fraction)
            self._robot.move(motion, asynchronous=True)
            self._motion = motion

    def joints_arrived(self) -> bool:
        """See `FrankaBackend`."""
        if self._motion is not None and self._robot.is_in_control:
            return False
        self._join()
        return True

    def grasp(self) -> None:
        """See `FrankaBackend`."""
        self._fingers.ask("grasp")

    def open(self) -> None:
        """See `FrankaBackend`."""
        self._fingers.ask("open")

    def recover(self) -> None:
        """See `FrankaBackend`."""
        self._join()
        try:
            self._robot.recover_from_errors()  # what it returns is of a state from before
        except self._driver.Exception as error:
            raise ArmFault(f"the arm doesn't recover: {error}", mode=self.state().mode) from error

    def close(self) -> None:
        """See `FrankaBackend`."""
        self.halt()
        self._fingers.close()
        del self._robot  # the box serves one client: the connection ends with its last reference

    @contextlib.contextmanager
    def _starting(self) -> Iterator[None]:
        try:
            with inherited(realtime=self._driving.realtime):  # its loop is a thread that this one starts
                yield
        except self._driver.Exception as error:
            self._motion = None
            raise ArmFault(f"the arm doesn't start: {error}", mode=self.state().mode) from error

    def _join(self) -> None:
        """Wait for the end of the motion, which is on its way; why it ended is told by the next state."""
        motion, self._motion = self._motion, None
        if motion is None:
            return
        try:
            self._robot.join_motion()
        except self._driver.Exception as error:
            log.info("the motion ended: %s", error)


class _Hand:
    """franky's gripper as a `fingers.Hand`."""

    def __init__(self, gripper: Any) -> None:
        self._gripper = gripper

    def width(self) -> float:
        return float(self._gripper.width)

    def grasp(self) -> None:
        self._gripper.grasp(0.0, SPEED, GRASP_FORCE, WIDEST, WIDEST)

    def open(self) -> None:
        self._gripper.move(WIDEST, SPEED)

    def stop(self) -> None:
        self._gripper.stop()


def _names(errors: Any) -> Iterator[str]:
    """Of the errors that are set."""
    return (name for name in dir(type(errors)) if not name.startswith("_") and getattr(errors, name) is True)
