"""Alembic's way in. The connection comes with the configuration: there is no ini file and no URL here."""

from typing import Any, Literal

from alembic import context

from server import models, models_people, models_quality, models_tags  # noqa: F401 - their tables belong to the metadata too
from server.models_base import Base, UtcDateTime


def _render(kind: str, item: Any, _: Any) -> str | Literal[False]:
    """A migration must not depend on today's models: their own types are written as what they stand for."""
    return "sa.DateTime(timezone=True)" if kind == "type" and isinstance(item, UtcDateTime) else False


context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=Base.metadata,
    render_as_batch=True,  # SQLite can't alter a column in place
    compare_type=True,
    render_item=_render,
)
with context.begin_transaction():
    context.run_migrations()
