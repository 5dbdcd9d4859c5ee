"""Runs what the Dockerfile says, without a Docker engine: its own commands, in a clean directory.

    python scripts/check_dockerfile.py [DIRECTORY]

COPY and RUN are carried out with the image's absolute paths moved below the directory; then CMD is started and
HEALTHCHECK has to succeed. What only an image can do (apt-get, useradd, USER) is shown and left out, and so is a
layer's cache. It takes as long as an installation.
"""

from __future__ import annotations

import fnmatch
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOVED = ("/opt/seed", "/src", "/data", "/home/seed")
"""Absolute paths of the image that are moved below the directory."""

ONLY_IN_AN_IMAGE = re.compile(r"\b(apt-get|useradd)\b")
HEALTHY_WITHIN = 90.0
"""Seconds."""


@dataclass
class Stage:
    """One FROM with its instructions, in order: (name, rest of the line)."""

    instructions: list[tuple[str, str]] = field(default_factory=list)

    def value(self, name: str) -> str | None:
        """What the last instruction of that name says."""
        return next((text for each, text in reversed(self.instructions) if each == name), None)


@dataclass
class Dockerfile:
    """A parsed Dockerfile: shell and exec forms, continued lines, comments."""

    stages: list[Stage]

    @classmethod
    def read(cls, path: Path) -> Dockerfile:
        """Parse it."""
        stages: list[Stage] = []
        text = re.sub(r"^\s*#.*\n", "", path.read_text("utf-8"), flags=re.MULTILINE)
        for line in re.sub(r"\\\n", " ", text).splitlines():
            name, _, rest = line.strip().partition(" ")
            if name == "FROM":
                stages.append(Stage())
            elif name:
                stages[-1].instructions.append((name, " ".join(rest.split())))
        return cls(stages)


def sources() -> list[str]:
    """What a build would be sent: tracked files that .dockerignore lets through."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    rules = (ROOT / ".dockerignore").read_text("utf-8").split()
    let_in = {rule[1:] for rule in rules if rule.startswith("!")}
    kept_out = [rule for rule in rules if rule != "*" and not rule.startswith("!")]
    return [
        name
        for name in listed
        if name.split("/")[0] in let_in and not any(fnmatch.fnmatch(name, rule + "*") for rule in kept_out)
    ]


class CleanRoom:
    """The directory that stands for the image's file system."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.work = folder
        self.environment = {k: v for k, v in os.environ.items() if k not in {"VIRTUAL_ENV", "PYTHONPATH"}}

    def moved(self, text: str) -> str:
        """`text` with the image's absolute paths moved below the directory."""
        return re.sub(r"(?<![\w./])(" + "|".join(MOVED) + r")(?=[/\s:]|$)", lambda m: f"{self.folder}{m[1]}", text)

    def carry_out(self, name: str, text: str) -> None:
        """One instruction.

        Raises:
            CalledProcessError: a RUN failed.
        """
        print(f"==> {name} {text}", flush=True)
        if name == "WORKDIR":
            self.work = Path(self.moved(text))
            self.work.mkdir(parents=True, exist_ok=True)
        elif name == "ENV":
            for pair in shlex.split(text):
                key, _, value = pair.partition("=")
                self.environment[key] = self.moved(value).replace("$PATH", self.environment["PATH"])
        elif name == "COPY" and not text.startswith("--from"):
            *what, where = text.split()
            self._copy(what, where)
        elif name == "RUN" and ONLY_IN_AN_IMAGE.search(text):
            print("    left out: only an image can do that", flush=True)
        elif name == "RUN":
            subprocess.run(["bash", "-c", self.moved(text)], cwd=self.work, env=self.environment, check=True)

    def _copy(self, what: list[str], where: str) -> None:
        names = sources() if what == ["."] else what
        for name in names:
            inside = name if what == ["."] else Path(name).name
            target = self.work / where / inside
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)

    def serve(self, stage: Stage) -> None:
        """Start CMD and wait for HEALTHCHECK to succeed; the port is a free one, on loopback.

        Raises:
            SystemExit: it ended, or did not become healthy.
        """
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = str(probe.getsockname()[1])
        data = self.folder / "data"
        data.mkdir(exist_ok=True)
        here = self.environment | {"SEED_PORT": port, "SEED_HOST": "127.0.0.1", "SEED_DATA_DIR": str(data)}
        health = (stage.value("HEALTHCHECK") or "").partition("CMD ")[2].replace(":8000", f":{port}")
        process = subprocess.Popen(_exec(stage.value("CMD") or "[]"), cwd=self.work, env=here, start_new_session=True)
        try:
            deadline = time.monotonic() + HEALTHY_WITHIN
            while subprocess.run(_exec(health), env=here, capture_output=True, check=False).returncode != 0:
                if process.poll() is not None or time.monotonic() > deadline:
                    raise SystemExit("the service did not become healthy")
                time.sleep(0.5)
            print("==> HEALTHCHECK succeeded", flush=True)
        finally:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait(timeout=30)


def _exec(text: str) -> list[str]:
    """The arguments of an exec form."""
    return re.findall(r'"([^"]*)"', text)


def main() -> None:
    """Everything, in the order of the file."""
    with tempfile.TemporaryDirectory(prefix="seed-image-") as temporary:
        room = CleanRoom(Path(sys.argv[1] if len(sys.argv) > 1 else temporary).resolve())
        dockerfile = Dockerfile.read(ROOT / "Dockerfile")
        for stage in dockerfile.stages:
            for name, text in stage.instructions:
                room.carry_out(name, text)
        room.serve(dockerfile.stages[-1])
    print("The Dockerfile's steps work.")


if __name__ == "__main__":
    main()
