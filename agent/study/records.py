"""A study's folder: what each file is called, and how it is written and read. Imports no torch.

- `study.json`: the plan and the versions; `results.csv`, `table.md`, `figures/`: what came out
- `runs/<id>/run.json`: everything that a run was made of; `evaluations.csv`: a row an evaluation
- `runs/<id>/progress.json`: how far it is, for whoever watches
- `runs/<id>/state.json` and the files it names: from where it goes on after it was interrupted
"""

from __future__ import annotations

import contextlib
import csv
import fcntl
import json
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from agent.study.plan import Axis, Plan, Run, StudyError

STUDY, RESULTS, TABLE, FIGURES, RUNS = "study.json", "results.csv", "table.md", "figures", "runs"
RUN, EVALUATIONS, PROGRESS, LOCK = "run.json", "evaluations.csv", "progress.json", ".lock"

State = Literal["waiting", "running", "interrupted", "finished", "failed"]


class Progress(BaseModel):
    """How far a run is. rate: units of its axis a second, since it was last started; error: why it failed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

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


@dataclass(frozen=True)
class Row:
    """One evaluation. The counts before it are of training; `seconds` is the time spent on the run until then."""

    evaluation: int
    decisions: int
    low_level_steps: int
    executions: int
    episodes: int
    successes: int
    violations: int
    updates: int
    rollouts: int
    rollouts_succeeded: int
    seconds: float

    @property
    def success_rate(self) -> float:
        """Share of the rollouts that succeeded."""
        return self.rollouts_succeeded / self.rollouts


COLUMNS = tuple(Row.__dataclass_fields__)


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
        if self.path.is_file() or (self.path.is_dir() and any(each.name != LOCK for each in self.path.iterdir())):
            raise StudyError(f"{self.path} is no empty folder", remedy="choose a new folder by --out")
        for run in plan.runs:
            self.run(run.id).mkdir(parents=True, exist_ok=True)
        content = {"plan": plan.model_dump(mode="json"), "versions": dict(versions), "created_at": time.time()}
        write_json(self.path / STUDY, content)

    def plan(self) -> Plan:
        """What is done here.

        Raises:
            StudyError: there is no study, or one that this version can't read.
        """
        try:
            return Plan.model_validate(self._study()["plan"])
        except (KeyError, TypeError, ValidationError) as error:
            raise StudyError(
                f"{self.path / STUDY} can't be read: {error}",
                remedy="run it with the version that made it (its `versions` say which), or begin anew by --out",
            ) from error

    def versions(self) -> Mapping[str, str]:
        """What it was begun with."""
        return dict(self._study().get("versions", {}))

    def created_at(self) -> float:
        """Seconds since the epoch."""
        return float(self._study().get("created_at", 0.0))

    def run(self, run_id: str) -> Path:
        """The folder of a run."""
        return self.path / RUNS / run_id

    def rows(self, run_id: str) -> list[Row]:
        """The evaluations of a run so far."""
        return read_rows(self.run(run_id) / EVALUATIONS)

    def progress(self, run_id: str, *, live: bool) -> Progress:
        """How far a run is. live: whether a process works on the study; without, a run that was going is not now."""
        try:
            found = Progress.model_validate(read_json(self.run(run_id) / PROGRESS))
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
        except FileNotFoundError:
            return False
        except BlockingIOError:
            return True
        return False

    @contextlib.contextmanager
    def worked_on(self) -> Iterator[None]:
        """Be the one process that works on it, while inside.

        Raises:
            StudyError: another one does.
        """
        self.path.mkdir(parents=True, exist_ok=True)
        with (self.path / LOCK).open("ab") as file:
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

    def _study(self) -> dict[str, Any]:
        try:
            found = read_json(self.path / STUDY)
        except (OSError, ValueError) as error:
            raise StudyError(
                f"there is no study in {self.path}", remedy="leave --resume out, or name its folder by --out"
            ) from error
        if not isinstance(found, dict):
            raise StudyError(f"{self.path / STUDY} is of something else", remedy="choose another folder by --out")
        return found


LOCK_ATTEMPTS = 25


def write_json(path: Path, content: Any) -> None:
    """Write whole or not at all, and to the disk."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with temporary.open("w", encoding="utf-8") as file:
        json.dump(content, file, indent=1)
        file.flush()
        os.fsync(file.fileno())
    temporary.replace(path)


def read_json(path: Path) -> Any:
    """What `write_json` wrote."""
    return json.loads(path.read_text("utf-8"))


def append_row(path: Path, row: Row) -> None:
    """Add a line to an evaluations file; the first one gets its heading."""
    new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(COLUMNS)
        writer.writerow([getattr(row, name) for name in COLUMNS])
        file.flush()
        os.fsync(file.fileno())


def read_rows(path: Path) -> list[Row]:
    """Every whole line of an evaluations file; none where there is no file yet."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [_row(line) for line in csv.DictReader(file) if all(line.get(name) for name in COLUMNS)]


def keep_rows(path: Path, rows: Sequence[Row]) -> None:
    """Make these the only lines: those after them were of work that was lost."""
    if path.exists():
        path.unlink()
    for row in rows:
        append_row(path, row)


def _row(line: Mapping[str, str]) -> Row:
    return Row(*(float(line[name]) if name == "seconds" else int(line[name]) for name in COLUMNS))  # type: ignore[arg-type]
