"""A simulated Franka that speaks libfranka's protocol: franky-sim, with blocks on a table and with what can go wrong.

Runs in a virtual environment of its own (`scripts/simulators.sh`): `python simulated_franka.py --host 127.0.0.9`.
franky-sim has no faults of its own. Added here: lock-step with the client, a table with blocks, contact forces, the
collision reflex, the user stop, lost commands, a cable that is pulled, and a grasp that holds nothing. A test says
what is to happen in JSON lines over TCP on port 1339 of the same host; every line is answered by the truth.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import select
import signal
import socket
import struct
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np
from franky_sim import franka_gripper_server, franka_server, mujoco_simulator
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

READY = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)  # rad; Franka's own "ready" pose, fingers pointing down
CARTESIAN_REFLEX, COMMUNICATION = 7, 25  # positions in libfranka's list of 41 errors
LOST_IN_A_ROW = 20  # commands; the real FCI then stops the motion
FORCE_FILTER = 0.05  # of a new force in every millisecond, about what the real estimate does
LOCK_STEP_PATIENCE = 0.25  # s for a client's command before it counts as lost
CONTROL_PORT = 1339


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


class Lab:
    """The arm at a table with blocks, and who may interfere with it."""

    def __init__(self, host: str, table: float, blocks: dict[str, float], *, gripper: bool) -> None:
        mend()
        self.sim = mujoco_simulator.MujocoSimulator()
        self.sim.init()
        self.sim.worldbody.find("geom[@name='ground']").set("pos", "0 0 -1")
        top = {"name": "table", "type": "box", "size": "0.4 0.5 0.02", "pos": f"0.56 0 {table - 0.02}"}
        ET.SubElement(self.sim.worldbody, "geom", top)
        for i, (name, half) in enumerate(blocks.items()):
            at = f"{0.5 + 0.15 * i} 0.2 {table + half}"
            body = ET.SubElement(self.sim.worldbody, "body", name=name, pos=at)
            ET.SubElement(body, "freejoint")
            ET.SubElement(
                body,
                "geom",
                type="box",
                size=f"{half} {half} {half}",
                density="400",
                condim="4",
                friction="1.5 0.02 0.0001",
                solref="0.008 1",
                rgba=f"{0.8 - 0.6 * i} {0.2 + 0.4 * i} 0.2 1",
            )
        self.robot = self.sim.add_robot(initial_q=READY, initial_hand_width=0.08)
        self.server = LabServer(self.robot, [host])
        self.server.gripper = gripper
        self.server.init()
        self.sim.start()
        model, self.data = self.sim.model, self.sim.data
        self.blocks = {name: model.body(name) for name in blocks}
        self.arm = np.array([model.body(b).rootid[0] == model.body("robot0_base").id for b in range(model.nbody)])
        self.hand = model.body("robot0_hand").id
        self.speed = 1.0
        self.lock_step = False
        self.slippery = False
        self.clock = 0
        self.doors = socket.create_server((host, CONTROL_PORT))
        self.doors.setblocking(False)
        self.guests: dict[socket.socket, bytes] = {}

    def run(self) -> None:
        """A millisecond after the other. In lock-step, while a client controls the arm, each waits for its command."""
        server, due = self.server, time.monotonic()
        while True:
            before = server.last_command
            server.process_commands()
            answered = server.last_command != before
            if self.lock_step and server.moving and server.plugged_in and not answered:
                answered = self.wait_for_command()
            server.watch(answered)
            self.sim.step()
            self.clock += 1
            self.feel()
            server.send_state()
            if self.clock % 10 == 0:
                self.hear()
            if not (self.lock_step and server.moving):
                due = max(due + 0.001 / self.speed, time.monotonic() - 0.02)
                time.sleep(max(0.0, due - time.monotonic()))

    def wait_for_command(self) -> bool:
        """The client's answer to the newest state."""
        server = self.server
        patience = LOCK_STEP_PATIENCE if server.begun else 0.005  # a client doesn't answer its motion's first states
        before, deadline = server.last_command, time.monotonic() + patience
        while server.moving and time.monotonic() < deadline:
            select.select([server._FrankaServer__udp_socket, server._tcp_socket], [], [], 0.005)
            server.process_commands()
            if server.last_command != before:
                return True
            self.hear()
        return False

    def feel(self) -> None:
        """The force that the arm puts on its surroundings, at the hand, base frame; what fingers hold cancels out."""
        wrench, pairs = np.zeros(6), self.data.contact.geom
        if self.data.ncon:
            ours = self.arm[self.sim.model.geom_bodyid[pairs]]
            for i in np.flatnonzero(ours[:, 0] != ours[:, 1]):
                contact, force = self.data.contact[i], np.zeros(6)
                mujoco.mj_contactForce(self.sim.model, self.data, i, force)
                pushed = contact.frame.reshape(3, 3).T @ force[:3]  # on the second of the pair
                pushed = pushed if ours[i, 0] else -pushed
                wrench[:3] += pushed
                wrench[3:] += np.cross(contact.pos - self.data.xpos[self.hand], pushed)
        self.server.wrench += FORCE_FILTER * (wrench - self.server.wrench)
        if self.clock % 10 == 0:
            jacobian = np.zeros((6, self.sim.model.nv))
            mujoco.mj_jacBody(self.sim.model, self.data, jacobian[:3], jacobian[3:], self.hand)
            self.server.torques = jacobian[:, self.robot._dof_addrs].T @ self.server.wrench

    # what a test may do

    def hear(self) -> None:
        """Take what was said since, and answer it."""
        with contextlib.suppress(BlockingIOError):
            guest, _ = self.doors.accept()
            guest.setblocking(False)
            self.guests[guest] = b""
        for guest in list(self.guests):
            for line in self.lines(guest):
                for name, value in json.loads(line).items():
                    getattr(self, f"do_{name}")(value)
                with contextlib.suppress(OSError):
                    guest.sendall(json.dumps(self.truth()).encode() + b"\n")

    def lines(self, guest: socket.socket) -> Iterator[bytes]:
        """Whole lines that have come; forgets a guest that has left."""
        try:
            data = guest.recv(65536)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            del self.guests[guest]
            guest.close()
            return
        *whole, self.guests[guest] = (self.guests[guest] + data).split(b"\n")
        yield from whole

    def truth(self) -> dict[str, Any]:
        """Everything, in m, N, s, base frame."""
        tip = self.robot.state.O_T_EE
        return {
            "blocks": {name: self.data.xpos[body.id].tolist() for name, body in self.blocks.items()},
            "up": {name: float(self.data.xmat[body.id][8]) for name, body in self.blocks.items()},
            "tip": [float(tip[i]) for i in (12, 13, 14)],
            "speed": float(np.linalg.norm(self.data.qvel[self.robot._dof_addrs])),
            "width": self.robot.hand_width,
            "force": self.server.wrench[:3].tolist(),
            "mode": (self.server.mode or RobotMode.kIdle).name if not self.server.moving else "kMove",
            "clock": self.clock / 1000,
            "lost": self.server.lost_in_all,
        }

    def do_look(self, _: Any) -> None:
        """Nothing but the truth."""

    def do_place(self, blocks: dict[str, list[float]]) -> None:
        """Put blocks somewhere, upright, at rest."""
        for name, at in blocks.items():
            joint = self.blocks[name].jntadr[0]
            position = self.sim.model.jnt_qposadr[joint]
            velocity = self.sim.model.jnt_dofadr[joint]
            self.data.qpos[position : position + 7] = [*at, 1.0, 0.0, 0.0, 0.0]
            self.data.qvel[velocity : velocity + 6] = 0.0

    def do_lock_step(self, on: bool) -> None:
        """Whether time waits for the client's commands."""
        self.lock_step = on

    def do_speed(self, factor: float) -> None:
        """Simulated seconds a second, where time doesn't wait."""
        self.speed = factor

    def do_user_stop(self, on: bool) -> None:
        """Somebody presses or releases the button."""
        if on:
            self.server.abort(MoveStatus.kPreemptedDueToActivatedSafetyFunctions, RobotMode.kUserStopped)
        else:
            self.server.mode = None

    def do_heal(self, _: Any) -> None:
        """Whatever was wrong is over; the arm is at home with open fingers."""
        self.server.mode, self.server.errors = None, [False] * 41
        self.server.wrench[:] = 0.0
        if not self.server.moving:
            for address, q in zip(self.robot._qpos_addrs, READY, strict=True):
                self.data.qpos[address] = q
            self.data.qpos[self.robot._finger_qpos_addrs] = 0.04
            self.data.qvel[self.robot._dof_addrs] = 0.0
            self.robot.set_hand_goal(0.08, 0.05, 70.0)
            mujoco.mj_forward(self.sim.model, self.data)
            self.server.stop_motion()
            self.server._FrankaRobotServer__holding_q = READY

    def do_plug(self, there: bool) -> None:
        """Somebody pulls the network cable, or plugs it in again."""
        self.server.plugged_in = there

    def do_slippery(self, on: bool) -> None:
        """Fingers and blocks lose all their grip."""
        for body in self.blocks.values():
            self.sim.model.geom_friction[body.geomadr[0], 0] = 0.001 if on else 1.5
            self.sim.model.geom_condim[body.geomadr[0]] = 3 if on else 4
        pads = self.arm[self.sim.model.geom_bodyid]
        self.sim.model.geom_friction[pads, 0] = 0.001 if on else 1.0


def main() -> None:
    """Entry point; ends on SIGTERM."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--table", type=float, default=0.0, help="z of the table, m, base frame")
    parser.add_argument("--blocks", type=json.loads, default={}, help='half sizes, m: {"block_a": 0.02}')
    parser.add_argument("--no-gripper", action="store_true")
    given = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    lab = Lab(given.host, given.table, given.blocks, gripper=not given.no_gripper)
    print("ready", flush=True)
    lab.run()


if __name__ == "__main__":
    main()
