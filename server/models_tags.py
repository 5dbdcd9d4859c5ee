"""The table of tags: words by which a researcher finds experiments again."""

from __future__ import annotations

from sqlalchemy import ForeignKey, String
from sqlalchemy.orm import Mapped, mapped_column

from server.models_base import Base


class TagRow(Base):
    """One word on one experiment."""

    __tablename__ = "tag"

    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"), primary_key=True)
    tag: Mapped[str] = mapped_column(String(40), primary_key=True, index=True)
