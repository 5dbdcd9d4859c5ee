"""The tables of label quality: known answers, estimates of each trainer, and practice."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import CheckConstraint, ForeignKey, Index, String, UniqueConstraint, text
from sqlalchemy.orm import Mapped, mapped_column, relationship

from server.models import ProposalRow, TrainerRow
from server.models_base import Base


class GoldMarkRow(Base):
    """A closed proposal whose answer an operator knows: it is put before trainers again, hidden among the others."""

    __tablename__ = "gold_mark"
    __table_args__ = (UniqueConstraint("proposal_id"), CheckConstraint("answer IN (-1, 1)", name="answer"))

    id: Mapped[int] = mapped_column(primary_key=True)
    proposal_id: Mapped[int] = mapped_column(ForeignKey("proposal.id"))
    answer: Mapped[int]
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"))
    at: Mapped[datetime]

    proposal: Mapped[ProposalRow] = relationship(lazy="joined", innerjoin=True)
    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)


class ReliabilityRow(Base):
    """The newest estimate of how often a trainer is right in an experiment; `weighted` reads `weight`."""

    __tablename__ = "reliability"

    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"), primary_key=True)
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"), primary_key=True)
    weight: Mapped[float]
    accuracy: Mapped[float | None]
    low: Mapped[float | None]
    high: Mapped[float | None]
    labels: Mapped[int]
    informative: Mapped[int]
    at: Mapped[datetime]

    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)


class PracticeRow(Base):
    """A practice proposal of one trainer: `card` is what they see, `known_answer` what they are told afterwards."""

    __tablename__ = "practice"
    __table_args__ = (
        UniqueConstraint("click_id"),
        UniqueConstraint("experiment_id", "trainer_id", "number"),
        CheckConstraint("known_answer IN (-1, 1)", name="known_answer"),
        CheckConstraint("value IN (-1, 0, 1)", name="value"),
        CheckConstraint("(click_id IS NULL) = (answered_at IS NULL)", name="answered"),
        Index(
            "uq_practice_open",
            "experiment_id",
            "trainer_id",
            unique=True,
            sqlite_where=text("answered_at IS NULL"),
            postgresql_where=text("answered_at IS NULL"),
        ),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"))
    number: Mapped[int]
    card: Mapped[dict[str, Any]]
    known_answer: Mapped[int]
    opened_at: Mapped[datetime]
    click_id: Mapped[str | None] = mapped_column(String(64))
    value: Mapped[int | None]
    answered_at: Mapped[datetime | None]

    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)


class QualificationRow(Base):
    """A trainer who has passed an experiment's practice: from then on their clicks count."""

    __tablename__ = "qualification"

    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"), primary_key=True)
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"), primary_key=True)
    at: Mapped[datetime]
