"""Networks that die without a word: noticed by the page's heartbeat, at a pace that the test sets."""

from __future__ import annotations

import asyncio
import json
from collections import Counter
from pathlib import Path

import pytest
from websockets.asyncio.client import ClientConnection
from websockets.exceptions import ConnectionClosed

from server import heartbeat
from server.heartbeat import ASKED_AFTER, GONE_AFTER
from server.stream import SILENT
from tests.server.serving import event, serving


class Beats:
    """Stands in for the clock of every heartbeat: a look comes when the test says so."""

    def __init__(self) -> None:
        self._number = 0
        self._waiting: Counter[int] = Counter()
        self._changed = asyncio.Condition()

    async def beat(self) -> None:
        async with self._changed:
            number = self._number
            self._waiting[number] += 1
            self._changed.notify_all()
            try:
                await self._changed.wait_for(lambda: self._number > number)
            finally:
                self._waiting[number] -= 1

    async def look(self, viewers: int) -> None:
        """Once this many wait for it, let each look once."""
        async with asyncio.timeout(60), self._changed:
            await self._changed.wait_for(lambda: self._waiting[self._number] == viewers)
            self._number += 1
            self._changed.notify_all()


@pytest.fixture
def beats(monkeypatch: pytest.MonkeyPatch) -> Beats:
    made = Beats()
    monkeypatch.setattr(heartbeat, "beat", made.beat)
    return made


async def ping(page: ClientConnection, *, regular: bool = True) -> None:
    """Say something, and wait until it was heard."""
    await page.send(json.dumps({"type": "ping", "regular": regular}))
    await event(page, "pong")


async def test_whose_network_dies_without_a_word_holds_up_no_majority(tmp_path: Path, beats: Beats) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment(aggregation="majority")
        page = f"{here}/stream?trainer="
        async with live.stream(page + "ann") as ann, live.stream(page + "bob") as bob, live.stream(here) as program:
            for viewer in (ann, bob, program):
                await event(viewer, "snapshot")
            await ping(ann)
            await ping(bob)
            await ping(program, regular=False)
            await live.http.post(f"/api/v1/experiments/{here}/start")
            proposal = (await event(bob, "proposal_opened"))["proposal"]
            assert sorted(proposal["electorate"]) == ["ann", "bob"]
            await bob.send(
                json.dumps(live.click(-1, trainer="bob") | {"type": "feedback", "proposal_id": proposal["id"]})
            )
            assert (await event(bob, "acknowledged"))["feedback"]["status"] == "stored"

            for number in range(1, GONE_AFTER):
                await beats.look(3)
                if number == ASKED_AFTER:
                    await event(ann, "pong")  # are you there?
                await ping(bob)
            assert (await live.http.get(f"/api/v1/proposals/{proposal['id']}")).json()["closed_at"] is None
            await beats.look(3)
            with pytest.raises(ConnectionClosed):
                await event(ann, "something that never comes")
            assert ann.close_code == SILENT
            # the time that this took counts: she was last heard of `vanish_seconds` ago
            closed = (await event(bob, "proposal_closed"))["proposal"]
            assert (closed["id"], closed["verdict"], closed["electorate"]) == (proposal["id"], "bad", ["bob"])
            # who never says that it is there isn't missed
            await ping(program, regular=False)


async def test_a_hidden_page_whose_timers_sleep_stays_by_answering(tmp_path: Path, beats: Beats) -> None:
    async with serving(tmp_path) as live, live.stream(await live.experiment()) as page:
        await event(page, "snapshot")
        await ping(page)
        for _ in range(2 * GONE_AFTER):
            for _ in range(ASKED_AFTER):
                await beats.look(1)
            await event(page, "pong")
            await ping(page)
