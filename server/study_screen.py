"""A study's live table on a terminal: how far, how fast, how long still, how well."""

from __future__ import annotations

import time
from collections.abc import Sequence

from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from agent.study.plan import Contestant, Plan, Run, Scenario
from agent.study.records import Folder, Progress
from agent.study.results import Outcome

EVERY = 1.0
"""s between two drawings."""


class Screen:
    """Draws on `console` while entered, at most every `EVERY` seconds; nothing where it is no terminal."""

    def __init__(self, console: Console, folder: Folder, plan: Plan, jobs: int) -> None:
        self._folder = folder
        self._plan = plan
        self._jobs = jobs
        self._live = Live(console=console, auto_refresh=False, transient=True)
        self._shown = console.is_terminal
        self._drawn = 0.0

    def __enter__(self) -> Screen:
        if self._shown:
            self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._shown:
            self._live.stop()

    def watch(self) -> None:
        """Draw anew if it is time to."""
        if self._shown and time.monotonic() - self._drawn >= EVERY:
            self._drawn = time.monotonic()
            self._live.update(progress_table(self._folder, self._plan, self._jobs), refresh=True)


def progress_table(folder: Folder, plan: Plan, jobs: int) -> Group:
    """A line for each scenario and contestant, and the whole study's remaining time below."""
    table = Table(title=f"study {plan.name} in {folder.path}", title_justify="left", title_style="bold")
    for name in ("task", "algorithm"):
        table.add_column(name, no_wrap=True)
    for name in ("runs", "done", "rate", "left", "success", "successes", "violations"):
        table.add_column(name, justify="right", no_wrap=True)
    work: list[float | None] = []
    for scenario in plan.scenarios:
        for contestant in plan.contestants:
            runs = plan.of(scenario.name, contestant.name)
            if runs:
                seen = [(run, folder.progress(run.id, live=True)) for run in runs]
                work.append(_work_left(seen))
                table.add_row(*_cells(scenario, contestant, seen, work[-1]))
    known = [each for each in work if each is not None]
    at_least = "at least " if len(known) < len(work) else ""
    return Group(table, Text(f"{at_least}{duration(sum(known) / jobs)} left on {jobs} process{'es' * (jobs > 1)}"))


def results_table(found: Sequence[Outcome]) -> Table:
    """What came out, in short; `table.md` has the rest."""
    table = Table()
    for name in ("task", "algorithm", "seeds", "budget used", "success", "IQM [95 %]", "successes", "violations"):
        table.add_column(name, justify="left" if name in {"task", "algorithm"} else "right", no_wrap=True)
    for each in found:
        rate, ratio = each.success_rate, each.violation_ratio
        table.add_row(
            each.scenario.name,
            each.contestant.name,
            f"{each.finished}/{each.planned}",
            f"{each.reached / each.budget:.0%}",
            f"{rate.mean:.2f}" + (f" ± {rate.sem:.2f}" if rate.sem is not None else ""),
            f"{rate.iqm:.2f}" + (f" [{rate.low:.2f}, {rate.high:.2f}]" if rate.low is not None else ""),
            f"{each.successes.mean:.1f}",
            "-" if ratio is None else f"{ratio:.2%}",
        )
    return table


def duration(seconds: float) -> str:
    """12 s, 3 min 05 s, 2 h 10 min."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def _cells(
    scenario: Scenario, contestant: Contestant, seen: Sequence[tuple[Run, Progress]], left: float | None
) -> list[str]:
    """A line of the table."""
    told = [progress for _, progress in seen]
    finished = sum(each.state == "finished" for each in told)
    failed = sum(each.state == "failed" for each in told)
    rates = [each.rate for each in told if each.rate and each.state == "running"]
    measured = [each.success_rate for each in told if each.success_rate is not None]
    return [
        scenario.name,
        contestant.name,
        f"{finished}/{len(seen)}" + (f", {failed} failed" if failed else ""),
        f"{sum(progress.done(run) for run, progress in seen) / len(seen):.0%}",
        f"{sum(rates):,.1f}/s" if rates else "",
        "" if not left else duration(left),
        f"{sum(measured) / len(measured):.0%}" if measured else "",
        str(sum(each.successes for each in told)),
        str(sum(each.violations for each in told)),
    ]


def _work_left(seen: Sequence[tuple[Run, Progress]]) -> float | None:
    """Seconds of one process that these runs still need, by the time that their done part took; None if none began."""
    done = sum(progress.done(run) for run, progress in seen)
    left = sum(1 - progress.done(run) for run, progress in seen if progress.state != "failed")
    spent = sum(progress.seconds for _, progress in seen)
    if left == 0:
        return 0.0
    return left * spent / done if done > 0 else None
