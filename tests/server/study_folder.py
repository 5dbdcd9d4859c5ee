"""A study's folder as its processes leave it, without the minutes that training takes."""

from __future__ import annotations

from pathlib import Path

from agent.study.algorithms import CONTESTANTS, ORACLE
from agent.study.evaluations import Row, append_row
from agent.study.files import write_json
from agent.study.plan import SCENARIOS, Plan, Protocol, planned
from agent.study.records import EVALUATIONS, PROGRESS, Folder, Progress


def plan(seeds: int = 2) -> Plan:
    """SEED and MAPLE-aff on the first subgoal."""
    return planned(
        "paper-sim",
        "kinematic",
        [(SCENARIOS["first_subgoal"], [CONTESTANTS["seed"], CONTESTANTS["maple-aff"]])],
        seeds=range(10, 10 + seeds),
        budgets={"first_subgoal": 100},
        protocol=Protocol(evaluations=4, rollouts=10),
        oracle=ORACLE,
    )


def begun(path: Path) -> Folder:
    """Two seeds of SEED: one finished, one at its second evaluation; MAPLE-aff waits."""
    folder, chosen = Folder(path), plan()
    folder.begin(chosen, {"python": "3.11", "code": "0123456789abcdef"})
    evaluate(folder, "first_subgoal-seed-10", [0, 2, 4, 9, 10], "finished")
    evaluate(folder, "first_subgoal-seed-11", [0, 0], "running")
    return folder


def evaluate(folder: Folder, run: str, successes: list[int], state: str) -> None:
    """Append evaluations 25 decisions apart, each with so many successes of 10 rollouts and while training."""
    done = len(folder.rows(run))
    for index, count in enumerate(successes, start=done):
        row = Row(index, 25 * index, 900 * index, 20 * index, count, count, 1, 125 * index, 10, count, 2.0 * index)
        append_row(folder.run(run) / EVALUATIONS, row)
        told = Progress(
            state=state,
            decisions=row.decisions,
            low_level_steps=row.low_level_steps,
            successes=count,
            violations=1,
            evaluations=index,
            success_rate=row.success_rate,
            rate=12.5,
            seconds=row.seconds,
        )
        write_json(folder.run(run) / PROGRESS, told.model_dump(mode="json"))
