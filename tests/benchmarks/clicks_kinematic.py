"""Feedbacks that SEED's presets need until 90 of 100 deterministic rollouts succeed, without physics.

    python -m tests.benchmarks.clicks_kinematic --tasks stacking sweeping --teachers right wrong_10 --seeds 10

prints a line for each teacher and task as soon as it is measured: mean ± standard error of the mean, each seed (never:
not within the budget, which then counts), and of the policies that got there how many of 100 episodes they solve from
layouts of twice the training range, without new feedback. Part of `python -m tests.benchmarks` is `recommended`
with a teacher that is right, three seeds a task, and `paper_sim` on two tasks, looked at every fifty labels with fewer
rollouts; the figure is `recommended` on Stacking. `BENCH_FEEDBACK` sets the budget of `paper_sim` (default 500),
`BENCH_SEEDS` the seeds of `recommended`.
"""

from __future__ import annotations

import argparse
import os
import time

from robot_adapters import registry
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.result import Result

BARS = {"stacking": 25, "reaching": 60, "sweeping": 60, "collecting_toy": 80, "cooking_hotdog": 120}
TEACHERS = {
    "right": clicks.right,
    "wrong_10": clicks.wrong(0.1),
    "wrong_20": clicks.wrong(0.2),
    "one_in_three": clicks.seldom(1 / 3, None),
    "two_in_three_neutral": clicks.seldom(1 / 3, 0),
    "disagreeing": clicks.disagreeing(0.3),
}
BUDGET = {"right": 2, "wrong_10": 3, "wrong_20": 4, "one_in_three": 2, "two_in_three_neutral": 2, "disagreeing": 4}
"""Times the bar: answers after which a seed is given up."""


def run() -> Result:
    """A row for each task and preset; the value is the mean of `recommended` on Stacking."""
    paper = int(os.environ.get("BENCH_FEEDBACK", "500"))
    seeds = clicks.seeds(3)
    lines, means = [], {}
    for task, bar in BARS.items():
        start = time.perf_counter()
        told = _told(clicks.Setup(task, 2 * bar), seeds)
        means[task] = told.mean
        lines.append(f"recommended {task}: {told.text()}, bar {bar}; {time.perf_counter() - start:.0f} s")
    baseline = None
    for task in ("reaching", "stacking") if paper else ():
        setup = clicks.Setup(task, paper, preset="paper_sim", rollouts=20, every=50)
        told = _told(setup, range(clicks.FIRST_SEED, clicks.FIRST_SEED + 5))
        baseline = told.mean
        lines.append(f"paper_sim {task}: {told.text()}")
    return Result(
        "clicks_kinematic",
        means["stacking"],
        f"feedback to {clicks.REACHED:.0%} (recommended on Stacking, mean of {len(seeds)} seeds)",
        baseline=baseline,
        bar=BARS["stacking"],
        ok=all(means[task] <= bar for task, bar in BARS.items()),
        lines=tuple(lines),
    )


def _told(setup: clicks.Setup, seeds: range) -> clicks.Told:
    return clicks.summary([clicks.train(setup, seed).needed for seed in seeds], setup.budget)


def row(task: str, teacher: str, seeds: range) -> str:
    """One line of the table."""
    start = time.perf_counter()
    setup = clicks.Setup(task, BUDGET[teacher] * BARS[task], judge=TEACHERS[teacher])
    wide = clicks.robot(task, layout=doubled(task))
    outcomes = [clicks.train(setup, seed) for seed in seeds]
    there = [o for o in outcomes if o.needed is not None]
    solved = [clicks.successes(o.learner, o.task, wide, 100) for o in there]
    wide.close()
    told = clicks.summary([o.needed for o in outcomes], setup.budget)
    proposals = sum(o.proposals for o in outcomes) / len(outcomes)
    seconds = time.perf_counter() - start
    return (
        f"{teacher:22}{task:16}{told.text()}; {proposals:.0f} proposals; on twice the layout {solved} of 100; "
        f"{seconds:.0f} s"
    )


def doubled(task: str) -> dict[str, tuple[float, float]]:
    """The ranges of a task's start layout, each twice as wide around its middle."""
    found = registry.task(task).layout.model_dump()
    return {name: ((3 * low - high) / 2, (3 * high - low) / 2) for name, (low, high) in found.items()}


def main() -> None:
    """Parse the command line, and print each row as soon as it is measured."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", choices=clicks.TASKS, default=list(clicks.TASKS))
    parser.add_argument("--teachers", nargs="+", choices=list(TEACHERS), default=["right"])
    parser.add_argument("--seeds", type=int, default=10, help="how many, from 10 on")
    arguments = parser.parse_args()
    seeds = range(clicks.FIRST_SEED, clicks.FIRST_SEED + arguments.seeds)
    for teacher in arguments.teachers:
        for task in arguments.tasks:
            print(row(task, teacher, seeds), flush=True)


if __name__ == "__main__":
    main()
