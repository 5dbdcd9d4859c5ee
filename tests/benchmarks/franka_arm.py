"""The simulated Franka on both drivers: Stacking in a row, how exactly blocks are placed, how quick a stop is.

Not part of `make bench`, which it would make an hour long: `make bench-arm`.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from dataclasses import dataclass, field

import numpy as np

from robot_adapters.base import Array, EndReason, SkillCall
from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.registry import task
from tests.benchmarks.result import Result
from tests.live import PLUGINS
from tests.simulators.franka import PYTHON, SimulatedFranka

BACKENDS = ("franka_rs", "franky")
EPISODES = 20
STOPS = 60
PLACE_BAR, STOP_BAR = 5.0, 100.0
"""mm from where a block was to be; ms from the request until nothing drives the arm, as `stop_latency` has it."""
BLOCKS = {"block_a": 0.02, "block_b": 0.025}
FAR = ("block_a", "block_b"), ([0.5, -0.3, 0.0], [0.6, -0.3, 0.0])
PATIENCE = 5.0
"""s of the dead-man timer: a machine that is busy elsewhere is no fault of the arm's."""


@dataclass
class Found:
    """What was measured on one driver."""

    stacked: int = 0
    off: list[float] = field(default_factory=list)
    """mm in the table's plane between a placed block and where it was to be."""
    stops: list[float] = field(default_factory=list)
    """ms of real time until nothing drives the arm any more."""
    stops_of_robot: list[float] = field(default_factory=list)
    """The same in ms of the robot's clock, which a busy machine slows."""
    standing: list[float] = field(default_factory=list)
    """ms of the robot's clock until every joint stands: the simulator's way to hold an arm, not a real brake's."""
    ran_on: list[float] = field(default_factory=list)
    """mm that the hand went on after the request."""
    went_wrong: list[str] = field(default_factory=list)


def run() -> Result:
    """All of it on both drivers; the value is how many of the three bars are reached."""
    if not PYTHON.exists():
        return Result("franka_arm", 0, "of 3 bars", ok=None, lines=("no simulated Franka: bash scripts/simulators.sh",))
    if str(PLUGINS) not in sys.path:
        sys.path.insert(0, str(PLUGINS))
    lines, found = [], []
    for backend in BACKENDS:
        began = os.getloadavg()[0]
        measured = _measure(backend)
        found.append(measured)
        off, real, robots, standing, ran_on = (
            np.array(v)
            for v in (measured.off, measured.stops, measured.stops_of_robot, measured.standing, measured.ran_on)
        )
        lines += [
            f"{backend}: {measured.stacked} of {EPISODES} episodes of Stacking",
            f"{backend}: placed {np.median(off):.1f} mm off at the median, {off.max():.1f} mm at worst, of {len(off)}",
            f"{backend}: {len(real)} stops; until nothing drives it {_spread(real)}, robot clock {_spread(robots)}",
            f"{backend}: until it stands {_spread(standing)}; the hand ran on {ran_on.max():.0f} mm at most",
            f"{backend}: load of the machine {began:.0f} at the start, {os.getloadavg()[0]:.0f} at the end",
            *(f"{backend}: {what}" for what in measured.went_wrong),
        ]
    reached = [
        all(f.stacked == EPISODES for f in found),
        all(max(f.off) <= PLACE_BAR for f in found),
        all(float(np.percentile(f.stops, 99)) <= STOP_BAR for f in found),
    ]
    return Result("franka_arm", sum(reached), "of 3 bars", bar=3, ok=all(reached), lines=tuple(lines))


def _spread(milliseconds: Array) -> str:
    p50, p99 = np.percentile(milliseconds, [50, 99])
    return f"p50 {p50:.0f} ms, p99 {p99:.0f} ms, worst {milliseconds.max():.0f} ms"


def _measure(backend: str) -> Found:
    stacking, found = task("stacking"), Found()
    with SimulatedFranka(table=stacking.table_height, blocks=BLOCKS) as lab:
        settings = FrankaSettings.model_validate(
            {
                "host": lab.host,
                "backend": backend,
                "realtime": False,
                "dead_man": PATIENCE,
                "eyes": "onlooker",
                "eyes_settings": {"host": lab.host},
            }
        )
        adapter = FrankaAdapter("stacking", settings)
        try:
            for seed in range(EPISODES):
                _episode(adapter, lab, seed, found)
                _progress(f"{backend}: episode {seed + 1}, {found.stacked} stacked")
            chance = np.random.default_rng(7)
            while len(found.stops) < STOPS:
                _stop(adapter, lab, chance, found)
                _progress(f"{backend}: {len(found.stops)} stops")
        finally:
            adapter.close()
    return found


def _episode(adapter: FrankaAdapter, lab: SimulatedFranka, seed: int, found: Found) -> None:
    """Blocks laid out by `seed`; the scripted algorithm proposes until they are stacked, or its horizon is over."""
    stacking = task("stacking")
    layout = stacking.sample_layout(np.random.default_rng(seed))
    lab.tell(heal=True, place={name: layout[name].tolist() for name in BLOCKS})
    adapter.reset()
    told = []
    for _ in range(stacking.horizon):
        call = stacking.true_call(adapter.observe().state)
        result = adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
        told.append(f"{call.skill} {result.end}")
        if call.skill == "place" and result.end is EndReason.ARRIVED:
            there = np.array(lab.truth()["blocks"]["block_a"])
            found.off.append(1e3 * float(np.linalg.norm(there[:2] - call.parameters[:2])))
        if result.success or result.violations:
            told += [v.detail for v in result.violations]
            break
    on_top = lab.truth()
    height = on_top["blocks"]["block_a"][2] - on_top["blocks"]["block_b"][2]
    if result.success and abs(height - sum(BLOCKS.values())) < 0.005:
        found.stacked += 1
    else:
        found.went_wrong.append(f"seed {seed}: {', '.join(told)}")


def _stop(adapter: FrankaAdapter, lab: SimulatedFranka, chance: np.random.Generator, found: Found) -> None:
    """Stop a motion at a moment of its own, and see until when the arm moved."""
    lab.tell(heal=True, paced=True, place=dict(zip(*FAR, strict=True)))
    adapter.reset()
    asked, stopped, steps = [], threading.Event(), 0
    at = int(chance.integers(4, 30))

    def count() -> None:
        nonlocal steps
        steps += 1
        if steps == at:
            delay = float(chance.uniform(0.0, 0.1))
            threading.Thread(target=ask, args=(delay,)).start()

    def ask(delay: float) -> None:
        time.sleep(delay)
        asked.append((lab.truth(), time.monotonic()))
        stopped.set()

    x, y = float(chance.uniform(0.45, 0.68)), float(chance.uniform(-0.12, 0.12))
    target = SkillCall("place", (x, y, task("stacking").table_height + 0.05))
    result = adapter.execute(target, should_stop=stopped.is_set, on_step=count)
    if result.end is not EndReason.STOPPED:
        return  # it had arrived
    time.sleep(1.0)
    truth = lab.truth()
    then, real = asked[0]
    found.stops.append(1e3 * max(0.0, truth["driven_on"] - real))
    found.stops_of_robot.append(1e3 * max(0.0, truth["driven_at"] - then["clock"]))
    found.standing.append(1e3 * max(0.0, truth["moved_at"] - then["clock"]))
    found.ran_on.append(1e3 * float(np.linalg.norm(np.subtract(truth["tip"], then["tip"]))))


def _progress(what: str) -> None:
    sys.stderr.write(f"\r{what}   ")
    sys.stderr.flush()
