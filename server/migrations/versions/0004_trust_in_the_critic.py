"""What the critic was unsure of, who a verdict is by, and the rule by which the critic may approve in simulation."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("proposal", sa.Column("uncertainty", sa.Double()))
    # in one statement: SQLite takes a constraint with a new column, and none afterwards
    op.execute(
        "ALTER TABLE proposal ADD COLUMN verdict_source VARCHAR"
        " CONSTRAINT ck_proposal_verdict_source CHECK (verdict_source IN ('trainers', 'critic', 'evaluation'))"
    )
    op.add_column("proposal", sa.Column("audit", sa.Boolean(), nullable=False, server_default=sa.text("false")))
    op.execute(
        "UPDATE proposal SET verdict_source = CASE purpose WHEN 'evaluation' THEN 'evaluation' ELSE 'trainers' END"
        " WHERE verdict IS NOT NULL"
    )
    op.add_column("experiment", sa.Column("auto_approved", sa.Integer(), nullable=False, server_default=sa.text("0")))
    op.add_column("experiment", sa.Column("auto_approval", sa.JSON()))
    op.add_column(
        "experiment", sa.Column("auto_approval_since", sa.Integer(), nullable=False, server_default=sa.text("0"))
    )
    op.add_column("experiment", sa.Column("auto_approval_suspended", sa.Text()))
