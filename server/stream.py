"""The WebSocket of an experiment: snapshot, events, newest frames, and what a viewer may send.

Events are serialised once and queued per viewer; frames are never queued, the newest of a camera replaces the one
before. A viewer that doesn't keep up is disconnected (1013) and finds its way back by what it missed, or by a snapshot:
nobody waits for it.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import struct
from collections import defaultdict, deque
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any

from fastapi import WebSocket, WebSocketDisconnect
from pydantic import TypeAdapter, ValidationError

from server.backlog import Backlog
from server.errors import ServiceError, problem, problem_of
from server.heartbeat import Heartbeat
from server.hub import Hub
from server.messages import (
    Acknowledged,
    ClientFeedback,
    ClientFrameAck,
    ClientHalt,
    ClientLook,
    ClientMessage,
    ClientPing,
    ClientRelabel,
    ClientUndo,
    FrameHeader,
    Pong,
    Refused,
    StreamEvent,
)
from server.presence import Visit
from server.principal import Principal
from server.privacy import Telling
from server.roles import refusal
from server.schemas import Feedback, FeedbackCreate
from server.schemas_labels import RelabelCreate
from server.schemas_problems import Problem
from server.store import Store
from server.store_errors import NotFound, StoreError

TRY_AGAIN_LATER = 1013
POLICY_VIOLATION = 1008
SIGNED_OUT = 4401
"""Close code of a stream whose viewer's access has ended; 4000 and up are an application's own."""
SILENT = 4408
"""Close code of a stream whose viewer has stopped saying that it is there."""
RUBBISH_LIMIT = 20
"""Unreadable messages after which a viewer is disconnected; a page of ours sends none."""
HASTE_LIMIT = 200
"""Messages in a row that came too fast: who goes on after so many refusals costs the others, and is disconnected."""
INBOX_LIMIT = 64
"""Messages of one viewer that may wait for the store."""
FAREWELL_SECONDS = 30.0
"""How long a close frame may wait for a viewer that has stopped reading."""
NO_FAREWELL_SECONDS = 0.5
"""The same for one that is gone: its seat and its part in a quorum wait for this."""

Pace = Callable[[Principal], None]
Request = ClientFeedback | ClientRelabel | ClientUndo

_client_message: TypeAdapter[ClientMessage] = TypeAdapter(ClientMessage)


def pack(header: FrameHeader, jpeg: bytes) -> bytes:
    """A binary message: `[u32 big-endian header length][JSON header][JPEG]`."""
    encoded = header.model_dump_json().encode()
    return struct.pack(">I", len(encoded)) + encoded + jpeg


class Outbox:
    """What waits for one viewer. Fed without blocking; taken from by one sender."""

    def __init__(self, limit: int, reader: str | None = None) -> None:
        """reader: who may not know the names of others; None: they may."""
        self.reader = reader
        self._limit = limit
        self._events: deque[str] = deque()
        self._frames: dict[tuple[int, str], bytes] = {}
        self._awaiting_ack = False
        self._ready = asyncio.Event()
        self._overflowed = asyncio.Event()

    def event(self, text: str) -> None:
        """Queue an event; a full queue marks the viewer as overflowed instead."""
        if len(self._events) >= self._limit:
            self._overflowed.set()
            return
        self._events.append(text)
        self._ready.set()

    def frame(self, robot: int, camera: str, packed: bytes) -> None:
        """Keep the newest frame of a robot's camera; it takes the place in line of the one it replaces."""
        self._frames[robot, camera] = packed
        self._ready.set()

    def acknowledged(self) -> None:
        """The viewer has drawn its frame: the next may go."""
        self._awaiting_ack = False
        self._ready.set()

    @property
    def overflowed(self) -> bool:
        """Whether events were lost to this viewer."""
        return self._overflowed.is_set()

    async def overflow(self) -> None:
        """Wait until the viewer has overflowed."""
        await self._overflowed.wait()

    async def next(self) -> str | bytes:
        """The next message: every waiting event before any frame, and one unacknowledged frame at a time."""
        while True:
            if self._events:
                return self._events.popleft()
            if self._frames and not self._awaiting_ack:
                self._awaiting_ack = True
                return self._frames.pop(next(iter(self._frames)))
            self._ready.clear()
            await self._ready.wait()


class Rooms:
    """Who watches which experiment. The hub publishes here (its `Publisher`); used from the event loop only."""

    shows_frames = True

    def __init__(self, *, queue_limit: int) -> None:
        self._queue_limit = queue_limit
        self._rooms: dict[int, set[Outbox]] = {}
        self._backlogs: defaultdict[int, Backlog] = defaultdict(lambda: Backlog(queue_limit))

    def newest(self, experiment_id: int) -> int:
        """Number of the experiment's last event."""
        backlog = self._backlogs.get(experiment_id)
        return 0 if backlog is None else backlog.newest

    def missed(self, experiment_id: int, since: int, reader: str | None = None) -> list[str] | None:
        """The events after that number, in order, as `reader` may hear them; None where they aren't known any more."""
        backlog = self._backlogs.get(experiment_id)
        events = None if backlog is None else backlog.since(since)
        return None if events is None else [Telling(event).to(reader) for event in events]

    def publish(self, experiment_id: int, event: StreamEvent) -> None:
        """Queue an event for every viewer of the experiment; never blocks."""
        backlog = self._backlogs[experiment_id]
        numbered = backlog.add(event)
        room = self._rooms.get(experiment_id)
        if room:
            telling = Telling(numbered)
            backlog.put_into_words(telling.to(None))
            for outbox in room:
                outbox.event(telling.to(outbox.reader))

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        """Offer a frame to every viewer of the experiment; never blocks."""
        room = self._rooms.get(experiment_id)
        if room:
            packed = pack(header, jpeg)
            for outbox in room:
                outbox.frame(header.robot, header.camera, packed)

    @contextmanager
    def join(self, experiment_id: int, reader: str | None = None) -> Iterator[Outbox]:
        """An outbox that receives everything published from now on, as `reader` may hear it."""
        outbox = Outbox(self._queue_limit, reader)
        room = self._rooms.setdefault(experiment_id, set())
        room.add(outbox)
        try:
            yield outbox
        finally:
            room.discard(outbox)
            if not room:
                self._rooms.pop(experiment_id, None)


class Connection:
    """One viewer's WebSocket on one experiment."""

    def __init__(
        self,
        socket: WebSocket,
        outbox: Outbox,
        hub: Hub,
        store: Store,
        visit: Visit,
        *,
        pace: Pace,
        trainer: str | None = None,
    ) -> None:
        """Be a viewer's side of it.

        pace: counts a message, and refuses what is too much. trainer: whose page it is; None: somebody's who only
        watches, or whose clicks say who they are.
        """
        self._socket = socket
        self._outbox = outbox
        self._hub = hub
        self._store = store
        self._visit = visit
        self._who = visit.who
        self._experiment_id = visit.experiment_id
        self._trainer = trainer
        self._inbox: asyncio.Queue[Request] = asyncio.Queue(INBOX_LIMIT)
        self._going: set[asyncio.Task[None]] = set()
        self._pace = pace
        self._rubbish = 0
        self._haste = 0
        self._heartbeat = Heartbeat(lambda: self._answer(Pong()))

    async def serve(self) -> None:
        """Run until either side ends."""
        lives = (
            *(self._send(), self._receive(), self._work()),
            *(self._outbox.overflow(), self._cut_off(), self._silence()),
        )
        parts = [asyncio.create_task(part) for part in lives]
        try:
            done, _ = await asyncio.wait(parts, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in parts:
                task.cancel()
        # what has been taken from the wire is carried through: a click, and above all a halt
        await asyncio.gather(*parts, *self._going, return_exceptions=True)
        if self._visit.cut.is_set():
            await self._close(SIGNED_OUT, "your access has ended")
        elif self._visit.silence:
            await self._close(SILENT, "nothing was heard of you: reconnect", NO_FAREWELL_SECONDS)
        elif self._outbox.overflowed:
            await self._close(TRY_AGAIN_LATER, "too slow: reconnect for a snapshot")
        elif self._rubbish >= RUBBISH_LIMIT:
            await self._close(POLICY_VIOLATION, "too many unreadable messages")
        elif self._haste >= HASTE_LIMIT:
            await self._close(POLICY_VIOLATION, "too many messages")
        for task in done:
            error = task.exception()
            if error is not None and not isinstance(error, WebSocketDisconnect):
                raise error

    async def _cut_off(self) -> None:
        await self._visit.cut.wait()

    async def _silence(self) -> None:
        self._visit.silence = await self._heartbeat.lost()

    async def _send(self) -> None:
        while True:
            message = await self._outbox.next()
            if isinstance(message, str):
                await self._socket.send_text(message)
            else:
                await self._socket.send_bytes(message)

    async def _receive(self) -> None:
        while self._rubbish < RUBBISH_LIMIT and self._haste < HASTE_LIMIT:
            received = await self._socket.receive()
            if received["type"] == "websocket.disconnect":
                return
            self._take(received.get("text"))

    def _take(self, text: str | None) -> None:
        if text is None:
            self._refuse_rubbish("a client sends text messages only")
            return
        try:
            message = _client_message.validate_json(text)
        except ValidationError as error:
            first = error.errors(include_input=False, include_url=False)[0]
            self._refuse_rubbish(".".join([*map(str, first["loc"]), first["msg"]]), _request_id(text))
            return
        self._heartbeat.heard(regular=isinstance(message, ClientPing) and message.regular)
        refused = refusal(self._who, message.type) or self._too_fast(message)
        if refused is not None:
            self._answer(Refused(request_id=_request_id(text), problem=refused))
        elif isinstance(message, ClientFrameAck):
            self._outbox.acknowledged()
        elif isinstance(message, ClientPing):
            self._answer(Pong())
        elif isinstance(message, ClientLook):
            if self._trainer is not None:
                self._carry(self._look(self._trainer))
        elif isinstance(message, ClientHalt):
            # beside the queue: a stop never waits for a click's commit
            self._carry(self._halt(message))
        else:
            try:
                self._inbox.put_nowait(message)
            except asyncio.QueueFull:
                details = problem(
                    503, "too many messages wait for an answer", remedy="wait for the answers, send again"
                )
                self._answer(Refused(request_id=_id_of(message), problem=details))

    def _too_fast(self, message: ClientMessage) -> Problem | None:
        """A stop is always taken, and a picture is only acknowledged as often as one was sent."""
        if isinstance(message, ClientHalt | ClientFrameAck):
            return None
        try:
            self._pace(self._who)
        except ServiceError as error:
            self._haste += 1
            return error.problem
        self._haste = 0
        return None

    async def _work(self) -> None:
        while True:
            message = await self._inbox.get()
            await asyncio.shield(self._carry(self._judge(message)))

    def _carry(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        """Start something that is finished even if its viewer leaves meanwhile."""
        task = asyncio.create_task(work)
        self._going.add(task)
        task.add_done_callback(self._going.discard)
        return task

    async def _judge(self, message: Request) -> None:
        try:
            if isinstance(message, ClientUndo):
                feedback = await self._undo(message)
            elif isinstance(message, ClientRelabel):
                correction = RelabelCreate(click_id=message.click_id, value=message.value, trainer=message.trainer)
                feedback, _ = await self._hub.relabel(
                    message.feedback_id, self._who.named(correction), self._experiment_id
                )
            else:
                click = FeedbackCreate(
                    click_id=message.click_id,
                    value=message.value,
                    trainer=message.trainer,
                    estimate_shown=message.estimate_shown,
                    looked=message.looked,
                )
                feedback, _ = await self._hub.feedback(
                    message.proposal_id, self._who.named(click), experiment_id=self._experiment_id
                )
        except Exception as error:  # noqa: BLE001  every error goes back to the viewer in one shape; the stream lives on
            self._answer(Refused(request_id=_id_of(message), problem=problem_of(error)))
        else:
            self._answer(Acknowledged(request_id=_id_of(message), feedback=feedback))

    async def _undo(self, message: ClientUndo) -> Feedback:
        feedback = await self._store.feedback(message.feedback_id)
        if feedback.experiment_id != self._experiment_id:
            raise NotFound("feedback of this experiment", message.feedback_id)
        return await self._hub.undo(message.feedback_id, by=self._who.asking(self._trainer))

    async def _look(self, trainer: str) -> None:
        with contextlib.suppress(StoreError):  # it comes again in a moment
            await self._hub.seats.look(self._experiment_id, trainer)

    async def _halt(self, message: ClientHalt) -> None:
        try:
            await self._hub.act(self._experiment_id, "halt")
        except Exception as error:  # noqa: BLE001  as above
            self._answer(Refused(request_id=message.request_id, problem=problem_of(error)))
        else:
            self._answer(Acknowledged(request_id=message.request_id))

    def _refuse_rubbish(self, detail: str, request_id: str | None = None) -> None:
        self._rubbish += 1
        details = problem(
            422, detail, remedy="send one of: feedback, look, relabel, undo, halt, frame_ack, ping; see docs/api.md"
        )
        self._answer(Refused(request_id=request_id, problem=details))

    def _answer(self, event: Acknowledged | Refused | Pong) -> None:
        self._outbox.event(Telling(event).to(self._outbox.reader))

    async def _close(self, code: int, reason: str, patience: float = FAREWELL_SECONDS) -> None:
        # the close frame stands behind what the viewer hasn't read
        with contextlib.suppress(TimeoutError, RuntimeError, WebSocketDisconnect):
            await asyncio.wait_for(self._socket.close(code, reason), patience)


def _id_of(message: Request) -> str:
    return message.request_id if isinstance(message, ClientUndo) else message.click_id


def _request_id(text: str) -> str | None:
    """The id that a wrong message carries, so that its sender knows which one was refused."""
    try:
        body = json.loads(text)
    except (ValueError, RecursionError):
        return None
    found = body.get("click_id", body.get("request_id")) if isinstance(body, dict) else None
    return found if isinstance(found, str) and len(found) <= 64 else None
