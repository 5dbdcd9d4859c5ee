"""A study from its plan to its tables and figures, in the folder where it is kept."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console

from agent.study.execution import execute
from agent.study.figures import write_figures
from agent.study.oracle import oracle_of
from agent.study.plan import Plan, StudyError
from agent.study.records import Folder, Progress
from agent.study.results import Outcome, write_results
from agent.study.versions import versions
from server.settings import Settings
from server.studies import STUDIES
from server.study_screen import Screen
from server.workers.study import builders


@dataclass(frozen=True)
class Place:
    """Where a study is kept and with how many processes; None stands for what is usual."""

    out: Path | None
    data_dir: Path | None
    jobs: int | None
    resume: bool

    @property
    def processes(self) -> int:
        """How many at a time."""
        return self.jobs or os.cpu_count() or 1

    def folder(self, name: str) -> Path:
        """The study's folder."""
        return self.out or (self.data_dir or Settings().data_dir) / STUDIES / name


@dataclass(frozen=True)
class Finished:
    """What came out of a study."""

    plan: Plan
    folder: Path
    ended: Mapping[str, Progress]
    outcomes: list[Outcome]
    figures: list[str]
    seconds: float
    warnings: list[str]
    """What takes from the results' worth."""

    @property
    def failed(self) -> dict[str, str]:
        """Run -> why, of those that failed."""
        return {run: each.error or "" for run, each in self.ended.items() if each.state == "failed"}

    def told(self) -> dict[str, Any]:
        """For `--json`."""
        return {
            "study": self.plan.name,
            "folder": str(self.folder),
            "runs": len(self.ended),
            "finished": sum(each.state == "finished" for each in self.ended.values()),
            "failed": len(self.failed),
            "seconds": round(self.seconds, 3),
            "figures": self.figures,
            "warnings": self.warnings,
            "results": [_told(each) for each in self.outcomes],
        }


def run_study(
    name: str, plan: Callable[[], Plan], given: Mapping[str, Any], place: Place, console: Console
) -> Finished:
    """Begin a study or go on with one, to its end. `given` are the options that make its plan, None where not given.

    Raises:
        StudyError: it can't be planned, or its folder is of another one. AdapterError: no such adapter.
        ProcessDied: a run's process was killed. KeyboardInterrupt: also on SIGTERM.
    """
    began = time.monotonic()
    folder = Folder(place.folder(name))
    chosen = _planned_before(name, folder, given) if place.resume else plan()
    surroundings = builders(chosen.adapter)
    with _terminated(), folder.worked_on():
        if not place.resume:
            folder.begin(chosen, versions())
        try:
            with Screen(console, folder, chosen, place.processes) as screen:
                ended = execute(chosen, folder.path, surroundings, place.processes, screen.watch)
        finally:  # an interrupted study, too, shows what it has
            outcomes = write_results(folder, chosen)
            figures = write_figures(folder, chosen)
    judges = [oracle_of(folder, chosen, scenario) for scenario in chosen.scenarios]
    warnings = [f"{each.run.scenario.name}: {each.told()}" for each in judges if each and each.poor]
    return Finished(chosen, folder.path, ended, outcomes, figures, time.monotonic() - began, warnings)


def _planned_before(name: str, folder: Folder, given: Mapping[str, Any]) -> Plan:
    named = [f"--{option.replace('_', '-')}" for option, value in given.items() if value is not None]
    if named:
        raise StudyError(
            f"{', '.join(named)} can't be given with --resume: the study is planned already",
            remedy="leave them out, or begin another study without --resume, by --out in another folder",
        )
    plan = folder.plan()
    if plan.name != name:
        raise StudyError(
            f"{folder.path} holds a study called {plan.name}", remedy=f"go on with it by: seed study {plan.name}"
        )
    return plan


@contextlib.contextmanager
def _terminated() -> Iterator[None]:
    """SIGTERM ends it as Ctrl-C does: in order, and to be gone on with."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _told(each: Outcome) -> dict[str, Any]:
    return {
        "task": each.scenario.name,
        "algorithm": each.contestant.name,
        "seeds": each.success_rate.n,
        "budget": each.budget,
        "axis": each.scenario.axis.value,
        "reached": each.reached,
        "success_rate": asdict(each.success_rate),
        "successes": asdict(each.successes),
        "violations": each.violations,
        "decisions": each.decisions,
    }
