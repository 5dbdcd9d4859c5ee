"""A driver that is frozen for 300 ms, at a second simulator, which is strict about commands that don't come."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.live import wait_for
from tests.simulators.franka import ROOT, free_host

pytestmark = [pytest.mark.simulated_arm, pytest.mark.long]

PYTHON = ROOT / ".simulators" / "franka-sim" / "bin" / "python"


@pytest.fixture
def host() -> Iterator[str]:
    """Where franka-sim listens."""
    (assets,) = (ROOT / ".simulators" / "franky-sim" / "lib").glob("python3*/site-packages/franky_sim/assets")
    address = free_host()
    command = [str(PYTHON), "-m", "tests.simulators.strict_franka", "--host", address, "--assets", str(assets)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as strict:
        assert strict.stdout is not None
        assert strict.stdout.readline().strip() == "ready"
        try:
            yield address
        finally:
            strict.send_signal(signal.SIGTERM)
            strict.wait(20)


@pytest.mark.parametrize("backend", ["franka_rs", "franky"])
def test_a_driver_that_was_frozen_finds_the_arm_stopped_and_can_recover_it(
    backend: str, host: str, tmp_path: Path
) -> None:
    said = tmp_path / "said"
    command = [sys.executable, "-m", "tests.simulators.driver", host, backend]
    with said.open("w") as told, subprocess.Popen(command, cwd=ROOT, stdout=told) as driver:
        try:
            # a machine that is busy elsewhere loses as many commands by itself, at any moment
            wait_for(lambda: said.read_text() or driver.poll() is not None, "the arm to move", 60)
            os.kill(driver.pid, signal.SIGSTOP)
            frozen = time.monotonic()
            wait_for(lambda: time.monotonic() - frozen > 0.3, "300 ms")
            os.kill(driver.pid, signal.SIGCONT)
            assert driver.wait(60) == 0
        finally:
            driver.kill()
    found = json.loads(said.read_text().splitlines()[-1])
    assert (found["mode"], found["after"]) == ("reflex", "idle")
    assert "reflex" in found["said"]
