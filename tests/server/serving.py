"""The real application under a real uvicorn on a free port, inside the test's own event loop."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import socket
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
from websockets.asyncio.client import ClientConnection, connect

from robot_adapters.base import SkillCall
from server.app import create_app
from server.cli_serve import Server, config
from server.images import Images
from server.schemas import Proposal
from server.schemas_views import Overlay
from server.service import Service, opened
from server.settings import Settings
from server.store_values import NewProposal, NewView

SMALL: dict[str, Any] = {"hidden_size": 16, "batch_size": 16}
"""Settings of a learner that costs nothing."""
EXPERIMENT: dict[str, Any] = {"name": "test", "task": "stacking", "adapter": "kinematic", "settings": SMALL}
JPEG = b"\xff\xd8\xff\xe0 stands for a picture \xff\xd9"


class _InLoop(Server):
    @contextlib.contextmanager
    def capture_signals(self) -> Any:
        yield


@dataclass
class Serving:
    """A service to talk to: by `http` and `stream` from outside, by `service` to set a scene."""

    url: str
    http: httpx.AsyncClient
    service: Service
    _counts: Any = field(default_factory=lambda: itertools.count(1))

    async def experiment(self, **fields: Any) -> int:
        """A new experiment's id."""
        answer = await self.http.post("/api/v1/experiments", json=EXPERIMENT | fields)
        assert answer.status_code == 201, answer.text
        return int(answer.json()["id"])

    async def proposal(self, experiment_id: int, electorate: tuple[str, ...] = ("local",)) -> Proposal:
        """A proposal opened as the runner does, without its processes; the experiment is set running first."""
        if (await self.service.store.experiment(experiment_id)).lifecycle != "running":
            await self.service.store.transition(experiment_id, "start")
            await self.service.store.begin_episode(experiment_id, 0)
        number = next(self._counts)
        image = Images(self.service.settings.data_dir).put(JPEG + str(number).encode())
        new = NewProposal(
            experiment_id=experiment_id,
            observation_id=f"observation-{number}",
            state=(0.5, 0.0, -0.09, 0.6, 0.1, -0.09),
            taken_at=1_700_000_000.0,
            call=SkillCall("pick", (0.5, 0.0, -0.09)),
            parameter_names=("x", "y", "z"),
            predicted_feedback=0.25,
            skill_probabilities={"pick": 0.75, "place": 0.25},
            policy_version=0,
            subgoal="pick up the red block",
            electorate=electorate,
            views=[NewView("left", 640, 480, image, Overlay(dot=(320.0, 240.0)))],
        )
        return await self.service.store.open_proposal(new)

    def click(self, value: int | str = -1, **fields: Any) -> dict[str, Any]:
        """The body of a click with an id of its own."""
        return {"click_id": f"click-{next(self._counts):08d}", "value": value} | fields

    def stream(self, experiment_id: int | str, **options: Any) -> connect:
        """A WebSocket on the experiment's stream, to be entered; instead of the id, its path may go on by itself."""
        path = f"{experiment_id}/stream" if "/" not in str(experiment_id) else experiment_id
        address = self.url.replace("http", "ws", 1) + f"/api/v1/experiments/{path}"
        return connect(address, **({"max_size": None} | options))


@contextlib.asynccontextmanager
async def serving(data_dir: Path, *, send_buffer: int | None = None, **settings: Any) -> AsyncIterator[Serving]:
    """Serve from `data_dir`; leaving ends every process. send_buffer: bytes that the kernel keeps of what is sent."""
    options: dict[str, Any] = {"data_dir": data_dir, "create_first_experiment": False} | settings
    chosen = Settings(**options)
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        if send_buffer is not None:  # those that it accepts have it too
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, send_buffer)
        url = f"http://127.0.0.1:{listener.getsockname()[1]}"
        async with opened(chosen) as service:
            server = _InLoop(config(create_app(chosen, service), chosen))
            started = asyncio.Event()
            server.on_ready = started.set
            task = asyncio.create_task(server.serve(sockets=[listener]))
            await started.wait()
            try:
                async with httpx.AsyncClient(base_url=url, timeout=60) as http:
                    yield Serving(url, http, service)
            finally:
                server.should_exit = True
                await task


async def event(viewer: ClientConnection, kind: str, patience: float = 60.0) -> dict[str, Any]:
    """The next text message of a type; others before it are passed over."""
    async with asyncio.timeout(patience):
        while True:
            message = await viewer.recv()
            if isinstance(message, str) and (body := json.loads(message))["type"] == kind:
                return dict(body)
