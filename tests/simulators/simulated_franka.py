"""A simulated Franka that speaks libfranka's protocol: franky-sim, with blocks on a table and with what can go wrong.

Runs in a virtual environment of its own (`scripts/simulators.sh`): `python -m tests.simulators.simulated_franka`. Added
to franky-sim: lock-step with the client, a table with blocks, contact forces, people who push, press the button or pull
the cable, and fingers that slip; `control_box.py` has what follows. A test says what is to happen in JSON lines over
TCP on port 1339 of the same host; every line is answered by the truth.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import select
import signal
import socket
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np
from franky_sim import mujoco_simulator
from franky_sim.franka_robot_protocol import MoveStatus, RobotMode

from tests.simulators.control_box import LabServer, mend

READY = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)  # rad; Franka's own "ready" pose, fingers pointing down
FORCE_FILTER = 0.05  # of a new force in every millisecond, about what the real estimate does
LOCK_STEP_PATIENCE = 3.0  # s for a client's command before it counts as lost: a loaded machine may need them
GONE_PATIENCE = 0.02  # s, likewise, once one was lost: nobody may be there any more
LOOK = 10  # ms between two looks at whether the arm stands
STANDING = 0.01  # rad/s of every joint, below which the arm stands still: less than 1 cm/s at the hand
PULL = 4.0  # N, twice what a grasp of 20 N holds of a smooth block
CONTROL_PORT = 1339
UNSTABLE = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
TIP = 0.1034  # m from the hand's frame to the end effector's, as Desk sets it for the hand


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
        self.paced = False
        self.joints = np.array(READY)
        self.moved_at, self.moved_on = 0, 0.0
        self.driven_at, self.driven_on = 0, 0.0
        self.clock = 0
        self.push = np.zeros(3)
        self.push_until = 0
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
            self.data.xfrc_applied[self.hand, :3] = self.push if self.clock < self.push_until else 0.0
            self.sim.step()
            self.clock += 1
            if self.clock % LOOK == 0:  # its own speed: what holds a joint makes it tremble from one ms to the next
                joints = self.data.qpos[self.robot._qpos_addrs]
                if np.abs(joints - self.joints).max() > STANDING * LOOK / 1000:
                    self.moved_at, self.moved_on = self.clock, time.monotonic()
                self.joints = joints
            if server.moving:
                self.driven_at, self.driven_on = self.clock, time.monotonic()
            self.feel()
            server.send_state()
            if self.clock % 10 == 0:
                self.hear()
                if any(self.data.warning[what].number for what in UNSTABLE):
                    sys.exit("the simulation is unstable: what it tells from here on isn't true")
            if self.paced or not (self.lock_step and server.moving):
                due = max(due + 0.001 / self.speed, time.monotonic() - 0.02)
                time.sleep(max(0.0, due - time.monotonic()))

    def wait_for_command(self) -> bool:
        """The client's answer to the newest state."""
        server = self.server
        patience = GONE_PATIENCE if server.lost else LOCK_STEP_PATIENCE
        if not server.begun:
            patience = 0.005  # a client doesn't answer its motion's first states
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
        wrench[:3] = -self.data.xfrc_applied[self.hand, :3]
        if self.data.ncon:
            ours = self.arm[self.sim.model.geom_bodyid[pairs]]
            met = np.flatnonzero(ours[:, 0] != ours[:, 1])
            forces = np.zeros((met.size, 6))
            for i, force in zip(met, forces, strict=True):
                mujoco.mj_contactForce(self.sim.model, self.data, i, force)
            frames = self.data.contact.frame[met].reshape(-1, 3, 3)
            pushed = np.einsum("nji,nj->ni", frames, forces[:, :3])  # on the second of each pair
            pushed[~ours[met, 0]] *= -1.0
            wrench[:3] += pushed.sum(axis=0)
            wrench[3:] += np.cross(self.data.contact.pos[met] - self.data.xpos[self.hand], pushed).sum(axis=0)
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
        """Everything, in m, N, s, base frame. `..._at` and `clock` are the robot's, `..._on` is CLOCK_MONOTONIC.

        moved: when the arm moved last. driven: when a client controlled it last.
        """
        # not the state's own: at a standstill that is of the joints it holds
        tip = self.data.xpos[self.hand] + self.data.xmat[self.hand].reshape(3, 3)[:, 2] * TIP
        return {
            "blocks": {name: self.data.xpos[body.id].tolist() for name, body in self.blocks.items()},
            "up": {name: float(self.data.xmat[body.id][8]) for name, body in self.blocks.items()},
            "tip": tip.tolist(),
            "width": self.robot.hand_width,
            "force": self.server.wrench[:3].tolist(),
            "mode": (self.server.mode or RobotMode.kIdle).name if not self.server.moving else "kMove",
            "clock": self.clock / 1000,
            "moved_at": self.moved_at / 1000,
            "moved_on": self.moved_on,
            "driven_at": self.driven_at / 1000,
            "driven_on": self.driven_on,
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

    def do_paced(self, on: bool) -> None:
        """Whether time passes no faster than it really does, while it waits for the client's commands."""
        self.paced = on

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
        self.do_jammed(on=False)
        self.server.mode, self.server.errors = None, [False] * 41
        self.server.wrench[:], self.push_until = 0.0, 0
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

    def do_push(self, how: list[float]) -> None:
        """Somebody pushes the hand: x, y, z in N, base frame, and for how many s."""
        self.push, self.push_until = np.array(how[:3]), self.clock + round(1000 * how[3])

    def do_guide(self, turned: list[float]) -> None:
        """Somebody turns the arm's joints by hand while nothing drives it, by so many rad each."""
        joints = [float(q) for q in self.data.qpos[self.robot._qpos_addrs] + np.array(turned)]
        for address, q in zip(self.robot._qpos_addrs, joints, strict=True):
            self.data.qpos[address] = q
        mujoco.mj_forward(self.sim.model, self.data)
        self.server._FrankaRobotServer__holding_q = tuple(joints)

    def do_fingers(self, width: float) -> None:
        """Somebody moves the fingers by hand: m between them."""
        self.robot.set_hand_goal(width, 0.05, 70.0)

    def do_jammed(self, on: bool) -> None:
        """The fingers don't move, and the hand says of every command that it has succeeded; or they do again."""
        if on:
            self.robot.set_hand_goal = lambda *_: None
        else:
            self.robot.__dict__.pop("set_hand_goal", None)

    def do_slippery(self, on: bool) -> None:
        """Blocks are smooth and pulled down, or as they were: fingers close on them, and they slide out."""
        model = self.sim.model
        for body in self.blocks.values():
            model.geom_friction[body.geomadr[0], 0] = 0.05 if on else 1.5
            self.data.xfrc_applied[body.id, 2] = -PULL if on else 0.0
        model.geom_friction[self.arm[model.geom_bodyid], 0] = 0.05 if on else 1.0


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
