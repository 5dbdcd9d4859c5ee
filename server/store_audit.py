"""The audit: who decided what, when, from which session. Written in the transaction of what it tells of."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import AsyncIterator
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from sqlalchemy import Select, select
from sqlalchemy.orm import Session

from server import store_pages
from server.models_people import AuditRow
from server.principal import SERVICE, Principal
from server.schemas_people import AuditEntry, AuditPage

if TYPE_CHECKING:
    from server.store import Store

DECISIONS = frozenset(
    {
        *("created", "updated", "start", "pause", "resume", "finish", "halt", "rearm", "reset", "archive"),
        *("gate", "execution_started", "execution_reported", "evaluation_started"),
        *("relabelled", "undone", "gold_marked", "gold_unmarked", "auto_approved"),
    }
)
"""Kinds of lines of an experiment's journal that are decisions. Clicks, attendance and access are recorded by name."""
COLUMNS = ("id", "at", "name", "role", "person_id", "session_id", "experiment_id", "action", "subject")
CHUNK = 1000


def record(
    session: Session, action: str, experiment_id: int | None = None, *, by: str | None = None, **subject: Any
) -> None:
    """Write down a decision of whoever acts in this transaction.

    by: the name that a client gave where nobody signs in; with a login it says nothing.
    """
    who: Principal = session.info.get("who", SERVICE)
    session.add(
        AuditRow(
            at=datetime.now(UTC),
            name=by if by is not None and who.local else who.name,
            role=who.role.value,
            person_id=who.person_id,
            session_id=who.session_id,
            experiment_id=experiment_id,
            action=action,
            subject=subject,
        )
    )


def page(session: Session, experiment_id: int | None, cursor: str | None, limit: int) -> AuditPage:
    """Newest first; of one experiment, or of everything."""
    query = _query(experiment_id)
    entries, following = store_pages.page(session, query, AuditRow.id, _wire, cursor=cursor, limit=limit)
    return AuditPage(items=entries, next_cursor=following)


async def table(store: Store, experiment_id: int | None) -> AsyncIterator[str]:
    """The whole of it as CSV, oldest first, piece by piece."""
    yield _csv([COLUMNS])
    after = 0
    while True:
        entries = await store.read(_reading(experiment_id, after))
        if not entries:
            return
        yield _csv([_cells(entry) for entry in entries])
        after = entries[-1].id


def _query(experiment_id: int | None) -> Select[Any]:
    query = select(AuditRow)
    return query if experiment_id is None else query.where(AuditRow.experiment_id == experiment_id)


def _reading(experiment_id: int | None, after: int) -> Any:
    query = _query(experiment_id).where(AuditRow.id > after).order_by(AuditRow.id).limit(CHUNK)
    return lambda session: [_wire(row) for row in session.scalars(query)]


def _wire(row: AuditRow) -> AuditEntry:
    return AuditEntry(**{column: getattr(row, column) for column in COLUMNS})


def _cells(entry: AuditEntry) -> tuple[Any, ...]:
    return (
        *(entry.id, entry.at.isoformat(), _plain(entry.name), entry.role, entry.person_id, entry.session_id),
        *(entry.experiment_id, entry.action, json.dumps(entry.subject)),
    )


def _plain(text: str) -> str:
    """A name that a spreadsheet would take for a formula is led by an apostrophe."""
    return f"'{text}" if text.startswith(("=", "+", "-", "@")) else text


def _csv(rows: list[tuple[Any, ...]]) -> str:
    out = io.StringIO()
    csv.writer(out).writerows(rows)
    return out.getvalue()
