"""The labels that a learner was given, appended to a file: a checkpoint of SEED doesn't hold its replay."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from agent.affordance import near
from agent.algorithm import Label, Problem
from agent.study.plan import StudyError
from robot_adapters.base import Array, SkillCall


class Labels:
    """A row of float64 for each label: state, index of the skill, parameters filled up with 0, value."""

    def __init__(self, path: Path, problem: Problem) -> None:
        """Go on with a file, or make one."""
        self._problem = problem
        self._path = path
        self._names = [spec.name for spec in problem.skills]
        self._state = len(problem.state_low)
        self._width = self._state + 2 + max(len(spec.parameters) for spec in problem.skills)
        self._file = path.open("ab")

    def append(self, label: Label) -> None:
        """Add the next label. It is on the disk for sure after `sync`."""
        row = np.zeros(self._width, dtype="<f8")
        row[: self._state] = label.state
        row[self._state] = self._names.index(label.call.skill)
        row[self._state + 1 : self._state + 1 + len(label.call.parameters)] = label.call.parameters
        row[-1] = label.value
        self._file.write(row.tobytes())

    def sync(self) -> None:
        """Bring everything to the disk."""
        self._file.flush()
        os.fsync(self._file.fileno())

    def keep(self, count: int) -> list[Label]:
        """Cut off what comes after the first `count` labels, and return these, numbered from 1.

        Raises:
            StudyError: there are fewer.
        """
        stored = np.fromfile(self._path, dtype="<f8", count=count * self._width)
        if stored.size != count * self._width:
            raise StudyError(
                f"{self._path} holds fewer than the {count} labels of the checkpoint beside it",
                remedy="delete this run's folder: it then starts anew",
            )
        self._file.truncate(count * self._width * stored.itemsize)
        rows = stored.reshape(count, self._width).astype(np.float64)
        return [self._label(number, row) for number, row in enumerate(rows, start=1)]

    def close(self) -> None:
        """Release the file."""
        self._file.close()

    def _label(self, number: int, row: Array) -> Label:
        state, spec = row[: self._state].copy(), self._problem.skills[int(row[self._state])]
        parameters = row[self._state + 1 : self._state + 1 + len(spec.parameters)]
        call = SkillCall(spec.name, tuple(parameters.tolist()))
        return Label(number, state, call, int(row[-1]), near(self._problem, state, call))
