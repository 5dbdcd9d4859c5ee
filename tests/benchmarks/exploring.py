"""Feedback to 90 % success with `explore` at `uncertainty` beside the default `value`, without physics.

`recommended`, on the seeds of `clicks_kinematic`, with the two critics of the preset and with five; each seed is run in
all four ways, so that luck of the seed is the same. A seed that did not get there within twice the task's bar counts
as that much. The value is the mean over tasks of each task's feedback by uncertainty over its feedback by value, with
two critics: below 1, asking for what is uncertain saves clicks. `BENCH_SEEDS` (default 10) and `BENCH_TASKS`
(default all five, by commas) say how much is run; all of it takes about ten minutes.
"""

from __future__ import annotations

import os
import statistics
from collections.abc import Sequence

import torch

from tests.benchmarks import _clicks as clicks
from tests.benchmarks._clicks import Setup, train
from tests.benchmarks.clicks_kinematic import BARS
from tests.benchmarks.result import Result

CRITICS = (2, 5)
WAYS = ("value", "uncertainty")


def run() -> Result:
    """A line for each task, way and number of critics."""
    seeds = clicks.seeds(10)
    tasks = os.environ.get("BENCH_TASKS", ",".join(BARS)).split(",")
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        needed = {
            (task, critics, way): [train(_setup(task, critics, way), seed).needed for seed in seeds]
            for task in tasks
            for critics in CRITICS
            for way in WAYS
        }
    finally:
        torch.set_num_threads(threads)
    means = {key: statistics.fmean(_counted(key[0], found)) for key, found in needed.items()}
    return Result(
        "exploring",
        statistics.fmean(means[task, 2, "uncertainty"] / means[task, 2, "value"] for task in tasks),
        f"feedback by uncertainty over feedback by value (mean over {len(tasks)} tasks, {len(seeds)} seeds)",
        baseline=1.0,
        lines=tuple(_line(*key, found) for key, found in needed.items()),
    )


def _setup(task: str, critics: int, way: str) -> Setup:
    return Setup(task, 2 * BARS[task], settings={"critics": critics, "explore": way})


def _counted(task: str, needed: Sequence[int | None]) -> list[int]:
    return [2 * BARS[task] if n is None else n for n in needed]


def _line(task: str, critics: int, way: str, needed: Sequence[int | None]) -> str:
    counted = _counted(task, needed)
    sem = statistics.stdev(counted) / len(counted) ** 0.5 if len(counted) > 1 else 0.0
    least = "at least " if None in needed else ""
    each = ", ".join(f"not within {2 * BARS[task]}" if n is None else str(n) for n in needed)
    return f"{task}, {critics} critics, {way}: {least}{statistics.fmean(counted):.0f} ± {sem:.0f} ({each})"
