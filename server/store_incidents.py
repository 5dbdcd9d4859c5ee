"""Reports on executions, and incidents. Every function runs inside one write transaction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sqlalchemy import select
from sqlalchemy.orm import Session

from server import schemas_incidents as wire
from server.models import ExecutionRow
from server.models_incidents import IncidentRow, ReportRow
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_labels import trainer


def report(session: Session, execution_id: int, body: wire.ReportCreate) -> tuple[ExecutionRow, bool]:
    """Keep what somebody saw; the second value: this very report is stored already.

    Raises:
        NotFound: no such execution. Conflict: it hasn't ended, or the report id was used for something else.
    """
    row = session.get(ExecutionRow, execution_id)
    if row is None:
        raise NotFound("execution", execution_id)
    known = session.scalars(select(ReportRow).where(ReportRow.report_id == body.report_id)).one_or_none()
    if known is not None:
        same = (known.execution_id, known.outcome, known.note, known.trainer.name)
        if same != (execution_id, body.outcome, body.note, body.trainer):
            raise Conflict(
                f"report {body.report_id} was stored with another content", remedy="make a new id for every report"
            )
        return row, True
    if row.outcome is None:
        raise Conflict(f"execution {execution_id} still moves the robot", remedy="report once it has ended")
    by = trainer(session, body.trainer, "person")
    session.add(
        ReportRow(
            report_id=body.report_id,
            execution_id=execution_id,
            trainer=by,
            outcome=body.outcome,
            note=body.note,
            at=now(),
        )
    )
    session.flush()
    session.refresh(row, ["reports"])
    journal(session, row.experiment_id, "execution_reported", execution=row.id, outcome=body.outcome, by=body.trainer)
    return row, False


def add_incident(
    session: Session,
    experiment_id: int,
    *,
    execution_id: int | None,
    kind: str,
    detail: str,
    frames: Sequence[dict[str, Any]],
) -> IncidentRow:
    """Keep an incident with the pictures of the seconds before."""
    load(session, experiment_id)
    row = IncidentRow(
        experiment_id=experiment_id, execution_id=execution_id, kind=kind, detail=detail, frames=list(frames), at=now()
    )
    session.add(row)
    session.flush()
    return row
