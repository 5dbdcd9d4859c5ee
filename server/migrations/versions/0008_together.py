"""Several trainers: rules weighted by reliability, and several open proposals of one robot, each in a slot."""

import sqlalchemy as sa
from alembic import op

from server.migrations.rebuilding import allow

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None

CLOSED = ("judged", "cant_tell", "timed_out", "withdrawn", "interrupted")
RULES = ("first", "majority", "unanimous")
OPEN = sa.text("closed_at IS NULL")


def upgrade() -> None:
    allow("experiment", "aggregation", RULES, (*RULES, "weighted"))
    op.add_column("experiment", sa.Column("together", sa.JSON(), nullable=False, server_default=sa.text("'{}'")))
    allow("proposal", "close_reason", CLOSED, ("judged", "cant_tell", "superseded", *CLOSED[2:]))
    # a robot's one open proposal of before is in the first slot
    op.add_column("proposal", sa.Column("slot", sa.Integer(), nullable=False, server_default=sa.text("0")))
    # by which rule a verdict of before was reached wasn't written down, and stays unknown
    op.add_column("proposal", sa.Column("rule", sa.String(), nullable=True))
    # in one statement: SQLite takes a constraint with a new column, and none afterwards
    op.execute(
        "ALTER TABLE proposal ADD COLUMN superseded_by INTEGER"
        " CONSTRAINT fk_proposal_superseded_by REFERENCES proposal (id)"
    )
    op.drop_index("uq_proposal_open", table_name="proposal")
    op.create_index(
        "uq_proposal_open",
        "proposal",
        ["experiment_id", "robot", "slot"],
        unique=True,
        sqlite_where=OPEN,
        postgresql_where=OPEN,
    )
