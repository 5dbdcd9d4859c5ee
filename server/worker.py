"""A child process that answers commands: started, watched, stopped at once, ended.

One worker has three channels (socket pairs; `server/workers/channel.py` is the other side): commands with their
replies, stops, and frames. A stop never waits behind a command; a frame never delays a reply.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import os
import socket
import subprocess
import sys
from collections.abc import Callable, Coroutine
from typing import Any

from server.workers.channel import ATTENDED, FORSAKEN, LENGTH, STOP

log = logging.getLogger(__name__)

OnFrame = Callable[[bytes, bytes], None]
"""Takes the JSON header and the JPEG of a frame."""
HELD_BACK = frozenset({"flush"})
"""Commands that a worker answers later than ones that were sent after them: nothing waits behind these."""


def framed(body: bytes) -> bytes:
    """A message as it is written (`server/workers/channel.py`)."""
    return LENGTH.pack(len(body)) + body


async def next_message(reader: asyncio.StreamReader) -> bytes:
    """The next one.

    Raises:
        asyncio.IncompleteReadError: the other side is gone.
    """
    return await reader.readexactly(LENGTH.unpack(await reader.readexactly(LENGTH.size))[0])


class WorkerError(Exception):
    """Base of what can go wrong with a worker. `remedy` says what the reader can do about it."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


class WorkerDied(WorkerError):
    """The process is gone, and with it whatever it was doing. `worker` is its name, `pid` None where there was none."""

    def __init__(
        self,
        worker: str,
        message: str,
        *,
        pid: int | None = None,
        remedy: str = "see the server's log for what it said last",
    ) -> None:
        super().__init__(message, remedy=remedy)
        self.worker = worker
        self.pid = pid


class WorkerTimeout(WorkerDied):
    """A command took longer than its deadline; the process has been killed."""


class CommandFailed(WorkerError):
    """The worker is well and refuses a command. `kind` is the name of the error on the other side."""

    def __init__(self, worker: str, kind: str, message: str, *, remedy: str) -> None:
        super().__init__(message, remedy=remedy)
        self.worker = worker
        self.kind = kind


class Worker:
    """A running child process. Made by `spawn`; used from one event loop."""

    def __init__(self, name: str, process: subprocess.Popen[bytes], stop: socket.socket) -> None:
        self.name = name
        self.pid = process.pid
        self._process = process
        self._stop = stop
        self._sent = 0
        self._waiting: dict[int, asyncio.Future[dict[str, Any]]] = {}
        self._held_back: set[int] = set()
        self._closing = False
        self._gone = asyncio.Event()
        self._death = "is being ended"
        self._writer: asyncio.StreamWriter
        self._readers: list[asyncio.Task[None]] = []

    @classmethod
    async def spawn(cls, name: str, module: str, *, on_frame: OnFrame | None = None, threads: int = 1) -> Worker:
        """Start `python -m module`. It may still be importing when this returns; commands wait in its pipe."""
        ours, theirs = zip(*(socket.socketpair() for _ in range(3)), strict=True)
        descriptors = [str(end.fileno()) for end in theirs]
        arguments = [f"--{k}={d}" for k, d in zip(("commands", "stop", "frames"), descriptors, strict=True)]
        process = await asyncio.to_thread(
            subprocess.Popen,
            # -P: the working directory is data, not code
            [sys.executable, "-P", "-m", module, *arguments],
            stdin=subprocess.DEVNULL,
            stdout=sys.__stderr__.fileno() if sys.__stderr__ else None,  # stdout belongs to the command line's user
            pass_fds=[end.fileno() for end in theirs],
            # numeric libraries size their pools when they are imported; two of them would fight over the cores
            env=os.environ | {"OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": str(threads)},
        )
        for end in theirs:
            end.close()
        commands, stop, frames = ours
        stop.setblocking(False)
        worker = cls(name, process, stop)
        reader, worker._writer = await asyncio.open_unix_connection(sock=commands)
        frame_reader, frame_writer = await asyncio.open_unix_connection(sock=frames)
        worker._readers = [
            asyncio.create_task(worker._read_replies(reader), name=f"{name} replies"),
            asyncio.create_task(worker._read_frames(frame_reader, frame_writer, on_frame), name=f"{name} frames"),
        ]
        return worker

    @property
    def alive(self) -> bool:
        """False from the moment the end of the process was noticed."""
        return not self._gone.is_set()

    async def death(self) -> WorkerDied:
        """Wait for the process to be gone."""
        await self._gone.wait()
        return self._obituary()

    def send(self, command: str, **arguments: Any) -> asyncio.Future[dict[str, Any]]:
        """Write a command now and return its reply to come; commands are answered in the order they were sent.

        The future raises CommandFailed (the worker refuses; it is well) or WorkerDied.
        """
        future = asyncio.get_running_loop().create_future()
        if not self.alive or self._closing:
            future.set_exception(self._obituary())
            return future
        self._sent += 1
        self._waiting[self._sent] = future
        if command in HELD_BACK:
            self._held_back.add(self._sent)
        message = json.dumps({"id": self._sent, "command": command, "arguments": arguments}).encode()
        self._writer.write(framed(message))
        return future

    def call(self, command: str, *, deadline: float, **arguments: Any) -> Coroutine[Any, Any, dict[str, Any]]:
        """Send a command now; what is returned waits for its reply, at most `deadline` seconds once it is its turn.

        Raises, when it is awaited:
            CommandFailed: the worker refuses; it is well.
            WorkerDied: the process is gone.
            WorkerTimeout: no reply in time; the process has been killed.
        """
        before = [reply for number, reply in self._waiting.items() if number not in self._held_back]
        return self._in_time(command, self.send(command, **arguments), before, deadline)

    async def _in_time(
        self,
        command: str,
        reply: asyncio.Future[dict[str, Any]],
        before: list[asyncio.Future[dict[str, Any]]],
        deadline: float,
    ) -> dict[str, Any]:
        """The reply. The clock starts when those before are answered: a long motion is no sign of a hung worker."""
        if before:
            await asyncio.wait(before)
        try:
            async with asyncio.timeout(deadline):
                return await reply
        except TimeoutError:
            self.kill()
            raise WorkerTimeout(
                self.name,
                f"the {self.name} worker did not answer {command!r} within {deadline:g} s and was killed",
                pid=self.pid,
                remedy="if the machine is just slow, raise the deadline in the settings",
            ) from None

    def stop(self, number: int) -> None:
        """Tell the worker to stop moving: at once, latched, whatever it is doing. Never waits, never raises.

        Stops are numbered from 1; the command `rearm` lifts those up to a number, so a later one can't be lifted.
        """
        with contextlib.suppress(OSError):  # a worker that is gone moves nothing
            self._stop.send(STOP.pack(number))

    def keep_alive(self) -> None:
        """Tell a real robot's worker that it is still attended; without such words for a while its motion ends."""
        self.stop(ATTENDED)

    def forsake(self) -> None:
        """Tell a real robot's worker that nobody attends it any more: its motion ends at once."""
        self.stop(FORSAKEN)

    def kill(self) -> None:
        """End the process at once."""
        with contextlib.suppress(ProcessLookupError):
            self._process.kill()

    async def close(self, *, grace: float = 1.0) -> None:
        """Ask the process to end, by closing its channels; kill it after `grace` seconds. Waits until it is gone."""
        self._stop.close()  # which also stops whatever moves
        self._closing = True
        if self.alive and self._writer.can_write_eof():
            self._writer.write_eof()
        try:
            await asyncio.to_thread(self._process.wait, grace)
        except subprocess.TimeoutExpired:
            self.kill()
            await asyncio.to_thread(self._process.wait)
        for reader in self._readers:
            reader.cancel()
        await asyncio.gather(*self._readers, return_exceptions=True)
        self._bury()

    async def _read_replies(self, reader: asyncio.StreamReader) -> None:
        """Hand replies to their callers until the process is gone, which its end of the pipe closing tells at once."""
        # OSError: a command that was written to a process just killed breaks the pipe for the reader too
        with contextlib.suppress(asyncio.IncompleteReadError, OSError):
            while True:
                self._settle(json.loads(await next_message(reader)))
        try:
            await asyncio.to_thread(self._process.wait, 0.5)
        except subprocess.TimeoutExpired:  # a process that has closed its pipe but lives is of no use
            self.kill()
            await asyncio.to_thread(self._process.wait)
        self._bury()

    async def _read_frames(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, on_frame: OnFrame | None
    ) -> None:
        try:
            while True:
                payload = await next_message(reader)
                head = LENGTH.size + LENGTH.unpack(payload[: LENGTH.size])[0]
                if on_frame is not None:
                    on_frame(payload[LENGTH.size : head], payload[head:])
        except (asyncio.IncompleteReadError, OSError):
            pass  # the end of the process; the replies' reader deals with it
        finally:
            writer.close()

    def _settle(self, reply: dict[str, Any]) -> None:
        future = self._waiting.pop(reply["id"])
        self._held_back.discard(reply["id"])
        if future.done():  # its caller was cancelled
            return
        if error := reply.get("error"):
            future.set_exception(CommandFailed(self.name, error["kind"], error["message"], remedy=error["remedy"]))
        else:
            future.set_result(reply["result"])

    def _obituary(self) -> WorkerDied:
        return WorkerDied(self.name, f"the {self.name} worker {self._death}", pid=self.pid)

    def _bury(self) -> None:
        """Say that the process is gone: once, to everyone who waits."""
        if self._gone.is_set():
            return
        code = self._process.returncode
        self._death = f"was ended by signal {-code}" if code is not None and code < 0 else f"ended with code {code}"
        self._gone.set()
        self._stop.close()
        self._writer.close()
        for future in self._waiting.values():
            if not future.done():
                future.set_exception(self._obituary())
        self._waiting.clear()
