"""Feedbacks that `recommended` needs until nine of ten deterministic rollouts succeed, with robosuite's physics.

    python -m tests.benchmarks.clicks_robosuite --tasks stacking reaching --seeds 5 --rollouts 100

prints a line for each task: mean ± standard error of the mean, and each seed (never: not within twice the bar of
`clicks_kinematic`, which then counts). Labels, starts and evaluation are those of `clicks_kinematic`; only the robot is
another. As part of `python -m tests.benchmarks` it takes Stacking, `BENCH_SEEDS` seeds (default 2) and 20 rollouts.
"""

from __future__ import annotations

import argparse

from tests.benchmarks import _clicks as clicks
from tests.benchmarks.clicks_kinematic import BARS
from tests.benchmarks.result import Result

STACKING_BAR = 40


def row(task: str, seeds: range, rollouts: int) -> clicks.Told:
    """One task."""
    setup = clicks.Setup(task, 2 * BARS[task], adapter="robosuite", rollouts=rollouts)
    return clicks.summary([clicks.train(setup, seed).needed for seed in seeds], setup.budget)


def run() -> Result:
    """Stacking."""
    seeds, rollouts = clicks.seeds(2), 20
    told = row("stacking", seeds, rollouts)
    return Result(
        "clicks_robosuite",
        told.mean,
        f"feedback to {clicks.REACHED:.0%} of {rollouts} rollouts (Stacking, mean of {len(seeds)} seeds)",
        bar=STACKING_BAR,
        ok=told.mean <= STACKING_BAR,
        lines=(told.text(),),
    )


def main() -> None:
    """Parse the command line, and print each task as soon as it is measured."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", choices=clicks.TASKS, default=["stacking"])
    parser.add_argument("--seeds", type=int, default=5, help="how many, from 10 on")
    parser.add_argument("--rollouts", type=int, default=100, help="evaluation episodes")
    arguments = parser.parse_args()
    seeds = range(clicks.FIRST_SEED, clicks.FIRST_SEED + arguments.seeds)
    for task in arguments.tasks:
        print(f"{task:16}{row(task, seeds, arguments.rollouts).text()}", flush=True)


if __name__ == "__main__":
    main()
