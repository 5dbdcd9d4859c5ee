"""One control period as machine code: MuJoCo's physics steps with robosuite's operational space control between them.

The equations are those of robosuite 1.5.2 (`controllers/parts/arm/osc.py`, `utils/control_utils.py`) for absolute poses
in the world frame at fixed gains. Cholesky factors solve what robosuite inverts: the same torques up to rounding, in a
microsecond.

MuJoCo is called through its C symbols: `load_symbols` first, or the first call finds none. An error inside MuJoCo,
which its Python bindings would raise, ends the process.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

import llvmlite.binding
import mujoco
import numpy as np
from numba import njit, types
from numpy.typing import NDArray

from robot_adapters.base import Array, Unavailable

ARM_JOINTS = 7  # a constant, so that the compiler unrolls its loops
JOINT_KP = 10.0  # robosuite's gain towards the joints the episode started at, where the task leaves a choice
JOINT_KV = 2.0 * math.sqrt(JOINT_KP)
SINGULAR = 1e-15  # what robosuite's pseudo-inverse takes for zero, relative to the greatest

_model_and_data = types.void(types.uintp, types.uintp)
_step1: Any = types.ExternalFunction("mj_step1", _model_and_data)
_step2: Any = types.ExternalFunction("mj_step2", _model_and_data)
_site_jacobian: Any = types.ExternalFunction(
    "mj_jacSite", types.void(types.uintp, types.uintp, types.uintp, types.uintp, types.int32)
)


class Memory(NamedTuple):
    """MuJoCo's own memory, which every physics step changes: addresses of the structs and views of their arrays."""

    model: int
    data: int
    qpos: Array
    """(nq,) positions of all joints."""
    qvel: Array
    """(nv,) velocities of all degrees of freedom."""
    ctrl: Array
    """(nu,) commands to all actuators."""
    bias: Array
    """(nv,) torques of gravity and Coriolis."""
    inertia: Array
    """The mass matrix as MuJoCo stores it (`mjData.qM`)."""
    inertia_row: Array
    """(nv,) where each row of it starts (`mjModel.dof_Madr`)."""
    parent: Array
    """(nv,) each degree of freedom's parent, -1 for none (`mjModel.dof_parentid`)."""
    hand: Array
    """(3,) grip site, m, world frame."""
    facing: Array
    """(9,) its rotation matrix, row by row."""


class Controller(NamedTuple):
    """What robosuite's controllers are set to. n is `ARM_JOINTS`."""

    site: int
    """The grip site's number."""
    positions: Array
    """(n,) the arm's joints in qpos."""
    velocities: Array
    """(n,) the arm's joints in qvel, ascending from the base."""
    actuators: Array
    """(n,) the arm's actuators."""
    gripper: Array
    """(g,) the gripper's actuators."""
    low: Array
    """(n,) least torque, N m."""
    high: Array
    """(n,) greatest torque, N m."""
    stiffness: Array
    """(6,) gains on the errors in position and orientation."""
    damping: Array
    """(6,) gains on the velocities."""
    rest: Array
    """(n,) rad, the posture to prefer."""


class Watch(NamedTuple):
    """Forces that are looked at after every physics step: a blow may be over before the control period is."""

    sensors: Array
    """All sensors' values (`mjData.sensordata`)."""
    contact: Array
    """(bodies, 6) torque and force of all contacts with a body (`mjData.cfrc_ext`)."""
    wrist: int
    """Where the force at the wrist starts in `sensors`."""
    bodies: NDArray[np.int64]
    """Those that should touch nothing."""
    wrist_force: float
    """N at the wrist beyond which the period is interrupted."""
    contact_force: float
    """N on one of `bodies`, likewise."""


class Scratch(NamedTuple):
    """Room to compute in, so that nothing is allocated between two physics steps."""

    linear: Array
    angular: Array
    J: Array
    """(6, n) Jacobian of the hand in the arm's joints."""
    M: Array
    """(n, n) mass matrix of the arm."""
    A: Array
    """(6, 6) J M^-1 J^T, the inverse of the hand's inertia."""
    factor: Array
    half: Array
    full_factor: Array
    block: Array
    block_factor: Array
    wrench: Array
    """(6,) force and torque on the hand."""
    force: Array
    torque: Array
    drift: Array
    back: Array


def load_symbols() -> None:
    """Make MuJoCo's C functions known to compiled code, also to code that comes out of numba's cache.

    Raises:
        Unavailable: the MuJoCo package has no shared library where its wheels have it.
    """
    folder = Path(mujoco.__file__).parent
    for pattern in ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll"):
        for library in folder.glob(pattern):
            llvmlite.binding.load_library_permanently(str(library))
            return
    raise Unavailable(f"no MuJoCo library in {folder}", remedy="install mujoco's wheel, or set stepping to reference")


@njit(cache=True, nogil=True, error_model="numpy")
def control_step(  # noqa: PLR0917  numba unpacks arguments one by one in 2 us a call, but takes 12 us for two tuples
    substeps: int,
    command: Array,
    # Memory
    model: int,
    data: int,
    qpos: Array,
    qvel: Array,
    ctrl: Array,
    bias: Array,
    inertia: Array,
    inertia_row: Array,
    parent: Array,
    hand: Array,
    facing: Array,
    # Controller
    site: int,
    positions: Array,
    velocities: Array,
    actuators: Array,
    gripper: Array,
    low: Array,
    high: Array,
    stiffness: Array,
    damping: Array,
    rest: Array,
    # Watch
    sensors: Array,
    contact: Array,
    wrist: int,
    bodies: NDArray[np.int64],
    wrist_force: float,
    contact_force: float,
) -> tuple[int, bool]:
    """Advance the physics by `substeps` towards the set-point in `command`, without holding the GIL.

    `command` is (6 + g,): the grip site in m and its rotation vector in rad, world frame, then the gripper's actuators.
    What follows are the fields of `Memory`, of `Controller`, and of `Watch`.

    Returns how many were taken, and whether a force was beyond its limit after the last: then there may be fewer, and
    a call with the rest goes on as if nothing had been.
    """
    memory = Memory(model, data, qpos, qvel, ctrl, bias, inertia, inertia_row, parent, hand, facing)
    controller = Controller(site, positions, velocities, actuators, gripper, low, high, stiffness, damping, rest)
    room = _scratch(qvel.shape[0])
    desired = _rotation(command[3:6])
    J, J_linear, J_angular = room.J, room.linear, room.angular
    watch = Watch(sensors, contact, wrist, bodies, wrist_force, contact_force)
    for taken in range(1, substeps + 1):
        _step1(model, data)
        _site_jacobian(model, data, J_linear.ctypes.data, J_angular.ctypes.data, site)
        for j in range(ARM_JOINTS):
            dof = velocities[j]
            for i in range(3):
                J[i, j], J[i + 3, j] = J_linear[i, dof], J_angular[i, dof]
        _mass_matrix(room.M, memory, controller)
        _mobility(room)
        _unit_wrench(memory, controller, room, command, desired)
        _torques(memory, controller, room)
        for g in range(gripper.shape[0]):
            ctrl[gripper[g]] = command[6 + g]
        _step2(model, data)
        if _alarming(watch):
            return taken, True
    return substeps, False


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _alarming(watch: Watch) -> bool:
    """Whether a force is beyond its limit now."""
    sensors, contact, bodies, at = watch.sensors, watch.contact, watch.bodies, watch.wrist
    if sensors[at] ** 2 + sensors[at + 1] ** 2 + sensors[at + 2] ** 2 > watch.wrist_force**2:
        return True
    for i in range(bodies.shape[0]):
        body = bodies[i]
        if contact[body, 3] ** 2 + contact[body, 4] ** 2 + contact[body, 5] ** 2 > watch.contact_force**2:
            return True
    return False


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _scratch(nv: int) -> Scratch:
    """Room for a model with `nv` degrees of freedom."""
    n = ARM_JOINTS
    return Scratch(
        np.zeros((3, nv)),
        np.zeros((3, nv)),
        np.zeros((6, n)),
        np.zeros((n, n)),
        np.zeros((6, 6)),
        np.zeros((n, n)),
        np.zeros((n, 6)),
        np.zeros((6, 6)),
        np.zeros((3, 3)),
        np.zeros((3, 3)),
        np.zeros(6),
        np.zeros(3),
        np.zeros(3),
        np.zeros(6),
        np.zeros(n),
    )


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _mobility(room: Scratch) -> None:
    """Fill A = J M^-1 J^T = H^T H, where M = L L^T and L H = J^T."""
    J, A, L, H = room.J, room.A, room.factor, room.half
    _factorise(room.M, L, ARM_JOINTS)
    for j in range(ARM_JOINTS):
        for row in range(6):
            H[j, row] = J[row, j]
        for k in range(j):
            for row in range(6):
                H[j, row] -= L[j, k] * H[k, row]
        for row in range(6):
            H[j, row] *= L[j, j]
    for row in range(6):
        for column in range(6):
            A[row, column] = 0.0
    for j in range(ARM_JOINTS):
        for row in range(6):
            for column in range(6):
                A[row, column] += H[j, row] * H[j, column]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _unit_wrench(memory: Memory, controller: Controller, room: Scratch, goal: Array, desired: Array) -> None:
    """Fill `wrench` with what a hand of unit inertia needs: a spring to the goal, and damping."""
    hand, facing, qvel, velocities = memory.hand, memory.facing, memory.qvel, controller.velocities
    stiffness, damping, J, wrench = controller.stiffness, controller.damping, room.J, room.wrench
    for i in range(3):
        velocity, spin = 0.0, 0.0
        for j in range(ARM_JOINTS):
            velocity += J[i, j] * qvel[velocities[j]]
            spin += J[i + 3, j] * qvel[velocities[j]]
        # half the sum of the cross products of the axes as they are and as they should be
        a, b = (i + 1) % 3, (i + 2) % 3
        turn = 0.0
        for c in range(3):
            turn += 0.5 * (facing[3 * a + c] * desired[b, c] - facing[3 * b + c] * desired[a, c])
        wrench[i] = stiffness[i] * (goal[i] - hand[i]) - damping[i] * velocity
        wrench[i + 3] = stiffness[i + 3] * turn - damping[i + 3] * spin


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _torques(memory: Memory, controller: Controller, room: Scratch) -> None:
    """Command the torques that put the wrench on the hand, hold the arm up, and draw it to its rest posture."""
    qpos, qvel, ctrl, bias = memory.qpos, memory.qvel, memory.ctrl, memory.bias
    positions, velocities, actuators = controller.positions, controller.velocities, controller.actuators
    low, high, rest = controller.low, controller.high, controller.rest
    J, M, A, wrench, back, drift = room.J, room.M, room.A, room.wrench, room.back, room.drift
    force, torque, block, block_factor = room.force, room.torque, room.block, room.block_factor
    # what moves the arm but not the hand: N^T M x = M x - J^T A^-1 J x
    for j in range(ARM_JOINTS):
        back[j] = JOINT_KP * (rest[j] - qpos[positions[j]]) - JOINT_KV * qvel[velocities[j]]
    for row in range(6):
        drift[row] = 0.0
        for j in range(ARM_JOINTS):
            drift[row] += J[row, j] * back[j]
    _factorise(A, room.full_factor, 6)
    _solve(room.full_factor, drift, 6)

    # position and orientation are decoupled: each meets the inertia that it has alone. The factor of A begins with that
    # of its upper left block
    for row in range(3):
        force[row], torque[row] = wrench[row], wrench[row + 3]
        for column in range(3):
            block[row, column] = A[row + 3, column + 3]
    _solve(room.full_factor, force, 3)
    _factorise(block, block_factor, 3)
    _solve(block_factor, torque, 3)
    for row in range(3):
        wrench[row], wrench[row + 3] = force[row] - drift[row], torque[row] - drift[row + 3]

    for j in range(ARM_JOINTS):
        total = bias[velocities[j]]
        for row in range(6):
            total += J[row, j] * wrench[row]
        for k in range(ARM_JOINTS):
            total += M[j, k] * back[k]
        ctrl[actuators[j]] = min(max(total, low[j]), high[j])


@njit(cache=True, nogil=True, error_model="numpy")
def _rotation(vector: Array) -> Array:
    """(3, 3) rotation matrix of a rotation vector (3,), rad, by way of a quaternion as in SciPy."""
    angle = math.sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2])
    # near 0 sin(angle / 2) / angle loses its digits: its series
    scale = 0.5 - angle * angle / 48.0 if angle < 1e-3 else math.sin(angle / 2.0) / angle
    x, y, z, w = vector[0] * scale, vector[1] * scale, vector[2] * scale, math.cos(angle / 2.0)
    matrix = np.empty((3, 3))
    matrix[0, 0] = w * w + x * x - y * y - z * z
    matrix[1, 1] = w * w - x * x + y * y - z * z
    matrix[2, 2] = w * w - x * x - y * y + z * z
    matrix[0, 1], matrix[1, 0] = 2.0 * (x * y - z * w), 2.0 * (x * y + z * w)
    matrix[0, 2], matrix[2, 0] = 2.0 * (x * z + y * w), 2.0 * (x * z - y * w)
    matrix[1, 2], matrix[2, 1] = 2.0 * (y * z - x * w), 2.0 * (y * z + x * w)
    return matrix


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _mass_matrix(M: Array, memory: Memory, controller: Controller) -> None:
    """Fill M (n, n) out of MuJoCo's rows: a degree of freedom, then its ancestors: the arm's joints before it."""
    inertia, row, parent, velocities = memory.inertia, memory.inertia_row, memory.parent, controller.velocities
    for j in range(ARM_JOINTS):
        dof, k = velocities[j], j
        at = row[dof]
        while dof >= 0 and k >= 0:
            if dof == velocities[k]:
                M[j, k] = M[k, j] = inertia[at]
                k -= 1
            at, dof = at + 1, parent[dof]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _factorise(matrix: Array, factor: Array, size: int) -> None:
    """Lower triangle of the Cholesky factor of (size, size); its diagonal is stored inverted.

    A direction without any mobility (only in an exact singularity) gets 0, so that no force is spent on it.
    """
    for j in range(size):
        pivot = matrix[j, j]
        for k in range(j):
            pivot -= factor[j, k] * factor[j, k]
        inverse = 1.0 / math.sqrt(pivot) if pivot > SINGULAR * matrix[j, j] else 0.0
        factor[j, j] = inverse
        for i in range(j + 1, size):
            total = matrix[i, j]
            for k in range(j):
                total -= factor[i, k] * factor[j, k]
            factor[i, j] = total * inverse


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _solve(factor: Array, vector: Array, size: int) -> None:
    """Replace `vector` (size,) by the solution of L L^T x = vector."""
    for i in range(size):
        for k in range(i):
            vector[i] -= factor[i, k] * vector[k]
        vector[i] *= factor[i, i]
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            vector[i] -= factor[k, i] * vector[k]
        vector[i] *= factor[i, i]
