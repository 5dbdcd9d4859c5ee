"""The WebSocket by real clients: snapshot, events in order, frames one at a time, slow viewers, rubbish."""

from __future__ import annotations

import asyncio
import json
import socket
import struct
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.asyncio.client import ClientConnection
from websockets.exceptions import ConnectionClosed, InvalidStatus

from server.errors import MEDIA_TYPE
from server.messages import FrameHeader, MetricsAdded, Pong
from server.schemas import MetricPoint
from server.schemas_problems import Problem
from server.stream import RUBBISH_LIMIT, Outbox, Rooms
from tests.server.serving import Serving, event, serving


async def heard(viewer: ClientConnection) -> dict[str, Any]:
    """The very next message, which must be an event."""
    async with asyncio.timeout(60):
        message = await viewer.recv()
    assert isinstance(message, str)
    return dict(json.loads(message))


async def frame(viewer: ClientConnection) -> tuple[dict[str, Any], bytes]:
    """The very next message, which must be a picture."""
    async with asyncio.timeout(60):
        message = await viewer.recv()
    assert isinstance(message, bytes)
    (length,) = struct.unpack(">I", message[:4])
    return json.loads(message[4 : 4 + length]), message[4 + length :]


async def say(viewer: ClientConnection, **message: Any) -> None:
    await viewer.send(json.dumps(message))


async def sent_until_closed(viewer: ClientConnection, messages: list[str]) -> int | None:
    """Send, then listen until the server closes the connection: its code."""
    try:
        for message in messages:
            await viewer.send(message)
        while True:
            await heard(viewer)
    except ConnectionClosed as closed:
        return None if closed.rcvd is None else closed.rcvd.code


def header(camera: str, number: int) -> FrameHeader:
    return FrameHeader(camera=camera, width=640, height=480, taken_at=float(number))


def metric(number: int, size: int = 0) -> MetricsAdded:
    """An event of at least `size` bytes."""
    values = {f"{n:0100d}": 0.0 for n in range(size // 100)}
    return MetricsAdded(point=MetricPoint(feedback=number, at="2026-01-01T00:00:00Z", values=values))


async def test_the_first_message_is_a_snapshot_of_now(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        boot_id = (await live.http.get("/health")).json()["boot_id"]
        async with live.stream(experiment) as viewer:
            empty = await heard(viewer)
            assert (empty["type"], empty["boot_id"], empty["proposal"]) == ("snapshot", boot_id, None)
            assert empty["experiment"]["id"] == experiment
        proposal = await live.proposal(experiment)
        async with live.stream(experiment) as viewer:
            full = await heard(viewer)
            assert full["proposal"]["id"] == proposal.id
            assert full["experiment"]["lifecycle"] == "running"
            assert full["undoable"] is None
            await say(viewer, type="feedback", proposal_id=proposal.id, **live.click(-1))
            stored = (await event(viewer, "acknowledged"))["feedback"]
        async with live.stream(experiment) as viewer:
            after = await heard(viewer)
            assert after["proposal"] is None
            assert after["undoable"]["id"] == stored["id"]


async def test_nothing_is_missed_between_snapshot_and_events(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        published = 0
        stop = asyncio.Event()

        async def publish() -> None:
            nonlocal published
            while not stop.is_set():
                published += 1
                live.service.rooms.publish(experiment, metric(published))
                await asyncio.sleep(0.001)  # leaves the loop to the viewers

        publisher = asyncio.create_task(publish())
        for _ in range(5):
            async with live.stream(experiment) as viewer:
                assert (await heard(viewer))["type"] == "snapshot"
                numbers = [(await heard(viewer))["point"]["feedback"] for _ in range(20)]
                assert numbers == list(range(numbers[0], numbers[0] + 20))
        stop.set()
        await publisher


async def test_who_comes_back_hears_what_was_missed_and_nothing_twice(tmp_path: Path) -> None:
    async with serving(tmp_path, viewer_queue=8) as live:
        experiment = await live.experiment()
        rooms = live.service.rooms
        async with live.stream(experiment) as viewer:
            boot_id = (await heard(viewer))["boot_id"]
            rooms.publish(experiment, metric(1))
            last = (await heard(viewer))["seq"]
        for number in range(2, 6):
            rooms.publish(experiment, metric(number))
        async with live.stream(f"{experiment}/stream?boot_id={boot_id}&since={last}") as viewer:
            resumed = await heard(viewer)
            assert (resumed["type"], resumed["missed"], resumed["seq"]) == ("resumed", 4, last + 4)
            rooms.publish(experiment, metric(6))
            missed = [await heard(viewer) for _ in range(5)]
            assert [told["point"]["feedback"] for told in missed] == [2, 3, 4, 5, 6]
            assert [told["seq"] for told in missed] == list(range(last + 1, last + 6))
        for number in range(20):
            rooms.publish(experiment, metric(number))
        forgotten = (f"boot_id={boot_id}&since={last}", f"boot_id={boot_id}&since={last + 10_000}")
        for question in (*forgotten, f"boot_id=another-run&since={last + 5}", f"boot_id={boot_id}&since=-1", "since=x"):
            async with live.stream(f"{experiment}/stream?{question}") as viewer:
                assert (await heard(viewer))["type"] == "snapshot", question


async def test_every_viewer_of_an_experiment_hears_the_same_and_no_other_experiment(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        first, second = await live.experiment(), await live.experiment()
        async with live.stream(first) as a, live.stream(first) as b, live.stream(second) as c:
            for viewer in (a, b, c):
                await heard(viewer)
            await live.http.patch(f"/api/v1/experiments/{first}", json={"name": "renamed"})
            live.service.rooms.publish(second, metric(1))
            for viewer in (a, b):
                assert (await heard(viewer))["experiment"]["name"] == "renamed"
            assert (await heard(c))["type"] == "metrics_added"


async def test_a_click_is_acknowledged_after_it_is_stored_and_everyone_hears_of_it(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        async with live.stream(experiment) as trainer, live.stream(experiment) as viewer:
            await heard(trainer)
            await heard(viewer)
            click = live.click(0)
            for _ in range(2):
                await say(trainer, type="feedback", proposal_id=proposal.id, **click)
                acknowledged = await event(trainer, "acknowledged")
                assert acknowledged["request_id"] == click["click_id"]
                told = acknowledged["feedback"]
                assert (await live.http.get(f"/api/v1/feedback/{told['id']}")).json() == told
            assert (await event(viewer, "feedback_stored"))["feedback"] == told
            assert (await event(viewer, "proposal_closed"))["proposal"]["verdict"] == "neutral"
            late = live.click(1)
            await say(trainer, type="feedback", proposal_id=proposal.id, **late)
            assert (await event(trainer, "acknowledged"))["feedback"]["status"] == "late"
            await say(trainer, type="undo", request_id="undo-0001", feedback_id=told["id"])
            assert (await event(trainer, "acknowledged"))["feedback"]["undone_at"] is not None
            assert (await event(viewer, "proposal_opened"))["proposal"]["id"] == proposal.id


async def test_what_belongs_to_another_experiment_is_refused(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        mine, theirs = await live.experiment(), await live.experiment()
        proposal = await live.proposal(theirs)
        async with live.stream(mine) as viewer:
            await heard(viewer)
            click = live.click(1)
            await say(viewer, type="feedback", proposal_id=proposal.id, **click)
            refused = await event(viewer, "refused")
            assert (refused["request_id"], refused["problem"]["status"]) == (click["click_id"], 404)
            Problem.model_validate(refused["problem"])
            await say(viewer, type="feedback", proposal_id=99999, **live.click(1))
            assert (await event(viewer, "refused"))["problem"]["status"] == 404
            await say(viewer, type="feedback", proposal_id=2**70, **live.click(1))
            assert (await event(viewer, "refused"))["problem"]["status"] in (404, 422)
            stored = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(-1))
            await say(viewer, type="undo", request_id="undo-0001", feedback_id=stored.json()["id"])
            assert (await event(viewer, "refused"))["problem"]["status"] == 404
        kept = (await live.http.get(f"/api/v1/experiments/{theirs}/feedback")).json()["items"]
        assert [f["undone_at"] for f in kept] == [None]


async def test_the_emergency_stop_works_over_the_stream(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        async with live.stream(experiment) as viewer:
            await heard(viewer)
            await say(viewer, type="halt", request_id="halt-0001")
            assert (await event(viewer, "acknowledged"))["request_id"] == "halt-0001"
        assert (await live.http.get(f"/api/v1/experiments/{experiment}")).json()["halted"] is True


async def test_rubbish_is_refused_and_the_connection_lives_on(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        async with live.stream(experiment) as viewer:
            await heard(viewer)
            rubbish: list[str | bytes] = [
                "",
                "no json",
                "[]",
                "null",
                "{}",
                b"\x00\x01",
                "[" * 30_000,
                '{"type": "fly"}',
                '{"type": "ping", "loudly": true}',
                json.dumps({"type": "feedback", "proposal_id": proposal.id} | live.click(2)),
                json.dumps({"type": "feedback", "proposal_id": str(proposal.id)} | live.click(1)),
                json.dumps({"type": "feedback"} | live.click(1)),
            ]
            assert len(rubbish) < RUBBISH_LIMIT
            for message in rubbish:
                await viewer.send(message)
                refused = await heard(viewer)
                assert refused["type"] == "refused", message
                assert refused["problem"]["remedy"], message
            wrong = live.click(2)
            await say(viewer, type="feedback", proposal_id=proposal.id, **wrong)
            assert (await heard(viewer))["request_id"] == wrong["click_id"]
            await say(viewer, type="ping")
            assert (await heard(viewer))["type"] == "pong"
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}/feedback")).json()["items"] == []


async def test_endless_rubbish_ends_the_connection_and_nothing_else(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        async with live.stream(experiment) as good, live.stream(experiment) as bad:
            await heard(good)
            assert await sent_until_closed(bad, ["rubbish"] * RUBBISH_LIMIT * 2) == 1008
            await say(good, type="ping")
            assert (await heard(good))["type"] == "pong"


async def test_a_huge_message_closes_the_connection_and_nothing_else(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        async with live.stream(experiment) as good, live.stream(experiment) as bad:
            await heard(good)
            # the server may hang up before a slow sender has read why
            assert await sent_until_closed(bad, ["x" * 10_000_000]) in (1009, None)
            await say(good, type="ping")
            assert (await heard(good))["type"] == "pong"


async def test_an_unknown_experiment_and_a_foreign_page_are_denied_with_a_problem(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        foreign = {"origin": "https://evil.example"}
        for address, options, status in (
            (4242, {}, 404),
            ("x", {}, 404),
            ("9" * 40, {}, 404),
            (experiment, foreign, 403),
        ):
            with pytest.raises(InvalidStatus) as denied:
                async with live.stream(address, **options):
                    pass
            answer = denied.value.response
            assert (answer.status_code, answer.headers["Content-Type"]) == (status, MEDIA_TYPE)
            assert Problem.model_validate_json(answer.body or b"").remedy
        async with live.stream(experiment, origin=live.url) as viewer:
            assert (await heard(viewer))["type"] == "snapshot"


async def test_frames_come_one_at_a_time_and_the_newest_of_each_camera_wins(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        rooms = live.service.rooms
        async with live.stream(experiment) as viewer:
            await heard(viewer)
            rooms.publish_frame(experiment, header("left", 0), b"left 0")
            assert await frame(viewer) == ({**header("left", 0).model_dump()}, b"left 0")
            for number in range(1, 100):
                rooms.publish_frame(experiment, header("left", number), b"left %d" % number)
                rooms.publish_frame(experiment, header("right", number), b"right %d" % number)
            # no frame may come before the acknowledgement: the events overtake them
            await say(viewer, type="ping")
            assert (await heard(viewer))["type"] == "pong"
            await say(viewer, type="frame_ack")
            assert (await frame(viewer))[1] == b"left 99"
            rooms.publish_frame(experiment, header("left", 100), b"left 100")
            await say(viewer, type="frame_ack")
            assert (await frame(viewer))[1] == b"right 99"
            await say(viewer, type="frame_ack")
            assert (await frame(viewer))[1] == b"left 100"


async def test_pictures_of_one_robot_take_no_place_of_anothers(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment(num_envs=2)
        async with live.stream(experiment) as viewer:
            await heard(viewer)
            for number, robot in enumerate((0, 1, 0, 1)):
                told = header("left", number).model_copy(update={"robot": robot})
                live.service.rooms.publish_frame(experiment, told, b"robot %d" % robot)
            shown = []
            for _ in range(2):
                told_header, picture = await frame(viewer)
                shown.append((told_header["robot"], picture))
                await say(viewer, type="frame_ack")
            assert sorted(shown) == [(0, b"robot 0"), (1, b"robot 1")]


async def _deaf(live: Serving, experiment: int) -> socket.socket:
    """A viewer that shakes hands and then never reads again."""
    client = socket.socket()
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    client.setblocking(False)
    address = httpx.URL(live.url)
    loop = asyncio.get_running_loop()
    await loop.sock_connect(client, (address.host, address.port))
    request = (
        f"GET /api/v1/experiments/{experiment}/stream HTTP/1.1\r\nHost: {address.host}:{address.port}\r\n"
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
    )
    await loop.sock_sendall(client, request.encode())
    assert b"101" in await loop.sock_recv(client, 32)
    return client


async def test_a_viewer_that_stops_reading_delays_nobody_and_is_closed(tmp_path: Path) -> None:
    async with serving(tmp_path, viewer_queue=32) as live:
        experiment = await live.experiment()
        rooms = live.service.rooms
        deaf = await _deaf(live, experiment)
        async with live.stream(experiment) as viewer:
            await heard(viewer)
            # 40 MB of events: far more than the deaf one's socket buffers and queue take
            for number in range(200):
                rooms.publish(experiment, metric(number, size=200_000))
                assert (await heard(viewer))["point"]["feedback"] == number
            await say(viewer, type="ping")
            assert (await heard(viewer))["type"] == "pong"
        # what it finds when it reads at last: everything up to the overflow, then the close frame
        deaf.setblocking(True)
        deaf.settimeout(60)
        received = await asyncio.to_thread(_read_to_end, deaf)
        assert b"snapshot" in received[:2000]
        code = struct.unpack(">H", received[received.rindex(b"\x88") + 2 :][:2])[0]
        assert code == 1013
        async with live.stream(experiment) as viewer:
            assert (await heard(viewer))["type"] == "snapshot"


def _read_to_end(client: socket.socket) -> bytes:
    """Everything until a close frame stands at the end: 0x88, its length, code and reason."""
    received = bytearray()
    with client:
        while not _closed(received):
            chunk = client.recv(1 << 20)
            if not chunk:
                break
            received += chunk
    return bytes(received)


def _closed(received: bytearray) -> bool:
    tail = received[-64:]
    at = tail.rfind(b"\x88")
    return at >= 0 and len(tail) >= at + 2 and len(tail) == at + 2 + tail[at + 1]


async def test_a_full_outbox_overflows_instead_of_growing() -> None:
    outbox = Outbox(limit=2)
    for number in range(2):
        outbox.event(str(number))
    assert not outbox.overflowed
    outbox.event("2")
    await asyncio.wait_for(outbox.overflow(), timeout=1)
    assert [await outbox.next(), await outbox.next()] == ["0", "1"]


def test_a_room_that_everyone_has_left_is_forgotten() -> None:
    rooms = Rooms(queue_limit=8)
    with rooms.join(1) as outbox:
        rooms.publish(1, Pong())
        rooms.publish(2, Pong())
    rooms.publish(1, Pong())
    assert len(outbox._events) == 1
    assert rooms._rooms == {}
