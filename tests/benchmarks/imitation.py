"""Cloning demonstrated skill calls against SEED with as many labels, without physics.

`BENCH_SEEDS` is how many seeds, from 10 on (default 1; the table of docs/claims.md says how many it has).
"""

from __future__ import annotations

import statistics

import torch

from agent.study import imitation
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.composition import ROLLOUTS, kinematic
from tests.benchmarks.result import Result


def run() -> Result:
    """The value is SEED's mean success over all rows; the baseline that of cloning with key points."""
    seeds = clicks.seeds(1)
    torch.set_num_threads(1)
    outcomes = imitation.run(kinematic, seeds, rollouts=ROLLOUTS)
    return Result(
        "imitation",
        statistics.fmean(o.seed_feedback for o in outcomes),
        f"share of rollouts solved after {imitation.STEPS} labels ({len(seeds)} seeds, {ROLLOUTS} rollouts each)",
        baseline=statistics.fmean(o.grounded for o in outcomes),
        lines=(*imitation.table_of(outcomes), *map(str, outcomes)),
    )
