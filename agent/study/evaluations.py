"""A run's evaluations: a line each in a CSV file, appended while it runs."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from agent.study.files import write_text


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


def append_row(path: Path, row: Row) -> None:
    """Add a line to an evaluations file; the first one gets its heading."""
    new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        file.write(_text([row]) if new else _text([row]).split("\r\n", 1)[1])
        file.flush()
        os.fsync(file.fileno())


def read_rows(path: Path) -> list[Row]:
    """Every whole line of an evaluations file; none where there is no file yet.

    Raises:
        ValueError: a line isn't one of numbers, or of no rollouts.
    """
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [_row(line) for line in csv.DictReader(file) if all(line.get(name) for name in COLUMNS)]


def keep_rows(path: Path, rows: Sequence[Row]) -> None:
    """Make these the only lines: those after them were of work that was lost.

    Killed at any moment, it leaves the file as it was or as it should be.
    """
    text = _text(rows)
    if not path.exists() or path.read_bytes() != text.encode():
        write_text(path, text)


def _text(rows: Sequence[Row]) -> str:
    """The file of these rows."""
    written = io.StringIO(newline="")
    writer = csv.writer(written)
    writer.writerow(COLUMNS)
    writer.writerows([getattr(row, name) for name in COLUMNS] for row in rows)
    return written.getvalue()


def _row(line: Mapping[str, str]) -> Row:
    row = Row(*(float(line[name]) if name == "seconds" else int(line[name]) for name in COLUMNS))  # type: ignore[arg-type]
    if row.rollouts < 1:
        raise ValueError(f"evaluation {row.evaluation} is of {row.rollouts} rollouts")
    return row
