"""Brings a database to this version's revision before anything else touches it, after a backup."""

from __future__ import annotations

import os
import sqlite3
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import URL, Connection

from server.database import WRITER_LOCK, engine, translated
from server.store_errors import NewerDatabase, StoreError

MIGRATIONS = Path(__file__).parent / "migrations"


def prepare(url: URL, data_dir: Path, *, backup: bool = True, revision: str = "head") -> None:
    """Create the database or migrate it to `revision`. Blocks; call it before anything else has the database open.

    Raises:
        NewerDatabase: a newer version wrote it. ReadOnly, Full: it can't be migrated. Nothing has changed.
    """
    file = Path(url.database) if url.get_backend_name() == "sqlite" and url.database else None
    existed = file is not None and file.is_file() and file.stat().st_size > 0
    # foreign keys are off because SQLite alters a table by rebuilding it; they are checked before the commit
    made = engine(url, begin="BEGIN IMMEDIATE", foreign_keys=False)
    try:
        with translated():
            with made.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
                if not pending(connection, revision):
                    return
            if backup and existed and file is not None:
                back_up(file, data_dir / "backups")
            with made.begin() as connection:
                if connection.dialect.name == "postgresql":
                    connection.exec_driver_sql(f"SELECT pg_advisory_xact_lock({WRITER_LOCK})")
                upgrade(connection, revision)
                _check_foreign_keys(connection)
    finally:
        made.dispose()


def pending(connection: Connection, revision: str = "head") -> bool:
    """Whether the database lacks a migration.

    Raises:
        NewerDatabase: its revision is unknown here.
    """
    scripts = ScriptDirectory.from_config(_config(connection))
    known = {script.revision for script in scripts.walk_revisions()}
    current = MigrationContext.configure(connection).get_current_heads()
    for head in current:
        if head not in known:
            raise NewerDatabase(head)
    wanted = scripts.get_current_head() if revision == "head" else revision
    return set(current) != {wanted}


def upgrade(connection: Connection, revision: str = "head") -> None:
    """Run the migrations inside the connection's transaction."""
    command.upgrade(_config(connection), revision)


def revisions() -> list[str]:
    """Every revision, oldest first."""
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    return [script.revision for script in ScriptDirectory.from_config(config).walk_revisions()][::-1]


def back_up(file: Path, directory: Path) -> Path:
    """A consistent copy of a SQLite database, complete or not there at all."""
    directory.mkdir(parents=True, exist_ok=True)
    stamp = datetime.now(UTC).strftime("%Y%m%dT%H%M%S%f")
    target = directory / f"{file.stem}-{stamp}.db"
    partial = target.with_suffix(".part")
    with (
        closing(sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro", uri=True)) as source,
        closing(sqlite3.connect(partial)) as copy,
    ):
        source.backup(copy)
    with partial.open("rb") as written:
        os.fsync(written.fileno())
    return partial.replace(target)


def _config(connection: Connection) -> Config:
    config = Config(attributes={"connection": connection})
    config.set_main_option("script_location", str(MIGRATIONS))
    return config


def _check_foreign_keys(connection: Connection) -> None:
    if connection.dialect.name != "sqlite":
        return
    broken = connection.exec_driver_sql("PRAGMA foreign_key_check").first()
    if broken is not None:
        raise StoreError(
            f"the database has rows that refer to nothing: {tuple(broken)}",
            remedy="put back a copy from the directory `backups` and report this",
        )
