"""Labels of proposals that another one's approval has closed: they train, and decide nothing."""

import sqlalchemy as sa
from alembic import op

from server.migrations.rebuilding import allow

revision = "0012"
down_revision = "0011"
branch_labels = None
depends_on = None

COUNTS = sa.text("status IN ('stored', 'overtaken') AND undone_at IS NULL")


def upgrade() -> None:
    allow("feedback", "status", ("stored", "late", "practice"), ("stored", "overtaken", "late", "practice"))
    op.drop_index("uq_feedback_one_vote", table_name="feedback")
    op.create_index(
        "uq_feedback_one_vote",
        "feedback",
        ["proposal_id", "trainer_id"],
        unique=True,
        sqlite_where=COUNTS,
        postgresql_where=COUNTS,
    )
