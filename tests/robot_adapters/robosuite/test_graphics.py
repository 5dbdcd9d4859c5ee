"""Missing or broken graphics are refused with a remedy, and the console stays quiet.

Each in a fresh process, because MuJoCo binds to its OpenGL once.
"""

from __future__ import annotations

import io
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from PIL import Image

from robot_adapters.base import Unavailable
from robot_adapters.robosuite import FACTORY, RobosuiteSettings, graphics
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from robot_adapters.robosuite.cameras import WrongThread, refuse_black

BUILD = """
import sys
from robot_adapters.base import Unavailable
from robot_adapters.robosuite import FACTORY, RobosuiteSettings
assert not {"mujoco", "robosuite", "torch"} & sys.modules.keys(), "importing the factory loaded the simulator"
try:
    adapter = FACTORY("reaching", RobosuiteSettings())
except Unavailable as error:
    print("unavailable:", error, "remedy:", error.remedy)
else:
    print(dict(adapter.info.details))
"""


WITHOUT = """
from robot_adapters import low_level
from robot_adapters.robosuite import FACTORY, RobosuiteSettings
adapter = FACTORY("stacking", RobosuiteSettings(draw=False))
print(dict(adapter.reset(0).frames), adapter.info.cameras, adapter.info.details["graphics"])
env = low_level.make("stacking", "robosuite")
env.reset(seed=0)
print(env.step(env.action_space.sample())[0].shape)
"""


def build(program: str = BUILD, **environment: str) -> subprocess.CompletedProcess[str]:
    kept = {k: v for k, v in os.environ.items() if k not in {"MUJOCO_GL", "PYOPENGL_PLATFORM"}}
    return subprocess.run(
        [sys.executable, "-c", program], env=kept | environment, capture_output=True, text=True, timeout=120, check=True
    )


def test_osmesa_is_respected_and_the_console_stays_quiet() -> None:
    done = build(MUJOCO_GL="osmesa")
    assert "'graphics': 'osmesa', 'graphics_chosen_by': 'MUJOCO_GL'" in done.stdout
    assert done.stdout.count("\n") == 1
    assert done.stderr == ""


@pytest.mark.parametrize("backend", ["disable", "glfw", "no-such-thing"])
def test_a_backend_that_draws_nothing_is_refused_with_a_remedy(backend: str) -> None:
    done = build(MUJOCO_GL=backend, DISPLAY="")
    assert done.stdout.startswith("unavailable:")
    assert backend in done.stdout
    assert "libegl1" in done.stdout


def test_without_pictures_no_graphics_are_needed() -> None:
    done = build(WITHOUT, MUJOCO_GL="disable")
    assert done.stdout.splitlines() == ["{} () none", "(10,)"]


def test_without_any_backend_the_remedy_names_the_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    # EGL is told to use a device that doesn't exist, OSMesa is no longer asked: as on a machine without either
    monkeypatch.setenv("MUJOCO_EGL_DEVICE_ID", "99")
    monkeypatch.setattr(graphics, "BACKENDS", ("egl",))
    with pytest.raises(Unavailable) as caught:
        graphics.choose_backend()
    assert "libegl1 libegl-mesa0 libosmesa6" in caught.value.remedy
    assert "MUJOCO_GL" not in os.environ


def test_a_black_picture_is_refused() -> None:
    with pytest.raises(Unavailable, match="empty picture") as caught:
        refuse_black(np.zeros((480, 640, 3), dtype=np.uint8), "egl")
    assert "libegl1 libegl-mesa0" in caught.value.remedy


def test_a_picture_on_another_thread_is_refused(stacking: RobosuiteAdapter) -> None:
    with ThreadPoolExecutor(1) as other, pytest.raises(WrongThread) as caught:
        other.submit(stacking.frame, "left").result()
    assert "the thread that built it" in caught.value.remedy
    assert stacking.frame("left").jpeg


def test_smooth_stills_have_softer_edges_than_the_live_picture() -> None:
    adapter = FACTORY("reaching", RobosuiteSettings(stills="smooth", jpeg_quality=95, live_jpeg_quality=95))
    still, live = (
        np.asarray(Image.open(io.BytesIO(frame.jpeg)), dtype=np.float64)
        for frame in (adapter.reset(0).frames["left"], adapter.frame("left"))
    )
    adapter.close()
    differs = np.abs(still - live).max(axis=2) > 30
    assert 0.001 < differs.mean() < 0.05, "the same picture but for its edges"
    # the horizon of floor and sky, say: steps from one pixel to the next are smaller
    assert np.abs(np.diff(still, axis=0)).mean() < np.abs(np.diff(live, axis=0)).mean()
