"""The audit: who decided what, when, from which session. Written in the transaction of what it tells of."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Select, insert, select
from sqlalchemy.orm import Session

from server import store_pages
from server.models import ProposalRow
from server.models_base import table
from server.models_people import AuditRow
from server.principal import SERVICE, Principal
from server.schemas_people import AuditEntry, AuditPage

DECISIONS = frozenset(
    {
        *("created", "updated", "start", "pause", "resume", "finish", "halt", "rearm", "reset", "archive"),
        *("gate", "execution_started", "execution_reported", "evaluation_started"),
        *("relabelled", "undone", "gold_marked", "gold_unmarked", "auto_approved", "practised"),
        *("attended", "unattended", "home_ordered", "recover_ordered", "cameras_calibrated"),
    }
)
"""Kinds of lines of an experiment's journal that are decisions. Clicks and access are recorded by name."""

_WRITE = insert(table(AuditRow))


def record(
    session: Session, action: str, experiment_id: int | None = None, *, by: str | None = None, **subject: Any
) -> None:
    """Write down a decision of whoever acts in this transaction.

    by: the name that a client gave where nobody signs in; with a login it says nothing.
    """
    who: Principal = session.info.get("who", SERVICE)
    entry = {
        "at": datetime.now(UTC),
        "name": by if by is not None and who.local else who.name,
        "role": who.role.value,
        "person_id": who.person_id,
        "session_id": who.session_id,
        "experiment_id": experiment_id,
        "action": action,
        "subject": subject,
    }
    session.connection().execute(_WRITE, entry)


def page(session: Session, experiment_id: int | None, cursor: str | None, limit: int) -> AuditPage:
    """Newest first; of one experiment, or of everything."""
    query = _query(experiment_id)
    entries, following = store_pages.page(session, query, AuditRow.id, _wire, cursor=cursor, limit=limit)
    return AuditPage(items=_told(session, entries), next_cursor=following)


def after(session: Session, experiment_id: int | None, last: int, limit: int) -> list[AuditEntry]:
    """The next ones after the id `last`, oldest first."""
    query = _query(experiment_id).where(AuditRow.id > last).order_by(AuditRow.id).limit(limit)
    return _told(session, [_wire(row) for row in session.scalars(query)])


def _query(experiment_id: int | None) -> Select[Any]:
    query = select(AuditRow)
    return query if experiment_id is None else query.where(AuditRow.experiment_id == experiment_id)


def _told(session: Session, entries: Sequence[AuditEntry]) -> list[AuditEntry]:
    """Without the `value` of a click on a proposal on which others are still asked: that is told once it is closed."""
    judged = {entry.subject.get("proposal") for entry in entries if entry.action == "clicked"}
    query = select(ProposalRow.id).where(ProposalRow.id.in_(judged), ProposalRow.closed_at.is_(None))
    asked = set(session.scalars(query)) if judged else set()
    return [
        entry.model_copy(update={"subject": {name: each for name, each in entry.subject.items() if name != "value"}})
        if entry.action == "clicked" and entry.subject.get("proposal") in asked
        else entry
        for entry in entries
    ]


def _wire(row: AuditRow) -> AuditEntry:
    return AuditEntry(**{field: getattr(row, field) for field in AuditEntry.model_fields})
