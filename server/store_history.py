"""What happened, read back: closed proposals with their clicks and executions, and episodes. Nothing runs for it."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from sqlalchemy import ColumnElement, func, select
from sqlalchemy.orm import Session, selectinload

from server import store_pages
from server import store_wire as wire
from server.models import COUNTING, EpisodeRow, ExecutionRow, FeedbackRow, ProposalRow
from server.models_incidents import ViolationRow
from server.schemas_history import Episode, EpisodePage, HistoryEntry, HistoryFilter, HistoryPage
from server.store_errors import NotFound
from server.store_experiments import load

_VALUES = {"good": 1, "neutral": 0, "bad": -1}


def history(session: Session, experiment_id: int, wanted: HistoryFilter, cursor: str | None, limit: int) -> HistoryPage:
    """One page. An open proposal isn't in it: what others say of it must sway nobody.

    Raises:
        NotFound: no such experiment. BadCursor: no page handed it out.
    """
    load(session, experiment_id)
    row = ProposalRow
    query = (
        select(row)
        .options(selectinload(row.heard))
        .where(row.experiment_id == experiment_id, row.closed_at.is_not(None), *_narrowed(wanted, experiment_id))
    )
    rows, after = store_pages.page(
        session, query, row.id, _as_it_is, cursor=cursor, limit=limit, newest_first=wanted.order == "desc"
    )
    return HistoryPage(items=_entries(session, rows), next_cursor=after)


def episodes(session: Session, experiment_id: int, cursor: str | None, limit: int) -> EpisodePage:
    """One page, newest first."""
    load(session, experiment_id)
    query = select(EpisodeRow).where(EpisodeRow.experiment_id == experiment_id)
    rows, after = store_pages.page(session, query, EpisodeRow.id, _as_it_is, cursor=cursor, limit=limit)
    return EpisodePage(items=_told(session, rows), next_cursor=after)


def episode(session: Session, experiment_id: int, number: int) -> Episode:
    """One episode.

    Raises:
        NotFound: no such experiment, or no such episode of it.
    """
    load(session, experiment_id)
    query = select(EpisodeRow).where(EpisodeRow.experiment_id == experiment_id, EpisodeRow.number == number)
    row = session.scalars(query).one_or_none()
    if row is None:
        raise NotFound("episode of this experiment", number)
    return _told(session, [row])[0]


def _as_it_is(row: Any) -> Any:
    return row


def _narrowed(wanted: HistoryFilter, experiment_id: int) -> list[ColumnElement[bool]]:
    row = ProposalRow
    found: list[ColumnElement[bool]] = []
    if wanted.skill is not None:
        found.append(row.skill == wanted.skill)
    if wanted.verdict is not None:
        found.append(row.verdict.is_(None) if wanted.verdict == "none" else row.verdict == wanted.verdict)
    if wanted.purpose is not None:
        found.append(row.purpose == wanted.purpose)
    if wanted.episode is not None:
        number, of = EpisodeRow.number == wanted.episode, EpisodeRow.experiment_id == experiment_id
        found.append(row.episode_id.in_(select(EpisodeRow.id).where(number, of)))
    if wanted.label is not None:
        value = FeedbackRow.label
        said = value.is_(None) if wanted.label == "cant_tell" else value == _VALUES[wanted.label]
        counts = (FeedbackRow.status.in_(COUNTING), FeedbackRow.undone_at.is_(None))
        found.append(select(FeedbackRow.id).where(FeedbackRow.proposal_id == row.id, *counts, said).exists())
    if wanted.executed is not None:
        ran = select(ExecutionRow.id).where(ExecutionRow.proposal_id == row.id).exists()
        found.append(ran if wanted.executed else ~ran)
    if wanted.violation is not None:
        violated = (
            select(ViolationRow.id)
            .join(ExecutionRow, ExecutionRow.id == ViolationRow.execution_id)
            .where(ExecutionRow.proposal_id == row.id)
            .exists()
        )
        found.append(violated if wanted.violation else ~violated)
    return found


def _entries(session: Session, rows: list[ProposalRow]) -> list[HistoryEntry]:
    ids = [row.id for row in rows]
    clicks: dict[int, list[FeedbackRow]] = defaultdict(list)
    said = (
        select(FeedbackRow)
        .options(selectinload(FeedbackRow.relabels))
        .where(FeedbackRow.proposal_id.in_(ids))
        .order_by(FeedbackRow.id)
    )
    for click in session.scalars(said):
        clicks[click.proposal_id].append(click)
    ran = {each.proposal_id: each for each in session.scalars(
        select(ExecutionRow).where(ExecutionRow.proposal_id.in_(ids))
    )}  # fmt: skip
    return [
        HistoryEntry(
            proposal=wire.proposal(row),
            feedback=[wire.feedback(click) for click in clicks[row.id]],
            execution=wire.execution(ran[row.id]) if row.id in ran else None,
        )
        for row in rows
    ]


def _told(session: Session, rows: list[EpisodeRow]) -> list[Episode]:
    """With what happened in each, counted."""
    counts = (
        select(
            ProposalRow.episode_id,
            func.count(ProposalRow.id.distinct()),
            func.count(ExecutionRow.id.distinct()),
            func.count(ViolationRow.id),
        )
        .outerjoin(ExecutionRow, ExecutionRow.proposal_id == ProposalRow.id)
        .outerjoin(ViolationRow, ViolationRow.execution_id == ExecutionRow.id)
        .where(ProposalRow.episode_id.in_([row.id for row in rows]))
        .group_by(ProposalRow.episode_id)
    )
    found = {episode_id: tuple(rest) for episode_id, *rest in session.execute(counts)}
    names = ("proposals", "executions", "violations")
    return [
        Episode.model_validate(
            {
                **{name: getattr(row, name) for name in Episode.model_fields if name not in names},
                **dict(zip(names, found.get(row.id, (0, 0, 0)), strict=True)),
            }
        )
        for row in rows
    ]
