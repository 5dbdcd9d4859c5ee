"""What came out of a study: a line a run for other programs (`results.csv`), and tables for people (`table.md`)."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from agent.study import paper
from agent.study.claims import claim_table
from agent.study.curves import value_of
from agent.study.evaluations import Row
from agent.study.oracle import oracle_of
from agent.study.plan import Axis, Contestant, Measure, Plan, Scenario
from agent.study.records import RESULTS, TABLE, Folder, Progress
from agent.study.statistics import CONFIDENCE, Summary, summary

UNIT = {Axis.LOW_LEVEL_STEPS: "low-level steps", Axis.DECISIONS: "decisions"}
"""A decision is a feedback where a trainer judges."""
REACHED = 0.9
"""Success rate of one evaluation that counts as learned, though with few rollouts luck has a part in it."""


@dataclass(frozen=True)
class Outcome:
    """A contestant in a scenario, over those of its seeds that have been evaluated. violations: over decision steps."""

    scenario: Scenario
    contestant: Contestant
    planned: int
    finished: int
    budget: int
    reached: float
    """Mean of where the seeds are on the scenario's axis."""
    success_rate: Summary
    successes: Summary
    violations: int
    decisions: int
    needed: tuple[int, ...]
    """Decisions before the first evaluation with `REACHED` success, of those seeds that got there."""

    @property
    def violation_ratio(self) -> float | None:
        """Safety violations over decision steps (paper, table 'Safety violation ratio'); None before any."""
        return self.violations / self.decisions if self.decisions else None


def outcomes(folder: Folder, plan: Plan) -> list[Outcome]:
    """What came out so far, by scenario and contestant; nothing of those that weren't begun."""
    found = []
    for scenario in plan.scenarios:
        for contestant in plan.contestants:
            runs = plan.of(scenario.name, contestant.name)
            measured = [rows for run in runs if (rows := folder.rows(run.id))]
            if not measured:
                continue
            last = [rows[-1] for rows in measured]
            needed = [next((row.decisions for row in rows if row.success_rate >= REACHED), None) for rows in measured]
            finished = sum(folder.progress(run.id, live=False).state == "finished" for run in runs)
            found.append(
                Outcome(
                    scenario,
                    contestant,
                    len(runs),
                    finished,
                    runs[0].budget,
                    float(np.mean([getattr(row, scenario.axis.value) for row in last])),
                    _summary(last, Measure.SUCCESS_RATE),
                    _summary(last, Measure.SUCCESSES),
                    sum(row.violations for row in last),
                    sum(row.decisions for row in last),
                    tuple(count for count in needed if count is not None),
                )
            )
    return found


def write_results(folder: Folder, plan: Plan) -> list[Outcome]:
    """Write both files; what they tell."""
    found = outcomes(folder, plan)
    _write_csv(folder, plan)
    table = _claim_table(folder, plan) if plan.claim else _tables(folder, plan, found)
    (folder.path / TABLE).write_text(table, "utf-8")
    return found


def budget_note(plan: Plan, scenario: Scenario) -> str:
    """In words: the budget, the paper's where it is another, seeds, adapter and evaluation."""
    budget = next(run.budget for run in plan.runs if run.scenario.name == scenario.name and run.shown)
    unit, seeds = UNIT[scenario.axis], f"{len(plan.seeds)} seed{'s' if len(plan.seeds) > 1 else ''}"
    if plan.claim:
        most = ", ".join(
            f"{run.contestant.title} {run.budget}"
            for run in plan.runs
            if run.scenario.name == scenario.name and run.seed == plan.seeds[0]
        )
        return (
            f"Each after its feedback, or demonstrated steps, of which it gets at most: {most}. {seeds}; "
            f"{plan.adapter} adapter; {plan.protocol.rollouts} rollouts."
        )
    differs = paper.curves(scenario.name) and budget != scenario.usual_budget
    papers = f" (the paper's figure goes to {scenario.usual_budget:,})" if differs else ""
    protocol = plan.protocol
    return (
        f"Budget {budget:,} {unit} a run{papers}; {seeds}; "
        f"{plan.adapter} adapter; {protocol.evaluations} evaluations of {protocol.rollouts} rollouts."
    )


def about(folder: Folder, plan: Plan, scenario: Scenario) -> str:
    """`budget_note`, and who judges low-level actions if anybody does."""
    oracle = oracle_of(folder, plan, scenario)
    return budget_note(plan, scenario) + (f" {oracle.told()}" if oracle else "")


def _summary(rows: Sequence[Row], measure: Measure) -> Summary:
    return summary(np.array([value_of(row, measure) for row in rows]))


def _write_csv(folder: Folder, plan: Plan) -> None:
    with (folder.path / RESULTS).open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        counted = ("decisions", "low_level_steps", "executions", "episodes", "successes", "violations")
        writer.writerow(
            ["run", "scenario", "algorithm", "seed", "budget", "axis", "state", *counted, "success_rate", "seconds"]
        )
        for run in plan.runs:
            progress: Progress = folder.progress(run.id, live=False)
            names = [run.id, run.scenario.name, run.contestant.name, run.seed, run.budget, run.scenario.axis.value]
            counts = [getattr(progress, name) for name in counted]
            writer.writerow([*names, progress.state, *counts, progress.success_rate, progress.seconds])


def _tables(folder: Folder, plan: Plan, found: Sequence[Outcome]) -> str:
    """Markdown: for each scenario what each contestant came to, then the safety violations."""
    lines = [f"# {plan.name}", ""]
    for scenario in plan.scenarios:
        rows = [each for each in found if each.scenario.name == scenario.name]
        lines += [f"## {scenario.title}", "", about(folder, plan, scenario), ""]
        if not rows:
            lines += ["Nothing was measured yet.", ""]
            continue
        interval = f"interquartile mean [{CONFIDENCE:.0%} bootstrap]"
        lines += [
            f"| algorithm | seeds | {UNIT[scenario.axis]} | success rate, mean ± SEM | {interval} | successes in "
            f"training, mean ± SEM | {interval} | decisions to {REACHED:.0%} | the paper's last value |",
            "|---|---|---|---|---|---|---|---|---|",
        ]
        lines += [_line(each) for each in rows] + [""]
    lines += [
        "## Safety violations over decision steps",
        "",
        "| task | algorithm | here | paper |",
        "|---|---|---|---|",
    ]
    for each in found:
        theirs = paper.violation_ratios(each.scenario.name).get(each.contestant.name)
        here = f"{each.violation_ratio:.2%}" if each.violation_ratio is not None else "-"
        of = f"{each.violations} of {each.decisions:,}"
        told = "-" if theirs is None else f"{theirs:.2%}"
        lines.append(f"| {each.scenario.title} | {each.contestant.title} | {here} ({of}) | {told} |")
    source = f"The paper's: {paper.source()}."
    return "\n".join([*lines, "", "A decision is a proposed skill, or a low-level action.", "", source]) + "\n"


def _claim_table(folder: Folder, plan: Plan) -> str:
    """Markdown: the claim's own."""
    seeds = f"{len(plan.seeds)} seeds from {plan.seeds[0]}"
    about_it = (
        f"{seeds}, {plan.adapter} adapter, {plan.protocol.rollouts} rollouts each, of the rows that are finished."
    )
    rows = claim_table(folder, plan) or ["Nothing was measured yet."]
    return "\n".join([f"# {plan.name}", "", about_it, "", *rows, ""])


def _line(each: Outcome) -> str:
    seeds = str(each.success_rate.n) if each.finished == each.planned else f"{each.finished} of {each.planned} finished"
    known = paper.curves(each.scenario.name)
    last = [f"{curve.y[-1]:g}" for curve in known if curve.algorithm == each.contestant.name]
    cells = [
        each.contestant.title,
        seeds,
        f"{each.reached:,.0f}",
        *_told(each.success_rate, "{:.2f}"),
        *_told(each.successes, "{:.1f}"),
        _needed(each),
        ", ".join(last) or "-",
    ]
    return f"| {' | '.join(cells)} |"


def _needed(each: Outcome) -> str:
    """Mean over the seeds that got there, and how many did not."""
    if not each.needed:
        return "not reached"
    missing = each.success_rate.n - len(each.needed)
    return f"{np.mean(each.needed):.0f}" + (f", {missing} of {each.success_rate.n} seeds not" if missing else "")


def _told(of: Summary, form: str) -> tuple[str, str]:
    """Mean ± standard error, and interquartile mean with its interval."""
    mean = form.format(of.mean) + ("" if of.sem is None else f" ± {form.format(of.sem)}")
    ends = "" if of.low is None or of.high is None else f" [{form.format(of.low)}, {form.format(of.high)}]"
    return mean, form.format(of.iqm) + ends
