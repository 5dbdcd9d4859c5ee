"""How an experiment's labels came in over time: counted in the database, by stretches of the same length."""

from __future__ import annotations

from bisect import bisect_right
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import ColumnElement, case, extract, func, select
from sqlalchemy.orm import Session

from server.models import COUNTING, EpisodeRow, ExecutionRow, FeedbackRow, ProposalRow
from server.models_incidents import ViolationRow
from server.schemas_history import Stretch, Timeline
from server.store_experiments import load


def timeline(session: Session, experiment_id: int, most: int) -> Timeline:
    """Labels on closed proposals, as they are by now, in at most so many stretches; empty ones are left out.

    Raises:
        NotFound: no such experiment.
    """
    load(session, experiment_id)
    row, of = FeedbackRow, ProposalRow
    at = extract("epoch", row.received_at)
    where = (
        row.experiment_id == experiment_id,
        row.status.in_(COUNTING),
        row.undone_at.is_(None),
        of.purpose == "training",
        of.closed_at.is_not(None),
    )
    ends = select(func.min(at), func.max(at)).join(of, of.id == row.proposal_id).where(*where)
    first, last = session.execute(ends).one()
    if first is None:
        return Timeline(seconds=1, started_at=None, ended_at=None, stretches=[])
    start, end = int(first), int(last)
    seconds = -(-(end - start + 1) // most)
    labels = (
        select(_place(at, start, seconds).label("place"), row.label.label("value"), of.number)
        .join(of, of.id == row.proposal_id)
        .where(*where)
        .subquery()
    )
    counted = select(
        labels.c.place,
        *(func.sum(case((labels.c.value == value, 1), else_=0)) for value in (1, 0, -1)),
        func.count(),
        func.min(labels.c.number),
    ).group_by(labels.c.place)
    found = {int(place): rest for place, *rest in session.execute(counted)}
    steps = _episodes(session, experiment_id, [rest[-1] for rest in found.values()])
    ran = _executions(session, experiment_id, start, seconds, sorted(found))
    return Timeline(
        seconds=seconds,
        started_at=_moment(start),
        ended_at=_moment(end),
        stretches=[
            Stretch(
                at=_moment(start + place),
                good=good,
                neutral=neutral,
                bad=bad,
                cant_tell=total - good - neutral - bad,
                executions=ran.get(place, (0, 0))[0],
                violations=ran.get(place, (0, 0))[1],
                proposal=number,
                episode=steps[number],
            )
            for place, (good, neutral, bad, total, number) in sorted(found.items())
        ],
    )


def _place(at: Any, start: int, seconds: int) -> ColumnElement[Any]:
    """Seconds from the start to the beginning of the stretch; whole ones on both databases, without rounding."""
    since = at - start
    place: ColumnElement[Any] = since - since % seconds
    return place


def _moment(epoch: int) -> datetime:
    return datetime.fromtimestamp(epoch, UTC)


def _episodes(session: Session, experiment_id: int, numbers: list[int]) -> dict[int, int]:
    """Number of a proposal -> number of its episode."""
    row = ProposalRow
    query = (
        select(row.number, EpisodeRow.number)
        .join(EpisodeRow, EpisodeRow.id == row.episode_id)
        .where(row.experiment_id == experiment_id, row.number.in_(numbers))
    )
    return dict(session.execute(query).all())


def _executions(
    session: Session, experiment_id: int, start: int, seconds: int, places: list[int]
) -> dict[int, tuple[int, int]]:
    """Stretch -> motions that began in it or before the next, and those of them with a safety violation."""
    row = ExecutionRow
    violated = select(ViolationRow.id).where(ViolationRow.execution_id == row.id).exists()
    each = (
        select(
            _place(extract("epoch", row.started_at), start, seconds).label("place"),
            case((violated, 1), else_=0).label("violated"),
        )
        .join(ProposalRow, ProposalRow.id == row.proposal_id)
        .where(row.experiment_id == experiment_id, ProposalRow.purpose == "training")
        .subquery()
    )
    query = select(each.c.place, func.count(), func.sum(each.c.violated)).group_by(each.c.place)
    found: dict[int, tuple[int, int]] = {}
    for place, count, bad in session.execute(query):
        here = places[max(bisect_right(places, int(place)) - 1, 0)]
        before = found.get(here, (0, 0))
        found[here] = (before[0] + count, before[1] + bad)
    return found
