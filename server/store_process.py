"""The store's writes in a process of their own: one interpreter can't both serve a crowd and write down what it says.

The service reads for itself and has this process do whatever is marked `server.database.writes`. A message is
`[u32 big-endian length][pickle]`, over a socket pair that only the two of them have.
"""

from __future__ import annotations

import asyncio
import contextlib
import fcntl
import gc
import logging
import os
import pickle
import signal
import socket
import traceback
from collections.abc import Iterator, Mapping, Sequence
from multiprocessing import get_context
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from server.principal import Principal, acting
from server.store import Store
from server.store_errors import StoreError
from server.worker import framed, next_message

log = logging.getLogger("seed.store")

GRACE = 10.0
"""Seconds that it gets to commit what waits, once the service has let go of it."""


class WriterEnded(StoreError):
    """The process has ended by itself."""

    def __init__(self) -> None:
        super().__init__("the process that writes to the database has ended", remedy="start the service again")


class StoreProcess:
    """The process, seen from the service. Fork it before there is an event loop or a thread, and leave it after both.

    If it ends by itself the service can't store anything any more, so it is asked to end too: the next start settles
    what was open, as after any crash. What was being written then is written whole or not at all.
    """

    def __init__(self) -> None:
        self._socket, theirs = socket.socketpair()
        # forked, not spawned: it needs the same modules again, which take longer to import than a service to start
        self._process = get_context("fork").Process(target=_work, args=(theirs, self._socket), name="seed-store")
        self._process.start()
        theirs.close()
        self._sent = 0
        self._waiting: dict[int, asyncio.Future[Any]] = {}
        self._writer: asyncio.StreamWriter | None = None
        self._replies: asyncio.Task[None] | None = None
        self._opened = self._closing = False
        self.died = False
        """Whether it has ended by itself."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let go of it, and wait until it is gone."""
        self._socket.close()
        self._process.join(GRACE)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()

    async def open(self, url: str | None, data_dir: Path, *, backup: bool) -> None:
        """Have it open the database. It raises what `Store.open` does."""
        reader, self._writer = await asyncio.open_unix_connection(sock=self._socket)
        self._replies = asyncio.create_task(self._read(reader), name="replies of the store")
        await self.call("open", (url, data_dir, backup), {})
        self._opened = True

    async def call(self, method: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """What a method of the store returns there, or raises.

        Raises:
            WriterEnded: it can't be done any more. StoreError: what the method does.
        """
        if self._writer is None or self._closing or self.died:
            raise WriterEnded
        future: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._sent += 1
        self._waiting[self._sent] = future
        self._writer.write(_framed((self._sent, acting.get(), method, args, kwargs)))
        return await future

    async def close(self) -> None:
        """Have it commit what waits and let go of the database."""
        if self._closing or self._writer is None or self._replies is None:
            return
        self._closing = True
        if not self.died:
            self._writer.write_eof()
        await self._replies
        self._writer.close()

    async def _read(self, reader: asyncio.StreamReader) -> None:
        """Hand replies to their callers until the process has closed its end."""
        try:
            while True:
                number, result, error = pickle.loads(await next_message(reader))
                future = self._waiting.pop(number)
                if future.done():  # its caller was cancelled
                    continue
                if error is None:
                    future.set_result(result)
                else:
                    future.set_exception(error)
        except (asyncio.IncompleteReadError, OSError):
            pass
        except asyncio.CancelledError:  # the event loop ends
            self._closing = True
            raise
        finally:
            self._end()

    def _end(self) -> None:
        """Nothing will be answered any more."""
        self.died = self._opened and not self._closing
        for future in self._waiting.values():
            if not future.done():
                future.set_exception(WriterEnded())
        self._waiting.clear()
        if self.died:
            log.critical("%s; the service ends", WriterEnded())
            os.kill(os.getpid(), signal.SIGTERM)


def _framed(message: object) -> bytes:
    return framed(pickle.dumps(message, pickle.HIGHEST_PROTOCOL))


# --- the other side -------------------------------------------------------------------------------------------------


def _work(end: socket.socket, others: socket.socket) -> None:
    others.close()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # meant for the service, which needs the store until it is through
    gc.freeze()
    asyncio.run(_answer(end))


async def _answer(end: socket.socket) -> None:
    """Do what is asked, in the order in which it is asked, until the service has closed its end."""
    reader, writer = await asyncio.open_unix_connection(sock=end)
    try:
        first = await next_message(reader)
    except asyncio.IncompleteReadError:  # the service couldn't even begin
        return
    number, _, _, (url, data_dir, backup), _ = pickle.loads(first)
    with _alone(data_dir):
        try:
            store = await Store.open(url, data_dir, backup=backup, alone=True)
        except StoreError as error:
            writer.write(_framed((number, None, error)))
            await writer.drain()
            return
        writer.write(_framed((number, None, None)))
        parts = {type(part).__name__: part for part in (store, store.people, store.quality)}
        under_way: set[asyncio.Task[None]] = set()

        async def do(number: int, who: Principal, method: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> None:
            acting.set(who)
            part, name = method.split(".")
            try:
                answer = _framed((number, await getattr(parts[part], name)(*args, **kwargs), None))
            except StoreError as error:
                answer = _framed((number, None, error))
            except Exception as error:  # noqa: BLE001 - handed to whoever asked
                # only its text can be sent: whatever it is, it is a mistake of ours
                mistake = RuntimeError(f"{method}: {error!r}")
                mistake.add_note(traceback.format_exc())
                answer = _framed((number, None, mistake))
            writer.write(answer)

        with contextlib.suppress(asyncio.IncompleteReadError, OSError):
            while True:
                task = asyncio.create_task(do(*pickle.loads(await next_message(reader))))
                under_way.add(task)
                task.add_done_callback(under_way.discard)
        if under_way:
            await asyncio.wait(under_way)
        await store.close()
        writer.close()


@contextlib.contextmanager
def _alone(directory: Path) -> Iterator[None]:
    """Wait for the one of a service that was killed just now: it may still commit what it had begun."""
    lock = os.open(directory / ".writing", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)
