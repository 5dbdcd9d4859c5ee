"""From asking the learner worker for a proposal to its answer, while it trains without pause: the real process.

Each preset learns Cooking-Hotdog, the task with the most to tell apart. The bar: p95 at most 15 ms. The baseline is the
same worker with nothing to train. What others on the machine take is told apart: the processor's time that the worker
used between question and answer is what the answer takes on a quiet machine.
"""

from __future__ import annotations

import asyncio
import statistics
import time
from typing import Any

import numpy as np

from agent.config import SEED, SeedSettings
from robot_adapters import registry
from robot_adapters.tasks.base import Task, state_bounds
from server.worker import Worker
from tests.benchmarks.result import Result

TASK = "cooking_hotdog"
LABELS = 300
ASKED = 150
BAR_MS = 15.0
STEPS_A_LABEL = 10_000
"""Think-time steps: the learner never runs out."""
PAUSE_S = (0.02, 0.06)
"""Between two questions, at random, so that they meet every moment of a gradient step."""

Percentiles = tuple[float, float]
"""p50 and p95."""


def run() -> Result:
    """Ask in every preset; the value is the worst p95 while training."""
    told = {preset: asyncio.run(_measure(preset)) for preset in ("paper_sim", "paper_real", "recommended")}
    lines = [
        f"{preset}: training p50 {trained[0]:.1f} ms, p95 {trained[1]:.1f} ms (of the processor {used[0]:.1f} and "
        f"{used[1]:.1f} ms); idle p50 {idle[0]:.1f} ms, p95 {idle[1]:.1f} ms; {steps} gradient steps meanwhile"
        for preset, (trained, used, idle, steps) in told.items()
    ]
    worst = max(trained[1] for trained, _, _, _ in told.values())
    baseline = max(idle[1] for _, _, idle, _ in told.values())
    unit = "ms from question to proposal while training, p95"
    return Result("proposal_latency", worst, unit, baseline, BAR_MS, ok=worst <= BAR_MS, lines=tuple(lines))


async def _measure(preset: str) -> tuple[Percentiles, Percentiles, Percentiles, int]:
    """Ms while training, those of the processor, ms while idle; and the gradient steps taken while asking."""
    trained, used, steps = await _latencies(preset, STEPS_A_LABEL)
    idle, _, _ = await _latencies(preset, 0)
    return _percentiles(trained), _percentiles(used), _percentiles(idle), steps


async def _latencies(preset: str, think_time: int) -> tuple[list[float], list[float], int]:
    task = registry.task(TASK)
    settings = SeedSettings(**{**SEED.presets[preset], "think_time_updates": think_time, "gradient_steps": 0})
    worker = await Worker.spawn("learner", "server.workers.learner")
    rng = np.random.default_rng(0)
    try:
        arguments = {"task": TASK, "algorithm": "seed", "settings": settings.model_dump(), "seed": 0}
        await worker.call("configure", deadline=120, lockstep=False, threads=1, device="cpu", **arguments)
        await worker.call("add", deadline=60, labels=_labels(task, rng))
        low, high = state_bounds(task.state_fields)
        took, used, versions = [], [], []
        clock = (~worker.pid << 3) | 2  # Linux: the processor's clock of another process, clock_getcpuclockid(3)
        for _ in range(ASKED):
            await asyncio.sleep(rng.uniform(*PAUSE_S))
            state = rng.uniform(low, high).tolist()
            start, before = time.perf_counter(), time.clock_gettime(clock)
            reply = await worker.call("propose", deadline=60, state=state, deterministic=False)
            took.append((time.perf_counter() - start) * 1000)
            used.append((time.clock_gettime(clock) - before) * 1000)
            versions.append(reply["policy_version"])
    finally:
        await worker.close()
    return took, used, versions[-1] - versions[0]


def _labels(task: Task, rng: np.random.Generator) -> list[dict[str, Any]]:
    """Random calls in random states, every third a good one."""
    low, high = state_bounds(task.state_fields)
    made = []
    for label_id in range(1, LABELS + 1):
        spec = task.skills[rng.integers(len(task.skills))]
        parameters = spec.denormalise(rng.uniform(-1, 1, len(spec.parameters))).tolist()
        state = rng.uniform(low, high).tolist()
        value = 1 if label_id % 3 == 0 else -1
        call = {"skill": spec.name, "parameters": parameters}
        made.append({"id": label_id, "state": state, **call, "value": value, "trainer": 1})
    return made


def _percentiles(values: list[float]) -> Percentiles:
    return statistics.median(values), statistics.quantiles(values, n=20, method="inclusive")[18]
