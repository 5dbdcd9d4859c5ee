"""Claims of the paper as studies: what each compares, row by row; and the work on one row from one seed.

A row trains all that it compares together, so its runs share a process. An interrupted row begins anew; those that are
finished stay.
"""

from __future__ import annotations

import importlib
import logging
import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any, Protocol

from agent.algorithm import AgentError
from agent.study.algorithms import Builders
from agent.study.episodes import Counts, Done
from agent.study.evaluations import Row, append_row, keep_rows
from agent.study.files import read_json, readable, write_json
from agent.study.lessons import Heard, Stage
from agent.study.plan import Axis, Contestant, Measure, Plan, Run, Scenario
from agent.study.plan import Protocol as Evaluation
from agent.study.records import AGAIN, EVALUATIONS, OUTCOME, PROGRESS, RUN, Folder, Progress, State
from agent.study.versions import versions
from robot_adapters.base import AdapterError

log = logging.getLogger("seed.study")

CLAIMS: Mapping[str, str] = {
    "composition": "critics of subgoals, composed for scenes and orders never trained",
    "imitation": "behaviour cloning of skill calls beside SEED with as many labels",
}
TELL_EVERY = 0.5
"""s between two notes of how far a row is."""


class Claim(Protocol):
    """What the module of a claim has."""

    CONTESTANTS: Mapping[str, str]
    """Name -> title of what it compares."""

    def budgets(self, row: str) -> Mapping[str, int]:
        """Labels, or demonstrated steps, that each contestant gets at most."""

    def rows(self) -> Sequence[str]:
        """Titles."""

    def outcome(self, row: str, stage: Stage, seed: int, rollouts: int, heard: Heard) -> Any:
        """What comes of a row, a dataclass."""

    def rates(self, outcome: Any) -> Mapping[str, float]:
        """Share of the rollouts that each contestant solved in the end."""

    def read(self, told: Mapping[str, Any]) -> Any:
        """The outcome again, from its JSON."""

    def table_of(self, outcomes: Sequence[Any]) -> list[str]:
        """Markdown rows."""


def claim(name: str) -> Claim:
    """The module; it loads torch."""
    assert name in CLAIMS
    module: Any = importlib.import_module(f"agent.study.{name}")
    found: Claim = module
    return found


def claimed(name: str, seeds: Sequence[int], rollouts: int) -> Plan:
    """The plan: seed by seed, all rows, what each compares."""
    of = claim(name)
    runs = [
        Run(
            id=f"{_scenario(row, of).name}-{who}-{seed}",
            contestant=Contestant(name=who, title=title, kind="claim", algorithm=name),
            scenario=_scenario(row, of),
            seed=seed,
            budget=of.budgets(row)[who],
        )
        for seed in seeds
        for row in of.rows()
        for who, title in of.CONTESTANTS.items()
    ]
    protocol = Evaluation(evaluations=1, rollouts=rollouts)
    return Plan(name=name, adapter="kinematic", seeds=tuple(seeds), protocol=protocol, runs=tuple(runs))


def _scenario(row: str, of: Claim) -> Scenario:
    return Scenario(
        name=re.sub(r"[^a-z0-9]+", "-", row.lower()).strip("-"),
        title=row,
        task=row,
        axis=Axis.DECISIONS,
        measure=Measure.SUCCESS_RATE,
        usual_budget=max(of.budgets(row).values()),
        algorithms=tuple(of.CONTESTANTS),
    )


def claim_table(folder: Folder, plan: Plan) -> list[str]:
    """The claim's own table, of the rows that are finished; empty before there is one.

    Raises:
        StudyError: an outcome is damaged.
    """
    of, found = claim(plan.name), []
    for group in plan.groups:
        path = folder.run(group[0].id) / OUTCOME
        if path.is_file():
            with readable(path, folder.path, AGAIN):
                found.append(of.read(read_json(path)))
    return of.table_of(found) if found else []


class _Stopped(Exception):
    """Somebody wants the process to end."""


class _Told:
    """How far each run of a row is, for whoever watches."""

    def __init__(self, group: Sequence[Run], folder: Folder) -> None:
        self._folder = folder
        self._began = time.monotonic()
        self._told = self._began
        self.counts = {run.contestant.name: (run, Counts()) for run in group}

    def hear(self, names: Iterable[str], done: Done | None) -> None:
        """Count a label, or a demonstrated step, for these contestants, and what was executed upon it."""
        for name in names:
            counts = self.counts[name][1]
            counts.decisions += 1
            if done is not None:
                counts.executions += 1
                counts.low_level_steps += done.low_level_steps
                counts.episodes += done.over
                counts.successes += done.success
                counts.violations += done.violations
        if time.monotonic() - self._told >= TELL_EVERY * len(self.counts):
            self.tell("running")

    def tell(self, state: State, error: str | None = None, rates: Mapping[str, float] | None = None) -> None:
        """Write it down."""
        self._told = time.monotonic()
        seconds = self._told - self._began
        for name, (run, counts) in self.counts.items():
            progress = Progress(
                state=state,
                error=error,
                **asdict(counts),
                evaluations=0 if rates is None else 1,
                success_rate=None if rates is None else rates[name],
                rate=counts.decisions / seconds if seconds > 0 and state == "running" else None,
                seconds=round(self.seconds, 3),
            )
            write_json(self._folder.run(run.id) / PROGRESS, progress.model_dump(mode="json"))

    @property
    def seconds(self) -> float:
        """Each run's share of the process's time."""
        return (time.monotonic() - self._began) / len(self.counts)


def work_on_row(
    group: Sequence[Run], plan: Plan, folder: Folder, builders: Builders, stop: Callable[[], bool]
) -> list[Progress]:
    """Do the runs of a row from one seed, unless they are finished; how far each came."""
    if any(folder.progress(run.id, live=False).state != "finished" for run in group):
        _work(group, plan, folder, builders, stop)
    return [folder.progress(run.id, live=True) for run in group]


def _work(group: Sequence[Run], plan: Plan, folder: Folder, builders: Builders, stop: Callable[[], bool]) -> None:
    told, of, rollouts = _Told(group, folder), claim(plan.name), plan.protocol.rollouts

    def heard(names: Iterable[str], done: Done | None) -> None:
        if stop():
            raise _Stopped
        told.hear(names, done)

    told.tell("running")
    try:
        for run in group:
            keep_rows(folder.run(run.id) / EVALUATIONS, [])
            about = {**run.model_dump(mode="json"), "adapter": plan.adapter, "rollouts": rollouts}
            write_json(folder.run(run.id) / RUN, {**about, "versions": versions()})
        outcome = of.outcome(group[0].scenario.title, builders.stage, group[0].seed, rollouts, heard)
        rates = of.rates(outcome)
        write_json(folder.run(group[0].id) / OUTCOME, asdict(outcome))
        for name, (run, counts) in told.counts.items():
            solved = round(rates[name] * rollouts)
            row = Row(
                1, **asdict(counts), updates=0, rollouts=rollouts, rollouts_succeeded=solved, seconds=told.seconds
            )
            append_row(folder.run(run.id) / EVALUATIONS, row)
        told.tell("finished", rates=rates)
    except _Stopped:
        told.tell("interrupted")
    except (AgentError, AdapterError) as error:
        told.tell("failed", f"{error}; {error.remedy}")
    except Exception as error:  # what nobody foresaw mustn't end the other runs; it is logged with its traceback
        log.exception("the row %s failed", group[0].scenario.title)
        told.tell("failed", f"{type(error).__name__}: {error}")
