"""The simulated table: a Panda, a task's blocks and marked areas, and two cameras, as a robosuite environment."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

import numpy as np
from robosuite.controllers import load_composite_controller_config
from robosuite.environments.manipulation.manipulation_env import ManipulationEnv
from robosuite.models.arenas import TableArena
from robosuite.models.objects import BoxObject
from robosuite.models.tasks import ManipulationTask
from robosuite.utils.mjcf_utils import new_geom, new_site

from robot_adapters.base import Array
from robot_adapters.robosuite.frames import BASE, TABLE
from robot_adapters.robosuite.scenes import Build
from robot_adapters.tasks.base import ObjectSpec

CONTROL_HZ = 20
OPEN = np.array([0.04, -0.04])  # finger joints, m
UPRIGHT = (1.0, 0.0, 0.0, 0.0)  # quaternion

# left and right of the robot, like the paper's page, where the arm hides little of the table
CAMERAS: Mapping[str, tuple[float, float, float]] = {"left": (0.80, 0.58, 1.50), "right": (0.80, -0.58, 1.50)}
CAMERA_TARGET = (0.0, 0.0, 0.87)
FIELD_OF_VIEW = 34.0  # degrees, vertical: the tasks' whole workspace is in the picture, and little else

# software OpenGL draws what nobody looks at as slowly as the rest: the walls, the floor's texture (4 ms a view) and
# the stand's 33,000 triangles (6 ms), for which a column stands in
WALLS = "wall_"
STAND = "fixed_mount0_pedestal_vis"
COLUMN_RADIUS = 0.12
FLOOR = [0.62, 0.65, 0.68, 1.0]


class Tabletop(ManipulationEnv):  # type: ignore[misc]
    """robosuite environment of any task: its blocks and areas, or what its scene builds. Positions in the world frame.

    Instead of sampling, a reset puts things where `layout` says: object -> (3,) m, slider -> (1,) m from closed.
    """

    def __init__(self, objects: tuple[ObjectSpec, ...], build: Build | None = None) -> None:
        self.specs = objects
        self.build = build
        self.layout: dict[str, Array] = {}
        self.blocks: dict[str, Any] = {}
        controller = load_composite_controller_config(robot="Panda")
        # absolute set-points in the world frame: what is commanded is what skills.py says, unscaled
        controller["body_parts"]["right"].update(input_type="absolute", input_ref_frame="world", kp=150)
        super().__init__(
            robots="Panda",
            controller_configs=controller,
            initialization_noise=None,
            use_camera_obs=False,
            has_renderer=False,
            has_offscreen_renderer=False,
            renderer="mujoco",
            control_freq=CONTROL_HZ,
            lite_physics=True,
            ignore_done=True,
            hard_reset=False,
        )

    def reward(self, action: Any) -> float:  # noqa: ARG002  robosuite's signature
        """Nothing: what is good, people say."""
        return 0.0

    def _load_model(self) -> None:
        super()._load_model()
        robot = self.robots[0].robot_model
        arena = TableArena(table_full_size=(0.8, 0.8, 0.05), table_offset=(0, 0, TABLE))
        robot.set_base_xpos(robot.base_xpos_offset["table"](0.8))
        _simplify(arena)
        for name, eye in CAMERAS.items():
            facing = _look_at(np.array(eye), np.array(CAMERA_TARGET))
            arena.set_camera(name, pos=eye, quat=facing, camera_attribs={"fovy": str(FIELD_OF_VIEW)})
        self.blocks = {}
        for spec in self.specs:
            if spec.shape == "block" and self.build is None:
                self.blocks[spec.name] = BoxObject(
                    name=spec.name, size=[spec.half_size] * 3, rgba=[*spec.colour, 1.0], rng=self.rng
                )
            elif spec.shape == "area" and spec.fixed is not None:
                # a site is drawn and touches nothing
                arena.worldbody.append(
                    new_site(
                        spec.name,
                        type="sphere",
                        pos=np.array(spec.fixed) + BASE,
                        size=[spec.half_size],
                        rgba=[*spec.colour, 0.45],
                        group="1",
                    )
                )
        self.model = ManipulationTask(
            mujoco_arena=arena, mujoco_robots=[robot], mujoco_objects=list(self.blocks.values())
        )
        if self.build is not None:
            self.model.worldbody.extend(self.build({spec.name: spec for spec in self.specs}))

    def _setup_references(self) -> None:
        super()._setup_references()
        self.sim.model.geom_rgba[self.sim.model.geom_name2id(STAND)] = 0.0

    def _setup_observables(self) -> OrderedDict[str, Any]:
        """None: robosuite would refresh them at every physics step; the simulator reads MuJoCo's arrays instead."""
        return OrderedDict()

    def _reset_internal(self) -> None:
        super()._reset_internal()
        # before, robosuite has put the arm at `init_qpos` and made controllers that refer to it
        robot = self.robots[0]
        self.sim.data.qpos[robot._ref_gripper_joint_pos_indexes["right"]] = OPEN
        for spec in self.specs:
            if spec.name not in self.layout:
                continue
            at = self.layout[spec.name]
            joint = self.body(spec.name).jntadr[0]
            start = self.sim.model._model.jnt_qposadr[joint]
            # an upright object where it belongs, or a slider so far from closed
            pose = np.concatenate([at, UPRIGHT]) if spec.movable else at
            self.sim.data.qpos[start : start + len(pose)] = pose

    def body(self, name: str) -> Any:
        """MuJoCo's view of the body that is the object of this name."""
        block = self.blocks.get(name)
        return self.sim.model._model.body(name if block is None else block.root_body)


def _simplify(arena: TableArena) -> None:
    """Take what is slow to draw out of the arena, and put a column under the robot."""
    for geom in list(arena.worldbody.findall("geom")):
        if geom.get("name", "").startswith(WALLS):
            arena.worldbody.remove(geom)
        elif geom.get("name") == "floor":
            geom.attrib.pop("material")
            geom.set("rgba", " ".join(map(str, FLOOR)))
    half = float(BASE[2]) / 2
    arena.worldbody.append(
        new_geom(
            "column",
            type="cylinder",
            pos=(float(BASE[0]), float(BASE[1]), half),
            size=(COLUMN_RADIUS, half),
            rgba=(0.16, 0.17, 0.19, 1.0),
            group=1,
            contype="0",
            conaffinity="0",
        )
    )


def _look_at(eye: Array, target: Array) -> Array:
    """(4,) quaternion w, x, y, z of a MuJoCo camera (x right, y up, looking along -z) at `eye` that sees `target`."""
    import mujoco  # noqa: PLC0415

    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.stack([right, np.cross(back, right), back], axis=1).flatten())
    return quaternion
