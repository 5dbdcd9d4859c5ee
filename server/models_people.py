"""The tables of who may come in, and of who has decided what."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import CheckConstraint, ForeignKey, Index, String, false
from sqlalchemy.orm import Mapped, mapped_column, relationship

from server.models_base import Base, one_of

ROLES = ("viewer", "trainer", "operator", "owner")
DIGEST = String(64)
"""SHA-256 of a token, in hex. The tokens are 256 random bits: there is nothing to guess, so no slow hash is needed."""


class InvitationRow(Base):
    """A link that lets people in, as often as it says and until when it says."""

    __tablename__ = "invitation"
    __table_args__ = (one_of("role", *ROLES), CheckConstraint("used <= uses", name="used"))

    id: Mapped[int] = mapped_column(primary_key=True)
    digest: Mapped[str] = mapped_column(DIGEST, unique=True)
    role: Mapped[str]
    experiment_id: Mapped[int | None] = mapped_column(ForeignKey("experiment.id"))
    note: Mapped[str]
    uses: Mapped[int]
    used: Mapped[int] = mapped_column(default=0)
    expires_at: Mapped[datetime]
    access_until: Mapped[datetime | None]
    invited_by: Mapped[str]
    created_at: Mapped[datetime]
    revoked_at: Mapped[datetime | None]


class PersonRow(Base):
    """Somebody who was let in. Names are given once, so that an audit of last year still means one person."""

    __tablename__ = "person"
    __table_args__ = (one_of("role", *ROLES),)

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(unique=True)
    role: Mapped[str]
    experiment_id: Mapped[int | None] = mapped_column(ForeignKey("experiment.id"))
    invitation_id: Mapped[int | None] = mapped_column(ForeignKey("invitation.id"))
    access_until: Mapped[datetime | None]
    created_at: Mapped[datetime]
    revoked_at: Mapped[datetime | None]

    sessions: Mapped[list[SessionRow]] = relationship(back_populates="person", order_by="SessionRow.id")


class SessionRow(Base):
    """A browser that somebody signed in with, or a token that they gave to a program."""

    __tablename__ = "session"
    __table_args__ = (one_of("kind", "page", "token"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    person_id: Mapped[int] = mapped_column(ForeignKey("person.id"), index=True)
    digest: Mapped[str] = mapped_column(DIGEST, unique=True)
    kind: Mapped[str]
    note: Mapped[str]
    once: Mapped[bool] = mapped_column(default=False, server_default=false())
    """A token that opens nothing by itself: somebody signs in by it, a single time."""
    created_at: Mapped[datetime]
    expires_at: Mapped[datetime | None]
    revoked_at: Mapped[datetime | None]

    person: Mapped[PersonRow] = relationship(back_populates="sessions", lazy="joined", innerjoin=True)


class AuditRow(Base):
    """A decision: who, what, when, from which session. Triggers of the database refuse to change or delete a row."""

    __tablename__ = "audit"
    __table_args__ = (Index("ix_audit_experiment_id_id", "experiment_id", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    at: Mapped[datetime]
    name: Mapped[str]
    role: Mapped[str]
    person_id: Mapped[int | None] = mapped_column(ForeignKey("person.id"))
    session_id: Mapped[int | None] = mapped_column(ForeignKey("session.id"))
    experiment_id: Mapped[int | None] = mapped_column(ForeignKey("experiment.id"))
    action: Mapped[str]
    subject: Mapped[dict[str, Any]]
