"""What a robot tells of itself reaches whoever watches: at rest, in motion, and late comers."""

from __future__ import annotations

import asyncio
import json
import struct
from pathlib import Path
from typing import Any

from tests.server.serving import event, serving


async def test_a_robot_tells_of_itself_at_rest_in_motion_and_to_late_comers(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment(adapter_settings={"step_seconds": 0.3})
        async with live.stream(experiment) as viewer:
            assert (await event(viewer, "snapshot"))["robots"] == []
            await live.http.post(f"/api/v1/experiments/{experiment}/start")
            told = await event(viewer, "robot_told")
            x, y, z = told["telemetry"]["gripper"]
            assert told["robot"] == 0
            assert 0.2 < x < 1.0
            assert told["telemetry"]["opening"] > 0.05
            assert told["telemetry"]["calibration"] == "exact"
            proposal = (await event(viewer, "proposal_opened"))["proposal"]
            await live.http.post(f"/api/v1/proposals/{proposal['id']}/feedback", json=live.click(1))
            moving = await _in_motion(viewer)
            assert moving["gripper"] != [x, y, z]
            after = (await event(viewer, "robot_told"))["telemetry"]["gripper"]
            assert after != [x, y, z]
        async with live.stream(experiment) as viewer:
            (known,) = (await event(viewer, "snapshot"))["robots"]
            assert known["telemetry"]["gripper"] == after
        async with live.stream(experiment) as viewer:
            await live.http.post(f"/api/v1/experiments/{experiment}/halt")
            kept = await event(viewer, "incident_kept")
            incident = (await live.http.get(f"/api/v1/incidents/{kept['incident_id']}")).json()
            assert (kept["kind"], incident["kind"]) == ("halt", "halt")
            assert incident["frames"], "it had moved in the seconds before"
        task = (await live.http.get("/api/v1/tasks/stacking")).json()
        assert "blocks" in task["by_hand"]


async def _in_motion(viewer: Any) -> dict[str, Any]:
    """Telemetry of the first live picture that carries some; every picture is acknowledged, as a page does."""
    async with asyncio.timeout(60):
        while True:
            message = await viewer.recv()
            if not isinstance(message, bytes):
                continue
            (length,) = struct.unpack(">I", message[:4])
            header = json.loads(message[4 : 4 + length])
            await viewer.send(json.dumps({"type": "frame_ack"}))
            if header["telemetry"] is not None:
                return dict(header["telemetry"])
