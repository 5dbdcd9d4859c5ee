"""Who goes by a name that is the service's own: an earlier version let people in by any name."""

from __future__ import annotations

from sqlalchemy import select, union
from sqlalchemy.orm import Session

from server.models import TrainerRow
from server.models_people import PersonRow
from server.names import is_taken


def misnamed(session: Session) -> frozenset[str]:
    """Names of people which nobody would be let in by now."""
    query = union(select(PersonRow.name), select(TrainerRow.name).where(TrainerRow.kind == "person"))
    return frozenset(name for name in session.scalars(query) if is_taken(name))
