"""Changes a constraint of a table, which SQLite does only by writing the table anew."""

from __future__ import annotations

from collections.abc import Sequence

from alembic import op


def rebuild(table: str, changes: Sequence[tuple[str, str]]) -> None:
    """Write a SQLite table anew, each piece of its declaration replaced; indexes and whatever refers to it stay.

    Alembic's own way reads the table's declaration back, and loses its CHECK constraints by that.

    Raises:
        LookupError: a piece is not in the declaration exactly once.
    """
    connection = op.get_bind()
    found = "SELECT sql FROM sqlite_master WHERE type = '{}' AND tbl_name = '{}' AND sql IS NOT NULL"
    declared: str = connection.exec_driver_sql(found.format("table", table)).scalar_one()
    indexes = connection.exec_driver_sql(found.format("index", table)).scalars().all()
    for old, new in changes:
        if declared.count(old) != 1:
            raise LookupError(f"{table}: {old!r} is declared {declared.count(old)} times")
        declared = declared.replace(old, new)
    _, body = declared.split("(", 1)
    op.execute(f"CREATE TABLE {table}_anew ({body}")
    op.execute(f"INSERT INTO {table}_anew SELECT * FROM {table}")
    op.execute(f"DROP TABLE {table}")
    op.execute(f"ALTER TABLE {table}_anew RENAME TO {table}")
    for index in indexes:
        op.execute(index)


def allow(table: str, column: str, before: Sequence[str], after: Sequence[str]) -> None:
    """Change which words a column takes, in its constraint `ck_{table}_{column}`."""
    old, new = (f"{column} IN ({', '.join(repr(word) for word in words)})" for words in (before, after))
    name = f"ck_{table}_{column}"
    if op.get_bind().dialect.name == "sqlite":
        rebuild(table, [(f"CONSTRAINT {name} CHECK ({old})", f"CONSTRAINT {name} CHECK ({new})")])
    else:
        op.drop_constraint(op.f(name), table, type_="check")
        op.create_check_constraint(op.f(name), table, new)
