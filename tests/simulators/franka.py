"""Starts a simulated Franka for a test, tells it what is to go wrong, and knows the truth."""

from __future__ import annotations

import itertools
import json
import os
import signal
import socket
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any

ROOT = Path(__file__).resolve().parent.parent.parent
PYTHON = ROOT / ".simulators" / "franky-sim" / "bin" / "python"
CONTROL_PORT = 1339
_hosts = itertools.count(1)


def free_host() -> str:
    """A loopback address of this test process's own: libfranka's ports are fixed, so simulators differ in that."""
    process = os.getpid()
    return f"127.{process >> 8 & 0x7F}.{process & 0xFF}.{next(_hosts)}"


class SimulatedFranka:
    """A running simulator (`simulated_franka.py`)."""

    def __init__(
        self,
        *,
        table: float = -0.112,
        blocks: dict[str, float] | None = None,
        gripper: bool = True,
        lock_step: bool = True,
    ) -> None:
        """Start it, and wait until it listens."""
        self.host = free_host()
        arguments = ["--host", self.host, "--table", str(table), "--blocks", json.dumps(blocks or {})]
        self._process = subprocess.Popen(
            [
                str(PYTHON),
                "-m",
                "tests.simulators.simulated_franka",
                *arguments,
                *([] if gripper else ["--no-gripper"]),
            ],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout is not None
        if self._process.stdout.readline().strip() != "ready":
            raise RuntimeError("the simulated Franka didn't start; `make setup-dev` makes its virtual environment")
        self._line = connect(self.host)
        if lock_step:
            self.tell(lock_step=True)

    @property
    def pid(self) -> int:
        """Of the simulator's process."""
        return self._process.pid

    def tell(self, **what: Any) -> dict[str, Any]:
        """Have something happen; the truth after it."""
        return ask(self._line, **what)

    def truth(self) -> dict[str, Any]:
        """Everything that is so now."""
        return self.tell(look=True)

    def close(self) -> None:
        """End it; what hangs is killed."""
        self._line.close()
        self._process.send_signal(signal.SIGTERM)
        try:
            self._process.wait(5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def __enter__(self) -> SimulatedFranka:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def connect(host: str) -> socket.socket:
    """A line to a simulator's control port."""
    return socket.create_connection((host, CONTROL_PORT), timeout=20)


def ask(line: socket.socket, **what: Any) -> dict[str, Any]:
    """Tell it something; its answer."""
    line.sendall(json.dumps(what or {"look": True}).encode() + b"\n")
    answer = b""
    while not answer.endswith(b"\n"):
        part = line.recv(65536)
        if not part:
            raise ConnectionError("the simulated Franka is gone")
        answer += part
    told: dict[str, Any] = json.loads(answer)
    return told
