"""Known answers hidden among proposals, estimates of each trainer, and practice."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None

OPEN = sa.text("answered_at IS NULL")


def _id() -> Any:
    return sa.Column("id", sa.Integer(), nullable=False)


def _number(name: str, *, nullable: bool = False) -> Any:
    return sa.Column(name, sa.Integer(), nullable=nullable)


def _at(name: str, *, nullable: bool = False) -> Any:
    return sa.Column(name, sa.DateTime(timezone=True), nullable=nullable)


def _to(table: str, other: str) -> sa.ForeignKeyConstraint:
    name = op.f(f"fk_{table}_{other}_id")
    return sa.ForeignKeyConstraint([f"{other}_id"], [f"{other}.id"], name=name)


def upgrade() -> None:
    op.add_column("experiment", sa.Column("gold_rate", sa.Double(), nullable=False, server_default=sa.text("0")))
    op.add_column("experiment", sa.Column("practice_required", sa.JSON()))
    op.add_column("proposal", _number("known_answer", nullable=True))
    # in one statement: SQLite takes a constraint with a new column, and none afterwards
    op.execute(
        "ALTER TABLE proposal ADD COLUMN gold_of INTEGER CONSTRAINT fk_proposal_gold_of REFERENCES proposal (id)"
    )
    op.create_table(
        "gold_mark",
        _id(),
        _number("proposal_id"),
        _number("answer"),
        _number("trainer_id"),
        _at("at"),
        sa.CheckConstraint("answer IN (-1, 1)", name=op.f("ck_gold_mark_answer")),
        _to("gold_mark", "proposal"),
        _to("gold_mark", "trainer"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_gold_mark")),
        sa.UniqueConstraint("proposal_id", name=op.f("uq_gold_mark_proposal_id")),
    )
    op.create_table(
        "reliability",
        _number("experiment_id"),
        _number("trainer_id"),
        sa.Column("weight", sa.Double(), nullable=False),
        *(sa.Column(name, sa.Double()) for name in ("accuracy", "low", "high")),
        _number("labels"),
        _number("informative"),
        _at("at"),
        _to("reliability", "experiment"),
        _to("reliability", "trainer"),
        sa.PrimaryKeyConstraint("experiment_id", "trainer_id", name=op.f("pk_reliability")),
    )
    op.create_table(
        "practice",
        _id(),
        _number("experiment_id"),
        _number("trainer_id"),
        _number("number"),
        sa.Column("card", sa.JSON(), nullable=False),
        _number("known_answer"),
        _at("opened_at"),
        sa.Column("click_id", sa.String(length=64)),
        _number("value", nullable=True),
        _at("answered_at", nullable=True),
        sa.CheckConstraint("known_answer IN (-1, 1)", name=op.f("ck_practice_known_answer")),
        sa.CheckConstraint("value IN (-1, 0, 1)", name=op.f("ck_practice_value")),
        sa.CheckConstraint("(click_id IS NULL) = (answered_at IS NULL)", name=op.f("ck_practice_answered")),
        _to("practice", "experiment"),
        _to("practice", "trainer"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_practice")),
        sa.UniqueConstraint("click_id", name=op.f("uq_practice_click_id")),
        sa.UniqueConstraint(
            "experiment_id", "trainer_id", "number", name=op.f("uq_practice_experiment_id_trainer_id_number")
        ),
    )
    op.create_index(
        "uq_practice_open",
        "practice",
        ["experiment_id", "trainer_id"],
        unique=True,
        sqlite_where=OPEN,
        postgresql_where=OPEN,
    )
    op.create_table(
        "qualification",
        _number("experiment_id"),
        _number("trainer_id"),
        _at("at"),
        _to("qualification", "experiment"),
        _to("qualification", "trainer"),
        sa.PrimaryKeyConstraint("experiment_id", "trainer_id", name=op.f("pk_qualification")),
    )
