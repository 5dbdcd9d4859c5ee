"""Connections: one writer thread that commits whatever waits as a group, and readers with connections of their own."""

from __future__ import annotations

import asyncio
import functools
import queue
import sqlite3
import threading
from collections.abc import Callable, Coroutine, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar, cast

from sqlalchemy import URL, Connection, Engine, create_engine, event, make_url
from sqlalchemy.exc import DBAPIError, IntegrityError
from sqlalchemy.orm import Session

from server.principal import Principal, acting
from server.store_errors import Conflict, Full, ReadOnly, StoreError

T = TypeVar("T")
P = ParamSpec("P")
S = TypeVar("S", bound="_Part")

BUSY_TIMEOUT = 10.0  # seconds to wait for another process's write, e.g. a backup tool's
READERS = 4
GROUP = 256
"""Jobs in one commit at most, so that the first of a flood doesn't wait for the last."""
WRITER_LOCK = 0x5EED
"""Key of the PostgreSQL advisory lock that stands in for SQLite's BEGIN IMMEDIATE."""


def resolve(url: str | None, data_dir: Path) -> URL:
    """The database's URL: without one, SQLite in the data directory; `postgresql:` means psycopg 3."""
    if url is None:
        return URL.create("sqlite", database=str(data_dir / "seed.db"))
    parsed = make_url(url)
    if parsed.get_backend_name() not in ("sqlite", "postgresql"):
        raise StoreError(
            f"databases of kind {parsed.get_backend_name()!r} aren't supported",
            remedy="use sqlite:/// or postgresql://",
        )
    return parsed.set(drivername="postgresql+psycopg") if parsed.get_backend_name() == "postgresql" else parsed


def engine(url: URL, *, begin: str, foreign_keys: bool = True, **options: Any) -> Engine:
    """An engine whose SQLite transactions begin with `begin`, as durable as the disk allows."""
    if url.get_backend_name() == "postgresql":
        return create_engine(url, pool_pre_ping=True, **options)
    made = create_engine(url, connect_args={"timeout": BUSY_TIMEOUT}, **options)

    @event.listens_for(made, "connect")
    def _configure(connection: sqlite3.Connection, _: object) -> None:
        connection.isolation_level = None  # the driver must not begin transactions of its own
        connection.execute(f"PRAGMA foreign_keys={'ON' if foreign_keys else 'OFF'}")
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("PRAGMA synchronous=FULL")

    @event.listens_for(made, "begin")
    def _begin(connection: Connection) -> None:
        connection.exec_driver_sql(begin)

    return made


@contextmanager
def translated() -> Iterator[None]:
    """Driver errors as errors of the store."""
    try:
        yield
    except DBAPIError as error:
        raise translate(error) from error


def translate(error: DBAPIError) -> StoreError:
    """What a driver's error means for the reader of it."""
    origin = error.orig
    detail = str(origin)
    name = getattr(origin, "sqlite_errorname", "") or ""
    state = getattr(origin, "sqlstate", "") or ""
    if name.startswith("SQLITE_FULL") or state == "53100":
        return Full(detail)
    if name.startswith(("SQLITE_READONLY", "SQLITE_CANTOPEN")) or state == "25006":
        return ReadOnly(detail)
    if name.startswith("SQLITE_BUSY"):
        return StoreError(f"the database is in use: {detail}", remedy="end the other program that writes to it")
    if name.startswith(("SQLITE_NOTADB", "SQLITE_CORRUPT")):
        return StoreError(f"the database is damaged: {detail}", remedy="put back a copy from the directory `backups`")
    if isinstance(error, IntegrityError):
        return Conflict(f"the database refuses this: {detail}", remedy="reload and try again; nothing was stored")
    return StoreError(f"the database failed: {detail}", remedy="check that the database can be reached, then try again")


@dataclass
class _Job:
    """One write. It may run in a group with others, but fails alone."""

    run: Callable[[Session], Any]
    who: Principal
    """In whose name; `session.info["who"]` while it runs."""
    future: Future[Any] | asyncio.Future[Any] = field(default_factory=Future)
    result: Any = None
    error: BaseException | None = None


class Elsewhere(Protocol):
    """Another process that writes: `server.store_process`."""

    async def open(self, url: str | None, data_dir: Path, *, backup: bool) -> None:
        """Open the store there."""

    async def call(self, method: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """What a method marked `writes` returns there, or raises."""

    async def close(self) -> None:
        """Commit what waits."""


class _Part(Protocol):
    """A part of the store."""

    @property
    def _database(self) -> Database: ...


def writes(
    method: Callable[Concatenate[S, P], Coroutine[Any, Any, T]],
) -> Callable[Concatenate[S, P], Coroutine[Any, Any, T]]:
    """A method of the store that writes: done where the writer is. What it takes and returns can be pickled."""

    @functools.wraps(method)
    async def here_or_there(self: S, *args: P.args, **kwargs: P.kwargs) -> T:
        elsewhere = self._database.elsewhere
        if elsewhere is None:
            return await method(self, *args, **kwargs)
        result: T = await elsewhere.call(f"{type(self).__name__}.{method.__name__}", args, kwargs)
        return result

    return cast("Callable[Concatenate[S, P], Coroutine[Any, Any, T]]", here_or_there)


class Database:
    """Both sides of one database. Writes are serial; a write's awaiter resumes only after its commit."""

    def __init__(self, url: URL, elsewhere: Elsewhere | None = None, *, alone: bool = False) -> None:
        """Connect when it is needed.

        elsewhere: has the writer; here are the readers only.
        alone: little but writes goes on in this process. They are done in its event loop then: a thread would wait for
        the interpreter at every statement.
        """
        writer: dict[str, Any] = {"pool_size": 1, "max_overflow": 0}
        readers: dict[str, Any] = {"pool_size": READERS, "max_overflow": 0}
        if url.get_backend_name() == "postgresql":
            readers["execution_options"] = {"isolation_level": "REPEATABLE READ", "postgresql_readonly": True}
        self.elsewhere = elsewhere
        self._read_engine = engine(url, begin="BEGIN", **readers)
        self._readers = ThreadPoolExecutor(READERS, thread_name_prefix="store-reader")
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._closed = False
        self._waiting: list[_Job] | None = [] if alone else None
        self._write_engine = engine(url, begin="BEGIN IMMEDIATE", **writer)
        # daemon: a program that forgets to close must still be able to end
        self._writer = threading.Thread(target=self._write_forever, name="store-writer", daemon=True)
        if elsewhere is None and not alone:
            self._writer.start()

    async def write(self, run: Callable[[Session], T]) -> T:
        """Run in a write transaction; returns after the commit. `run` may raise to undo its own part only."""
        if self._closed:
            raise StoreError("the store is closed", remedy="start the service again")
        if self.elsewhere is not None:
            raise RuntimeError("what writes is marked `writes`")
        if self._waiting is not None:
            return await self._write_here(run)
        job = _Job(run, acting.get())
        self._jobs.put(job)
        result: T = await asyncio.wrap_future(cast("Future[T]", job.future))
        return result

    async def _write_here(self, run: Callable[[Session], T]) -> T:
        assert self._waiting is not None
        loop = asyncio.get_running_loop()
        job = _Job(run, acting.get(), loop.create_future())
        if not self._waiting:
            loop.call_soon(self._commit_waiting)  # with everything that is asked for in this turn of the loop
        self._waiting.append(job)
        result: T = await cast("asyncio.Future[T]", job.future)
        return result

    def _commit_waiting(self) -> None:
        assert self._waiting is not None
        group = [job for job in self._waiting if not job.future.cancelled()]
        self._waiting.clear()
        self._commit(group)

    async def read(self, run: Callable[[Session], T]) -> T:
        """Run on a snapshot of what is committed."""
        if self._closed:
            raise StoreError("the store is closed", remedy="start the service again")
        return await asyncio.get_running_loop().run_in_executor(self._readers, self._read, run)

    async def close(self) -> None:
        """Commit what waits, then let go of every connection."""
        if self._closed:
            return
        self._closed = True
        if self.elsewhere is not None:
            await self.elsewhere.close()
        elif self._writer.is_alive():
            self._jobs.put(None)
            await asyncio.to_thread(self._writer.join)
        await asyncio.to_thread(self._readers.shutdown)
        self._read_engine.dispose()
        self._write_engine.dispose()

    def _read(self, run: Callable[[Session], T]) -> T:
        with translated(), Session(self._read_engine) as session:
            return run(session)

    def _write_forever(self) -> None:
        while (first := self._jobs.get()) is not None:
            group, last = [first], False
            while len(group) < GROUP and not last:
                try:
                    job = self._jobs.get_nowait()
                except queue.Empty:
                    break
                if job is None:
                    last = True
                else:
                    group.append(job)
            self._commit([job for job in group if cast("Future[Any]", job.future).set_running_or_notify_cancel()])
            if last:
                return

    def _commit(self, group: list[_Job]) -> None:
        """One transaction for all; nobody is told anything before it is committed."""
        try:
            with self._write_engine.begin() as connection:
                if connection.dialect.name == "postgresql":
                    connection.exec_driver_sql(f"SELECT pg_advisory_xact_lock({WRITER_LOCK})")
                for job in group:
                    self._attempt(connection, job)
        except BaseException as error:  # noqa: BLE001 - handed to every awaiter
            failure = translate(error) if isinstance(error, DBAPIError) else error
            for job in group:
                job.future.set_exception(failure)
            return
        for job in group:
            if job.error is not None:
                job.future.set_exception(job.error)
            else:
                job.future.set_result(job.result)

    def _attempt(self, connection: Connection, job: _Job) -> None:
        session = Session(
            connection, join_transaction_mode="create_savepoint", expire_on_commit=False, info={"who": job.who}
        )
        try:
            job.result = job.run(session)
            session.commit()  # of the savepoint
        except Exception as error:
            if not _in_transaction(connection):
                # a full disk ends SQLite's whole transaction, a lost connection any: nobody's part is left
                raise _origin(error) from error
            session.rollback()
            job.error = translate(error) if isinstance(error, DBAPIError) else error
        session.close()


def _in_transaction(connection: Connection) -> bool:
    if connection.invalidated:
        return False
    driver = connection.connection.dbapi_connection
    return driver.in_transaction if isinstance(driver, sqlite3.Connection) else True


def _origin(error: BaseException) -> BaseException:
    """The first error of the chain: those after it only say that the savepoint is gone too."""
    while error.__context__ is not None:
        error = error.__context__
        if isinstance(error, DBAPIError) and not isinstance(error.__context__, DBAPIError):
            break
    return error
