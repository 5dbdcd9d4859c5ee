"""What would damage the robot or its surroundings, looked for after every set-point.

The limits are those at which a person would press the emergency stop (paper, section 'Results', on safety).
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

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
        names = [f"robot0_joint{i}" for i in range(1, 8)]
        self._joints = [int(model.joint(n).qposadr[0]) for n in names]
        self._dofs = [int(model.joint(n).dofadr[0]) for n in names]
        limits = np.array([model.joint(n).range for n in names])
        self._low, self._high = limits[:, 0] + JOINT_MARGIN, limits[:, 1] - JOINT_MARGIN

    def found(self) -> str | None:
        """What is over its limit now, in words; None if nothing is."""
        wrist = math.sqrt(self._wrist.dot(self._wrist))
        if wrist > WRIST_FORCE:
            return f"{wrist:.0f} N at the wrist"
        hand, own = self._contacts()
        if hand > HAND_FORCE:
            return f"the hand or arm presses against something with {hand:.0f} N"
        if own > SELF_FORCE:
            return f"the robot presses against itself with {own:.0f} N"
        angles = self._data.qpos[self._joints]
        near = (angles < self._low) | (angles > self._high)
        if not np.count_nonzero(near):
            return None
        # one that moves away again is let go, or no skill could ever take it out of there
        speeds = self._data.qvel[self._dofs]
        into = near & (np.where(angles < self._low, -speeds, speeds) > AT_REST)
        return f"joint {int(np.argmax(into)) + 1} runs into its limit" if into.any() else None

    def _contacts(self) -> tuple[float, float]:
        """N of the robot without its fingers against the world, and against itself."""
        pairs = self._data.contact.geom
        stiff = self._stiff[pairs]
        # most set-points end here: this is looked at 20 times a simulated second
        if not np.count_nonzero(stiff):
            return 0.0, 0.0
        own = self._robot[pairs].all(axis=1)
        totals, force = [0.0, 0.0], np.zeros(6)
        for i in np.flatnonzero(stiff.any(axis=1)):
            mujoco.mj_contactForce(self._model, self._data, i, force)
            totals[int(own[i])] += float(np.linalg.norm(force[:3]))
        return totals[0], totals[1]
