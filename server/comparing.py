"""Several experiments' curves in one picture: each by itself, or the mean of those that are alike."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np
from sqlalchemy.orm import Session

from agent.study import paper
from agent.study.algorithms import CONTESTANTS
from agent.study.curves import joined
from agent.study.plan import SCENARIOS
from robot_adapters.base import Array
from server.models import ExperimentRow
from server.schemas_curves import (
    Axis,
    Chart,
    ComparedCurve,
    Comparison,
    Grouping,
    Measure,
    PaperCurve,
    PaperFigure,
    PaperFigures,
)
from server.store_curves import measured
from server.store_experiments import load

POINTS = 400
"""Of each experiment's own curve, before they are brought together."""
_AXES: Mapping[Measure, Axis] = {"success_rate": "low_level_steps"}


def compare(session: Session, experiments: Sequence[int], measure: Measure, by: Sequence[Grouping]) -> Comparison:
    """The curve of each group at the points that all of its experiments came to; one group an experiment without `by`.

    Raises:
        NotFound: one of the experiments isn't there.
    """
    groups: dict[tuple[str, ...], list[ExperimentRow]] = defaultdict(list)
    for experiment_id in dict.fromkeys(experiments):
        row = load(session, experiment_id)
        groups[tuple(_value(row, each) for each in by) or (str(row.id),)].append(row)
    found, missing = [], []
    for key, rows in groups.items():
        runs = {row.id: _run(measured(session, row.id, measure, POINTS)) for row in rows}
        known = {number: run for number, run in runs.items() if run is not None}
        missing += [number for number in runs if number not in known]
        if known:
            label = " · ".join(key) if by else rows[0].name
            found.append(_compared(label, known))
    return Comparison(measure=measure, axis=_AXES.get(measure, "feedback"), curves=found, missing=missing)


def paper_figures() -> PaperFigures:
    """The paper's curves and its safety table."""
    figures = [
        PaperFigure(
            scenario=scenario.name,
            title=scenario.title,
            task=scenario.task,
            axis=scenario.axis.value,
            measure=scenario.measure.value,
            note=paper.note(scenario.name),
            curves=[
                PaperCurve(
                    algorithm=each.algorithm,
                    title=CONTESTANTS[each.algorithm].title,
                    trial=each.trial,
                    x=list(each.x),
                    y=list(each.y),
                )
                for each in paper.curves(scenario.name)
            ],
            violation_ratios=dict(paper.violation_ratios(scenario.name)),
        )
        for scenario in SCENARIOS.values()
        if paper.curves(scenario.name) or paper.violation_ratios(scenario.name)
    ]
    return PaperFigures(source=paper.source(), figures=figures)


def _value(row: ExperimentRow, by: Grouping) -> str:
    if by == "tag":
        return ", ".join(each.tag for each in row.tags) or "none"
    return str(getattr(row, by) or "none")


def _run(chart: Chart) -> tuple[Array, Array] | None:
    """X and y of one experiment where y is known. A click that was taken back lets x fall: it is kept where it was."""
    known = [(x, y) for line in chart.curves[:1] for x, y in zip(line.x, line.y, strict=True) if y is not None]
    if not known:
        return None
    return np.maximum.accumulate([x for x, _ in known]), np.array([y for _, y in known])


def _compared(label: str, runs: Mapping[int, tuple[Array, Array]]) -> ComparedCurve:
    curve = joined([x for x, _ in runs.values()], [y for _, y in runs.values()])
    n = curve.seeds
    sem = curve.values.std(axis=0, ddof=1) / np.sqrt(n) if n > 1 else None
    return ComparedCurve(
        label=label,
        experiments=list(runs),
        x=curve.x.tolist(),
        mean=curve.values.mean(axis=0).tolist(),
        sem=[None] * len(curve.x) if sem is None else sem.tolist(),
    )
