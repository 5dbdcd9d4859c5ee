"""Emergency stop on robosuite: from the request until the arm's last set-point, over REST, while a skill moves."""

from __future__ import annotations

import asyncio
import random
import socket
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import uvicorn

from server.app import create_app
from server.crew_values import Done
from server.robots import Robot
from server.schemas import ExperimentCreate
from server.service import Service, opened
from server.settings import Settings
from tests.benchmarks.result import Result

BAR = 100.0
"""ms: from the request to the last set-point."""
STOPS = 60
SPEEDS = (0.0, 1.0)
"""As fast as the simulator goes, and at the pace of a real arm: 20 set-points a second."""


def run() -> Result:
    """Approve whatever is proposed, and stop it at a random moment."""
    latencies = {speed: asyncio.run(_measure(speed, STOPS // len(SPEEDS))) for speed in SPEEDS}
    every = np.concatenate([np.array(values) for values in latencies.values()])
    p50, p99 = np.percentile(every, [50, 99])
    lines = [f"{len(every)} stops by POST .../halt: p50 {p50:.1f} ms, p99 {p99:.1f} ms, worst {every.max():.1f} ms"]
    for speed, values in latencies.items():
        pace = f"at {speed:g} times real time" if speed else "as fast as it goes"
        lines.append(f"{pace}: p50 {np.percentile(values, 50):.1f} ms, p99 {np.percentile(values, 99):.1f} ms")
    return Result("stop_latency", float(p99), "ms p99", bar=BAR, ok=bool(p99 <= BAR), lines=tuple(lines))


async def _measure(speed: float, stops: int) -> list[float]:
    """Ms from sending the request to the last set-point; 0 where that had come already."""
    motions: asyncio.Queue[Done] = asyncio.Queue()
    execute = Robot.execute

    async def watched(self: Robot, *arguments: Any) -> Done:
        done = await execute(self, *arguments)
        motions.put_nowait(done)
        return done

    Robot.execute = watched  # type: ignore[method-assign,assignment]
    try:
        with tempfile.TemporaryDirectory() as directory:
            settings = Settings(data_dir=Path(directory), create_first_experiment=False, log_level="error")
            async with opened(settings) as service, _client(service) as client:
                return [t async for t in _stops(service, client, motions, speed, stops)]
    finally:
        Robot.execute = execute  # type: ignore[method-assign]


async def _stops(
    service: Service,
    client: httpx.AsyncClient,
    motions: asyncio.Queue[Done],
    speed: float,
    stops: int,
) -> AsyncIterator[float]:
    chance = random.Random(7)
    body = ExperimentCreate(name="stop", task="stacking", adapter_settings={"speed": speed})
    experiment = (await service.create(body)).id
    path = f"/api/v1/experiments/{experiment}"
    await _post(client, f"{path}/start")
    counted = 0
    while counted < stops:
        proposal = await _waiting(client, path)
        click = {"click_id": f"stop-{proposal['id']:06d}", "value": 1}
        await _post(client, f"/api/v1/proposals/{proposal['id']}/feedback", click)
        # a skill takes about 44 set-points, at full speed .03 s and its pictures; stop in their midst
        await asyncio.sleep(chance.uniform(0.02, 1.5) if speed else chance.uniform(0.0, 0.05))
        asked = time.monotonic()
        await _post(client, f"{path}/halt")
        done = await motions.get()
        if done.stopped and done.last_set_point_at is not None:
            counted += 1
            yield max(0.0, done.last_set_point_at - asked) * 1e3
        await service.hub.idle(experiment)
        await _post(client, f"{path}/rearm")
        await _post(client, f"{path}/reset")
        await _post(client, f"{path}/resume")


async def _waiting(client: httpx.AsyncClient, path: str) -> dict[str, Any]:
    while True:
        newest: dict[str, Any] = (await client.get(f"{path}/proposals", params={"limit": 1})).json()
        if newest["items"] and newest["items"][0]["closed_at"] is None:
            found: dict[str, Any] = newest["items"][0]
            return found
        await asyncio.sleep(0.02)


async def _post(client: httpx.AsyncClient, path: str, body: dict[str, Any] | None = None) -> None:
    (await client.post(path, json=body)).raise_for_status()


@asynccontextmanager
async def _client(service: Service) -> AsyncIterator[httpx.AsyncClient]:
    """A client of the real HTTP server, on a free port of this machine."""
    listening = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(uvicorn.Config(create_app(service=service), log_level="error"))
    serving = asyncio.create_task(server.serve(sockets=[listening]))
    try:
        address = f"http://127.0.0.1:{listening.getsockname()[1]}"
        async with httpx.AsyncClient(base_url=address, timeout=60) as client:
            yield client
    finally:
        server.should_exit = True
        await serving
