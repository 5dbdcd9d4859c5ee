"""Several robots in one experiment: which one each episode, proposal and execution is of."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None

ONE_EACH = (
    ("episode", "uq_episode_open", "ended_at IS NULL"),
    ("proposal", "uq_proposal_open", "closed_at IS NULL"),
    ("execution", "uq_execution_running", "ended_at IS NULL"),
)
"""Table, index and condition: of what may be there once, an experiment had one, and now each of its robots has."""


def upgrade() -> None:
    # experiments of before have one robot, the first
    op.add_column("experiment", sa.Column("num_envs", sa.Integer(), nullable=False, server_default=sa.text("1")))
    for table, index, condition in ONE_EACH:
        op.add_column(table, sa.Column("robot", sa.Integer(), nullable=False, server_default=sa.text("0")))
        op.drop_index(index, table_name=table)
        op.create_index(
            index,
            table,
            ["experiment_id", "robot"],
            unique=True,
            sqlite_where=sa.text(condition),
            postgresql_where=sa.text(condition),
        )
