"""The tables of what went wrong: violations, reports of people on executions, and incidents with their video."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import ForeignKey, Index, String, Text, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column, relationship

from server.models import TrainerRow
from server.models_base import Base, one_of


class ViolationRow(Base):
    """A safety violation seen in an execution."""

    __tablename__ = "violation"
    __table_args__ = (one_of("kind", "damage", "manual_reset"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"), index=True)
    execution_id: Mapped[int] = mapped_column(ForeignKey("execution.id"), index=True)
    kind: Mapped[str]
    detail: Mapped[str] = mapped_column(Text)
    at: Mapped[datetime]


class ReportRow(Base):
    """What a person saw an execution do. Rows are never changed: the newest one of an execution is what counts."""

    __tablename__ = "report"
    __table_args__ = (
        UniqueConstraint("report_id"),
        one_of("outcome", "success", "failed", "damage", "needs_reset"),
        Index("ix_report_execution_id_id", "execution_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    report_id: Mapped[str] = mapped_column(String(64))
    execution_id: Mapped[int] = mapped_column(ForeignKey("execution.id"))
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"))
    outcome: Mapped[str]
    note: Mapped[str] = mapped_column(Text)
    at: Mapped[datetime]

    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)


class IncidentRow(Base):
    """A safety violation or an emergency stop, with the pictures of the seconds before: camera, hash, size and time."""

    __tablename__ = "incident"
    __table_args__ = (
        one_of("kind", "damage", "manual_reset", "halt"),
        Index("ix_incident_experiment_id_id", "experiment_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    execution_id: Mapped[int | None] = mapped_column(ForeignKey("execution.id"))
    kind: Mapped[str]
    detail: Mapped[str] = mapped_column(Text)
    frames: Mapped[list[Any]]
    at: Mapped[datetime]
