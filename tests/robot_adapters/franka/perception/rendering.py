"""What cameras would see: a table with tagged blocks and a board, drawn by MuJoCo, then blurred and made noisy."""

from __future__ import annotations

import importlib
import os
from collections.abc import Mapping
from dataclasses import dataclass, field

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array
from robot_adapters.franka.perception.camera import Lens
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.tags import modules
from robot_adapters.projection import look_at
from robot_adapters.robosuite.graphics import choose_backend
from robot_adapters.tasks.base import Part

TABLE = -0.112
WIDTH, HEIGHT = 1280, 720
FIELD_OF_VIEW = np.deg2rad(42.5)
"""Vertical, of the colour camera of a D415 (datasheet)."""
EYES = {"left": np.array([0.82, 0.46, 0.56]), "right": np.array([0.82, -0.46, 0.56])}
LOOKS_AT = np.array([0.54, 0.0, -0.08])
BLUR = 0.7
"""Standard deviation, pixels: what a D415's lens does."""
NOISE = 3.0
"""Standard deviation of 255, likewise indoors."""


def view(eye: Array, at: Array = LOOKS_AT) -> View:
    """A camera at `eye` that looks at `at`, both (3,) m."""
    seen = look_at(eye, at, vertical_field_of_view=float(FIELD_OF_VIEW), width=WIDTH, height=HEIGHT)
    matrix = seen.intrinsics.copy()
    matrix[:2, 2] -= 0.5  # OpenCV counts from pixels' centres
    return View(Lens(WIDTH, HEIGHT, matrix, np.zeros(5)), seen.camera_from_base)


@dataclass(frozen=True)
class Patch:
    """A flat picture somewhere: pixels (h, w) or (h, w, 3), `size` (width, height) m, its middle at the body's `at`.

    at: (3,) m from its body. rotation: (3, 3), of which x is right in the picture, y up and z towards the viewer.
    """

    pixels: NDArray[np.uint8]
    size: tuple[float, float]
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation: Array = field(default_factory=lambda: np.eye(3))


@dataclass(frozen=True)
class Solid:
    """Something made of boxes, with pictures on it."""

    boxes: tuple[Part, ...] = ()
    patches: tuple[Patch, ...] = ()


def cube(half: float, colour: tuple[float, float, float] = (0.8, 0.7, 0.5), patches: tuple[Patch, ...] = ()) -> Solid:
    """A cube, half its edge in m."""
    return Solid((Part((0.0, 0.0, 0.0), (half, half, half), colour),), patches)


def tag_pixels(number: int) -> NDArray[np.uint8]:
    """The picture of a tag with 20 pixels a module, and its white rim of one module."""
    grid = np.kron(modules(number), np.ones((20, 20), dtype=bool))
    return np.pad(np.where(grid, 0, 255).astype(np.uint8), 20, constant_values=255)


def tag_patch(number: int, size: float, at: tuple[float, float, float], rotation: Array | None = None) -> Patch:
    """A tag whose black square is `size` m wide."""
    side = size * 200 / 160
    return Patch(tag_pixels(number), (side, side), at, np.eye(3) if rotation is None else rotation)


class Stage:
    """The scene with its two cameras. Made, used and closed on one thread."""

    def __init__(self, solids: Mapping[str, Solid], eyes: Mapping[str, View], *, seed: int = 0) -> None:
        choose_backend()
        self._views = dict(eyes)
        self.rng = np.random.default_rng(seed)
        spec = mujoco.MjSpec()
        spec.visual.global_.offwidth, spec.visual.global_.offheight = WIDTH, HEIGHT
        spec.visual.quality.offsamples = 4
        spec.visual.map.znear, spec.visual.map.zfar = 0.01, 50.0
        spec.visual.headlight.ambient, spec.visual.headlight.diffuse = [0.45] * 3, [0.35] * 3
        spec.worldbody.add_light(pos=[0.3, 0.2, 2.0], dir=[0.1, -0.1, -1.0], diffuse=[0.4] * 3)
        self._picture(spec, spec.worldbody, "table", Patch(_wood(), (1.2, 1.2), (0.6, 0.0, TABLE)))
        self._picture(spec, spec.worldbody, "floor", Patch(_wood(7, 60), (6.0, 6.0), (0.0, 0.0, TABLE - 0.75)))
        for i, (x, y, z) in enumerate([(0.15, 0.5, 0.05), (0.1, -0.45, 0.08), (0.9, -0.5, 0.02), (0.95, 0.52, 0.03)]):
            box = _wood(20 + i, 8)
            self._picture(spec, spec.worldbody, f"box{i}", Patch(box, (0.12, 0.12), (x, y, TABLE + 2 * z)))
        for name, solid in solids.items():
            body = spec.worldbody.add_body(name=name, mocap=True)
            for part in solid.boxes:
                round_ = part.shape != "box"
                body.add_geom(
                    type=mujoco.mjtGeom.mjGEOM_CYLINDER if round_ else mujoco.mjtGeom.mjGEOM_BOX,
                    size=[part.half[0], part.half[2], 0.0] if round_ else part.half,
                    pos=part.centre,
                    rgba=[*part.colour, part.opacity],
                )
            for i, patch in enumerate(solid.patches):
                self._picture(spec, body, f"{name}{i}", patch)
        for name in eyes:
            spec.worldbody.add_camera(name=name, fovy=float(np.rad2deg(FIELD_OF_VIEW)))
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self._solids = list(solids)
        self.clear()
        self._gl = importlib.import_module(f"mujoco.{os.environ['MUJOCO_GL']}").GLContext(WIDTH, HEIGHT)
        self._gl.make_current()
        self._context = mujoco.MjrContext(self.model, mujoco.mjtFontScale.mjFONTSCALE_100)
        self._scene = mujoco.MjvScene(self.model, maxgeom=200)
        self._option = mujoco.MjvOption()
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        for name, seen in eyes.items():
            self.stand(name, seen)

    def place(self, name: str, at: tuple[float, float, float] | Array, rotation: Array | float = 0.0) -> None:
        """Put a solid at (3,) m, base frame, turned by (3, 3) or by an angle about z, rad."""
        body = self.model.body(name).mocapid[0]
        if not isinstance(rotation, np.ndarray):
            c, s = np.cos(rotation), np.sin(rotation)
            rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        self.data.mocap_pos[body] = at
        mujoco.mju_mat2Quat(self.data.mocap_quat[body], np.ascontiguousarray(rotation).ravel())

    def clear(self) -> None:
        """Take everything off the table, to where no camera sees it."""
        for name in self._solids:
            self.place(name, (0.0, 0.0, -5.0))

    def stand(self, camera: str, seen: View) -> None:
        """Put a camera where this view is."""
        index = self.model.camera(camera).id
        self._views[camera] = seen
        self.model.cam_pos[index] = seen.eye
        rotation = seen.camera_from_base[:3, :3].T @ np.diag([1.0, -1.0, -1.0])
        mujoco.mju_mat2Quat(self.model.cam_quat[index], np.ascontiguousarray(rotation).ravel())

    def draw(self, camera: str, *, clean: bool = False) -> NDArray[np.uint8]:
        """(720, 1280, 3) RGB as a camera would see it now."""
        colour, _ = self.render(camera)
        if clean:
            return colour
        soft = cv2.GaussianBlur(colour, (0, 0), BLUR).astype(np.float32)
        noisy = soft + self.rng.normal(0.0, NOISE, soft.shape).astype(np.float32)
        return np.clip(noisy + 0.5, 0, 255).astype(np.uint8)

    def render(self, camera: str) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
        """(720, 1280, 3) RGB without any faults, and (720, 1280) depth in m."""
        mujoco.mj_forward(self.model, self.data)
        seen = mujoco.MjvCamera()
        seen.type, seen.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, self.model.camera(camera).id
        self._gl.make_current()
        mujoco.mjv_updateScene(self.model, self.data, self._option, None, seen, mujoco.mjtCatBit.mjCAT_ALL, self._scene)
        for flag in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION, mujoco.mjtRndFlag.mjRND_HAZE):
            self._scene.flags[flag] = 0
        frame = mujoco.MjrRect(0, 0, WIDTH, HEIGHT)
        mujoco.mjr_render(frame, self._scene, self._context)
        colour = np.empty((HEIGHT, WIDTH, 3), dtype=np.uint8)
        depth = np.empty((HEIGHT, WIDTH), dtype=np.float32)
        mujoco.mjr_readPixels(colour, depth, frame, self._context)
        near = self.model.vis.map.znear * self.model.stat.extent
        far = self.model.vis.map.zfar * self.model.stat.extent
        metres = near / (1.0 - depth * (1.0 - near / far))
        return np.ascontiguousarray(colour[::-1]), np.ascontiguousarray(metres[::-1]).astype(np.float32)

    def close(self) -> None:
        """Free the graphics."""
        self._context.free()
        self._gl.free()

    @staticmethod
    def _picture(spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, patch: Patch) -> None:
        pixels = patch.pixels if patch.pixels.ndim == 3 else np.repeat(patch.pixels[..., None], 3, axis=2)
        texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D)
        texture.height, texture.width, texture.nchannel = pixels.shape
        texture.data = np.ascontiguousarray(pixels).tobytes()
        material = spec.add_material(name=name)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
        material.specular = 0.1
        w, h = patch.size[0] / 2, patch.size[1] / 2
        mesh = spec.add_mesh(name=name)
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        mesh.uservert = [-w, -h, 0, w, -h, 0, w, h, 0, -w, h, 0]
        mesh.userface = [0, 1, 2, 0, 2, 3]
        mesh.usertexcoord = [0, 1, 1, 1, 1, 0, 0, 0]
        # a hair above what it is stuck to
        at = np.array(patch.at) + 0.0002 * patch.rotation[:, 2]
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(patch.rotation).ravel())
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=name,
            material=name,
            pos=at,
            quat=quaternion,
            contype=0,
            conaffinity=0,
        )


def _wood(seed: int = 1, cells: int = 40) -> NDArray[np.uint8]:
    """A surface with something to see on it, as every real one has."""
    rng = np.random.default_rng(seed)
    coarse = rng.integers(90, 200, (cells, cells), dtype=np.uint8)
    grey = cv2.resize(coarse, (512, 512), interpolation=cv2.INTER_CUBIC).astype(np.int16)
    grain = rng.normal(0, 8, grey.shape)
    mixed = np.clip(grey * 0.5 + 70 + grain, 0, 255)
    found: NDArray[np.uint8] = np.stack((mixed, mixed * 0.92, mixed * 0.8), axis=2).astype(np.uint8)
    return found
