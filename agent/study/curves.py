"""One curve of several seeds: what each had last reached at common points, no further than all of them came.

Runs that are far behind the others are not in it, or each seed that begins would take back the curve to its start.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from agent.study.evaluations import Row
from agent.study.plan import Axis, Measure, Plan
from agent.study.records import Folder
from robot_adapters.base import Array


@dataclass(frozen=True)
class Curve:
    """x: (m,) points of the axis. values: (n, m) of n seeds there."""

    x: Array
    values: Array

    @property
    def seeds(self) -> int:
        """How many it is of."""
        return len(self.values)


def value_of(row: Row, measure: Measure) -> float:
    """A curve's y at an evaluation."""
    return row.success_rate if measure is Measure.SUCCESS_RATE else float(row.successes)


def curve(runs: Sequence[Sequence[Row]], axis: Axis, measure: Measure, points: int = 100) -> Curve | None:
    """The curve of runs given by their evaluations; None before every one of them has one.

    A run's value at x is that of its last evaluation at or before x. The curve ends where the first of the runs does:
    nothing is drawn where a seed wasn't measured.
    """
    if not runs or not all(runs):
        return None
    reached = [np.array([getattr(row, axis.value) for row in rows], dtype=np.float64) for rows in runs]
    measured = [np.array([value_of(row, measure) for row in rows]) for rows in runs]
    return joined(reached, measured, points)


def joined(reached: Sequence[Array], measured: Sequence[Array], points: int = 100) -> Curve:
    """Runs at common points, each given by its (k,) points of the axis, ascending, and its (k,) values there.

    A run that was first measured later has its first value before that.
    """
    end = min(float(x[-1]) for x in reached)
    # the points are those of the run that was measured most often: no value is invented between two evaluations
    densest = max(reached, key=lambda x: int((x <= end).sum()))
    x = np.unique(np.append(densest[densest <= end], end))
    if len(x) > points + 1:
        x = x[np.unique(np.linspace(0, len(x) - 1, points + 1).round().astype(int))]
    values = [
        y[np.maximum(np.searchsorted(at, x, side="right") - 1, 0)] for at, y in zip(reached, measured, strict=True)
    ]
    return Curve(x, np.stack(values))


def study_curve(
    folder: Folder, plan: Plan, scenario: str, contestant: str, *, axis: Axis, measure: Measure
) -> Curve | None:
    """The curve of one contestant, of those of its runs that are about as far as each other."""
    rows = [folder.rows(run.id) for run in plan.of(scenario, contestant)]
    return curve(abreast(rows, plan.protocol.evaluations), axis, measure)


def abreast(runs: Sequence[Sequence[Row]], evaluations: int) -> list[Sequence[Row]]:
    """The runs that can be one curve: those at their end; before one is, at least half as far as the farthest.

    evaluations: how many a run has at its end, beside the one before it.
    """
    farthest = max((rows[-1].evaluation for rows in runs if rows), default=0)
    least = farthest if farthest == evaluations else farthest / 2
    return [rows for rows in runs if rows and rows[-1].evaluation >= least]
