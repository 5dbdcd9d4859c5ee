"""The real service as a process of its own, to be talked to, killed and started again; and waiting for conditions."""

from __future__ import annotations

import contextlib
import itertools
import os
import re
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import httpx

T = TypeVar("T")

ROOT = Path(__file__).resolve().parent.parent
PLUGINS = ROOT / "tests" / "plugins"
START_TIMEOUT = 60.0
"""Seconds; a loaded two-core machine imports slowly."""


def wait_for(condition: Callable[[], T | None], what: str, timeout: float = 30.0) -> T:
    """The first true value of `condition`.

    Raises:
        AssertionError: it stayed false for `timeout` seconds.
    """
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"waited {timeout:.0f} s for {what}")


def _own_ports() -> Iterator[int]:
    """Of this test process: below those that the kernel gives to connections, and apart from other processes'."""
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    return itertools.count(20_000 + 3_000 * (worker % 4) + os.getpid() % 2_000)


_ports = _own_ports()


def free_port() -> int:
    """A port that nobody listens on now, nor is given by chance to a connection until it is listened on."""
    while True:
        port = next(_ports)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def children(pid: int) -> list[int]:
    """Ids of a process's children, whichever of its threads has made them."""
    told = (task.read_text("ascii").split() for task in Path(f"/proc/{pid}/task").glob("*/children"))
    return [int(child) for some in told for child in some]


def gone(pid: int) -> bool:
    """Whether a process has ended (a zombie has)."""
    try:
        return "\nState:\tZ" in Path(f"/proc/{pid}/status").read_text("utf-8")
    except FileNotFoundError:
        return True


class LiveService:
    """`seed serve` on a port and data directory that stay the same when it is started again."""

    def __init__(self, data_dir: Path, **settings: str) -> None:
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.data_dir = data_dir
        self.http = httpx.Client(base_url=self.url, timeout=30.0)
        self._log = data_dir.parent / f"{data_dir.name}.log"
        self._process: subprocess.Popen[bytes] | None = None
        self._environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(filter(None, [str(PLUGINS), os.environ.get("PYTHONPATH")])),
            "SEED_HOST": "127.0.0.1",
            "SEED_PORT": str(self.port),
            "SEED_DATA_DIR": str(data_dir),
            "SEED_CREATE_FIRST_EXPERIMENT": "false",
            # Workers share two cores with a browser here.
            "OMP_NUM_THREADS": "1",
            # Nor is a service that the browser keeps waiting for a second one that has left its robot alone.
            "SEED_OPERATOR_SILENCE": "10",
            **settings,
        }

    @property
    def pid(self) -> int:
        """Of the server's process, which leads a session of its own."""
        assert self._process is not None
        return self._process.pid

    @property
    def writer(self) -> int:
        """Of the process that writes to the database: the one child that was forked."""
        own = Path(f"/proc/{self.pid}/cmdline").read_bytes()
        (found,) = (child for child in children(self.pid) if Path(f"/proc/{child}/cmdline").read_bytes() == own)
        return found

    def start(self) -> None:
        """Start it and wait until it is ready."""
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-c", "from server.cli import app; app()", "serve"],
                cwd=self.data_dir.parent,
                env=self._environment,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        wait_for(self._ready, "the service to start", START_TIMEOUT)

    def ensure(self) -> None:
        """Start it if it doesn't run: the test before may have failed after killing it."""
        if self._process is None or self._process.poll() is not None:
            self.start()

    def _ready(self) -> bool:
        assert self._process is not None
        if self._process.poll() is not None:
            raise AssertionError(f"the service ended with {self._process.returncode}:\n{self.log()}")
        with contextlib.suppress(httpx.TransportError):
            return self.http.get("/ready").status_code == httpx.codes.OK
        return False

    def kill(self) -> None:
        """SIGKILL the server process alone, as a power cut would; its workers have to notice by themselves."""
        assert self._process is not None
        self._process.send_signal(signal.SIGKILL)
        self._process.wait()

    def stop(self) -> int:
        """Ask it to end; its exit code. Whatever is left of it afterwards is killed."""
        assert self._process is not None
        self._process.terminate()
        try:
            return self._process.wait(timeout=30)
        finally:
            self.sweep()

    def sweep(self) -> None:
        """Kill whatever is left in the service's session."""
        if self._process is not None:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()

    def log(self) -> str:
        """What it printed so far."""
        return self._log.read_text("utf-8", "replace") if self._log.exists() else ""

    def post(self, path: str, body: dict[str, Any] | None = None) -> dict[str, Any]:
        """POST below /api/v1 and expect success."""
        answer = self.http.post(f"/api/v1{path}", json=body)
        assert answer.is_success, f"POST {path}: {answer.status_code} {answer.text}"
        return dict(answer.json())

    def sign_in(self) -> str:
        """With SEED_LOGIN: come in by what the first start printed; the token goes with every request from now on."""
        (printed,) = re.findall(r"/join#(\S+)", self.log())
        token = str(self.post("/sign-in", {"token": printed, "bearer": True})["token"])
        self.http.headers["Authorization"] = f"Bearer {token}"
        return token

    def get(self, path: str) -> dict[str, Any]:
        """GET below /api/v1 and expect success."""
        answer = self.http.get(f"/api/v1{path}")
        assert answer.is_success, f"GET {path}: {answer.status_code} {answer.text}"
        return dict(answer.json())

    def experiment(self, **fields: Any) -> int:
        """Create a Stacking experiment of the scripted algorithm; its id."""
        body = {"name": "Stack two blocks", "task": "stacking", "adapter": "robosuite", "algorithm": "scripted"}
        return int(self.post("/experiments", body | fields)["id"])

    def rows(self, query: str, *values: object) -> list[sqlite3.Row]:
        """Rows of the SQLite database, read beside the running service."""
        (database,) = self.data_dir.glob("*.db") or self.data_dir.glob("*.sqlite*")
        with contextlib.closing(sqlite3.connect(f"file:{database}?mode=ro", uri=True)) as connection:
            connection.row_factory = sqlite3.Row
            return connection.execute(query, values).fetchall()


@contextlib.contextmanager
def running_service(folder: Path, **settings: str) -> Iterator[LiveService]:
    """A service that runs, with its data in this folder; whatever is left of it at the end is killed."""
    live = LiveService(folder / "data", **settings)
    try:
        live.start()
        yield live
    finally:
        live.sweep()
        live.http.close()
