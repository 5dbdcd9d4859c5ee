"""Reward composition, zero-shot, without physics: what critics of subgoals do in scenes and orders never trained.

`BENCH_SEEDS` is how many seeds, from 10 on (default 1; the table of docs/claims.md says how many it has).
"""

from __future__ import annotations

import statistics

import torch

from agent.study import composition
from robot_adapters.base import Adapter
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.tasks.base import Task
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.result import Result

ROLLOUTS = 50


def kinematic(task: Task) -> Adapter:
    """A table without physics or pictures."""
    return KinematicAdapter(task, KinematicSettings.model_validate({"draw": False}))


def run() -> Result:
    """The value is the mean success of the composed critics over all scenes; the baseline that of undivided ones."""
    seeds = clicks.seeds(1)
    torch.set_num_threads(1)
    outcomes = composition.run(kinematic, seeds, rollouts=ROLLOUTS)
    return Result(
        "composition",
        statistics.fmean(o.composed for o in outcomes),
        f"share of rollouts solved with no feedback in the new scene ({len(seeds)} seeds, {ROLLOUTS} rollouts each)",
        baseline=statistics.fmean(o.rebound for o in outcomes),
        lines=(*composition.table_of(outcomes), *map(str, outcomes)),
    )
