"""Feedbacks that `recommended` needs without one of its ingredients at a time, without physics.

    python -m tests.benchmarks.ablation --tasks stacking reaching --rows nothing recall --seeds 5
    python -m tests.benchmarks.ablation --tasks stacking --ladder --every 1

prints one line for each task and row of `agent.ablation.ABLATIONS`, or `LADDER`: mean ± standard error of the mean, and
each seed (never: not within the budget, which then counts). `--every`: labels between two looks. Part of
`python -m tests.benchmarks` are Stacking and Sweeping.
"""

from __future__ import annotations

import argparse

from agent.ablation import ABLATIONS, LADDER, Ablation
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.result import Result

BUDGETS = {"stacking": 150, "reaching": 150, "sweeping": 150, "collecting_toy": 150, "cooking_hotdog": 250}
"""Answers after which a seed is given up."""


def row(task: str, changed: Ablation, seeds: range, every: int = clicks.EVERY) -> clicks.Told:
    """One task without one ingredient."""
    setup = clicks.Setup(task, BUDGETS[task], settings=changed.settings, every=every)
    return clicks.summary([clicks.train(setup, seed).needed for seed in seeds], setup.budget)


def run() -> Result:
    """Every row on Stacking and Sweeping, three seeds each; the value is what the worst row needs on Sweeping."""
    seeds = clicks.seeds(3)
    table = {
        task: {name: row(task, each, seeds) for name, each in ABLATIONS.items()} for task in ("stacking", "sweeping")
    }
    worst = max(told.mean for told in table["sweeping"].values())
    lines = tuple(line(task, ABLATIONS[name], told) for task, rows in table.items() for name, told in rows.items())
    reference = table["sweeping"]["nothing"].mean
    return Result("ablation", worst, "feedback on Sweeping, the worst row", baseline=reference, lines=lines)


def line(task: str, changed: Ablation, told: clicks.Told) -> str:
    """A row of the table."""
    return f"{task:16}{changed.title:28}{told.text()}"


def main() -> None:
    """Parse the command line, and print each row as soon as it is measured."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", choices=clicks.TASKS, default=list(clicks.TASKS))
    parser.add_argument("--rows", nargs="+", choices=list(dict.fromkeys([*ABLATIONS, *LADDER])))
    parser.add_argument("--ladder", action="store_true", help="from paper_sim up to recommended")
    parser.add_argument("--every", type=int, default=clicks.EVERY, help="labels between two looks")
    parser.add_argument("--seeds", type=int, default=5, help="how many, from 10 on")
    arguments = parser.parse_args()
    seeds = range(clicks.FIRST_SEED, clicks.FIRST_SEED + arguments.seeds)
    rows = LADDER if arguments.ladder else ABLATIONS
    for task in arguments.tasks:
        for name in arguments.rows or rows:
            print(line(task, rows[name], row(task, rows[name], seeds, arguments.every)), flush=True)


if __name__ == "__main__":
    main()
