"""Builds the web page into server/static whenever the package is built or installed (wheel and editable alike).

A machine without Node.js gets it as a build requirement for just that time. `SEED_SKIP_WEB=1` leaves the page alone.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).resolve().parent
WEB = ROOT / "web"
STATIC = ROOT / "server" / "static"
STAMP = STATIC / ".sources"
"""Digest of the sources that the built page was made from."""

NOT_SOURCES = {"node_modules", "test", "dist", "coverage"}


class WebPage(BuildHookInterface):  # type: ignore[type-arg]  # hatchling's base is generic over its builder's config
    """The build hook that hatchling calls."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """Node.js as a Python package, where the system has none and the page has to be built."""
        node = _node()
        return [node.REQUIREMENT] if _wanted() and node.system() is None else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's signature
        """Build the page, unless it was built from exactly these sources.

        Raises:
            RuntimeError: npm failed, or there is no page and no source of one.
        """
        if self.target_name == "wheel" and _wanted():
            _build()
        if self.target_name == "wheel" and version != "editable" and not (STATIC / "index.html").is_file():
            raise RuntimeError("the wheel would hold no web page: unset SEED_SKIP_WEB and build it again")


def _node() -> Any:
    """scripts/node.py as a module; a build runs with only hatchling importable, so it is loaded by its path."""
    spec = importlib.util.spec_from_file_location("seed_node", ROOT / "scripts" / "node.py")
    if spec is None or spec.loader is None:
        raise RuntimeError("scripts/node.py is missing from the source tree")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up there
    spec.loader.exec_module(module)
    return module


def _wanted() -> bool:
    """Whether the page is out of date and may be built."""
    return os.environ.get("SEED_SKIP_WEB") != "1" and WEB.is_dir() and not _current()


def _current() -> bool:
    """Whether server/static holds the page of exactly these sources."""
    return (STATIC / "index.html").is_file() and STAMP.is_file() and STAMP.read_text("utf-8") == _digest()


def _digest() -> str:
    """SHA-256 over names and contents of the page's sources; tests are no sources."""
    total = hashlib.sha256()
    for path in sorted(p for p in WEB.rglob("*") if p.is_file()):
        inside = path.relative_to(WEB)
        if NOT_SOURCES.intersection(inside.parts) or ".test." in path.name:
            continue
        total.update(f"{inside.as_posix()}\0{path.stat().st_size}\0".encode())
        total.update(path.read_bytes())
    return total.hexdigest()


def _build() -> None:
    """Install what the page needs, if it isn't there, and build it."""
    node = _node().find()
    lock, installed = WEB / "package-lock.json", WEB / "node_modules" / ".package-lock.json"
    try:
        if not installed.is_file() or installed.stat().st_mtime < lock.stat().st_mtime:
            print("==> Fetching what the web page is built with", flush=True)
            # whoever develops the page keeps what it is checked with
            developed = (WEB / "node_modules" / ".installed-dev").is_file()
            node.run("ci", *(() if developed else ("--omit=dev",)))
        print("==> Building the web page", flush=True)
        node.run("run", "build")
    except subprocess.CalledProcessError as error:
        raise RuntimeError(f"the web page could not be built: npm ended with {error.returncode}, see above") from error
    STAMP.write_text(_digest(), "utf-8")
