"""What REST tells of studies, which processes of their own run: `seed study`."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from server.schemas import Wire

RunState = Literal["waiting", "running", "interrupted", "finished", "failed"]


class StudySummary(Wire):
    """A study in the list. live: a process works on it now. done: 0 to 1. problem: why it can't be read."""

    name: str
    study: str | None
    adapter: str | None
    created_at: datetime | None
    live: bool
    done: float
    runs: int
    finished: int
    failed: int
    problem: str | None


class StudyRun(Wire):
    """One contestant in one scenario from one seed. rate: units of the scenario's axis a second."""

    id: str
    scenario: str
    algorithm: str
    title: str
    seed: int
    budget: int
    state: RunState
    done: float
    decisions: int
    low_level_steps: int
    successes: int
    violations: int
    evaluations: int
    success_rate: float | None
    rate: float | None
    seconds: float
    error: str | None


class StudyCurve(Wire):
    """The mean at common points of the seeds that are about as far as each other; sem: its standard error.

    seeds: how many they are, of those `planned`; sem is null from one seed.
    """

    algorithm: str
    title: str
    seeds: int
    planned: int
    x: list[float]
    mean: list[float]
    sem: list[float | None]


class StudyPaperCurve(Wire):
    """What the paper's figure shows; trial: which of single runs, null where it is the mean of all."""

    algorithm: str
    title: str
    trial: int | None
    x: list[float]
    y: list[float]


class StudyScenario(Wire):
    """A task as one figure looks at it: our curves, the paper's, and a caption for means and standard errors."""

    name: str
    title: str
    axis: Literal["low_level_steps", "decisions"]
    measure: Literal["success_rate", "successes"]
    caption: str
    curves: list[StudyCurve]
    paper: list[StudyPaperCurve]


class Study(StudySummary):
    """A study with its runs and curves so far. files: what `files/{file}` has, once the study has come to its end."""

    versions: dict[str, str]
    scenarios: list[StudyScenario]
    run_list: list[StudyRun]
    files: list[str]
