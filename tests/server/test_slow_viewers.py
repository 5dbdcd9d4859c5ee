"""One viewer that reads nothing and one at a picture a second, beside fifty: what they don't take, nobody waits for."""

from __future__ import annotations

import asyncio
import contextlib
import re
import socket
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

from websockets.asyncio.client import ClientConnection

from server.stream import Outbox
from tests.live import wait_for
from tests.server.serving import Serving, serving

NORMAL = 50
BUFFER = 4096
"""Bytes that the kernel keeps for a socket, at either end: a few events fill it."""
SEQ = re.compile(r'"seq":(\d+)')
PROPOSAL = re.compile(r'"proposal":\{"id":(\d+)')
KIND = re.compile(r'"type":"(\w+)"')


@dataclass
class Viewer:
    """Reads as the page does. pause: seconds before a picture is acknowledged."""

    socket: ClientConnection
    pause: float = 0.0
    seqs: list[int] = field(default_factory=list)
    frames: int = 0
    unanswered: int = 0
    most_unanswered: int = 0
    motions: int = 0
    opened: int | None = None
    """The newest proposal, until it is judged."""
    _acknowledging: set[asyncio.Task[None]] = field(default_factory=set)

    async def read(self) -> None:
        async for message in self.socket:
            if isinstance(message, bytes):
                self.frames += 1
                self.unanswered += 1
                self.most_unanswered = max(self.most_unanswered, self.unanswered)
                asyncio.get_running_loop().call_later(self.pause, self._acknowledge)
            elif (seq := SEQ.search(message)) is not None:
                self.seqs.append(int(seq[1]))
                kind = KIND.search(message)
                self.motions += kind is not None and kind[1] == "execution_ended"
                if kind is not None and kind[1] == "proposal_opened" and (proposal := PROPOSAL.search(message)):
                    self.opened = int(proposal[1])

    def _acknowledge(self) -> None:
        self.unanswered -= 1
        self._acknowledging.add(task := asyncio.create_task(self.socket.send('{"type":"frame_ack"}')))
        task.add_done_callback(self._acknowledging.discard)

    @property
    def complete(self) -> bool:
        """Whether it has every event since it came, once and in order."""
        return self.seqs == list(range(self.seqs[0], self.seqs[-1] + 1))


async def until(condition: Callable[[], bool]) -> None:
    """Look again after whatever else has been done."""
    await asyncio.to_thread(wait_for, condition, "the viewers", 120)


async def deaf(live: Serving, path: str) -> socket.socket:
    """The connection of a viewer that sends its handshake, and never reads."""
    at = urlsplit(live.url)
    sock = socket.socket()
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
    sock.setblocking(False)
    loop = asyncio.get_running_loop()
    await loop.sock_connect(sock, (at.hostname, at.port))
    request = (
        f"GET /api/v1/experiments/{path}/stream HTTP/1.1\r\nHost: {at.netloc}\r\nConnection: Upgrade\r\n"
        "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
    )
    await loop.sock_sendall(sock, request.encode())
    return sock


@contextlib.asynccontextmanager
async def audience(live: Serving, here: int) -> AsyncIterator[list[Viewer]]:
    """Fifty as they should be, and, as the last, one at a picture a second."""
    async with contextlib.AsyncExitStack() as stack, asyncio.TaskGroup() as reading:
        viewers = [
            Viewer(await stack.enter_async_context(live.stream(here)), pause=1.0 if number == NORMAL else 0.0)
            for number in range(NORMAL + 1)
        ]
        readers = [reading.create_task(viewer.read()) for viewer in viewers]
        yield viewers
        for reader in readers:
            reader.cancel()


async def test_what_a_deaf_viewer_leaves_unread_keeps_nobody_waiting(tmp_path: Path, plugins: None) -> None:
    async with serving(tmp_path, viewer_queue=64, send_buffer=BUFFER) as live:
        here = await live.experiment(algorithm="scripted", settings={}, adapter_settings={"step_seconds": 0.02})
        room = live.service.rooms._rooms

        async def judge(slow: Viewer, value: int) -> None:
            await until(lambda: slow.opened is not None)
            proposal, slow.opened = slow.opened, None
            answer = await live.http.post(f"/api/v1/proposals/{proposal}/feedback", json=live.click(value))
            assert answer.status_code == 201, answer.text

        async with audience(live, here) as viewers:
            normal, slow = viewers[:NORMAL], viewers[NORMAL]
            await until(lambda: all(viewer.seqs for viewer in viewers))
            others = set(room[here])
            stuck = await deaf(live, str(here))
            await until(lambda: len(room[here]) == len(others) + 1)
            (its,) = room[here] - others
            await live.http.post(f"/api/v1/experiments/{here}/start")

            def newest() -> int:
                return live.service.rooms.newest(here)

            def caught_up() -> bool:
                return all(viewer.seqs[-1] == newest() for viewer in viewers)

            # its socket takes no more: the others have heard all there is, and it still has something to send
            held, before = "", "nothing yet"
            while not held or held != before:  # the same as one answer ago: it is stuck, and not just on its way
                await judge(slow, -1)
                await until(caught_up)
                held, before = first_of(its), held
            seen = newest()

            # while that waits for the deaf one, the robot moves, and everybody sees and hears of it
            frames = [viewer.frames for viewer in normal]
            await judge(slow, 1)
            await until(lambda: all(viewer.motions for viewer in viewers))
            await until(lambda: all(viewer.frames > before for viewer, before in zip(normal, frames, strict=True)))
            assert first_of(its) == held
            assert all(viewer.seqs[-1] > seen for viewer in viewers)
            assert not its.overflowed

            # until too much waits: it is let go of, and the others don't notice
            while not its.overflowed:
                await judge(slow, -1)
            await until(lambda: its not in room[here])
            last = newest()
            await judge(slow, -1)
            await until(lambda: newest() > last and caught_up())
            assert set(room[here]) == others, "nobody else was cut off"
            assert all(viewer.complete for viewer in viewers)
            assert slow.frames > 0
            assert slow.most_unanswered == 1, "it gets the next picture once it has drawn one"
            stuck.close()


def first_of(outbox: Outbox) -> str:
    """The event that waits for its viewer longest; empty if none does."""
    return outbox._events[0] if outbox._events else ""
