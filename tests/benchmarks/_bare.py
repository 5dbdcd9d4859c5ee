"""The baseline of `load`: a Starlette server that acknowledges clicks, broadcasts, and stores nothing.

`python -m tests.benchmarks._bare PORT`; a client's address says how many events of which size a click causes.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import sys
from collections import defaultdict
from datetime import UTC, datetime

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

rooms: defaultdict[str, set[asyncio.Queue[str]]] = defaultdict(set)
owed: defaultdict[tuple[str, str], float] = defaultdict(float)
numbers = itertools.count(1)


async def stream(socket: WebSocket) -> None:
    """One viewer of a room."""
    await socket.accept()
    room = rooms[socket.url.path]
    queue: asyncio.Queue[str] = asyncio.Queue()
    room.add(queue)
    await socket.send_text('{"type":"snapshot","proposal":{"id":1}}')
    sending = asyncio.create_task(_send(socket, queue))
    try:
        while True:
            click = json.loads(await socket.receive_text())
            answer = {"type": "acknowledged", "request_id": click["click_id"], "feedback": {"status": "stored"}}
            queue.put_nowait(json.dumps(answer, separators=(",", ":")))
            for event in socket.url.query.split(","):
                _broadcast(socket.url.path, *event.split(":"))
    except WebSocketDisconnect:
        pass
    finally:
        room.discard(queue)
        sending.cancel()


def _broadcast(room: str, kind: str, count: str, size: str) -> None:
    owed[room, kind] += float(count)
    while owed[room, kind] >= 1:
        owed[room, kind] -= 1
        number, opened = next(numbers), datetime.now(UTC).isoformat()
        text = f'{{"type":"{kind}","proposal":{{"id":{number},"opened_at":"{opened}"}},"rest":"'
        text += "x" * (int(size) - len(text)) + '"}'
        for queue in rooms[room]:
            queue.put_nowait(text)


async def _send(socket: WebSocket, queue: asyncio.Queue[str]) -> None:
    while True:
        await socket.send_text(await queue.get())


async def up(request: Request) -> PlainTextResponse:
    """Whether it runs."""
    return PlainTextResponse("up")


if __name__ == "__main__":
    app = Starlette(routes=[Route("/", up), WebSocketRoute("/{room:int}", stream)])
    uvicorn.run(app, port=int(sys.argv[1]), log_level="error", ws="websockets-sansio", ws_per_message_deflate=False)
