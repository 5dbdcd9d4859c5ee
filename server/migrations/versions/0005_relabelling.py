"""Corrections of earlier clicks, and the answer that nothing can be told from the view."""

import sqlalchemy as sa
from alembic import op

from server.migrations.rebuilding import allow, rebuild

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None

CLOSED = ("judged", "timed_out", "withdrawn", "interrupted")
STATUSES = ("stored", "late")


def upgrade() -> None:
    allow("proposal", "close_reason", CLOSED, ("judged", "cant_tell", *CLOSED[1:]))
    allow("feedback", "status", STATUSES, (*STATUSES, "practice"))
    if op.get_bind().dialect.name == "sqlite":
        rebuild("feedback", [("value INTEGER NOT NULL", "value INTEGER")])
    else:
        op.alter_column("feedback", "value", nullable=True)
    for counter in ("cant_tell", "relabelled"):
        op.add_column("experiment", sa.Column(counter, sa.Integer(), nullable=False, server_default=sa.text("0")))
    op.create_table(
        "relabel",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("click_id", sa.String(length=64), nullable=False),
        sa.Column("feedback_id", sa.Integer(), nullable=False),
        sa.Column("trainer_id", sa.Integer(), nullable=False),
        sa.Column("value", sa.Integer(), nullable=True),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.CheckConstraint("value IN (-1, 0, 1)", name=op.f("ck_relabel_value")),
        sa.ForeignKeyConstraint(["feedback_id"], ["feedback.id"], name=op.f("fk_relabel_feedback_id")),
        sa.ForeignKeyConstraint(["trainer_id"], ["trainer.id"], name=op.f("fk_relabel_trainer_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_relabel")),
        sa.UniqueConstraint("click_id", name=op.f("uq_relabel_click_id")),
    )
    op.create_index("ix_relabel_feedback_id_id", "relabel", ["feedback_id", "id"])
