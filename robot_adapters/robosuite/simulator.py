"""The simulated arm: robosuite's physics and controller behind the `Arm` of `skills.py`, in the robot base frame."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from robot_adapters.base import Array, Scene
from robot_adapters.robosuite.kinematics import solve
from robot_adapters.robosuite.scene import BASE, TABLE, Tabletop
from robot_adapters.tasks.base import ObjectSpec

GRIP_SITE = "gripper0_right_grip_site"
FINGERS = ("gripper0_right_finger_joint1", "gripper0_right_finger_joint2")
SETTLING_STEPS = 4  # set-points after a reset, for the blocks to come to rest on the table
START_NOISE = 0.02  # rad, standard deviation, robosuite's own, for a task that doesn't place the gripper


class Simulator:
    """Owns the physics. The only place that steps it, so another stepping loop can take robosuite's place here."""

    table_height: float = TABLE - float(BASE[2])

    def __init__(self, objects: tuple[ObjectSpec, ...]) -> None:
        self._env = Tabletop(objects)
        self.model: mujoco.MjModel = self._env.sim.model._model
        self.data: mujoco.MjData = self._env.sim.data._data
        self._closed = False
        self.yaw = 0.0
        """The angle last commanded, rad: the one to keep, where the measured one would drift from skill to skill."""
        self._home = np.array(self._robot.init_qpos)
        self._site = self.model.site(GRIP_SITE).id
        self._fingers = [self.model.joint(name).qposadr[0] for name in FINGERS]
        self._bodies = {name: self.model.body(block.root_body).id for name, block in self._env.blocks.items()}
        self.low_level_steps = 0
        """Set-points since the adapter was built."""

    @property
    def _robot(self) -> Any:
        return self._env.robots[0]

    def reset(self, layout: Mapping[str, Array], rng: np.random.Generator) -> None:
        """Put the blocks and the open gripper where `layout` says, m, base frame, and let everything come to rest."""
        placed = dict(layout)
        gripper = placed.pop("gripper", None)
        self._env.layout = {name: position + BASE for name, position in placed.items()}
        if gripper is None:
            joints = self._home + rng.normal(0.0, START_NOISE, self._home.shape)
        else:
            joints = solve(self.model, GRIP_SITE, gripper + BASE, self._home)
        self._robot.init_qpos = joints
        self._env.reset()
        self._closed = False
        here, yaw = self.pose()
        for _ in range(SETTLING_STEPS):
            self.step(here, yaw, gripper_closed=False)

    # the Arm of skills.py

    def pose(self) -> tuple[Array, float]:
        """Grip site (3,) m, base frame, and yaw in rad (0: the fingers close along y)."""
        # the fingers close along the site's x axis, which points along the base's y axis at yaw 0
        rotation = self.data.site_xmat[self._site].reshape(3, 3)
        return self.data.site_xpos[self._site] - BASE, math.atan2(-rotation[0, 0], rotation[1, 0])

    def gripper_width(self) -> float:
        """Distance between the fingers, m."""
        return float(abs(self.data.qpos[self._fingers[0]] - self.data.qpos[self._fingers[1]]))

    def gripper_closed(self) -> bool:
        """Whether the fingers were last commanded to close."""
        return self._closed

    def step(self, target: Array, yaw: float, gripper_closed: bool) -> None:
        """Hold the set-point for one control period."""
        self._closed, self.yaw = gripper_closed, yaw
        # at once (gripper rate 1), where robosuite ramps the command over ten steps: the fingers are damped enough
        self._robot.gripper["right"].current_action = np.array([1.0, -1.0]) * (-1.0 if gripper_closed else 1.0)
        # pointing down with the site's x axis at an angle is a half turn about the axis at half that angle
        half = (yaw + math.pi / 2) / 2
        rotation = math.pi * np.array([math.cos(half), math.sin(half), 0.0])
        self._env.step(np.concatenate([target + BASE, rotation, [1.0 if gripper_closed else -1.0]]))
        self.low_level_steps += 1

    # what a task may look at

    def scene(self) -> Scene:
        """Every block's centre, the gripper and what it holds, as they are now."""
        return Scene(
            objects={name: self.data.xpos[body] - BASE for name, body in self._bodies.items()},
            gripper=self.pose()[0],
            gripper_closed=self._closed,
            held=self._held(),
        )

    def close(self) -> None:
        """Release robosuite's buffers."""
        self._env.close()

    def _held(self) -> str | None:
        """The block that both finger pads touch while they are commanded closed."""
        if not self._closed:
            return None
        gripper = self._robot.gripper["right"]
        for name, block in self._env.blocks.items():
            if self._env._check_grasp(gripper, block):
                return name
        return None
