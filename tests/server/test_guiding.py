"""Calibrating over HTTP: a simulated robot has nothing to calibrate, and bad numbers are named."""

from __future__ import annotations

from pathlib import Path

from tests.server.serving import EXPERIMENT, serving
from tests.server.test_errors import check_problem


async def test_a_simulated_robot_has_no_cameras_to_calibrate(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        made = (await live.http.post("/api/v1/experiments", json=EXPERIMENT)).json()
        path = f"/api/v1/experiments/{made['id']}/camera-calibration"
        for answer in (
            await live.http.get(path),
            await live.http.post(path, json={}),
            await live.http.post(f"{path}/looks", json={"take": True}),
            await live.http.post(f"{path}/solution"),
            await live.http.put(path),
        ):
            assert "cameras are exact" in check_problem(answer, 409).detail
        for body, field in (({"square_mm": 1}, "square_mm"), ({"wanted": 3}, "wanted"), ({"square": 36}, "square")):
            told = check_problem(await live.http.post(path, json=body), 422)
            assert [f.field for f in told.fields] == [field]
        check_problem(await live.http.post("/api/v1/experiments/999/camera-calibration", json={}), 404)
