"""Missing or broken graphics are refused with a remedy, and the console stays quiet.

Each in a fresh process, because MuJoCo binds to its OpenGL once.
"""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from robot_adapters.base import Unavailable
from robot_adapters.robosuite import graphics
from robot_adapters.robosuite.cameras import refuse_black

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


def build(**environment: str) -> subprocess.CompletedProcess[str]:
    kept = {k: v for k, v in os.environ.items() if k not in {"MUJOCO_GL", "PYOPENGL_PLATFORM"}}
    return subprocess.run(
        [sys.executable, "-c", BUILD], env=kept | environment, capture_output=True, text=True, timeout=120, check=True
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
