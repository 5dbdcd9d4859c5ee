"""A database of an older version opens after an upgrade with every row; one of a newer version is left alone."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from sqlalchemy import Engine, create_engine, inspect

from server.database import resolve
from server.models_base import Base
from server.schemas import CloseReason, Lifecycle, Verdict
from server.store import NewerDatabase, ReadOnly, Store, StoreError
from server.store_upgrade import prepare, revisions
from tests.server.databases import created

AT = "'2026-01-02 03:04:05'"
HASH = "'" + "a" * 64 + "'"
FIRST_ROWS = (
    "INSERT INTO experiment VALUES (1, 'old', 'stacking', 'kinematic', 'seed', NULL, '{}', '{}', 7, 'execute_approved',"
    " 'first', NULL, NULL, false, 'paused', true, NULL, 1, 1, 0, 0, 1, 2, 1, 40, 1, 1, 1, " + f"{AT}, {AT})",
    f"INSERT INTO trainer VALUES (1, 'local', 'person', {AT})",
    f"INSERT INTO episode VALUES (1, 1, 1, 'training', 3, 'success', {AT}, {AT})",
    "INSERT INTO observation VALUES (1, 1, 'o1', '[0.1, 0.2]', 1.5)",
    "INSERT INTO proposal VALUES (1, 1, 1, 1, 1, 'training', 'pick', '[0.5]', '[\"x\"]', "
    + HASH
    + ", 0.5, '{}', 3, NULL,"
    f" '[]', '[\"local\"]', {AT}, {AT}, 'judged', 'good', true, 'open')",
    "INSERT INTO proposal VALUES (2, 1, 1, 1, 2, 'training', 'pick', '[0.6]', '[\"x\"]', "
    + HASH
    + ", 0.5, '{}', 3, NULL,"
    f" '[]', '[\"local\"]', {AT}, {AT}, 'timed_out', NULL, NULL, NULL)",
    f"INSERT INTO feedback VALUES (1, 'click-0001', 1, 1, 1, 1, 'stored', {AT}, NULL)",
    f"INSERT INTO feedback VALUES (2, 'click-0002', 1, 2, 1, -1, 'late', {AT}, NULL)",
    f"INSERT INTO execution VALUES (1, 1, 1, {AT}, {AT}, 'succeeded', 'arrived', 40, true)",
    f"INSERT INTO violation VALUES (1, 1, 1, 'damage', 'bumped', {AT})",
    f"INSERT INTO metric VALUES (1, 1, 1, {AT}, " + "'{\"loss\": 0.5}')",
    f"INSERT INTO evaluation VALUES (1, 1, 1, 3, 10, 10, 9, 400, 5, {AT}, {AT})",
    f"INSERT INTO checkpoint VALUES (1, 1, 3, 1, {HASH}, {AT})",
    "INSERT INTO event VALUES (1, 1, 'created', '{}', " + f"{AT})",
    f"INSERT INTO idempotency VALUES ('key', 'POST /x', {HASH}, 201, 'null', {AT})",
)
"""A row of every kind as revision 0001 wrote it, in the order of its columns. Never edit: it stands for real data."""


async def test_a_database_of_the_first_version_keeps_every_row_through_every_upgrade(url: str, tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    engine = create_engine(resolve(url, tmp_path))
    for revision in revisions():
        prepare(resolve(url, tmp_path), tmp_path / "data", revision=revision)
        if revision == revisions()[0]:
            with engine.begin() as connection:
                for statement in FIRST_ROWS:
                    connection.exec_driver_sql(statement)
            before = _counts(engine)
            assert all(before.values())
        after = _counts(engine)
        assert {table: after[table] for table in before} == before
    engine.dispose()
    store = await Store.open(url, tmp_path / "data")
    try:
        experiment = await store.experiment(1)
        assert (experiment.name, experiment.lifecycle, experiment.halted) == ("old", Lifecycle.PAUSED, True)
        assert experiment.teacher_settings == {}
        assert (experiment.counters.feedback, experiment.counters.low_level_steps) == (1, 40)
        assert (await store.proposal(1)).verdict is Verdict.GOOD
        assert (await store.proposal(1)).verdict_source == "trainers"
        assert (await store.proposal(1)).uncertainty is None
        assert (await store.proposal(2)).close_reason is CloseReason.TIMED_OUT
        assert [f.click_id for f in (await store.feedback_of_experiment(1)).items] == ["click-0002", "click-0001"]
        assert [(label.feedback_id, label.parameters) for label in await store.labels(1)] == [(1, (0.5,))]
        assert (await store.execution(1)).parameters == {"x": 0.5}
        assert (await store.evaluation(1)).success_rate == 0.9
        assert (await store.metrics(1)).items[0].values == {"loss": 0.5}
        assert (await store.latest_checkpoint(1)) is not None
        assert (await store.trainers()).items[0].name == "local"
    finally:
        await store.close()


async def test_the_migrations_make_exactly_the_models(store: Store, url: str) -> None:
    assert (await store.experiments()).items == []
    engine = create_engine(resolve(url, Path()))
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, Base.metadata) == []
    engine.dispose()


async def test_a_database_of_a_newer_version_is_left_as_it_is(url: str, tmp_path: Path) -> None:
    first = await Store.open(url, tmp_path / "data")
    made = await created(first)
    await first.close()
    _set_revision(url, "fedcba")
    with pytest.raises(NewerDatabase) as caught:
        await Store.open(url, tmp_path / "data")
    assert "fedcba" in str(caught.value)
    assert "version" in caught.value.remedy
    assert not (tmp_path / "data" / "backups").exists()
    _set_revision(url, revisions()[-1])
    again = await Store.open(url, tmp_path / "data")
    assert await again.experiment(made.id) == made
    await again.close()


async def test_a_backup_comes_before_a_migration_and_only_then(tmp_path: Path) -> None:
    with closing(sqlite3.connect(tmp_path / "seed.db")) as connection:
        connection.execute("CREATE TABLE keepsake (word TEXT)")
        connection.execute("INSERT INTO keepsake VALUES ('remember')")
        connection.commit()
    for _ in range(2):
        await (await Store.open(None, tmp_path)).close()
    backups = list((tmp_path / "backups").iterdir())
    assert len(backups) == 1
    with closing(sqlite3.connect(backups[0])) as connection:
        assert connection.execute("SELECT word FROM keepsake").fetchall() == [("remember",)]
        assert connection.execute("SELECT count(*) FROM sqlite_master").fetchone() == (1,)
    with closing(sqlite3.connect(tmp_path / "seed.db")) as connection:
        assert connection.execute("SELECT word FROM keepsake").fetchall() == [("remember",)]


async def test_a_fresh_directory_needs_no_backup(tmp_path: Path) -> None:
    await (await Store.open(None, tmp_path / "new" / "data")).close()
    assert (tmp_path / "new" / "data" / "seed.db").is_file()
    assert not (tmp_path / "new" / "data" / "backups").exists()


async def test_a_migration_that_fails_changes_nothing(url: str, tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    engine = create_engine(resolve(url, tmp_path))
    with engine.begin() as connection:
        connection.exec_driver_sql("CREATE TABLE feedback (word VARCHAR(9))")  # in the way of a migration
    with pytest.raises(StoreError) as caught:
        await Store.open(url, tmp_path / "data")
    assert caught.value.remedy
    assert inspect(engine).get_table_names() == ["feedback"]
    engine.dispose()


async def test_a_file_that_is_no_database_is_said_and_kept(tmp_path: Path) -> None:
    (tmp_path / "seed.db").write_bytes(b"these are my notes, not a database " * 100)
    with pytest.raises(StoreError, match="damaged") as caught:
        await Store.open(None, tmp_path)
    assert "backups" in caught.value.remedy
    assert (tmp_path / "seed.db").read_bytes().startswith(b"these are my notes")


async def test_a_due_migration_of_a_read_only_database_is_said(tmp_path: Path) -> None:
    with closing(sqlite3.connect(tmp_path / "seed.db")) as connection:
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("CREATE TABLE keepsake (word TEXT)")
    with pytest.raises(ReadOnly):
        await Store.open(f"sqlite:///file:{tmp_path / 'seed.db'}?mode=ro&uri=true", tmp_path)


async def test_a_data_directory_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("a file in the way")
    with pytest.raises(StoreError) as caught:
        await Store.open(None, tmp_path / "data")
    assert caught.value.remedy


async def test_another_kind_of_database_is_refused(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="mysql"):
        await Store.open("mysql://localhost/seed", tmp_path)


def _counts(engine: Engine) -> dict[str, int]:
    tables = [name for name in inspect(engine).get_table_names() if name != "alembic_version"]
    with engine.connect() as connection:
        return {name: int(connection.exec_driver_sql(f"SELECT count(*) FROM {name}").scalar_one()) for name in tables}


def _set_revision(url: str, revision: str) -> None:
    engine = create_engine(resolve(url, Path()))
    with engine.begin() as connection:
        connection.exec_driver_sql(f"UPDATE alembic_version SET version_num = '{revision}'")
    engine.dispose()
