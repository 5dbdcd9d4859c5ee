"""The other side of Deoxys's wire: an arm without physics that follows its goals, on a thread, with ZeroMQ sockets."""

from __future__ import annotations

import threading
import time

import numpy as np
import zmq

from robot_adapters.base import Array
from robot_adapters.franka import deoxys_pb2 as wire
from robot_adapters.franka.backend import READY

TICK = 0.01  # s: a hundred states a second
SPEED = 1.0  # m/s and rad/s: it keeps up with any goal, so that who asks sets the pace
FINGERS = 0.1  # m/s
HOME = np.array([0.307, 0.0, 0.487])


class DeoxysPeer:
    """Plays the arm's own computer: binds 5556 and 5558 on `host`, and listens to the PC at `pc`."""

    def __init__(self, host: str, pc: str, *, block: float = 0.0) -> None:
        """Begin at home with open fingers. block: m, how wide is what the fingers find when they close."""
        self._context = zmq.Context()
        self._states = self._publisher(host, 5556)
        self._hand_states = self._publisher(host, 5558)
        self._commands = self._listener(pc, 5555)
        self._hand_commands = self._listener(pc, 5557)
        self.block = block
        self.position, self.yaw, self.joints = HOME.copy(), 0.0, READY.copy()
        self.width = 0.08
        self.mode = wire.FrankaRobotStateMessage.Idle
        self.goals: list[Array] = []
        """Every place that was asked for, (3,) m."""
        self.terminations = 0
        self.hand_stops = 0
        self.silent = self.hand_silent = False
        self.forceless = False
        """Whether its states say nothing of forces."""
        self.jammed = False
        """Whether the fingers stay where they are, whatever they are told."""
        self.timed_out = False
        self._goal: Array | None = None
        self._joint_goal: Array | None = None
        self._width_goal = 0.08
        self._clock, self._heard, self._timeout = 0.0, 0.0, 0.2
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._run, name="deoxys peer")
        self._thread.start()

    def close(self) -> None:
        """End it."""
        self._closed.set()
        self._thread.join()
        self._context.destroy(linger=0)

    def rotation(self) -> Array:
        """(3, 3) of the hand: its fingers point down."""
        cos, sin = np.cos(self.yaw), np.sin(self.yaw)
        return np.array([[cos, sin, 0.0], [sin, -cos, 0.0], [0.0, 0.0, -1.0]])

    def _publisher(self, host: str, port: int) -> zmq.Socket[bytes]:
        socket = self._context.socket(zmq.PUB)
        socket.bind(f"tcp://{host}:{port}")
        return socket

    def _listener(self, pc: str, port: int) -> zmq.Socket[bytes]:
        socket = self._context.socket(zmq.SUB)
        socket.setsockopt(zmq.SUBSCRIBE, b"")
        socket.connect(f"tcp://{pc}:{port}")
        return socket

    def _run(self) -> None:
        due = time.monotonic()
        while not self._closed.is_set():
            self._hear()
            self._move()
            self._clock += TICK
            if not self.silent:
                self._tell()
            due = max(due + TICK, time.monotonic() - TICK)
            self._closed.wait(max(0.0, due - time.monotonic()))

    def _hear(self) -> None:
        while self._commands.poll(0):
            message = wire.FrankaControlMessage.FromString(self._commands.recv())
            self._heard, self._timeout = self._clock, message.timeout
            if message.termination:
                self.terminations += 1
                self._goal = self._joint_goal = None
            elif message.controller_type == wire.FrankaControlMessage.OSC_POSE:
                osc = wire.FrankaOSCPoseControllerMessage()
                assert message.control_msg.Unpack(osc)
                assert not osc.goal.is_delta
                assert len(osc.translational_stiffness) == len(osc.rotational_stiffness) == 3
                self._goal = np.array([osc.goal.x, osc.goal.y, osc.goal.z])
                self.yaw = 2 * float(np.arctan2(osc.goal.ay, osc.goal.ax))
                self.goals.append(self._goal)
            elif message.controller_type == wire.FrankaControlMessage.JOINT_POSITION:
                to = wire.FrankaJointPositionControllerMessage()
                assert message.control_msg.Unpack(to)
                self._joint_goal = np.array([getattr(to.goal, f"q{i}") for i in range(1, 8)])
        while self._hand_commands.poll(0):
            asked = wire.FrankaGripperControlMessage.FromString(self._hand_commands.recv())
            grasp, move = wire.FrankaGripperGraspMessage(), wire.FrankaGripperMoveMessage()
            if asked.control_msg.Unpack(grasp):
                self._width_goal = max(grasp.width, self.block)
            elif asked.control_msg.Unpack(move):
                self._width_goal = move.width
            else:
                self.hand_stops += 1
                self._width_goal = self.width

    def _move(self) -> None:
        if (self._goal is not None or self._joint_goal is not None) and self._clock - self._heard > self._timeout:
            self._goal = self._joint_goal = None
            self.timed_out = True
        moving = self._goal is not None or self._joint_goal is not None
        idle, busy = wire.FrankaRobotStateMessage.Idle, wire.FrankaRobotStateMessage.Move
        if self.mode in (idle, busy):
            self.mode = busy if moving else idle
        if self._goal is not None:
            self.position = _towards(self.position, self._goal, SPEED * TICK)
            self.joints[:3] = READY[:3] + (self.position - HOME)  # any angles that belong to the place
        if self._joint_goal is not None:
            self.joints = _towards(self.joints, self._joint_goal, SPEED * TICK)
            self.position = HOME + (self.joints - READY)[:3]
        if not self.jammed:
            self.width += float(np.clip(self._width_goal - self.width, -FINGERS * TICK, FINGERS * TICK))

    def _tell(self) -> None:
        state = wire.FrankaRobotStateMessage(robot_mode=self.mode)
        pose = np.eye(4)
        pose[:3, :3] = self.rotation()
        pose[:3, 3] = self.position
        state.O_T_EE.extend(pose.T.ravel().tolist())
        state.q.extend(self.joints.tolist())
        state.dq.extend([0.0] * 7)
        state.O_F_ext_hat_K.extend([] if self.forceless else [0.0] * 6)
        state.time.toSec = self._clock
        self._states.send(state.SerializeToString())
        if not self.hand_silent:
            told = wire.FrankaGripperStateMessage(width=self.width, max_width=0.08)
            self._hand_states.send(told.SerializeToString())


def _towards(here: Array, goal: Array, most: float) -> Array:
    """A stride of at most `most` from here to the goal."""
    way = goal - here
    length = float(np.linalg.norm(way))
    return goal if length <= most else here + way * (most / length)
