"""Joint angles that put the gripper somewhere, pointing down: where an episode starts."""

from __future__ import annotations

import mujoco
import numpy as np

from robot_adapters.base import Array

DOWN = np.array([0.0, 1.0, 1.0, 0.0]) / np.sqrt(2.0)  # quaternion of the grip site pointing down with yaw 0
DAMPING = 1e-4
ITERATIONS = 200
CLOSE_ENOUGH = 1e-5  # m and rad


def solve(model: mujoco.MjModel, site: str, position: Array, home: Array) -> Array:
    """(7,) rad of the first seven joints that bring `site` to `position` (3,) m, world frame, with yaw 0.

    Damped least squares from the posture `home` (7,), so that the same position always gives the same posture.

    Raises:
        ValueError: out of the arm's reach.
    """
    data = mujoco.MjData(model)
    identity = model.site(site).id
    dofs = [model.joint(f"robot0_joint{i}").dofadr[0] for i in range(1, 8)]
    qpos = [model.joint(f"robot0_joint{i}").qposadr[0] for i in range(1, 8)]
    limits = np.array([model.joint(f"robot0_joint{i}").range for i in range(1, 8)])
    data.qpos[qpos] = home
    positional, rotational = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    quaternion, conjugate, difference, rotation = np.zeros(4), np.zeros(4), np.zeros(4), np.zeros(3)
    for _ in range(ITERATIONS):
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mju_mat2Quat(quaternion, data.site_xmat[identity])
        mujoco.mju_negQuat(conjugate, quaternion)
        mujoco.mju_mulQuat(difference, DOWN, conjugate)
        mujoco.mju_quat2Vel(rotation, difference, 1.0)
        error = np.concatenate([position - data.site_xpos[identity], rotation])
        if float(np.abs(error).max()) < CLOSE_ENOUGH:
            return np.array(data.qpos[qpos])
        mujoco.mj_jacSite(model, data, positional, rotational, identity)
        jacobian = np.concatenate([positional, rotational])[:, dofs]
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + DAMPING * np.eye(6), error)
        data.qpos[qpos] = np.clip(data.qpos[qpos] + step, limits[:, 0], limits[:, 1])
    raise ValueError(f"no posture brings the gripper to {position.round(3).tolist()} m (world frame)")
