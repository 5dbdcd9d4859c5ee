"""What would damage the robot or its surroundings: forces after every physics step, joints after every set-point.

The limits are those at which a person would press the emergency stop (paper, section 'Results', on safety).
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot_adapters.robosuite.control_step import ARM_JOINTS, Watch

WRIST_FORCE = 100.0  # N, between arm and hand
HAND_FORCE = 60.0  # N, of anything but the fingers against the world
SELF_FORCE = 10.0  # N, of one part of the robot against another
JOINT_MARGIN = 0.05  # rad before a joint's limit
AT_REST = 0.02  # rad/s

WRIST_SENSOR = "gripper0_right_force_ee"
ARM, GRIPPER, FINGER = "robot0_", "gripper0_", "finger"


class Damage:
    """Looks at forces and joints of one model."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        start = int(model.sensor(WRIST_SENSOR).adr[0])
        self._wrist = data.sensordata[start : start + 3]
        bodies = [model.body(int(b)).name for b in model.geom_bodyid]
        robot = np.array([b.startswith((ARM, GRIPPER)) for b in bodies])
        finger = robot & np.array([FINGER in b for b in bodies])
        self._stiff: NDArray[np.bool_] = robot & ~finger
        self._robot: NDArray[np.bool_] = robot
        # a chain of hinges, one after the other in MuJoCo's arrays
        first, joints = model.joint("robot0_joint1"), slice(0, ARM_JOINTS)
        self._angles, self._speeds = data.qpos[first.qposadr[0] :][joints], data.qvel[first.dofadr[0] :][joints]
        limits = np.array([model.joint(f"robot0_joint{i + 1}").range for i in range(ARM_JOINTS)])
        self._low, self._high = (limits[:, 0] + JOINT_MARGIN).tolist(), (limits[:, 1] - JOINT_MARGIN).tolist()
        self._noted: str | None = None

    def watch(self) -> Watch:
        """What the compiled stepping looks at, to interrupt itself for `note`.

        One limit for all contacts, the lowest: the sum over a body's contacts doesn't tell the world from the robot.
        """
        bodies = np.unique(self._model.geom_bodyid[self._stiff]).astype(np.int64)
        data, wrist = self._data, int(self._model.sensor(WRIST_SENSOR).adr[0])
        return Watch(data.sensordata, data.cfrc_ext, wrist, bodies, WRIST_FORCE, min(HAND_FORCE, SELF_FORCE))

    def note(self) -> None:
        """Look at the forces now; `found` tells the first that was over its limit."""
        self._noted = self._noted or self._forces()

    def found(self) -> str | None:
        """What was noted since the last time, or a joint that now runs into its limit, in words; None if nothing."""
        noted, self._noted = self._noted, None
        return noted or self._joint()

    def _forces(self) -> str | None:
        wrist = math.sqrt(self._wrist.dot(self._wrist))
        if wrist > WRIST_FORCE:
            return f"{wrist:.0f} N at the wrist"
        hand, own = self._contacts()
        if hand > HAND_FORCE:
            return f"the hand or arm presses against something with {hand:.0f} N"
        if own > SELF_FORCE:
            return f"the robot presses against itself with {own:.0f} N"
        return None

    def _joint(self) -> str | None:
        # plain numbers: for seven, numpy's calls would cost ten times as much, at every set-point
        for i, (angle, low, high) in enumerate(zip(self._angles.tolist(), self._low, self._high, strict=True)):
            if low <= angle <= high:
                continue
            # one that moves away again is let go, or no skill could ever take it out of there
            speed = float(self._speeds[i])
            if (-speed if angle < low else speed) > AT_REST:
                return f"joint {i + 1} runs into its limit"
        return None

    def _contacts(self) -> tuple[float, float]:
        """N of the robot without its fingers against the world, and against itself."""
        pairs = self._data.contact.geom
        stiff = self._stiff[pairs]
        if not np.count_nonzero(stiff):
            return 0.0, 0.0
        own = self._robot[pairs].all(axis=1)
        totals, force = [0.0, 0.0], np.zeros(6)
        for i in np.flatnonzero(stiff.any(axis=1)):
            mujoco.mj_contactForce(self._model, self._data, i, force)
            totals[int(own[i])] += float(np.linalg.norm(force[:3]))
        return totals[0], totals[1]
