"""Many synthetic trainers and viewers on one service, each with a connection of its own and a log of what it was told.

They do what the page does: keep a click until it is answered, and send it again, by the same id, after a break.
"""

from __future__ import annotations

import asyncio
import json
import random
import re
import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from datetime import datetime

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import InvalidHandshake, WebSocketException

KIND = re.compile(r'"type":"(\w+)"')
PROPOSAL = re.compile(r'"proposal":\{"id":(\d+)')
OPENED = re.compile(r'"opened_at":"([^"]+)"')
ANSWER = re.compile(r'"request_id":"([^"]+)"')
STATUS = re.compile(r'"status":"(\w+)"')
RETRY_S = 0.1
"""Pause between two attempts to reach a service that is down."""


@dataclass
class Sent:
    """One click, as its trainer knows it."""

    click_id: str
    proposal_id: int
    value: int
    sent_at: float
    answered_at: float | None = None
    answer: str | None = None
    """stored, late or refused."""


@dataclass
class Member:
    """A viewer, or, with a pause, a trainer: clicks on what is open, about every `pause` seconds."""

    name: str
    url: str
    """Of the experiment's stream."""
    pause: float | None
    chance: random.Random
    clicks: list[Sent] = field(default_factory=list)
    fan_out: list[float] = field(default_factory=list)
    """Seconds from a proposal's opening (before its commit) until this member heard of it."""
    heard: dict[str, int] = field(default_factory=dict)
    sizes: dict[str, int] = field(default_factory=dict)
    connections: int = 0
    _open: int | None = None
    _pending: dict[str, Sent] = field(default_factory=dict)
    _settled: asyncio.Event = field(default_factory=asyncio.Event)
    """No click waits for its answer."""

    def __post_init__(self) -> None:
        self._settled.set()

    async def run(self, over: asyncio.Event) -> None:
        """Until it is over, and every click is answered: come back whenever the connection is lost."""
        while not over.is_set() or self._pending:
            try:
                async with connect(self.url, max_size=None, compression=None, ping_interval=None) as socket:
                    self.connections += 1
                    await self._serve(socket, over)
            except (OSError, WebSocketException, InvalidHandshake, EOFError):
                await asyncio.sleep(RETRY_S)

    async def _serve(self, socket: ClientConnection, over: asyncio.Event) -> None:
        for click in self._pending.values():
            await self._send(socket, click)
        parts = [asyncio.create_task(self._listen(socket)), asyncio.create_task(self._leave(over))]
        clicking = asyncio.create_task(self._click(socket, over))
        try:
            done, _ = await asyncio.wait(parts, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for part in (*parts, clicking):
                part.cancel()
            await asyncio.gather(*parts, clicking, return_exceptions=True)
        for part in done:
            part.result()

    async def _leave(self, over: asyncio.Event) -> None:
        await over.wait()
        await self._settled.wait()

    async def _click(self, socket: ClientConnection, over: asyncio.Event) -> None:
        while self.pause is not None:
            await asyncio.sleep(self.pause * self.chance.uniform(0.5, 1.5))
            if over.is_set():
                return
            if self._open is None:
                continue
            value = self.chance.choice((-1, -1, 0))
            click = Sent(f"{self.name}-{len(self.clicks):06d}", self._open, value, 0.0)
            self._open = None
            self.clicks.append(click)
            self._pending[click.click_id] = click
            self._settled.clear()
            await self._send(socket, click)

    async def _send(self, socket: ClientConnection, click: Sent) -> None:
        click.sent_at = time.perf_counter()
        body = {"click_id": click.click_id, "proposal_id": click.proposal_id, "value": click.value}
        await socket.send(json.dumps({"type": "feedback", "trainer": self.name} | body))

    async def _listen(self, socket: ClientConnection) -> None:
        async for message in socket:
            if isinstance(message, bytes):
                await socket.send('{"type":"frame_ack"}')
                continue
            # the messages of a crowd are many: only what it acts on is looked at
            kind = _first(KIND, message)
            self.heard[kind] = self.heard.get(kind, 0) + 1
            self.sizes[kind] = self.sizes.get(kind, 0) + len(message)
            if kind == "proposal_opened":
                self._open = int(_first(PROPOSAL, message))
                opened = datetime.fromisoformat(_first(OPENED, message)).timestamp()
                self.fan_out.append(time.time() - opened)
            elif kind == "snapshot":
                waiting = json.loads(message)["proposal"]
                self._open = waiting["id"] if waiting else None
            elif kind == "proposal_closed" and self._open == int(_first(PROPOSAL, message)):
                self._open = None
            elif kind in ("acknowledged", "refused"):
                self._answered(message, kind)

    def _answered(self, message: str, kind: str) -> None:
        click = self._pending.pop(_first(ANSWER, message), None)
        if click is not None:
            click.answered_at = time.perf_counter()
            click.answer = _first(STATUS, message) if kind == "acknowledged" else "refused"
            if not self._pending:
                self._settled.set()


def lost_or_doubled(members: Iterable[Member], rows: Iterable[tuple[str, int, int, str]]) -> list[str]:
    """Where the members' logs and the database (click id, proposal, value, status) differ, in words."""
    stored: dict[str, tuple[int, int, str]] = {}
    wrong = []
    for click_id, proposal_id, value, status in rows:
        if click_id in stored:
            wrong.append(f"{click_id} is stored twice")
        stored[click_id] = (proposal_id, value, status)
    for member in members:
        for click in member.clicks:
            kept = stored.pop(click.click_id, None)
            if click.answer in ("stored", "late") and kept != (click.proposal_id, click.value, click.answer):
                wrong.append(f"{click.click_id} was answered {click.answer}, and is {kept}")
            elif click.answer == "refused" and kept is not None:
                wrong.append(f"{click.click_id} was refused, and is stored")
            elif click.answer is None:
                wrong.append(f"{click.click_id} was never answered")
    wrong += [f"nobody sent {click_id}" for click_id in stored]
    return wrong


def _first(pattern: re.Pattern[str], text: str) -> str:
    found = pattern.search(text)
    assert found is not None, f"{pattern.pattern} isn't in {text[:200]}"
    return found.group(1)
