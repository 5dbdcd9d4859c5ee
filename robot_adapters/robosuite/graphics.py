"""Finds off-screen OpenGL that works, before MuJoCo binds to one at import, and loads robosuite without its chatter."""

from __future__ import annotations

import importlib
import logging
import os
import subprocess
import sys

from robot_adapters.base import Unavailable

BACKENDS = ("egl", "osmesa")
"""Tried in this order: EGL uses a graphics card where there is one."""

PACKAGES = {"egl": "libegl1 libegl-mesa0", "osmesa": "libosmesa6"}
"""Debian packages of each backend."""

INSTALL = "install software graphics: apt-get install " + " ".join(PACKAGES.values())

_PROBE = "import mujoco; c = mujoco.GLContext(16, 16); c.make_current(); c.free()"
_PROBE_SECONDS = 60  # a loaded machine takes seconds to import MuJoCo; a driver that hangs must not hang us


def choose_backend() -> tuple[str, str]:
    """(backend, who chose it), with `MUJOCO_GL` set to it so that MuJoCo binds to it at import.

    `MUJOCO_GL` is respected where the user has set it. Otherwise each backend is tried in a child process, because a
    process that has bound to one that doesn't work can't change over.

    Raises:
        Unavailable: none works.
    """
    asked = os.environ.get("MUJOCO_GL", "").strip().lower()
    if asked:
        return asked, "MUJOCO_GL"
    for backend in BACKENDS:
        if _works(backend):
            os.environ["MUJOCO_GL"] = backend
            return backend, "first that works"
    raise Unavailable("no off-screen OpenGL works on this machine, so there would be no camera images", remedy=INSTALL)


def load_robosuite() -> None:
    """Import MuJoCo and robosuite, whose hints about optional parts stay out of the console.

    Raises:
        Unavailable: either isn't installed, or MuJoCo can't bind to the backend `MUJOCO_GL` names.
    """
    # robosuite warns at import about macros and robots that nobody here uses; its errors still come through
    logger = logging.getLogger("robosuite_logs")
    logger.addFilter(_errors_only)
    backend = os.environ.get("MUJOCO_GL")
    try:
        # MuJoCo first: robosuite overwrites MUJOCO_GL on import
        importlib.import_module("mujoco")
        importlib.import_module("robosuite")
    except ModuleNotFoundError as error:
        raise Unavailable(f"{error.name} isn't installed", remedy="pip install 'robosuite>=1.5.2,<1.6'") from error
    except (ImportError, RuntimeError, AttributeError, OSError) as error:
        raise Unavailable(f"MuJoCo can't load with MUJOCO_GL={backend}: {error}", remedy=remedy(backend)) from error
    finally:
        if backend is None:
            os.environ.pop("MUJOCO_GL", None)
        else:
            os.environ["MUJOCO_GL"] = backend


def remedy(backend: str | None) -> str:
    """What to do where `backend` doesn't draw."""
    known = PACKAGES.get(backend or "")
    install = f"apt-get install {known}" if known else INSTALL
    return f"{install}; or unset MUJOCO_GL to let a working backend be found"


def _errors_only(record: logging.LogRecord) -> bool:
    return record.levelno >= logging.ERROR


def _works(backend: str) -> bool:
    environment = {**os.environ, "MUJOCO_GL": backend}
    environment.pop("PYOPENGL_PLATFORM", None)
    try:
        probe = subprocess.run(
            [sys.executable, "-c", _PROBE], env=environment, capture_output=True, timeout=_PROBE_SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        return False
    return probe.returncode == 0
