"""The compiled control step beside robosuite's own: the same physics, set-point by set-point, in every task."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import mujoco
import numpy as np
import pytest

from robot_adapters.base import Array, Unavailable
from robot_adapters.registry import task
from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from robot_adapters.robosuite.simulator import Simulator
from tests.robot_adapters.robosuite.conftest import build

TASKS = sorted(FACTORY.tasks)
SAME = 1e-9  # m, rad, and those a second; measured 2e-12 at most
# of two boxes that touch face to face, MuJoCo chooses the points of contact by the last bit. The fingertips are such
# boxes once nothing is between them; elsewhere it is rare, and either way the choice moves things by next to nothing
FINGERS_MEET = 0.002  # m
FLIPS = 0.01  # of the set-points; measured 1 in 319
FLIPPED = 1e-4  # m, rad, and those a second; measured 1.4e-6


class Beside:
    """Takes every set-point in machine code, and once more by robosuite from the very same state."""

    def __init__(self, ours: RobosuiteAdapter, theirs: RobosuiteAdapter) -> None:
        self._ours, self._theirs = ours.simulator, theirs.simulator
        self._native, self._reference = self._ours._stepping, self._theirs._stepping
        self.differences: list[tuple[float, bool]] = []
        """After each set-point: how far apart, and whether the empty fingers met."""

    def bind(self) -> None:
        self._native.bind()

    def step(self, action: Array) -> None:
        everything = mujoco.mjtState.mjSTATE_INTEGRATION
        before = np.empty(mujoco.mj_stateSize(self._ours.model, everything))
        mujoco.mj_getState(self._ours.model, self._ours.data, before, everything)
        self._native.step(action)
        mujoco.mj_setState(self._theirs.model, self._theirs.data, before, everything)
        self._reference.bind()
        self._reference.step(action)
        difference = float(np.abs(moving(self._ours) - moving(self._theirs)).max())
        self.differences.append((difference, self._ours.gripper_width() < FINGERS_MEET))


def moving(simulator: Simulator) -> Array:
    """Positions and velocities."""
    return np.concatenate([simulator.data.qpos, simulator.data.qvel])


def solve(adapter: RobosuiteAdapter, name: str, seed: int) -> None:
    """Solve the task by its true calls."""
    staged = task(name)
    for _ in range(staged.horizon):
        call = staged.true_call(adapter.observe().state)
        if adapter.execute(call, should_stop=lambda: False, on_step=lambda: None).success:
            break
    assert adapter.success(), seed


def wander(adapter: RobosuiteAdapter) -> list[Array]:
    """Positions and velocities after each of 240 set-points that go here and there, turning."""
    adapter.reset(3)
    simulator, rng, seen = adapter.simulator, np.random.default_rng(0), list[Array]()
    low, high = np.array([0.40, -0.2, simulator.table_height + 0.02]), np.array([0.65, 0.2, 0.2])
    target, yaw = simulator.pose()
    for i in range(240):
        if i % 6 == 0:
            target, yaw = np.clip(target + rng.uniform(-0.06, 0.06, 3), low, high), rng.uniform(-0.5, 0.5)
        simulator.step(target, yaw, gripper_closed=False)
        seen.append(moving(simulator))
    return seen


@pytest.fixture(params=TASKS)
def both(request: pytest.FixtureRequest) -> Iterator[tuple[RobosuiteAdapter, RobosuiteAdapter]]:
    """The same task twice: (compiled, robosuite's own)."""
    native, reference = build(request.param), FACTORY(request.param, RobosuiteSettings(stepping="reference"))
    assert isinstance(reference, RobosuiteAdapter)
    yield native, reference
    native.close()
    reference.close()


def test_both_ways_of_stepping_move_everything_alike(
    both: tuple[RobosuiteAdapter, RobosuiteAdapter], request: pytest.FixtureRequest
) -> None:
    native, reference = both
    for seed in (1, 2):
        native.reset(seed)
        reference.reset(seed)
        beside = Beside(native, reference)
        native.simulator._stepping = beside
        solve(native, request.node.callspec.params["both"], seed)
        native.simulator._stepping = beside._native
        assert max(difference for difference, _ in beside.differences) < FLIPPED
        apart = [difference for difference, met in beside.differences if not met]
        assert sum(difference >= SAME for difference in apart) <= FLIPS * len(apart)
    ours, theirs = wander(native), wander(reference)
    assert max(float(np.abs(a - b).max()) for a, b in zip(ours, theirs, strict=True)) < SAME
    assert all((a != b).any() for a, b in pairwise(ours))


def test_stepping_is_a_setting_that_the_adapter_tells(stacking: RobosuiteAdapter) -> None:
    assert stacking.info.details["stepping"] == "native"
    assert RobosuiteSettings(stepping="reference").stepping == "reference"
    with pytest.raises(ValueError, match="stepping"):
        RobosuiteSettings.model_validate({"stepping": "by hand"})


def test_a_controller_that_it_does_not_know_is_refused(stacking: RobosuiteAdapter) -> None:
    # here and not above: MuJoCo binds to its OpenGL at import, which the adapter has chosen
    from robot_adapters.robosuite.damage import Damage  # noqa: PLC0415
    from robot_adapters.robosuite.scene import Tabletop  # noqa: PLC0415
    from robot_adapters.robosuite.stepping import ARM, NativeStepping  # noqa: PLC0415

    env = Tabletop(())
    damage = Damage(env.sim.model._model, env.sim.data._data)
    native = NativeStepping(env, damage)
    env.robots[0].part_controllers[ARM].impedance_mode = "variable"
    with pytest.raises(Unavailable, match="impedance_mode='variable'") as refused:
        native.bind()
    assert refused.value.remedy == "set stepping to reference"
    env.sim.model._model.opt.timestep = 0.004
    with pytest.raises(ValueError, match=r"0\.05 s isn't a multiple of 0\.004 s"):
        NativeStepping(env, damage)
    env.close()


def test_a_direction_without_mobility_gets_no_force(stacking: RobosuiteAdapter) -> None:
    from robot_adapters.robosuite.control_step import _factorise, _solve  # noqa: PLC0415

    rng = np.random.default_rng(0)
    half = rng.normal(size=(6, 7))
    regular, singular = half @ half.T, np.diag([4.0, 0.0, 2.0])
    for matrix, force in ((regular, rng.normal(size=6)), (singular, np.array([1.0, 5.0, 1.0]))):
        factor, solved = np.zeros_like(matrix), force.copy()
        _factorise(matrix, factor, len(matrix))
        _solve(factor, solved, len(solved))
        assert solved == pytest.approx(np.linalg.pinv(matrix) @ force, rel=1e-9)


def test_a_blow_that_is_over_before_the_control_period_is_noticed(stacking: RobosuiteAdapter) -> None:
    stacking.reset(0)
    simulator = stacking.simulator
    model, data = simulator.model, simulator.data
    hand, block = model.body("robot0_right_hand").id, model.body("block_b_main")
    place, speed = int(model.jnt_qposadr[block.jntadr[0]]), int(model.jnt_dofadr[block.jntadr[0]])
    # the block flies against the hand's side, and back
    data.qpos[place : place + 3] = data.xpos[hand] + [0.15, 0.0, 0.08]
    data.qvel[speed : speed + 3] = [-4.0, 0.0, 0.0]
    here, yaw = simulator.pose()
    simulator.step(here, yaw, gripper_closed=False)
    assert np.linalg.norm(data.cfrc_ext[hand]) < 1.0
    overload = simulator.overload()
    assert overload is not None
    assert overload.startswith("the hand or arm presses against something with ")
    stacking.reset(0)
    simulator.step(here, yaw, gripper_closed=False)
    assert simulator.overload() is None
