"""The simulated arm: robosuite's physics and controller behind the `Arm` of `skills.py`, in the robot base frame."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal

import mujoco
import numpy as np

from robot_adapters.base import Array, Scene, Telemetry
from robot_adapters.robosuite.damage import Damage
from robot_adapters.robosuite.frames import BASE, TABLE
from robot_adapters.robosuite.kinematics import solve
from robot_adapters.robosuite.scene import Tabletop
from robot_adapters.robosuite.scenes import Build
from robot_adapters.robosuite.stepping import NativeStepping, ReferenceStepping, Stepping
from robot_adapters.tasks.base import ObjectSpec

GRIP_SITE = "gripper0_right_grip_site"
GRASPING = (
    ("gripper0_right_finger1_collision", "gripper0_right_finger1_pad_collision"),
    ("gripper0_right_finger2_collision", "gripper0_right_finger2_pad_collision"),
)
FINGERS = ("gripper0_right_finger_joint1", "gripper0_right_finger_joint2")
SETTLING_STEPS = 2  # set-points after a reset, for everything to come to rest where it was put
START_NOISE = 0.02  # rad, standard deviation, robosuite's own, for a task that doesn't place the gripper

FORCE = "gripper0_right_force_ee"


class Simulator:
    """Owns the physics. The only place that steps it, natively or by robosuite's own loop."""

    table_height: float = TABLE - float(BASE[2])

    def __init__(
        self,
        objects: tuple[ObjectSpec, ...],
        stepping: Literal["native", "reference"] = "native",
        build: Build | None = None,
    ) -> None:
        """Make the scene.

        Args:
            objects: of the task.
            stepping: who advances the physics.
            build: the task's scene (`scenes.find`); None where blocks and areas are all there is.
        """
        self._env = Tabletop(objects, build)
        self.model: mujoco.MjModel = self._env.sim.model._model
        self.data: mujoco.MjData = self._env.sim.data._data
        self._damage = Damage(self.model, self.data)
        backend = NativeStepping if stepping == "native" else ReferenceStepping
        self._stepping: Stepping = backend(self._env, self._damage)
        self._closed = False
        self.yaw = 0.0
        """The angle last commanded, rad: the one to keep, where the measured one would drift from skill to skill."""
        self._home = np.array(self._robot.init_qpos)
        self._site = self.model.site(GRIP_SITE).id
        self._fingers = [self.model.joint(name).qposadr[0] for name in FINGERS]
        self._bodies = {spec.name: self._env.body(spec.name).id for spec in objects if spec.movable}
        # a cube is as good on any of its sides
        self._upright = [spec.name for spec in objects if spec.shape == "thing"]
        self._sliders = {
            spec.name: int(self.model.joint(spec.name).qposadr[0]) for spec in objects if spec.shape == "slider"
        }
        self._grasping = [[self.model.geom(name).id for name in finger] for finger in GRASPING]
        self._joints = [int(at) for at in self._robot._ref_joint_pos_indexes]
        ranges = {int(at): limits for at, limits in zip(self.model.jnt_qposadr, self.model.jnt_range, strict=True)}
        self._joint_limits = tuple((float(ranges[at][0]), float(ranges[at][1])) for at in self._joints)
        self._overload: str | None = None
        self.damage: str | None = None
        """The newest overload, until it is set to None."""
        self.low_level_steps = 0
        """Set-points since the adapter was built."""

    @property
    def _robot(self) -> Any:
        return self._env.robots[0]

    def reset(self, layout: Mapping[str, Array], rng: np.random.Generator) -> None:
        """Put the blocks and the open gripper where `layout` says, m, base frame, and let everything come to rest."""
        placed = dict(layout)
        gripper = placed.pop("gripper", None)
        # a slider's one number has no frame
        self._env.layout = {name: at + BASE if len(at) == len(BASE) else at for name, at in placed.items()}
        if gripper is None:
            joints = self._home + rng.normal(0.0, START_NOISE, self._home.shape)
        else:
            joints = solve(self.model, GRIP_SITE, gripper + BASE, self._home)
        self._robot.init_qpos = joints
        self._env.reset()
        self._stepping.bind()
        self._closed = False
        here, yaw = self.pose()
        for _ in range(SETTLING_STEPS):
            self.step(here, yaw, gripper_closed=False)
        self.damage = None

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
        # pointing down with the site's x axis at an angle is a half turn about the axis at half that angle
        half = (yaw + math.pi / 2) / 2
        turn = (math.pi * math.cos(half), math.pi * math.sin(half), 0.0)
        self._stepping.step(np.array([*(target + BASE), *turn, 1.0 if gripper_closed else -1.0]))
        self.low_level_steps += 1
        self._overload = self._damage.found()
        self.damage = self._overload or self.damage

    def overload(self) -> str | None:
        """What was beyond its limit during the last set-point, in words."""
        return self._overload

    # what a task may look at

    def scene(self) -> Scene:
        """Every object's origin, the gripper and what it holds, as they are now."""
        return Scene(
            objects={name: self.data.xpos[body] - BASE for name, body in self._bodies.items()},
            gripper=self.pose()[0],
            gripper_closed=self._closed,
            held=self._held(),
            joints={name: float(self.data.qpos[at]) for name, at in self._sliders.items()},
            # the last of a body's rotation matrix is how much of its own z axis is upright
            tilts={
                name: math.acos(np.clip(self.data.xmat[self._bodies[name]][8], -1.0, 1.0)) for name in self._upright
            },
        )

    def telemetry(self) -> Telemetry:
        """Joints, gripper, and the force that the hand feels."""
        x, y, z = (float(v) for v in self.pose()[0])
        fx, fy, fz = (float(v) for v in self.data.sensor(FORCE).data)
        return Telemetry(
            joints=tuple(float(self.data.qpos[at]) for at in self._joints),
            joint_limits=self._joint_limits,
            gripper=(x, y, z),
            opening=self.gripper_width(),
            force=(fx, fy, fz),
        )

    def close(self) -> None:
        """Release robosuite's buffers."""
        self._env.close()

    def _held(self) -> str | None:
        """The object that both fingers touch while they are commanded closed."""
        if not self._closed or self.data.ncon == 0:
            return None
        pairs = self.data.contact.geom
        touched = [
            set(self.model.geom_bodyid[pairs[np.isin(pairs, finger).any(axis=1)]].flatten().tolist())
            for finger in self._grasping
        ]
        return next((name for name, body in self._bodies.items() if all(body in bodies for bodies in touched)), None)
