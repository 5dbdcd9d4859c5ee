"""The one writer: groups, failures in a group, a full or read-only database, and a process killed while it writes."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from sqlalchemy import create_engine, event, text
from sqlalchemy.orm import Session

from server.database import Database, resolve
from server.store import Conflict, Full, NotFound, ReadOnly, Store, StoreError
from tests.server.databases import begun, click, created, opened, running


class _Held:
    """Keeps the writer busy with one job, so that everything sent meanwhile waits together."""

    def __init__(self, store: Store) -> None:
        self.database: Database = store._database
        self.commits = 0
        self._held, self._go = threading.Event(), threading.Event()
        event.listen(self.database._write_engine, "commit", self._count)

    async def hold(self) -> asyncio.Task[None]:
        task = asyncio.create_task(self.database.write(self._wait))
        await asyncio.to_thread(self._held.wait)
        return task

    def release(self) -> None:
        self._go.set()

    def _wait(self, _: Session) -> None:
        self._held.set()
        self._go.wait()

    def _count(self, _: object) -> None:
        self.commits += 1


async def test_what_waits_is_committed_together(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    names = [f"trainer-{n}" for n in range(100)]
    proposal = await opened(store, experiment_id, electorate=names)
    writer = _Held(store)
    holding = await writer.hold()
    clicks = [asyncio.create_task(store.submit_feedback(proposal.id, click(1, trainer=n))) for n in names]
    await asyncio.sleep(0)  # every task has handed its job over
    writer.release()
    answers = await asyncio.gather(*clicks)
    await holding
    assert writer.commits == 2
    assert len({a.feedback.id for a in answers}) == 100
    assert [a.closed is not None for a in answers].index(True) == 50  # as if they had come one by one


async def test_one_bad_job_of_a_group_fails_alone(store: Store) -> None:
    experiment_id = await running(store)
    writer = _Held(store)
    holding = await writer.hold()
    jobs = [
        asyncio.create_task(store.add_event(experiment_id, "first", {})),
        asyncio.create_task(store.add_event(999, "nowhere", {})),
        asyncio.create_task(writer.database.write(_break_a_rule)),
        asyncio.create_task(store.add_event(experiment_id, "last", {})),
    ]
    await asyncio.sleep(0)
    writer.release()
    first, nowhere, broken, last = await asyncio.gather(*jobs, return_exceptions=True)
    await holding
    assert isinstance(nowhere, NotFound)
    assert isinstance(broken, Conflict)
    assert writer.commits == 2
    stored = (await store.events(experiment_id)).items
    assert [first, last] == stored[-2:]


async def test_a_failed_commit_fails_everyone_and_stores_nothing(sqlite_store: Store) -> None:
    store = sqlite_store
    experiment_id = await running(store)
    before = (await store.events(experiment_id)).items
    writer = _Held(store)
    holding = await writer.hold()
    jobs = [
        asyncio.create_task(store.add_event(experiment_id, "kind", {})),
        asyncio.create_task(writer.database.write(_break_a_rule_at_commit)),
    ]
    await asyncio.sleep(0)
    writer.release()
    outcomes = await asyncio.gather(*jobs, return_exceptions=True)
    await holding
    assert [type(outcome) for outcome in outcomes] == [Conflict, Conflict]
    assert (await store.events(experiment_id)).items == before
    await store.add_event(experiment_id, "afterwards", {})
    assert (await store.events(experiment_id)).items[:-1] == before


async def test_a_cancelled_wait_leaves_the_writer_well(store: Store) -> None:
    experiment_id = await running(store)
    writer = _Held(store)
    holding = await writer.hold()
    waiting = asyncio.create_task(store.add_event(experiment_id, "cancelled", {}))
    await asyncio.sleep(0)
    waiting.cancel()
    writer.release()
    await holding
    with pytest.raises(asyncio.CancelledError):
        await waiting
    assert (await store.add_event(experiment_id, "kind", {})).kind == "kind"


async def test_a_full_database_says_so_and_goes_on_when_there_is_room(sqlite_store: Store) -> None:
    store = sqlite_store
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    await _limit(store, 1)  # SQLite takes the present size for the least
    with pytest.raises(Full) as caught:
        await store.add_event(experiment_id, "ballast", {"text": "x" * 200_000})
    assert "free space" in caught.value.remedy
    assert (await store.open_proposals(experiment_id)) == [proposal]  # reads go on
    stored = (await store.events(experiment_id, limit=500)).items
    with pytest.raises(Full):
        await store.add_event(experiment_id, "ballast", {"text": "x" * 200_000})
    assert (await store.events(experiment_id, limit=500)).items == stored
    await _limit(store, 1_000_000)
    assert (await store.submit_feedback(proposal.id, click(1))).closed is not None


async def test_a_read_only_database_is_still_read(tmp_path: Path) -> None:
    first = await Store.open(None, tmp_path)
    made = await created(first)
    await first.close()
    store = await Store.open(f"sqlite:///file:{tmp_path / 'seed.db'}?mode=ro&uri=true", tmp_path)
    try:
        with pytest.raises(ReadOnly) as caught:
            await store.halt(made.id)
        assert "writable" in caught.value.remedy
        assert await store.experiment(made.id) == made
    finally:
        await store.close()


@pytest.mark.parametrize("url", ["postgresql"], indirect=True)
async def test_a_read_only_postgresql_is_still_read(url: str, tmp_path: Path) -> None:
    first = await Store.open(url, tmp_path)
    made = await created(first)
    await first.close()
    engine = create_engine(url, isolation_level="AUTOCOMMIT")
    try:
        with engine.connect() as connection:
            connection.exec_driver_sql("ALTER ROLE CURRENT_USER SET default_transaction_read_only = on")
        store = await Store.open(url, tmp_path)
        with pytest.raises(ReadOnly):
            await store.halt(made.id)
        assert await store.experiment(made.id) == made
        await store.close()
    finally:
        with engine.connect() as connection:
            connection.exec_driver_sql("SET default_transaction_read_only = off")
            connection.exec_driver_sql("ALTER ROLE CURRENT_USER RESET default_transaction_read_only")
        engine.dispose()


async def test_a_closed_store_says_so(tmp_path: Path) -> None:
    store = await Store.open(None, tmp_path)
    await store.close()
    await store.close()
    for question in (store.experiments(), store.halt(1)):
        with pytest.raises(StoreError, match="closed"):
            await question


@pytest.mark.parametrize(
    "statement",
    [
        "INSERT INTO feedback (click_id, experiment_id, proposal_id, trainer_id, value, status, received_at)"
        " SELECT 'other-click', experiment_id, proposal_id, trainer_id, 2, 'late', received_at FROM feedback",
        "INSERT INTO feedback (click_id, experiment_id, proposal_id, trainer_id, value, status, received_at)"
        " SELECT click_id, experiment_id, proposal_id, trainer_id, value, 'late', received_at FROM feedback",
        "INSERT INTO feedback (click_id, experiment_id, proposal_id, trainer_id, value, status, received_at)"
        " SELECT 'other-click', experiment_id, proposal_id, trainer_id, value, status, received_at FROM feedback",
        "INSERT INTO execution"
        " (experiment_id, proposal_id, started_at, ended_at, outcome, low_level_steps, task_success)"
        " SELECT experiment_id, proposal_id, started_at, started_at, 'stopped', 0, task_success FROM execution",
        "UPDATE feedback SET proposal_id = 999",
        "UPDATE proposal SET verdict = NULL",
        "UPDATE execution SET outcome = 'succeeded'",
        "UPDATE experiment SET lifecycle = 'flying'",
    ],
    ids=["value", "click", "vote", "execution", "dangling", "verdict", "outcome", "lifecycle"],
)
async def test_the_schema_itself_refuses_what_must_never_be(url: str, tmp_path: Path, statement: str) -> None:
    store = await Store.open(url, tmp_path / "data")
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    await store.submit_feedback(proposal.id, click(1))
    await begun(store, proposal.id)
    with pytest.raises(Conflict, match="the database refuses"):
        await store._database.write(lambda session: session.execute(text(statement)))
    await store.close()


def test_no_acknowledged_click_is_lost_when_the_process_is_killed(url: str, tmp_path: Path) -> None:
    acknowledged: dict[str, tuple[int, int]] = {}
    for name, enough in (("one", 10), ("two", 25)):
        command = [sys.executable, "-m", "tests.server.clicker", url, str(tmp_path / "data"), f"killed-{name}"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            for count, line in enumerate(process.stdout, 1):
                if not line.endswith("\n"):  # killed in the middle of saying it
                    break
                click_id, proposal_id, value = line.split()
                acknowledged[click_id] = (int(proposal_id), int(value))
                if count == enough:
                    os.kill(process.pid, signal.SIGKILL)  # it goes on clicking until this arrives
        assert process.returncode == -signal.SIGKILL
    with create_engine(resolve(url, tmp_path)).connect() as connection:
        rows = connection.exec_driver_sql("SELECT click_id, proposal_id, value FROM feedback").all()
    stored = {click_id: (proposal_id, value) for click_id, proposal_id, value in rows}
    assert len(stored) == len(rows)
    assert len(acknowledged) >= 35
    assert acknowledged.items() <= stored.items()


def _break_a_rule(session: Session) -> None:
    session.execute(text("INSERT INTO trainer (name, kind, created_at) VALUES ('x', 'ghost', '2026-01-01 00:00:00')"))


def _break_a_rule_at_commit(session: Session) -> None:
    session.execute(text("PRAGMA defer_foreign_keys = ON"))
    session.execute(
        text("INSERT INTO event (experiment_id, kind, payload, at) VALUES (999, 'x', '{}', '2026-01-01 00:00:00')")
    )


async def _limit(store: Store, pages: int) -> None:
    def limit(session: Session) -> None:
        session.execute(text(f"PRAGMA max_page_count = {pages}"))

    await store._database.write(limit)
