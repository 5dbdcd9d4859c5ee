"""Tokens that somebody signs in by a single time. Those of before stay what they were."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("session", sa.Column("once", sa.Boolean(), nullable=False, server_default=sa.false()))
