"""An experiment's clicks as columns, for figures that take all of them in: 31 bytes a click, where objects take 800."""

from __future__ import annotations

from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Select, case, func, select
from sqlalchemy.orm import Session

from server.models import COUNTING, FeedbackRow, ProposalRow, RelabelRow, TrainerRow
from server.reliability import Said
from server.trainer_figures import NOTHING, Clicks, Person

CHUNK = 500
"""Rows held as objects at once: with ten times as many, the garbage collector takes half of the time."""


def clicks(session: Session, experiment_id: int) -> Clicks:
    """Those that weren't taken back, without practice, in the order they came."""
    query = select(
        FeedbackRow.id,
        FeedbackRow.proposal_id,
        FeedbackRow.trainer_id,
        func.coalesce(FeedbackRow.value, NOTHING),
        case((FeedbackRow.status.in_(COUNTING), 1), else_=0),
        case({"good": 1, "neutral": 0, "bad": -1}, value=ProposalRow.verdict, else_=NOTHING),
        func.coalesce(ProposalRow.known_answer, NOTHING),
        FeedbackRow.received_at,
    )
    read = _columns(session, _of(query, experiment_id), "qqibbbbd")
    ids, proposal, trainer, value, counted, verdict, known, seconds = read
    label, relabelled = _corrected(session, experiment_id, ids, value)
    at = np.rint(seconds * 1e6).astype(np.int64)
    word = words(proposal, trainer, counted)
    return Clicks(proposal, trainer, value, label, counted != 0, word, relabelled, verdict, known, at)


def said(session: Session, experiment_id: int) -> Said:
    """Everybody's one word on each proposal, where it was good, neutral or bad."""
    query = select(
        FeedbackRow.proposal_id,
        FeedbackRow.trainer_id,
        func.coalesce(FeedbackRow.value, NOTHING),
        case((FeedbackRow.status.in_(COUNTING), 1), else_=0),
    )
    proposal, trainer, value, counted = _columns(session, _of(query, experiment_id), "qibb")
    says = words(proposal, trainer, counted) & (value != NOTHING)
    return Said(proposal[says], trainer[says], value[says])


def words(proposal: NDArray[Any], trainer: NDArray[Any], counted: NDArray[Any]) -> NDArray[np.bool_]:
    """(N,) Whether a click is its trainer's one word on its proposal: the one that counts, else the first late one.

    Who clicks on after the verdict is known, from a second tab or to look better, says nothing by it.
    """
    order = np.lexsort((counted == 0, trainer, proposal))  # stable: of two late ones the earlier stays ahead
    new = np.ones(len(order), np.bool_)
    new[1:] = (np.diff(proposal[order]) != 0) | (np.diff(trainer[order]) != 0)
    word = np.zeros(len(order), np.bool_)
    word[order[new]] = True
    return word


def people(session: Session, experiment_id: int) -> dict[int, Person]:
    """Who has clicked in an experiment, by id."""
    whose = select(FeedbackRow.trainer_id).where(FeedbackRow.experiment_id == experiment_id)
    query = select(TrainerRow.id, TrainerRow.name, TrainerRow.kind).where(TrainerRow.id.in_(whose))
    return {number: Person(name, kind) for number, name, kind in session.execute(query)}


def _corrected(
    session: Session, experiment_id: int, ids: NDArray[Any], value: NDArray[Any]
) -> tuple[NDArray[np.int8], NDArray[np.bool_]]:
    """What each click says by now, and whether it was ever corrected. ids: (N,), ascending."""
    query = select(RelabelRow.feedback_id, func.coalesce(RelabelRow.value, NOTHING)).order_by(RelabelRow.id)
    query = query.join(FeedbackRow, FeedbackRow.id == RelabelRow.feedback_id)
    clicked, newer = _columns(session, query.where(FeedbackRow.experiment_id == experiment_id), "qb")
    label, relabelled = value.copy(), np.zeros(len(ids), np.bool_)
    here = np.isin(clicked, ids)
    at = np.searchsorted(ids, clicked[here])
    label[at] = newer[here]  # where an index is there twice, numpy keeps what comes last
    relabelled[at] = True
    return label, relabelled


def _columns(session: Session, query: Select[*tuple[Any, ...]], kinds: str) -> list[NDArray[Any]]:
    """Of numbers and times, a letter for each: `q` 8 bytes, `i` 4, `b` 1, `d` a time in seconds since the epoch."""
    read = [array(kind) for kind in kinds]
    # rows of the connection, not of the session: nothing is made of them
    rows = session.connection().execute(query.execution_options(yield_per=CHUNK))
    for some in rows.partitions():
        for kind, held, column in zip(kinds, read, zip(*some, strict=True), strict=True):
            held.extend([each.timestamp() for each in column] if kind == "d" else column)
    return [np.asarray(held) for held in read]


def _of(query: Select[*tuple[Any, ...]], experiment_id: int) -> Select[*tuple[Any, ...]]:
    heard = (
        FeedbackRow.experiment_id == experiment_id,
        FeedbackRow.undone_at.is_(None),
        FeedbackRow.status != "practice",
        ProposalRow.purpose == "training",
        # nobody's figures may tell what was said of a proposal on which others are still asked
        ProposalRow.closed_at.is_not(None),
    )
    return query.join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id).where(*heard).order_by(FeedbackRow.id)
