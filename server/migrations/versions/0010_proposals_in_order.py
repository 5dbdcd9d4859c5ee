"""An experiment's newest proposals without looking at all of them."""

from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_index("ix_proposal_experiment_id_id", "proposal", ["experiment_id", "id"])
