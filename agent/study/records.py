"""A study's folder: what each file is called, and how it is written and read. Imports no torch.

- `study.json`: the plan and the versions; `results.csv`, `table.md`, `figures/`: what came out
- `runs/<id>/run.json`: everything that a run was made of; `evaluations.csv`: a row an evaluation
- `runs/<id>/outcome.json`: what came of a claim's row, in the folder of its first run
- `runs/<id>/progress.json`: how far it is, for whoever watches
- `runs/<id>/state.json` and the files it names: from where it goes on after it was interrupted
- `together/<id of the first>.json`: the same of runs that share a process, all at the same moment
"""

from __future__ import annotations

import contextlib
import fcntl
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from agent.study.evaluations import Row, read_rows
from agent.study.files import read_json, readable, write_json
from agent.study.plan import Axis, Plan, Run, StudyError

STUDY, RESULTS, TABLE, FIGURES, RUNS = "study.json", "results.csv", "table.md", "figures", "runs"
RUN, EVALUATIONS, PROGRESS, STATE = "run.json", "evaluations.csv", "progress.json", "state.json"
OUTCOME, TOGETHER, LOCK = "outcome.json", "together", ".lock"

State = Literal["waiting", "running", "interrupted", "finished", "failed"]


class Progress(BaseModel):
    """How far a run is. rate: units of its axis a second, since it was last started; error: why it failed."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    state: State = "waiting"
    decisions: int = 0
    low_level_steps: int = 0
    executions: int = 0
    episodes: int = 0
    successes: int = 0
    violations: int = 0
    evaluations: int = 0
    success_rate: float | None = None
    rate: float | None = None
    seconds: float = 0.0
    error: str | None = None

    def done(self, run: Run) -> float:
        """Share of the run that is done, 0 to 1."""
        if self.state == "finished":
            return 1.0
        share = (self.low_level_steps if run.scenario.axis is Axis.LOW_LEVEL_STEPS else self.decisions) / run.budget
        if run.most_decisions is not None:
            share = max(share, self.decisions / run.most_decisions)
        return min(1.0, share)


class Checkpoint(BaseModel):
    """From where a run goes on. evaluated: the newest evaluation; course: what the course needs beside its learner."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    learner: str
    """Name of the learner's file, beside this one."""
    evaluated: int
    seconds: float
    course: Mapping[str, Any]


class _Begun(BaseModel):
    """`study.json`."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    plan: Plan
    versions: Mapping[str, str] = {}
    created_at: float = Field(ge=0, lt=253_402_300_800)  # s since the epoch; that is the year 10000


class Folder:
    """A study on disk."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @property
    def exists(self) -> bool:
        """Whether a study was begun here."""
        return (self.path / STUDY).is_file()

    def begin(self, plan: Plan, versions: Mapping[str, str]) -> None:
        """Write down what is going to be done.

        Raises:
            StudyError: the folder holds a study, or something else.
        """
        if self.exists:
            raise StudyError(
                f"{self.path} holds a study already",
                remedy="go on with it by --resume, or choose another folder by --out",
            )
        self.require_empty()
        for run in plan.runs:
            self.run(run.id).mkdir(parents=True, exist_ok=True)
        content = {"plan": plan.model_dump(mode="json"), "versions": dict(versions), "created_at": time.time()}
        write_json(self.path / STUDY, content)

    def require_empty(self) -> None:
        """Make sure that nothing is overwritten here.

        Raises:
            StudyError: there is something.
        """
        if self.path.is_dir() and any(each.name != LOCK for each in self.path.iterdir()):
            raise StudyError(f"{self.path} is no empty folder", remedy="choose a new folder by --out")

    def plan(self) -> Plan:
        """What is done here.

        Raises:
            StudyError: there is no study, or one that this version can't read.
        """
        return self._begun().plan

    def versions(self) -> Mapping[str, str]:
        """What it was begun with; raises as `plan` does."""
        return self._begun().versions

    def created_at(self) -> float:
        """Seconds since the epoch; raises as `plan` does."""
        return self._begun().created_at

    def run(self, run_id: str) -> Path:
        """The folder of a run."""
        return self.path / RUNS / run_id

    def rows(self, run_id: str) -> list[Row]:
        """The evaluations of a run so far.

        Raises:
            StudyError: their file is damaged.
        """
        path = self.run(run_id) / EVALUATIONS
        with readable(path, self.path, AGAIN):
            return read_rows(path)

    def checkpoint(self, run_id: str) -> Checkpoint | None:
        """From where a run goes on; None where it begins.

        Raises:
            StudyError: its file is damaged.
        """
        path = self.run(run_id) / STATE
        try:
            with readable(path, self.path, AGAIN):
                return Checkpoint.model_validate(read_json(path))
        except FileNotFoundError:
            return None

    def checkpoints(self, group: Sequence[Run]) -> dict[str, Checkpoint]:
        """From where runs of one process go on, by id; those that aren't in it begin.

        Raises:
            StudyError: a file is damaged.
        """
        if len(group) == 1:
            alone = self.checkpoint(group[0].id)
            return {} if alone is None else {group[0].id: alone}
        path = self._together(group)
        remedy = f"delete it and the folders of its runs ({', '.join(run.id for run in group)}): they are done anew"
        try:
            with readable(path, self.path, remedy):
                found = {run_id: Checkpoint.model_validate(each) for run_id, each in read_json(path).items()}
        except FileNotFoundError:
            return {}
        return {run_id: each for run_id, each in found.items() if (self.run(run_id) / RUN).is_file()}

    def keep(self, group: Sequence[Run], found: Mapping[str, Checkpoint]) -> None:
        """From here on these checkpoints count, all at once."""
        content = {run_id: each.model_dump(mode="json") for run_id, each in found.items()}
        if len(group) == 1:
            write_json(self.run(group[0].id) / STATE, content[group[0].id])
            return
        self._together(group).parent.mkdir(exist_ok=True)
        write_json(self._together(group), content)

    def _together(self, group: Sequence[Run]) -> Path:
        return self.path / TOGETHER / f"{group[0].id}.json"

    def progress(self, run_id: str, *, live: bool) -> Progress:
        """How far a run is. live: whether a process works on the study; without, a run that was going is not now.

        Raises:
            StudyError: its file is damaged.
        """
        path = self.run(run_id) / PROGRESS
        try:
            with readable(path, self.path, "delete this file and go on with the study: it is written anew"):
                found = Progress.model_validate(read_json(path))
        except FileNotFoundError:
            return Progress()
        if found.state == "running" and not live:
            return found.model_copy(update={"state": "interrupted", "rate": None})
        return found

    def figures(self) -> list[str]:
        """Names of the figures' files."""
        folder = self.path / FIGURES
        return sorted(each.name for each in folder.iterdir()) if folder.is_dir() else []

    @property
    def live(self) -> bool:
        """Whether a process works on it now."""
        try:
            with (self.path / LOCK).open("rb") as file:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:  # there is none, or it isn't ours
            return False
        return False

    @contextlib.contextmanager
    def worked_on(self) -> Iterator[None]:
        """Be the one process that works on it, while inside.

        Raises:
            StudyError: another one does, or there can't be such a folder.
        """
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            lock = (self.path / LOCK).open("ab")
        except OSError as error:
            raise StudyError(
                f"--out: {self.path} can't be written to: {error.strerror}", remedy="choose another folder by --out"
            ) from error
        with lock as file:
            for attempt in range(LOCK_ATTEMPTS):
                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    break
                except BlockingIOError as error:  # a reader holds it for a moment, another study for long
                    if attempt == LOCK_ATTEMPTS - 1:
                        raise StudyError(
                            f"another process works on {self.path}", remedy="wait for it, or end it first"
                        ) from error
                    time.sleep(0.02)
            yield

    def _begun(self) -> _Begun:
        path = self.path / STUDY
        remedy = "run it with the version that made it (its `versions` say which), or begin anew in another folder"
        try:
            with readable(path, self.path, remedy):
                return _Begun.model_validate(read_json(path))
        except FileNotFoundError as error:
            raise StudyError(
                f"there is no study in {self.path}", remedy="leave --resume out, or name its folder by --out"
            ) from error


AGAIN = "delete the run's folder and go on with the study: the run is done anew"
LOCK_ATTEMPTS = 25
