"""The emergency stop at the simulated Franka through the whole service: from the request until every joint stands.

Not part of `make bench`: `python -m tests.benchmarks franka_stops`.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from robot_adapters.base import Array
from robot_adapters.registry import task
from tests.benchmarks.result import Result
from tests.live import LiveService, wait_for
from tests.simulators.franka import PYTHON, SimulatedFranka
from tests.simulators.session import Session

BACKENDS = ("franka_rs", "franky")
STOPS = 50
"""Of each driver."""
BAR = 100.0
"""ms from the request until the arm stands, at the 99th percentile."""
BLOCKS = {"block_a": 0.02, "block_b": 0.025}
STILL = 0.15
"""s of the robot's clock without a motion, after which it stands for good."""


@dataclass
class Found:
    """What was measured on one driver, in ms. Standing: each joint below .01 rad/s over 10 ms."""

    standing: list[float] = field(default_factory=list)
    """By the robot's clock, which a busy machine slows."""
    standing_real: list[float] = field(default_factory=list)
    """By CLOCK_MONOTONIC."""
    driven_real: list[float] = field(default_factory=list)
    """Until nothing drives the arm any more, likewise."""


def run() -> Result:
    """Stops at moments of chance while a skill moves the arm, by POST .../halt; the value is the worse driver's p99."""
    if not PYTHON.exists():
        return Result("franka_stops", 0, "ms p99", ok=None, lines=("no simulated Franka: bash scripts/simulators.sh",))
    lines, worst = [], 0.0
    for backend in BACKENDS:
        found = _measure(backend)
        worst = max(worst, float(np.percentile(found.standing_real, 99)))
        lines += [
            f"{backend}: {len(found.standing)} stops by POST .../halt, load of the machine {os.getloadavg()[0]:.0f}",
            f"{backend}: until nothing drives it {_spread(np.array(found.driven_real))}",
            f"{backend}: until it stands {_spread(np.array(found.standing_real))}",
            f"{backend}: the same by the robot's clock {_spread(np.array(found.standing))}",
        ]
    return Result("franka_stops", worst, "ms p99", bar=BAR, ok=worst <= BAR, lines=tuple(lines))


def _spread(milliseconds: Array) -> str:
    p50, p99 = np.percentile(milliseconds, [50, 99])
    return f"p50 {p50:.0f} ms, p99 {p99:.0f} ms, worst {milliseconds.max():.0f} ms"


def _measure(backend: str) -> Found:
    stacking, chance, found = task("stacking"), np.random.default_rng(7), Found()
    with tempfile.TemporaryDirectory() as directory:
        service = LiveService(Path(directory) / "data")
        try:
            service.start()
            with SimulatedFranka(table=stacking.table_height, blocks=BLOCKS) as lab:
                layout = stacking.sample_layout(np.random.default_rng(1))
                lab.tell(paced=True, place={name: layout[name].tolist() for name in BLOCKS})
                session = Session(service, lab, backend)
                session.patch(mode="execute_approved")
                service.post(f"{session.path}/start")
                with session.attended():
                    while len(found.standing) < STOPS:
                        _stop(session, chance, found)
                        sys.stderr.write(f"\r{backend}: {len(found.standing)} stops   ")
        finally:
            service.stop()
    return found


def _stop(session: Session, chance: np.random.Generator, found: Found) -> None:
    """One stop somewhere on the way to a pick; arms that fingers hold would begin with a place."""
    lab, service, path = session.lab, session.service, session.path
    session.approve(session.proposal())
    session.moving()
    until = lab.truth()["clock"] + float(chance.uniform(0.1, 2.5))
    wait_for(lambda: lab.truth()["clock"] >= until, "the moment of the stop", 60)
    before, asked = lab.truth(), time.monotonic()
    service.post(f"{path}/halt")
    wait_for(lambda: (t := lab.truth())["mode"] != "kMove" and t["clock"] > t["moved_at"] + STILL, "standstill", 60)
    truth = lab.truth()
    if before["mode"] == "kMove":
        found.standing.append(1e3 * max(0.0, truth["moved_at"] - before["clock"]))
        found.standing_real.append(1e3 * max(0.0, truth["moved_on"] - asked))
        found.driven_real.append(1e3 * max(0.0, truth["driven_on"] - asked))
    wait_for(lambda: session.executions()[-1]["ended_at"], "the execution to end", 60)
    service.post(f"{path}/rearm")
    service.post(f"{path}/resume")
