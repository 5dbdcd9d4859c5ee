"""Live video on robosuite at the pace of a real arm: pictures a second of each camera while a skill moves."""

from __future__ import annotations

import asyncio
import json
import struct
import tempfile
from collections import defaultdict
from pathlib import Path
from statistics import median

from tests.benchmarks.result import Result
from tests.server.serving import Serving, serving

BAR = 5.0
"""Pictures a second: below it a person can't follow what the arm does."""
EXECUTIONS = 10
FIELDS = {
    "adapter": "robosuite",
    "adapter_settings": {"speed": 1.0},
    "teacher": "synthetic",
    "preset": "recommended",
    "settings": {},
}


def run() -> Result:
    """Watch the first skills of an experiment that a synthetic teacher judges."""
    with tempfile.TemporaryDirectory() as folder:
        taken = asyncio.run(_watch(Path(folder)))
    rates = defaultdict(list)
    for (_, camera), stamps in taken.items():
        if len(stamps) > 1:
            rates[camera].append((len(stamps) - 1) / (stamps[-1] - stamps[0]))
    lines = [f"{camera}: median {median(r):.1f}, lowest {min(r):.1f}, {len(r)} skills" for camera, r in rates.items()]
    worst = min(median(r) for r in rates.values())
    return Result("live_video", worst, "pictures/s a camera", bar=BAR, ok=worst >= BAR, lines=tuple(lines))


async def _watch(folder: Path) -> dict[tuple[int, str], list[float]]:
    """Execution and camera -> when its pictures were taken, s."""
    async with serving(folder / "data") as service:
        experiment = await service.experiment(**FIELDS)
        try:
            return await _pictures(service, experiment)
        finally:
            await service.http.post(f"/api/v1/experiments/{experiment}/pause")


async def _pictures(service: Serving, experiment: int) -> dict[tuple[int, str], list[float]]:
    taken: dict[tuple[int, str], list[float]] = defaultdict(list)
    ended = 0
    async with service.stream(experiment) as stream:
        (await service.http.post(f"/api/v1/experiments/{experiment}/start")).raise_for_status()
        async for message in stream:
            if isinstance(message, str):
                ended += json.loads(message)["type"] == "execution_ended"
                if ended == EXECUTIONS:
                    break
                continue
            (length,) = struct.unpack_from(">I", message)
            header = json.loads(message[4 : 4 + length])
            if header["execution_id"] is not None:
                taken[header["execution_id"], header["camera"]].append(header["taken_at"])
            await stream.send(json.dumps({"type": "frame_ack"}))
    return dict(taken)
