"""The WebSocket route of an experiment, and its messages in OpenAPI."""

from __future__ import annotations

import re
from typing import Annotated, get_args

from fastapi import APIRouter, Body, FastAPI, WebSocket, WebSocketDisconnect
from starlette.websockets import WebSocketState

from server.access import principal
from server.errors import problem, problem_of, response
from server.messages import ClientMessage, FrameHeader, Resumed, StreamEvent
from server.names import must_be_a_persons
from server.principal import Role
from server.privacy import Telling, reader
from server.routes.dependencies import LARGEST_ID
from server.service import Service
from server.store_errors import BadName, StoreError
from server.stream import Connection

router = APIRouter()

_trainer_name = re.compile(r"[^\x00-\x1f\x7f]{1,64}")


@router.websocket("/experiments/{experiment_id}/stream")
async def stream(socket: WebSocket, experiment_id: str, boot_id: str = "", since: str = "", trainer: str = "") -> None:
    """A snapshot, or what was missed since the event `since` of this `boot_id`; then everything that happens.

    trainer: who sits at this page to judge, and gets proposals; left out: somebody who watches.
    """
    service: Service = socket.app.state.service
    if not experiment_id.isascii() or not experiment_id.isdigit() or int(experiment_id[:20]) > LARGEST_ID:
        details = problem(404, f"there is no experiment {experiment_id[:40]!r}", remedy="see GET /api/v1/experiments")
        await socket.send_denial_response(response(details))
        return
    watched = int(experiment_id)
    if trainer and not _trainer_name.fullmatch(trainer):
        details = problem(
            422, "trainer: is no name", remedy="give 1 to 64 characters, none of them a control character"
        )
        await socket.send_denial_response(response(details))
        return
    who = principal(socket)
    if trainer and who.local:
        try:
            must_be_a_persons(trainer, "trainer")
        except BadName as error:
            await socket.send_denial_response(response(problem_of(error)))
            return
    same_run = boot_id == socket.app.state.boot_id and since.isascii() and since.isdigit()
    # first listen, then look: whatever happens while the snapshot is read comes after it, some of it twice,
    # and every event carries the whole of what it is about, so twice is harmless
    seat = who.called(trainer).name if trainer and who.role.covers(Role.TRAINER) else None
    hears = reader(who)
    with service.rooms.join(watched, hears) as outbox, service.hub.presence.visit(watched, who) as visit:
        newest = service.rooms.newest(watched)
        missed = service.rooms.missed(watched, int(since[:20]), hears) if same_run else None
        pace = service.doors.pace
        connection = Connection(socket, outbox, service.hub, service.store, visit, pace=pace, trainer=seat)
        try:
            async with service.hub.seats.seated(watched, seat, visit):
                if missed is None:
                    snapshot = await service.hub.snapshot(watched, socket.app.state.boot_id, seat)
                    first = [Telling(snapshot.model_copy(update={"seq": newest})).to(hears)]
                else:
                    await service.store.experiment(watched)
                    first = [Resumed(seq=newest, missed=len(missed)).model_dump_json(), *missed]
                await socket.accept()
                for message in first:
                    await socket.send_text(message)
                await connection.serve()
        except StoreError as error:
            if socket.application_state is WebSocketState.CONNECTING:
                await socket.send_denial_response(response(problem_of(error)))
            else:
                raise
        except WebSocketDisconnect:
            return


def document(app: FastAPI) -> None:
    """Declare every message of the stream as a webhook, so that OpenAPI (and the types made from it) has them."""

    @app.webhooks.post("stream-event", tags=["stream"], summary="Any event of the stream (text message)")
    def stream_event(body: StreamEvent) -> None:
        """What the server sends as text messages, told apart by `type`."""

    @app.webhooks.post("stream-frame", tags=["stream"], summary="Header of a live picture (binary message)")
    def stream_frame(body: FrameHeader) -> None:
        """A binary message is `[u32 big-endian header length][this as JSON][JPEG]`; answer it with `frame_ack`."""

    @app.webhooks.post("stream-message", tags=["stream"], summary="Any message of a client")
    def stream_message(body: Annotated[ClientMessage, Body()]) -> None:
        """What a client may send as text messages, told apart by `type`."""

    for event in get_args(get_args(StreamEvent)[0]):
        _document_one(app, event)


def _document_one(app: FastAPI, event: type) -> None:
    name = event.model_fields["type"].default  # type: ignore[attr-defined]  # every member of the union has it

    def declared(body: object) -> None: ...

    declared.__annotations__["body"] = event
    declared.__doc__ = event.__doc__
    summary = f"Event {name}"
    app.webhooks.post(f"stream-event/{name}", tags=["stream"], summary=summary, operation_id=f"event_{name}")(declared)
