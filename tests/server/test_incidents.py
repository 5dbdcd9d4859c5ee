"""What went wrong is kept: the video of the seconds before, and what people saw, in words of their own."""

from __future__ import annotations

from typing import Any

import httpx

from server.store import Store
from tests.live import LiveService, wait_for
from tests.server.databases import click, opened, running
from tests.server.test_violations import approve

PATIENCE = 90.0


def incidents(service: LiveService, experiment: int) -> list[dict[str, Any]]:
    return list(service.get(f"/experiments/{experiment}/incidents")["items"])


def test_damage_is_kept_with_the_video_of_the_seconds_before(service: LiveService) -> None:
    settings = {"violation": "damage", "every": 1, "step_seconds": 0.1}
    experiment = service.experiment(adapter="clumsy", adapter_settings=settings)
    service.post(f"/experiments/{experiment}/start")
    approve(service, experiment, 1)
    (incident,) = wait_for(lambda: incidents(service, experiment), "the incident", PATIENCE)
    (execution,) = service.get(f"/experiments/{experiment}/executions")["items"]
    assert (incident["kind"], incident["detail"]) == ("damage", "bumped into the table")
    assert incident["execution_id"] == execution["id"]
    assert execution["violations"] == [{"kind": "damage", "detail": "bumped into the table"}]
    times = [frame["taken_at"] for frame in incident["frames"]]
    assert len(times) > 4
    assert times == sorted(times)
    assert {frame["camera"] for frame in incident["frames"]} == {"left", "right"}
    picture = service.http.get(incident["frames"][-1]["url"])
    assert (picture.status_code, picture.headers["content-type"]) == (httpx.codes.OK, "image/jpeg")
    assert picture.content.startswith(b"\xff\xd8")
    beyond = service.http.get(f"/api/v1/incidents/{incident['id']}/frames/{len(times)}")
    assert beyond.status_code == httpx.codes.NOT_FOUND
    assert str(len(times)) in beyond.json()["remedy"]
    service.post(f"/experiments/{experiment}/finish")


def test_a_stop_is_one_incident_however_often_it_is_asked_for(service: LiveService) -> None:
    experiment = service.experiment(adapter="kinematic")
    for _ in range(3):
        service.post(f"/experiments/{experiment}/halt")
    (incident,) = wait_for(lambda: incidents(service, experiment), "the incident", PATIENCE)
    assert (incident["kind"], incident["execution_id"], incident["frames"]) == ("halt", None, [])
    service.post(f"/experiments/{experiment}/rearm")
    service.post(f"/experiments/{experiment}/halt")
    again = wait_for(lambda: _two(incidents(service, experiment)), "the second incident", PATIENCE)
    assert [each["kind"] for each in again] == ["halt", "halt"]
    service.post(f"/experiments/{experiment}/rearm")


def test_what_people_saw_is_kept_beside_what_the_robot_told(service: LiveService) -> None:
    experiment = service.experiment(adapter="kinematic")
    service.post(f"/experiments/{experiment}/start")
    approve(service, experiment, 1)
    execution = wait_for(lambda: _ended(service, experiment), "the execution", PATIENCE)
    path = f"/api/v1/executions/{execution['id']}/reports"
    body = {
        "report_id": f"report-{execution['id']:06}",
        "outcome": "needs_reset",
        "note": "it fell",
        "trainer": "Ana",
    }
    first = service.http.post(path, json=body)
    assert first.status_code == httpx.codes.CREATED
    (kept,) = first.json()["reports"]
    assert (kept["outcome"], kept["note"], kept["trainer"]) == ("needs_reset", "it fell", "Ana")
    assert first.json()["outcome"] == execution["outcome"], "the robot's own word stays"
    again = service.http.post(path, json=body)
    assert (again.status_code, len(again.json()["reports"])) == (httpx.codes.OK, 1)
    other = service.http.post(path, json=body | {"outcome": "success"})
    assert other.status_code == httpx.codes.CONFLICT
    service.http.post(path, json=body | {"outcome": "failed", "report_id": "report-second"})
    (listed,) = service.get(f"/experiments/{experiment}/executions")["items"]
    assert [report["outcome"] for report in listed["reports"]] == ["needs_reset", "failed"]
    wrong = service.http.post(path, json=body | {"outcome": "great", "report_id": "report-third"})
    assert wrong.status_code == httpx.codes.UNPROCESSABLE_ENTITY
    assert wrong.json()["fields"][0]["field"].endswith("outcome")
    assert service.http.post("/api/v1/executions/99999/reports", json=body).status_code == httpx.codes.NOT_FOUND
    kinds = service.rows("SELECT kind FROM event WHERE experiment_id = ? AND kind = 'execution_reported'", experiment)
    assert len(kinds) == 2
    service.post(f"/experiments/{experiment}/finish")


async def test_a_click_tells_whether_the_estimate_was_in_sight(store: Store) -> None:
    experiment = await running(store)
    told = []
    for number, shown in enumerate((True, False, None)):
        proposal = await opened(store, experiment, f"o{number}")
        body = click(-1).model_copy(update={"estimate_shown": shown})
        told.append((await store.submit_feedback(proposal.id, body)).feedback.estimate_shown)
    assert told == [True, False, None]


def _two(found: list[dict[str, Any]]) -> list[dict[str, Any]] | None:
    return found if len(found) == 2 else None


def _ended(service: LiveService, experiment: int) -> dict[str, Any] | None:
    found = service.get(f"/experiments/{experiment}/executions")["items"]
    return found[0] if found and found[0]["ended_at"] else None
