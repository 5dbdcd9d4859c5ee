"""Two ways to hold a set-point for one control period: robosuite's own, and the same in machine code."""

from __future__ import annotations

import logging
import math
import time
from typing import Any, Protocol

import numpy as np

from robot_adapters.base import Array, Unavailable
from robot_adapters.robosuite.control_step import Controller, Memory, control_step, load_symbols
from robot_adapters.robosuite.damage import Damage

log = logging.getLogger(__name__)

ARM = "right"
GRIPPER = "right_gripper"
SUPPORTED = {
    "use_ori": True,
    "input_type": "absolute",
    "input_ref_frame": "world",
    "impedance_mode": "fixed",
    "interpolator_pos": None,
    "interpolator_ori": None,
    "uncoupling": True,
}
"""Attributes of robosuite's arm controller whose equations `control_step` has."""


class Stepping(Protocol):
    """Advances the physics. The fingers take a command at once, where robosuite ramps it: they are damped enough."""

    def bind(self) -> None:
        """Take over the controllers that robosuite has made anew; to call after each of its resets."""

    def step(self, action: Array) -> None:
        """Hold the set-point for one control period.

        Args:
            action: (7,) grip site in m and rotation vector in rad, world frame; above 0 closes the gripper.
        """


class ReferenceStepping:
    """robosuite's `env.step`: many times as slow, and what the other is held to. Forces are seen once a set-point."""

    def __init__(self, env: Any, damage: Damage) -> None:
        self._env = env
        self._damage = damage

    def bind(self) -> None:
        """Let the controllers look anew: they remember the arm as it was before the scene placed the fingers."""
        for controller in self._env.robots[0].part_controllers.values():
            controller.new_update = True

    def step(self, action: Array) -> None:
        """See `Stepping.step`."""
        fingers = np.array([-1.0, 1.0]) * np.sign(action[6])
        self._env.robots[0].gripper[ARM].current_action = fingers
        self._env.step(action)
        self._damage.note()


class NativeStepping:
    """The same physics and equations without Python between two physics steps, and without the GIL."""

    def __init__(self, env: Any, damage: Damage) -> None:
        """Compile, or load what was compiled before.

        Args:
            env: robosuite's environment.
            damage: is asked to note what it sees after every physics step with a force beyond its limit.
        """
        self._env = env
        self._damage, self._watch = damage, damage.watch()
        self._model, self._data = env.sim.model._model, env.sim.data._data
        period = 1.0 / env.control_freq
        timestep = self._model.opt.timestep
        self._substeps = round(period / timestep)
        if not math.isclose(self._substeps * timestep, period):
            # robosuite would cut the period short without a word
            raise ValueError(f"a control period of {period} s isn't a multiple of {timestep} s")
        load_symbols()
        self.bind()
        started = time.perf_counter()
        # compiles now and not in the first motion; numba keeps the result for the next start
        self._run(0)
        if control_step.stats.cache_misses:
            log.info("compiled the control step in %.1f s; the next start loads it", time.perf_counter() - started)

    def bind(self) -> None:
        """Read indices, gains, limits and rest posture off the present controllers.

        Raises:
            Unavailable: a controller is set to do something that this backend doesn't.
        """
        robot, model, data = self._env.robots[0], self._model, self._data
        arm, gripper = robot.part_controllers[ARM], robot.part_controllers[GRIPPER]
        for name, value in SUPPORTED.items():
            if getattr(arm, name) != value:
                raise Unavailable(
                    f"the native stepping knows no controller with {name}={getattr(arm, name)!r}",
                    remedy="set stepping to reference",
                )
        actuators = robot._ref_actuators_indexes_dict
        site = model.site(arm.ref_name).id
        low, high = model.actuator_ctrlrange[actuators[ARM]].T.copy()
        self._memory = Memory(
            model._address,
            data._address,
            data.qpos,
            data.qvel,
            data.ctrl,
            data.qfrc_bias,
            data.qM,
            model.dof_Madr,
            model.dof_parentid,
            data.site_xpos[site],
            data.site_xmat[site],
        )
        self._controller = Controller(
            site,
            np.array(arm.qpos_index),
            np.array(arm.qvel_index),
            np.array(actuators[ARM]),
            np.array(actuators[GRIPPER]),
            low,
            high,
            np.array(arm.kp, dtype=np.float64),
            np.array(arm.kd, dtype=np.float64),
            np.array(arm.initial_joint, dtype=np.float64),
        )
        self._open, self._closed = (self._fingers(gripper, np.array(to)) for to in ([1.0, -1.0], [-1.0, 1.0]))
        self._command = np.concatenate([np.zeros(6), self._open])

    def step(self, action: Array) -> None:
        """See `Stepping.step`."""
        self._command[:6] = action[:6]
        self._command[6:] = self._closed if action[6] > 0 else self._open
        left = self._substeps
        while left:
            taken, alarmed = self._run(left)
            left -= taken
            if alarmed:
                self._damage.note()

    def _run(self, substeps: int) -> tuple[int, bool]:
        result: tuple[int, bool] = control_step(substeps, self._command, *self._memory, *self._controller, *self._watch)
        return result

    def _fingers(self, gripper: Any, action: Array) -> Array:
        """(g,) what robosuite's gripper controller makes of an action (g,) in [-1, 1]."""
        middle, reach = gripper.actuator_max + gripper.actuator_min, gripper.actuator_max - gripper.actuator_min
        command = middle / 2 + reach / 2 * gripper.scale_action(action)
        clipped: Array = np.clip(command, *self._model.actuator_ctrlrange[self._controller.gripper].T)
        return clipped
