"""Settings of an experiment's teacher."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    # experiments of before judged by the rule alone, which is what no settings mean
    op.add_column(
        "experiment", sa.Column("teacher_settings", sa.JSON(), nullable=False, server_default=sa.text("'{}'"))
    )
