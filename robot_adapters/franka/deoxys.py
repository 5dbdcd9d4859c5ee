"""The third backend: a Deoxys that already runs on the arm's own computer, spoken to over its own wire.

This PC binds 5555 (commands to the arm) and 5557 (to the hand); the arm's computer binds 5556 (states, a hundred a
second) and 5558 (the hand's). What is on them is `deoxys.proto`; `deoxys_pb2.py` is written by protoc from it.
"""

from __future__ import annotations

import contextlib
import logging
import math
import threading
import time
from typing import Any

import numpy as np

from robot_adapters.base import Array, Unavailable
from robot_adapters.franka.backend import WORDS, ArmFault, ArmState, Facts, Goal, HandState, Mode
from robot_adapters.franka.driving import Driving
from robot_adapters.franka.fingers import GRASP_FORCE, SPEED, WIDEST

log = logging.getLogger(__name__)

ARM_COMMANDS, ARM_STATES, HAND_COMMANDS, HAND_STATES = 5555, 5556, 5557, 5558
AGAIN = 0.05
"""s between two commands; Deoxys wants twenty a second."""
TIMEOUT = 0.2
"""s after which Deoxys stops the arm by itself where no command comes."""
ONCE_MORE = 0.1
"""s for a state to come before the arm counts as gone: after a pause of this process what came waits to be read."""
PATIENCE = 3.0
"""s for the first states: sockets connect in the background."""
SETTLED = 0.35
"""s for which fingers that have moved are seen to stand still before they count as arrived."""
BEGINNING = 1.0
"""s that fingers which have been told to move may take to begin; then they count as arrived where they are."""
STILL = 0.0003
"""m between two looks at fingers that stand still."""
ROTATIONAL = 60.0
"""Nm/rad that hold the hand upright."""


class Deoxys:
    """`FrankaBackend` over Deoxys. It has no limits of its own for the speed: the pacer's goals are the limit."""

    def __init__(self, driving: Driving) -> None:
        """Bind, connect, and wait for the first states.

        Raises:
            Unavailable: packages are missing, a port is taken, or nothing is heard of the arm.
        """
        try:
            import zmq  # noqa: PLC0415  the server lists adapters without it

            from robot_adapters.franka import deoxys_pb2  # noqa: PLC0415  likewise
        except ImportError as error:
            raise Unavailable(f"no Deoxys without: {error}", remedy="pip install seed-robot[franka]") from error
        self._zmq, self._messages, self._driving = zmq, deoxys_pb2, driving
        self._context = zmq.Context()
        try:
            self._arm = self._bound(ARM_COMMANDS)
            self._fingers = self._bound(HAND_COMMANDS)
        except zmq.ZMQError as error:
            self._context.destroy(linger=0)
            raise Unavailable(
                f"this PC can't listen on {driving.bind}: {error}", remedy="end the program that holds 5555 or 5557"
            ) from error
        self._arm_states = self._connected(ARM_STATES)
        self._hand_states = self._connected(HAND_STATES)
        self._sending = threading.Lock()
        self._command: bytes | None = None
        self._alive_at = 0.0
        """When whoever drives the arm looked at it last, or sent something."""
        self._forceless = False
        self._state: Any = None
        self._heard_at = time.monotonic()
        self._width: float | None = None
        self._hand_heard_at = time.monotonic()
        self._asked_at: float | None = None
        self._moved_at = self._watched_since = 0.0
        self._joints: Array | None = None
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._repeat, name="deoxys", daemon=True)
        until = time.monotonic() + PATIENCE
        while self._state is None or self._width is None:
            self._hear(0.05)
            if time.monotonic() > until:
                self._context.destroy(linger=0)
                heard = "the arm but not its hand" if self._state is not None else "nothing"
                if self._forceless:
                    raise Unavailable(
                        f"Deoxys on {driving.host} doesn't tell the force at the hand, without which no limit holds",
                        remedy="run a Deoxys there whose states carry O_F_ext_hat_K",
                    )
                raise Unavailable(
                    f"Deoxys on {driving.host} tells {heard}", remedy="start its arm and gripper programs there"
                )
        self._thread.start()

    def facts(self) -> Facts:
        """See `FrankaBackend`. Deoxys keeps versions to itself."""
        return Facts("deoxys", None, "not told by Deoxys", None)

    def state(self) -> ArmState:
        """See `FrankaBackend`."""
        self._live()
        self._hear(0.0)
        if self._unheard():
            self._hear(ONCE_MORE)
        if self._unheard():
            raise ArmFault("Deoxys doesn't tell of the arm any more", mode=Mode.DISCONNECTED)
        raw, modes = self._state, self._messages.FrankaRobotStateMessage
        known = {modes.Other: Mode.IDLE, modes.Idle: Mode.IDLE, modes.Move: Mode.MOVING, modes.Reflex: Mode.REFLEX}
        pose = np.array(raw.O_T_EE).reshape(4, 4).T
        return ArmState(
            raw.time.toSec,
            pose[:3, 3],
            pose[:3, :3],
            np.array(raw.q),
            np.array(raw.dq),
            np.array(raw.O_F_ext_hat_K[:3]),
            known.get(raw.robot_mode, Mode.USER_STOPPED),
        )

    def hand(self) -> HandState:
        """See `FrankaBackend`. That the fingers have arrived is told by their standing still."""
        self._hear(0.0)
        if self._hand_unheard():
            self._hear(ONCE_MORE)
        if self._asked_at is not None:
            moved = self._moved_at > self._asked_at
            since = max(self._asked_at, self._moved_at, self._watched_since)
            if self._hand_heard_at - since > (SETTLED if moved else BEGINNING):
                self._asked_at = None
        return HandState(self._width or 0.0, self._asked_at is not None, there=not self._hand_unheard())

    def begin(self) -> None:
        """See `FrankaBackend`. Deoxys takes control with the first goal."""

    def track(self, goal: Goal) -> None:
        """See `FrankaBackend`: an absolute pose for its operational space control."""
        messages = self._messages
        x, y, z = goal.position
        half = goal.yaw / 2  # pointing down: half a turn about an axis at half the yaw
        turn = (math.pi * math.cos(half), math.pi * math.sin(half), 0.0)
        pose = messages.FrankaOSCPoseControllerMessage(
            goal=messages.Goal(is_delta=False, x=x, y=y, z=z, ax=turn[0], ay=turn[1], az=turn[2]),
            translational_stiffness=[self._driving.stiffness] * 3,
            rotational_stiffness=[ROTATIONAL] * 3,
        )
        kinds = messages.FrankaControlMessage
        self._send(self._arm_command(pose, kinds.OSC_POSE, kinds.LINEAR_POSE, fraction=0.3))

    def end(self) -> None:
        """See `FrankaBackend`."""
        self._terminate()

    def halt(self) -> None:
        """See `FrankaBackend`. Fingers that stand are left alone: a stop would let go of what they hold."""
        self._terminate()
        if self._asked_at is not None:
            self._asked_at = None
            self._say_to_hand(self._messages.FrankaGripperStopMessage(stop=True))

    def start_joints(self, joints: Array) -> None:
        """See `FrankaBackend`."""
        messages, kinds = self._messages, self._messages.FrankaControlMessage
        goal = messages.JointGoal(**{f"q{i + 1}": float(q) for i, q in enumerate(joints)})
        to = messages.FrankaJointPositionControllerMessage(goal=goal, speed_factor=self._driving.homing_fraction)
        self._joints = joints
        self._send(self._arm_command(to, kinds.JOINT_POSITION, kinds.SMOOTH_JOINT_POSITION, fraction=0.3))

    def joints_arrived(self) -> bool:
        """See `FrankaBackend`."""
        state, joints = self.state(), self._joints
        if joints is None or np.abs(state.joints - joints).max() > 0.01:  # rad
            return joints is None
        self._joints = None
        self._terminate()
        return True

    def grasp(self) -> None:
        """See `FrankaBackend`."""
        asked = self._messages.FrankaGripperGraspMessage(
            width=0.0, speed=SPEED, force=GRASP_FORCE, epsilon_inner=WIDEST, epsilon_outer=WIDEST
        )
        self._ask_hand(asked)

    def open(self) -> None:
        """See `FrankaBackend`."""
        self._ask_hand(self._messages.FrankaGripperMoveMessage(width=WIDEST, speed=SPEED))

    def recover(self) -> None:
        """See `FrankaBackend`. Deoxys clears reflexes when its program starts, and not over the wire."""
        mode = self.state().mode
        if mode is Mode.REFLEX:
            raise ArmFault(
                "Deoxys can't be asked to recover the arm",
                mode=mode,
                remedy="restart its arm program on the arm's computer; then the arm is ready again",
            )
        if mode is Mode.USER_STOPPED:
            raise ArmFault("the arm is stopped by its button", mode=mode, remedy=WORDS[mode])

    def close(self) -> None:
        """See `FrankaBackend`."""
        if not self._closed.is_set():
            self.halt()
            self._closed.set()
            self._thread.join()
            self._context.destroy(linger=100)

    def _unheard(self) -> bool:
        return time.monotonic() - self._heard_at > self._driving.silence

    def _hand_unheard(self) -> bool:
        return time.monotonic() - self._hand_heard_at > self._driving.silence

    def _bound(self, port: int) -> Any:
        socket = self._context.socket(self._zmq.PUB)
        socket.bind(f"tcp://{self._driving.bind}:{port}")
        return socket

    def _connected(self, port: int) -> Any:
        socket = self._context.socket(self._zmq.SUB)
        socket.setsockopt(self._zmq.SUBSCRIBE, b"")
        socket.connect(f"tcp://{self._driving.host}:{port}")
        return socket

    def _hear(self, patience: float) -> None:
        """Take in what has come, the newest state last; wait for so many s where nothing has."""
        self._arm_states.poll(round(1000 * patience))
        with contextlib.suppress(self._zmq.Again):
            while True:
                message = self._messages.FrankaRobotStateMessage.FromString(
                    self._arm_states.recv(flags=self._zmq.NOBLOCK)
                )
                self._forceless = len(message.O_F_ext_hat_K) < 3
                if len(message.O_T_EE) == 16 and len(message.q) == 7 and not self._forceless:
                    self._state, self._heard_at = message, time.monotonic()
        with contextlib.suppress(self._zmq.Again):
            while True:
                told = self._messages.FrankaGripperStateMessage.FromString(
                    self._hand_states.recv(flags=self._zmq.NOBLOCK)
                )
                now = time.monotonic()
                # after a silence nobody knows what they have done, nor whether they have heard of what was asked
                if now - self._hand_heard_at > SETTLED:
                    self._watched_since = now
                if self._width is None or abs(told.width - self._width) > STILL:
                    self._moved_at = now
                self._hand_heard_at, self._width = now, told.width

    def _arm_command(self, what: Any, kind: Any, interpolation: Any, *, fraction: float) -> bytes:
        command = self._messages.FrankaControlMessage(
            controller_type=kind,
            traj_interpolator_type=interpolation,
            traj_interpolator_time_fraction=fraction,
            timeout=TIMEOUT,
        )
        command.control_msg.Pack(what)
        serialised: bytes = command.SerializeToString()
        return serialised

    def _send(self, command: bytes) -> None:
        with self._sending:
            if self._must_be_alive():
                self._alive_at = time.monotonic()
                self._command = command
                self._arm.send(command)

    def _live(self) -> None:
        """Whoever drives the arm looks at it; too late, and the arm is stopped instead."""
        with self._sending:
            self._must_be_alive()
            self._alive_at = time.monotonic()

    def _must_be_alive(self) -> bool:
        """Stop the arm, with the lock held, where nobody has driven it for too long: all of this may have been frozen.

        What was to be sent then is of before; the dead-man timer, which was frozen too, ends the motion.
        """
        if self._command is None or time.monotonic() - self._alive_at <= self._driving.dead_man:
            return True
        log.error("nobody has driven the arm for %.1f s: it is stopped", self._driving.dead_man)
        self._say_terminated()
        return False

    def _terminate(self) -> None:
        """Tell Deoxys to stop the arm where it is."""
        self._joints = None
        with self._sending:
            self._say_terminated()

    def _say_terminated(self) -> None:
        """With the lock held, and more than once: nobody acknowledges."""
        command = self._messages.FrankaControlMessage(termination=True, timeout=TIMEOUT)
        command.control_msg.Pack(self._messages.FrankaDummyControllerMessage(termination=True))
        self._command = None
        for _ in range(3):
            self._arm.send(command.SerializeToString())

    def _ask_hand(self, what: Any) -> None:
        self._asked_at = time.monotonic()
        self._say_to_hand(what)

    def _say_to_hand(self, what: Any) -> None:
        command = self._messages.FrankaGripperControlMessage()
        command.control_msg.Pack(what)
        with self._sending:
            self._fingers.send(command.SerializeToString())

    def _repeat(self) -> None:
        """Say the newest goal again while fingers move and no new one comes, as long as somebody looks at the arm."""
        while not self._closed.wait(AGAIN):
            with self._sending:
                if self._must_be_alive() and self._command is not None:
                    self._arm.send(self._command)
