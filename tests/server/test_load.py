"""A small crowd on the real service: nothing lost or doubled, over kills of the server and beside slow viewers."""

from __future__ import annotations

import asyncio
import random
from pathlib import Path

from tests.benchmarks.load import busy_service, click_for, crowd, kill_and_return, stored
from tests.crowd import Member, lost_or_doubled


def test_a_crowd_loses_and_doubles_no_click_over_three_kills(tmp_path: Path) -> None:
    with busy_service(tmp_path, 2) as (service, streams):
        members = crowd(streams, trainers=16, viewers=4, pause=0.5)
        assert kill_and_return(service, members, kills=3, seconds=10) == []
        clicks = [click for member in members for click in member.clicks]
        assert len(clicks) > 50
        assert {click.answer for click in clicks} <= {"stored", "late"}
        assert all(member.connections > 3 for member in members)


def test_slow_viewers_keep_no_one_waiting(tmp_path: Path) -> None:
    """One that reads nothing but its handshake, one at a picture a second, fifty as they should be."""
    with busy_service(tmp_path, 1) as (service, streams):
        normal = crowd(streams, trainers=4, viewers=46, pause=0.5)
        slow = Member("slow", streams[0], None, random.Random(0), frame_pause=1.0)
        asyncio.run(_beside_a_deaf_one([*normal, slow], streams[0]))
        assert lost_or_doubled(normal, stored(service)) == []
        # nobody was cut off
        assert all(member.connections == 1 for member in normal)


async def _beside_a_deaf_one(members: list[Member], url: str) -> None:
    host, port = url.removeprefix("ws://").split("/", 1)[0].split(":")
    _, writer = await asyncio.open_connection(host, int(port), limit=1)
    path = "/" + url.removeprefix("ws://").split("/", 1)[1]
    writer.write(
        f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
    )
    await writer.drain()
    writer.transport.pause_reading()  # type: ignore[attr-defined]  # of a socket's transport
    await click_for(members, _heard_enough(members))
    writer.close()


async def _heard_enough(members: list[Member]) -> None:
    """Until every normal one has heard of many proposals, the slow one at its pace."""
    await asyncio.gather(*[member.hears(30) for member in members])
