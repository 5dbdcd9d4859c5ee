"""Curves of one experiment by queries: counted and averaged in the database, so that few rows leave it.

Counters only grow, so of their rows some are taken; labels, skills and speed are means over as many buckets. How wide
a bucket is comes from the experiment's own counters: to count the rows takes as long as to average them.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from sqlalchemy import ColumnElement, case, exists, extract, func, select
from sqlalchemy.orm import Session

from server.models import (
    COUNTING,
    EvaluationRow,
    ExecutionRow,
    ExperimentRow,
    FeedbackRow,
    MetricRow,
    ProposalRow,
)
from server.schemas_curves import Chart, Curve, Curves, Measure
from server.store_experiments import load

LEAST = 10
"""Rows of a bucket: a share of fewer says little."""
LEAST_TIMED = 20
"""Labels of a bucket whose speed is told: SQLite tells times to the second only."""
PAUSE = 60
"""Seconds without a label after which a trainer is taken to have paused; such a gap is no part of the speed."""

COUNTED = {"successes": ("successes", "executions"), "violation_ratio": ("violation_ratio",)}
GROUPED = {
    "critic_loss": ("critic_loss",),
    "actor_losses": ("skill_actor_loss", "parameter_actor_loss"),
    "temperatures": ("skill_temperature", "parameter_temperature"),
    "entropies": ("skill_entropy", "parameter_entropy"),
}
"""Chart -> the learner's metrics in it; any other metric has a chart of its own."""
ELSEWHERE = frozenset({"predicted_feedback", "label", "good_share", "violations"})
"""Stored with each label, and told better by buckets."""


def curves(session: Session, experiment_id: int, points: int) -> Curves:
    """Every chart that there is something for; at most about `points` points a curve."""
    experiment = load(session, experiment_id)
    sampled = _sampled(session, experiment_id, points)
    buckets = _labels(session, experiment, points)
    charts = [
        _of_metrics("successes", sampled, COUNTED["successes"]),
        _success_rate(session, experiment_id),
        _of_metrics("violation_ratio", sampled, COUNTED["violation_ratio"]),
        _good_share(sampled, buckets),
        _of_metrics("critic_loss", sampled, GROUPED["critic_loss"]),
        _estimates(buckets),
        _estimate_error(buckets),
        _of_metrics("temperatures", sampled, GROUPED["temperatures"]),
        _of_metrics("entropies", sampled, GROUPED["entropies"]),
        _of_metrics("actor_losses", sampled, GROUPED["actor_losses"]),
        _skills(session, experiment, points),
        _throughput(session, experiment, points),
        *_others(sampled),
    ]
    feedback = max((row.feedback for row in sampled), default=0)
    return Curves(experiment_id=experiment_id, feedback=feedback, charts=[each for each in charts if each.curves])


def measured(session: Session, experiment_id: int, measure: Measure, points: int) -> Chart:
    """The one chart whose first curve is this measure."""
    if measure == "success_rate":
        return _success_rate(session, experiment_id)
    if measure == "estimate_error":
        return _estimate_error(_labels(session, load(session, experiment_id), points))
    return _of_metrics(measure, _sampled(session, experiment_id, points), [measure])


def success_rate(session: Session, experiment_id: int) -> list[tuple[int, int, int]]:
    """Finished evaluations: low-level steps of training before it, rollouts, successes. Oldest first."""
    row = EvaluationRow
    query = (
        select(extract("epoch", row.started_at), row.rollouts, row.successes)
        .where(row.experiment_id == experiment_id, row.ended_at.is_not(None), row.rollouts > 0)
        .order_by(row.id)
    )
    evaluations = [(float(at), rollouts, successes) for at, rollouts, successes in session.execute(query)]
    if not evaluations:
        return []
    moved = (
        select(extract("epoch", ExecutionRow.ended_at), func.sum(ExecutionRow.low_level_steps))
        .join(ProposalRow, ProposalRow.id == ExecutionRow.proposal_id)
        .where(
            ExecutionRow.experiment_id == experiment_id,
            ExecutionRow.ended_at.is_not(None),
            ProposalRow.purpose == "training",
        )
        .group_by(extract("epoch", ExecutionRow.ended_at))
        .order_by(extract("epoch", ExecutionRow.ended_at))
    )
    times, totals, total = [], [0], 0
    for at, steps in session.execute(moved):
        total += int(steps)
        times.append(float(at))
        totals.append(total)
    return [(totals[bisect_right(times, at)], rollouts, successes) for at, rollouts, successes in evaluations]


def _success_rate(session: Session, experiment_id: int) -> Chart:
    found = success_rate(session, experiment_id)
    rates = [successes / rollouts for _, rollouts, successes in found]
    sems = [math.sqrt(p * (1 - p) / n) for p, (_, n, _) in zip(rates, found, strict=True)]
    curve = Curve(
        name="success_rate",
        x=[steps for steps, _, _ in found],
        y=list(rates),
        low=[max(0.0, p - e) for p, e in zip(rates, sems, strict=True)],
        high=[min(1.0, p + e) for p, e in zip(rates, sems, strict=True)],
    )
    return Chart(name="success_rate", axis="low_level_steps", curves=[curve] if found else [])


def _sampled(session: Session, experiment_id: int, points: int) -> Sequence[Any]:
    """Some of the metric rows, evenly, and the last one."""
    row = MetricRow
    total = session.scalar(select(func.count(row.id)).where(row.experiment_id == experiment_id)) or 0
    stride = max(1, -(-total // points))
    number = func.row_number().over(order_by=row.id)
    numbered = select(row.id, number.label("n")).where(row.experiment_id == experiment_id).subquery()
    query = (
        select(row.feedback, row.data)
        .join(numbered, numbered.c.id == row.id)
        .where((numbered.c.n % stride == 0) | (numbered.c.n == total))
        .order_by(row.id)
    )
    return session.execute(query).all()


def _of_metrics(name: str, sampled: Sequence[Any], columns: Iterable[str]) -> Chart:
    found = [
        Curve(name=column, x=[row.feedback for row in sampled], y=[_rounded(row.data.get(column)) for row in sampled])
        for column in columns
        if any(column in row.data for row in sampled)
    ]
    return Chart(name=name, axis="feedback", curves=found)


def _rounded(value: float | None) -> float | None:
    """To six digits: more can't be seen, and doubles the answer."""
    return None if value is None else float(f"{value:.6g}")


def _others(sampled: Sequence[Any]) -> list[Chart]:
    """What a foreign algorithm reports, each in a chart of its own."""
    known = {name for group in (*COUNTED.values(), *GROUPED.values()) for name in group} | ELSEWHERE
    names = sorted({name for row in sampled[-1:] for name in row.data} - known)
    return [_of_metrics(name, sampled, [name]) for name in names]


def _labels(session: Session, experiment: ExperimentRow, points: int) -> list[Any]:
    """Means over buckets of successive labels. Those of an open proposal are told once nobody is asked any more."""
    value = FeedbackRow.label
    label = (
        select(FeedbackRow.id, value.label("value"), ProposalRow.predicted_feedback.label("predicted"))
        .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
        .where(
            ProposalRow.purpose == "training",
            ProposalRow.closed_at.is_not(None),
            FeedbackRow.experiment_id == experiment.id,
            FeedbackRow.status.in_(COUNTING),
            FeedbackRow.undone_at.is_(None),
            value.is_not(None),
        )
        .subquery()
    )
    number = func.row_number().over(order_by=label.c.id)
    each = select(number.label("n"), label.c.value, label.c.predicted).subquery()
    bucket = (each.c.n - 1) // max(LEAST, -(-experiment.feedback // points))
    query = (
        select(
            func.max(each.c.n).label("n"),
            func.avg(case((each.c.value == 1, 1.0), else_=0.0)).label("good"),
            func.avg(each.c.predicted).label("predicted"),
            func.avg(each.c.value * 1.0).label("label"),
            func.avg(func.abs(each.c.predicted - each.c.value)).label("error"),
        )
        .group_by(bucket)
        .order_by(bucket)
    )
    return list(session.execute(query))


def _bucketed(buckets: Sequence[Any], column: str, name: str | None = None) -> Curve:
    values = [_rounded(getattr(row, column)) for row in buckets]
    return Curve(name=name or column, x=[float(row.n) for row in buckets], y=values)


def _good_share(sampled: Sequence[Any], buckets: Sequence[Any]) -> Chart:
    overall = _of_metrics("good_share", sampled, ["good_share"]).curves
    recent = [_bucketed(buckets, "good", "recent")] if buckets else []
    return Chart(name="good_share", axis="feedback", curves=[*overall, *recent])


def _estimates(buckets: Sequence[Any]) -> Chart:
    found = [_bucketed(buckets, "predicted"), _bucketed(buckets, "label")] if buckets else []
    return Chart(name="estimates", axis="feedback", curves=found)


def _estimate_error(buckets: Sequence[Any]) -> Chart:
    found = [_bucketed(buckets, "error", "estimate_error")] if buckets else []
    return Chart(name="estimate_error", axis="feedback", curves=found)


def _skills(session: Session, experiment: ExperimentRow, points: int) -> Chart:
    """Each skill's share of the proposals, bucket by bucket."""
    row = ProposalRow
    where = (row.experiment_id == experiment.id, row.purpose == "training")
    numbered = select(row.skill, func.row_number().over(order_by=row.id).label("n")).where(*where).subquery()
    bucket = (numbered.c.n - 1) // max(LEAST, -(-experiment.proposals // points))
    query = (
        select(bucket, numbered.c.skill, func.count(), func.max(numbered.c.n))
        .group_by(bucket, numbered.c.skill)
        .order_by(bucket)
    )
    counts: dict[int, dict[str, int]] = defaultdict(dict)
    ends: dict[int, int] = {}
    for place, skill, count, end in session.execute(query):
        counts[place][skill] = count
        ends[place] = max(ends.get(place, 0), end)
    skills = sorted({skill for each in counts.values() for skill in each})
    x = [float(end) for end in ends.values()]
    curves = [Curve(name=skill, x=x, y=_shares(counts, skill)) for skill in skills]
    return Chart(name="skills", axis="proposals", curves=curves)


def _shares(counts: Mapping[int, Mapping[str, int]], skill: str) -> list[float | None]:
    return [_rounded(each.get(skill, 0) / sum(each.values())) for each in counts.values()]


def _training() -> ColumnElement[bool]:
    """Of a feedback: people's or a teacher's, not an evaluation's own; on a proposal that is closed."""
    of = ProposalRow
    return exists().where(of.id == FeedbackRow.proposal_id, of.purpose == "training", of.closed_at.is_not(None))


def _throughput(session: Session, experiment: ExperimentRow, points: int) -> Chart:
    """Labels a minute while somebody labels."""
    row = FeedbackRow
    at = extract("epoch", row.received_at)
    where = (row.experiment_id == experiment.id, row.status.in_(COUNTING), row.undone_at.is_(None), _training())
    each = (
        select(
            func.row_number().over(order_by=row.id).label("n"),
            (at - func.lag(at).over(order_by=row.id)).label("gap"),
        )
        .where(*where)
        .subquery()
    )
    bucket = (each.c.n - 1) // max(LEAST_TIMED, -(-experiment.feedback // points))
    worked = each.c.gap <= PAUSE
    query = (
        select(
            func.max(each.c.n),
            func.sum(case((worked, 1), else_=0)),
            func.sum(case((worked, each.c.gap), else_=0)),
        )
        .group_by(bucket)
        .order_by(bucket)
    )
    # PostgreSQL answers with decimals, and knows the fractions of a second that SQLite's gaps have lost
    found = [(float(n), 60.0 * count / float(seconds)) for n, count, seconds in session.execute(query) if seconds]
    curve = Curve(name="throughput", x=[n for n, _ in found], y=[speed for _, speed in found])
    return Chart(name="throughput", axis="feedback", curves=[curve] if found else [])
