"""Files that outlive a killed process: written whole or not at all, and read with errors that name them."""

from __future__ import annotations

import contextlib
import csv
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from agent.study.plan import StudyError


def write_text(path: Path, text: str) -> None:
    """Write whole or not at all, and to the disk."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with temporary.open("w", newline="", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    temporary.replace(path)


def write_json(path: Path, content: Any) -> None:
    """Write whole or not at all, and to the disk."""
    write_text(path, json.dumps(content, indent=1))


def read_json(path: Path) -> Any:
    """What `write_json` wrote."""
    return json.loads(path.read_text("utf-8"))


@contextlib.contextmanager
def readable(path: Path, study: Path, remedy: str) -> Iterator[None]:
    """Around reading a file of a study's folder and taking what it says; one that isn't there is the caller's matter.

    Raises:
        StudyError: it is damaged, or of something else. It is named from the study's folder on: whoever reads this on
            a page needn't know where the service keeps its data.
    """
    try:
        yield
    except FileNotFoundError:
        raise
    except (OSError, ValueError, KeyError, TypeError, OverflowError, csv.Error) as error:
        why = error.strerror if isinstance(error, OSError) else str(error)  # an OSError's text has the whole path
        raise StudyError(f"{study.name}/{path.relative_to(study)} can't be read: {why}", remedy=remedy) from error
