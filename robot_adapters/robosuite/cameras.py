"""Renders the two views, and calibrates them from MuJoCo's own cameras. Everything here belongs to one thread."""

from __future__ import annotations

import atexit
import importlib
import io
import math
import os
import threading
import time
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from robot_adapters.base import AdapterError, CameraCalibration, CameraFrame, Unavailable
from robot_adapters.projection import intrinsics
from robot_adapters.robosuite.frames import BASE
from robot_adapters.robosuite.graphics import BACKENDS, remedy
from robot_adapters.robosuite.scene import CAMERAS

WIDTH, HEIGHT = 640, 480

# MuJoCo's cameras look along -z with y up; OpenCV's along z with y down
OPENCV = np.diag([1.0, -1.0, -1.0])

# what costs software OpenGL most and tells a trainer least. Shadows and reflections draw the scene again
OFF = (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION, mujoco.mjtRndFlag.mjRND_HAZE)

VISUAL = 1  # robosuite's group of what is for looks; 0 is for collisions

SMOOTHING = 4  # samples a pixel of a smooth still: edges without steps, at two and a half times the time


class WrongThread(AdapterError):
    """A picture was asked for on another thread than the context's: OpenGL would draw it black, and say nothing."""


class Cameras:
    """The OpenGL context with the scene in it. Create, use and close it on one thread, which owns it."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, *, smooth_stills: bool = False) -> None:
        """Make a context and draw once with it.

        Raises:
            Unavailable: there is no OpenGL, or it draws nothing but black.
        """
        self._model, self._data = model, data
        self._owner = threading.get_ident()
        model.vis.global_.offwidth, model.vis.global_.offheight = WIDTH, HEIGHT
        model.vis.quality.shadowsize = 0
        backend = os.environ.get("MUJOCO_GL", "")
        try:
            self._gl = gl_context(backend)
            self._gl.make_current()
            self._fast = _context(model, 0)
            self._still = _context(model, SMOOTHING) if smooth_stills else self._fast
        except Exception as error:  # whatever a driver raises, the reader needs the same remedy
            raise Unavailable(f"no OpenGL context with MUJOCO_GL={backend}: {error}", remedy=remedy(backend)) from error
        self._scene = mujoco.MjvScene(model, maxgeom=1000)
        for flag in OFF:
            self._scene.flags[flag] = 0
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = 0
        self._option.geomgroup[VISUAL] = 1
        self._option.sitegroup[:] = 0
        self._camera = mujoco.MjvCamera()
        self._camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        self._pixels = np.empty((HEIGHT, WIDTH, 3), dtype=np.uint8)
        # a context that outlives MuJoCo's own clean-up at exit complains on the console
        atexit.register(self.close)
        for still in (False, True):
            refuse_black(self.render(next(iter(CAMERAS)), still=still), backend)

    def render(self, camera: str, *, still: bool = False, segmentation: bool = False) -> NDArray[np.uint8]:
        """(480, 640, 3) RGB picture now, top row first, fast or as good as stills are.

        With `segmentation`, in colours that `geoms` understands.

        Raises:
            WrongThread: this isn't the thread that made the context.
        """
        if threading.get_ident() != self._owner:
            raise WrongThread(
                "a picture was asked for on another thread than the cameras'",
                remedy="use an adapter on the thread that built it, and only there",
            )
        context = self._still if still else self._fast
        # robosuite's invisible sites, a line through the gripper among them, would be drawn in a segmentation
        self._option.sitegroup[VISUAL] = not segmentation
        # another adapter of this thread may have drawn since, or a still
        self._gl.make_current()
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, context)
        self._camera.fixedcamid = self._model.camera(camera).id
        mujoco.mjv_updateScene(
            self._model, self._data, self._option, None, self._camera, mujoco.mjtCatBit.mjCAT_ALL, self._scene
        )
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = segmentation
        self._scene.flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = segmentation
        viewport = mujoco.MjrRect(0, 0, WIDTH, HEIGHT)
        mujoco.mjr_render(viewport, self._scene, context)
        mujoco.mjr_readPixels(self._pixels, None, viewport, context)
        return np.ascontiguousarray(self._pixels[::-1])

    def geoms(self, camera: str) -> NDArray[np.int64]:
        """(480, 640) the id of the MuJoCo geom seen at each pixel, top row first; -1 where there is none."""
        picture = self.render(camera, segmentation=True).astype(np.int64)
        index = picture[..., 0] + (picture[..., 1] << 8) + (picture[..., 2] << 16) - 1
        known = np.full(self._scene.ngeom + 1, -1, dtype=np.int64)
        for drawn in self._scene.geoms[: self._scene.ngeom]:
            if drawn.segid >= 0 and drawn.objtype == mujoco.mjtObj.mjOBJ_GEOM:
                known[drawn.segid] = drawn.objid
        at: NDArray[np.int64] = known[np.where((index >= 0) & (index < self._scene.ngeom), index, -1)]
        return at

    def frame(self, camera: str, quality: int, *, still: bool = False) -> CameraFrame:
        """A JPEG now."""
        taken_at = time.time()
        buffer = io.BytesIO()
        Image.fromarray(self.render(camera, still=still)).save(buffer, "JPEG", quality=quality)
        return CameraFrame(camera, buffer.getvalue(), WIDTH, HEIGHT, taken_at)

    def calibration(self, camera: str) -> CameraCalibration:
        """Where the camera is, from MuJoCo itself."""
        identity = self._model.camera(camera).id
        rotation = OPENCV @ self._data.cam_xmat[identity].reshape(3, 3).T
        transform = np.eye(4)
        transform[:3, :3] = rotation
        transform[:3, 3] = -rotation @ (self._data.cam_xpos[identity] - BASE)
        field_of_view = math.radians(float(self._model.cam_fovy[identity]))
        return CameraCalibration(WIDTH, HEIGHT, intrinsics(field_of_view, WIDTH, HEIGHT), transform)

    def close(self) -> None:
        """Free the context, on the thread that made it."""
        atexit.unregister(self.close)
        for context in {self._fast, self._still}:
            context.free()
        self._gl.free()


def _context(model: mujoco.MjModel, samples: int) -> mujoco.MjrContext:
    """The model uploaded to the current OpenGL, to be drawn off-screen with so many samples a pixel."""
    model.vis.quality.offsamples = samples
    return mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)


def gl_context(backend: str) -> Any:
    """MuJoCo's off-screen context of exactly this backend, even where MuJoCo was imported before it was chosen."""
    module = importlib.import_module(f"mujoco.{backend}") if backend in BACKENDS else mujoco
    return module.GLContext(WIDTH, HEIGHT)


def refuse_black(picture: NDArray[np.uint8], backend: str) -> None:
    """Raise `Unavailable` if the picture (h, w, 3) shows nothing: some drivers start and then draw black."""
    if int(picture.max()) - int(picture.min()) < 8:
        raise Unavailable(f"OpenGL draws an empty picture with MUJOCO_GL={backend}", remedy=remedy(backend))
