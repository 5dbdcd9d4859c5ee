"""An experiment's feedback as a table, one line for each click and each correction; and its metrics, one a label."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import AsyncIterator, Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

from sqlalchemy import select
from sqlalchemy.orm import Session, defer, joinedload, selectinload

from server import store_audit, store_records
from server.models import EpisodeRow, FeedbackRow, MetricRow, ObservationRow, ProposalRow
from server.schemas_labels import answer_of
from server.schemas_people import AuditEntry
from server.store import Store

Form = Literal["csv", "jsonl"]
MEDIA_TYPES: Mapping[Form, str] = {"csv": "text/csv; charset=utf-8", "jsonl": "application/x-ndjson"}

COLUMNS = (
    *(
        "act",
        "feedback_id",
        "click_id",
        "at",
        "trainer",
        "kind",
        "answer",
        "label_now",
        "status",
        "undone_at",
        "estimate_shown",
    ),
    *("proposal_id", "proposal_number", "episode", "robot", "observation_id", "skill", "parameters"),
    *("predicted_feedback", "policy_version", "verdict", "verdict_source", "close_reason", "gold", "known_answer"),
)
"""act: `click`, or `relabel`, whose `trainer` is who corrected it and whose `at` is when."""
FORMULAS = frozenset("=+-@\t\r\n")
"""How a formula may begin in one spreadsheet or another."""
CHUNK = 500
"""Rows read at once: an export of any size needs little memory, and holds up nobody."""


async def feedback(store: Store, experiment_id: int, form: Form) -> AsyncIterator[str]:
    """The whole table, piece by piece. Practice is in it, by its `status`."""
    if form == "csv":
        yield _csv([dict(zip(COLUMNS, COLUMNS, strict=True))])
    after = 0
    while True:
        rows, after = await store.read(_reading(experiment_id, after))
        if not rows:
            return
        yield _csv(rows) if form == "csv" else "".join(json.dumps(row) + "\n" for row in rows)


async def metrics(store: Store, experiment_id: int, form: Form) -> AsyncIterator[str]:
    """Every metric point in the order they came; the columns are those of all points, by the alphabet."""
    names = await store.read(lambda session: store_records.metric_names(session, experiment_id))
    columns = ("feedback", "at", *names)
    if form == "csv":
        yield _lines([[_cell(column) for column in columns]])
    after = 0
    while True:
        rows, after = await store.read(_points(experiment_id, after))
        if not rows:
            return
        if form == "csv":
            yield _lines([[row.get(column, "") for column in columns] for row in rows])
        else:
            yield "".join(json.dumps(row) + "\n" for row in rows)


async def audit(store: Store, experiment_id: int | None) -> AsyncIterator[str]:
    """Every decision as CSV, oldest first; of one experiment, or of everything."""
    yield _lines([list(AuditEntry.model_fields)])
    last = 0
    while entries := await store.read(_decisions(experiment_id, last)):
        rows = [entry.model_dump() | {"at": entry.at.isoformat()} for entry in entries]
        yield _lines([[_cell(value) for value in row.values()] for row in rows])
        last = entries[-1].id


def _decisions(experiment_id: int | None, last: int) -> Callable[[Session], list[AuditEntry]]:
    return lambda session: store_audit.after(session, experiment_id, last, CHUNK)


def _points(experiment_id: int, after: int) -> Callable[[Session], tuple[list[dict[str, Any]], int]]:
    def read(session: Session) -> tuple[list[dict[str, Any]], int]:
        row = MetricRow
        query = select(row).where(row.experiment_id == experiment_id, row.id > after).order_by(row.id).limit(CHUNK)
        found = session.scalars(query).all()
        rows = [{"feedback": each.feedback, "at": each.at.isoformat(), **each.data} for each in found]
        return rows, found[-1].id if found else after

    return read


def _reading(experiment_id: int, after: int) -> Callable[[Session], tuple[list[dict[str, Any]], int]]:
    def read(session: Session) -> tuple[list[dict[str, Any]], int]:
        query = (
            select(FeedbackRow, ProposalRow)
            .options(
                selectinload(FeedbackRow.relabels),
                # pictures and state are most of a row, and aren't in the table
                defer(ProposalRow.views),
                defer(ProposalRow.skill_probabilities),
                joinedload(ProposalRow.observation).load_only(ObservationRow.uid),
                joinedload(ProposalRow.episode).load_only(EpisodeRow.number),
            )
            .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
            .where(
                FeedbackRow.experiment_id == experiment_id,
                FeedbackRow.id > after,
                ProposalRow.purpose == "training",
            )
            .order_by(FeedbackRow.id)
            .limit(CHUNK)
        )
        found = session.execute(query).all()
        rows = [row for click, proposal in found for row in _rows(click, proposal)]
        return rows, found[-1][0].id if found else after

    return read


def _rows(click: FeedbackRow, proposal: ProposalRow) -> list[dict[str, Any]]:
    """The click, then its corrections. What was known or said of a proposal isn't told while it is open."""
    told = proposal.closed_at is not None
    known = proposal.known_answer if told else None
    shared = {
        "feedback_id": click.id,
        "label_now": answer_of(click.label) if told else None,
        "status": click.status,
        "undone_at": None if click.undone_at is None else click.undone_at.isoformat(),
        "estimate_shown": click.estimate_shown,
        "proposal_id": proposal.id,
        "proposal_number": proposal.number,
        "episode": proposal.episode.number,
        "robot": proposal.robot,
        "observation_id": proposal.observation.uid,
        "skill": proposal.skill,
        "parameters": dict(zip(proposal.parameter_names, proposal.parameters, strict=True)),
        "predicted_feedback": proposal.predicted_feedback,
        "policy_version": proposal.policy_version,
        "verdict": proposal.verdict,
        "verdict_source": proposal.verdict_source,
        "close_reason": proposal.close_reason,
        "gold": known is not None,
        "known_answer": known,
    }
    acts = [("click", click.click_id, click.received_at, click.trainer, click.value)]
    acts += [("relabel", each.click_id, each.at, each.trainer, each.value) for each in click.relabels]
    made = [
        {
            "act": act,
            "click_id": click_id,
            "at": at.isoformat(),
            "trainer": by.name,
            "kind": by.kind,
            "answer": answer_of(value) if told else None,
            **shared,
        }
        for act, click_id, at, by, value in acts
    ]
    return [{column: row[column] for column in COLUMNS} for row in made]


def _csv(rows: Sequence[Mapping[str, Any]]) -> str:
    return _lines([[_cell(row[column]) for column in COLUMNS] for row in rows])


def _lines(rows: Iterable[Sequence[Any]]) -> str:
    written = io.StringIO()
    csv.writer(written).writerows(rows)
    return written.getvalue()


def _cell(value: Any) -> Any:
    """A name that a spreadsheet would take for a formula is written as text (OWASP, "CSV Injection")."""
    if isinstance(value, dict):
        return json.dumps(value)
    if isinstance(value, bool):
        return str(value).lower()
    return f"'{value}" if isinstance(value, str) and value[:1] in FORMULAS else value
