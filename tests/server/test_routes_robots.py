"""Several robots through the real service: asked for, watched and judged from outside, over a crash of the service."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

from tests.live import LiveService, wait_for
from tests.server.serving import EXPERIMENT, event, serving
from tests.server.test_errors import check_problem

PATIENCE = 90.0


async def test_the_number_of_robots_is_chosen_at_creation(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        one = (await live.http.post("/api/v1/experiments", json=EXPERIMENT)).json()
        assert one["num_envs"] == 1
        made = (await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"num_envs": 16})).json()
        assert made["num_envs"] == 16
        address = f"/api/v1/experiments/{made['id']}"
        assert (await live.http.get(address)).json() == made
        check_problem(await live.http.patch(address, json={"num_envs": 2}), 422)
        for wrong in (0, 17, 1.5, "two"):
            told = check_problem(
                await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"num_envs": wrong}), 422
            )
            assert [field.field.split(".")[-1] for field in told.fields or []] == ["num_envs"]
        async with live.stream(made["id"]) as viewer:
            snapshot = await event(viewer, "snapshot")
        assert (snapshot["proposals"], snapshot["executions"], snapshot["proposal"]) == ([], [], None)
        check_problem(await live.http.post(f"{address}/reset", params={"robot": -1}), 422)
        check_problem(await live.http.post(f"{address}/reset", params={"robot": 16}), 404)


def test_a_real_robot_is_one(service: LiveService) -> None:
    real = EXPERIMENT | {"adapter": "benchtop", "num_envs": 2}
    told = check_problem(service.http.post("/api/v1/experiments", json=real), 422)
    assert [field.field for field in told.fields or []] == ["num_envs"]
    assert "leave num_envs at 1" in told.remedy
    assert service.http.post("/api/v1/experiments", json=real | {"num_envs": 1}).is_success


def test_two_robots_are_judged_by_a_client_over_a_crash_of_the_service(service: LiveService) -> None:
    experiment = service.experiment(adapter="kinematic", num_envs=2, adapter_settings={"step_seconds": 0.3})
    path = f"/experiments/{experiment}"
    numbers = itertools.count(1)

    def judge(proposal: dict[str, Any]) -> None:
        service.post(f"/proposals/{proposal['id']}/feedback", {"click_id": f"robots-{next(numbers)}", "value": 1})

    def waiting(after: int = 0) -> list[dict[str, Any]] | None:
        newest = service.get(f"{path}/proposals?limit=10")["items"]
        found = {p["robot"]: p for p in newest if p["closed_at"] is None and p["id"] > after}
        return [found[robot] for robot in range(2)] if len(found) == 2 else None

    def moving() -> list[dict[str, Any]]:
        return [e for e in service.get(f"{path}/executions")["items"] if e["ended_at"] is None]

    service.post(f"{path}/start")
    first = wait_for(waiting, "a proposal of each robot", PATIENCE)
    judge(first[0])
    wait_for(moving, "a motion", PATIENCE)
    service.kill()

    service.start()
    outcomes = {e["robot"]: (e["outcome"], e["proposal_id"]) for e in service.get(f"{path}/executions")["items"]}
    assert outcomes == {0: ("interrupted", first[0]["id"])}
    assert service.get(f"/proposals/{first[1]['id']}")["close_reason"] == "interrupted"
    assert service.get(path)["lifecycle"] == "paused"
    assert service.rows("SELECT count(*) FROM episode WHERE outcome = 'interrupted'")[0][0] == 2

    service.post(f"{path}/resume")
    second = wait_for(lambda: waiting(max(p["id"] for p in first)), "a new proposal of each robot", PATIENCE)
    assert sorted(p["episode"] for p in second) == [3, 4]
    for proposal in second:
        judge(proposal)

    def done() -> bool:
        ended = [e for e in service.get(f"{path}/executions")["items"] if e["outcome"] == "succeeded"]
        return {e["proposal_id"] for e in ended} == {p["id"] for p in second}

    wait_for(done, "two motions", PATIENCE)
    assert service.get(path)["counters"]["feedback"] == 3
