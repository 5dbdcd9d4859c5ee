"""Franka's control box with what happens in it when something is wrong, put over franky-sim's, which has no faults.

Also mends what a client stricter than libfranka stumbles over. Runs in the simulator's own virtual environment.
"""

from __future__ import annotations

import socket
import struct
import sys
from typing import Any

import numpy as np
from franky_sim import franka_gripper_server, franka_server
from franky_sim.franka_gripper_protocol import GripperCommandStatus
from franky_sim.franka_robot_protocol import (
    AutomaticErrorRecoveryCommand,
    AutomaticErrorRecoveryStatus,
    BaseCommand,
    MoveCommand,
    MoveStatus,
    RobotCommand,
    RobotMode,
    SetCollisionBehaviorCommand,
)
from franky_sim.franka_robot_server import FrankaRobotServer

CARTESIAN_REFLEX, COMMUNICATION = 7, 25  # positions in libfranka's list of 41 errors
LOST_IN_A_ROW = 20  # commands; the real FCI then stops the motion


class LabServer(FrankaRobotServer):  # type: ignore[misc]
    """The arm's server with what a control box does when something is wrong."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.mode: RobotMode | None = None
        self.errors = [False] * 41
        self.thresholds = np.full(6, np.inf)
        self.wrench = np.zeros(6)
        self.torques = np.zeros(7)
        self.last_command = 0
        self.begun = False
        self.lost = 0
        self.lost_in_all = 0
        self.plugged_in = True
        self.gripper = True

    @property
    def moving(self) -> bool:
        """Whether a client controls the arm."""
        return bool(self.current_motion_id)

    def abort(self, status: MoveStatus, mode: RobotMode | None, error: int | None = None) -> None:
        """End the motion, if there is one, and refuse others until that is lifted."""
        motion = self.current_motion_id
        self.stop_motion(send_preemption_signal=False)
        self.mode = mode
        if error is not None:
            self.errors[error] = True
        self.send_state()
        if motion:
            self.reset_current_motion_id()
            BaseCommand.send_response(self._tcp_socket, RobotCommand.kMove, motion, status)

    def watch(self, answered: bool) -> None:
        """Look for a collision, and count commands that didn't come; once a millisecond."""
        if self.mode is None and bool((np.abs(self.wrench) > self.thresholds).any()):
            self.abort(MoveStatus.kReflexAborted, RobotMode.kReflex, CARTESIAN_REFLEX)
        self.lost = 0 if answered or not (self.begun and self.moving) else self.lost + 1
        self.lost_in_all += self.lost > 0
        if self.lost >= LOST_IN_A_ROW:
            self.lost = 0
            self.abort(MoveStatus.kReflexAborted, RobotMode.kReflex, COMMUNICATION)

    def start_motion(self, *arguments: Any) -> None:
        """Start, with nothing lost so far."""
        self.lost, self.begun = 0, False
        super().start_motion(*arguments)

    def stop_motion(self, send_preemption_signal: bool = True) -> None:
        """Hold the arm where it is: franky-sim's holds where it was to be, and creeps there for seconds."""
        super().stop_motion(send_preemption_signal)
        self._FrankaRobotServer__holding_q = tuple(self.robot.inner_state.q)

    def _handle_udp_command(self, command_data: bytes) -> None:
        self.last_command = struct.unpack_from("<Q", command_data)[0]
        self.begun = self.moving
        if self.mode is None and self.moving:
            super()._handle_udp_command(command_data)

    def send_state(self) -> None:
        """Nothing comes through a cable that is pulled; nor does a gripper that isn't there say anything."""
        if self.plugged_in:
            super().send_state()

    def process_commands(self) -> None:
        """Likewise the other way. The arm goes on holding still."""
        if self.plugged_in:
            super().process_commands()
        else:
            self._post_process_commands()

    def _bind_children(self, hostname: str) -> None:
        if self.gripper:
            super()._bind_children(hostname)

    @property
    def robot_state(self) -> Any:
        """The state with forces, mode and errors."""
        state = super().robot_state
        forces = tuple(self.wrench.tolist())
        hit = tuple(float(abs(f) > t) for f, t in zip(self.wrench, self.thresholds, strict=True))
        more = {"robot_mode": self.mode} if self.mode is not None else {}
        return state.replace(
            O_F_ext_hat_K=forces,
            K_F_ext_hat_K=forces,
            tau_ext_hat_filtered=tuple(self.torques.tolist()),
            cartesian_contact=hit,
            cartesian_collision=hit,
            errors=tuple(self.errors),
            reflex_reason=tuple(self.errors),
            **more,
        )


class LabGripper(franka_gripper_server.FrankaGripperServer):  # type: ignore[misc]
    """The hand's server. A grasp that held nothing is `unsuccessful`, as the real hand says, and not a failure."""

    def stop(self, command_id: int, tcp_socket: socket.socket) -> None:
        """Stop; the command that was under way is answered too."""
        if self._pending_command_id is not None and self._pending_tcp_socket is not None:
            BaseCommand.send_response(
                self._pending_tcp_socket,
                self._pending_command_type,
                self._pending_command_id,
                GripperCommandStatus.kAborted,
                command_type_struct="H",
                status_type_struct="H",
            )
        super().stop(command_id, tcp_socket)

    def _check_motion_state(self) -> None:
        failed, GripperCommandStatus.kFail._value_ = GripperCommandStatus.kFail._value_, 2
        try:
            super()._check_motion_state()
        finally:
            GripperCommandStatus.kFail._value_ = failed


def mend() -> None:
    """Put the parts above in the places of franky-sim's own, and what is needed of a command's handling."""
    mujoco_connect = franka_server.ConnectCommand.handle

    def connect(self: Any, server: Any, command_type_struct: str = "I") -> None:
        """The reply's status is one byte for the arm, and two for the hand: what libfranka 0.21 reads leniently."""
        if command_type_struct != "I":
            mujoco_connect(self, server, command_type_struct)
            return
        header = franka_server.MessageHeader(self.command_type, self.command_id, 8)
        reply = struct.pack("<BH5x", franka_server.ConnectStatus.kSuccess.value, server.library_version)
        self.client_socket.sendall(header.to_bytes(command_type_struct) + reply)
        server._setup_udp_connection(self.network_udp_port)

    start = MoveCommand.handle

    def move(self: Any, server: LabServer) -> None:
        if server.mode is RobotMode.kUserStopped:
            self.reply(MoveStatus.kCommandRejectedDueToActivatedSafetyFunctions)
        elif server.mode is not None:
            self.reply(MoveStatus.kCommandNotPossibleRejected)
        else:
            start(self, server)

    def recover(self: Any, server: LabServer) -> None:
        if server.mode is RobotMode.kUserStopped:
            self.reply(AutomaticErrorRecoveryStatus.kCommandRejectedDueToActivatedSafetyFunctions)
            return
        server.mode = None
        server.errors = [False] * 41
        self.reply(AutomaticErrorRecoveryStatus.kSuccess)

    def collide(self: Any, server: LabServer) -> None:
        server.thresholds = np.array(self.upper_force_thresholds_nominal)
        self.reply(0)

    franka_server.ConnectCommand.handle = connect
    MoveCommand.handle = move
    AutomaticErrorRecoveryCommand.handle = recover
    SetCollisionBehaviorCommand.handle = collide
    sys.modules["franky_sim.franka_robot_server"].FrankaGripperServer = LabGripper  # type: ignore[attr-defined]
