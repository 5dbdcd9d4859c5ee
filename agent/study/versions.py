"""What a run was made with: packages, interpreter, machine, and a digest of the code itself."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterable
from importlib import metadata, resources

PACKAGES = ("seed-robot", "torch", "numpy", "scipy", "gymnasium", "mujoco", "robosuite")
CODE = ("agent", "robot_adapters")
"""The packages that decide what a run's numbers are."""


def versions() -> dict[str, str]:
    """Name -> version. `code` changes with every change of the code, installed or checked out."""
    found = {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found | {"code": code_digest(CODE)}


def code_digest(packages: Iterable[str]) -> str:
    """SHA-256 over the names and bytes of every Python file of the packages, its first 16 digits."""
    digest = hashlib.sha256()
    for package in packages:
        with resources.as_file(resources.files(package)) as root:
            for path in sorted(root.rglob("*.py")):
                digest.update(f"{package}/{path.relative_to(root).as_posix()}\0".encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
