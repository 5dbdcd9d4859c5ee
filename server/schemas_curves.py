"""An experiment's curves, thinned out by the service: what a page needs to draw, whatever the number of rows."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schemas import Wire

Axis = Literal["feedback", "low_level_steps", "proposals", "decisions"]
Measure = Literal["successes", "success_rate", "violation_ratio", "good_share", "critic_loss", "estimate_error"]
Grouping = Literal["task", "algorithm", "preset", "adapter", "teacher", "tag"]


class Curve(Wire):
    """One line. y is null where nothing was measured; low and high are the ends of a band, where there is one."""

    name: str
    x: list[float]
    y: list[float | None]
    low: list[float | None] | None = None
    high: list[float | None] | None = None


class Chart(Wire):
    """Lines that belong into one picture."""

    name: Annotated[str, Field(description="what is measured; for an algorithm's own metric its name")]
    axis: Axis
    curves: list[Curve]


class Curves(Wire):
    """Everything that changed in an experiment, oldest first in each curve."""

    experiment_id: int
    feedback: Annotated[int, Field(description="labels behind them")]
    charts: list[Chart]


class ComparedCurve(Wire):
    """The mean of several experiments at common points, or one experiment; sem: the standard error of that mean."""

    label: str
    experiments: list[int]
    x: list[float]
    mean: list[float]
    sem: list[float | None]


class Comparison(Wire):
    """Curves of several experiments in one picture. missing: experiments that have none of this yet."""

    measure: Measure
    axis: Axis
    curves: list[ComparedCurve]
    missing: list[int]


class PaperCurve(Wire):
    """One line of the paper; trial: which of single runs, null where it is the mean of all."""

    algorithm: str
    title: str
    trial: int | None
    x: list[float]
    y: list[float]


class PaperFigure(Wire):
    """What one of the paper's figures shows of a task, read off by eye; note: what it was measured on."""

    scenario: str
    title: str
    task: str
    axis: Axis
    measure: Literal["success_rate", "successes"]
    note: str
    curves: list[PaperCurve]
    violation_ratios: Annotated[dict[str, float], Field(description="of the paper's safety table, by algorithm")]


class PaperFigures(Wire):
    """The paper's results as numbers. source: where they are from, and how exact they are."""

    source: str
    figures: list[PaperFigure]
