"""Clicks over HTTP: stored once, late, foreign, wrong, taken back; and the pictures they are about."""

from __future__ import annotations

from pathlib import Path

from tests.server.serving import JPEG, serving
from tests.server.test_errors import check_problem


async def test_a_click_is_stored_once_however_often_it_is_sent(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        click = live.click(-1)
        first = await live.http.post(address, json=click)
        assert first.status_code == 201
        again = await live.http.post(address, json=click)
        assert again.status_code == 200
        assert again.json() == first.json()
        check_problem(await live.http.post(address, json=click | {"value": 1}), 409)
        other = await live.proposal(experiment)
        check_problem(await live.http.post(f"/api/v1/proposals/{other.id}/feedback", json=click), 409)
        listed = (await live.http.get(address)).json()["items"]
        assert listed == [first.json()]
        assert (await live.http.get(f"/api/v1/experiments/{experiment}/feedback")).json()["items"] == listed
        assert (await live.http.get(f"/api/v1/feedback/{first.json()['id']}")).json() == first.json()
        judged = (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()
        assert (judged["verdict"], judged["close_reason"]) == ("bad", "judged")
        counters = (await live.http.get(f"/api/v1/experiments/{experiment}")).json()["counters"]
        assert (counters["feedback"], counters["bad"]) == (1, 1)


async def test_a_late_click_is_kept_and_refused(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        await live.http.post(address, json=live.click(0))
        click = live.click(1)
        told = check_problem(await live.http.post(address, json=click), 409)
        assert told.type == "/problems/late-feedback"
        kept = told.model_dump()["feedback"]
        assert (kept["click_id"], kept["status"], kept["value"]) == (click["click_id"], "late", 1)
        assert kept["late_because"] == "it was judged neutral before this click came"
        assert kept["late_because"] in told.detail
        assert (await live.http.get(f"/api/v1/feedback/{kept['id']}")).json() == kept | {"late_because": None}
        assert check_problem(await live.http.post(address, json=click), 409).model_dump()["feedback"] == kept
        counters = (await live.http.get(f"/api/v1/experiments/{experiment}")).json()["counters"]
        assert (counters["feedback"], counters["late"]) == (1, 1)
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["verdict"] == "neutral"


async def test_a_wrong_click_changes_nothing(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        for change, field in (
            ({"value": 2}, "value"),
            ({"value": -2}, "value"),
            ({"value": 0.5}, "value"),
            ({"value": True}, "value"),
            ({"value": "1"}, "value"),
            ({"value": None}, "value"),
            ({"click_id": "short"}, "click_id"),
            ({"click_id": "x" * 65}, "click_id"),
            ({"click_id": "spaces are out"}, "click_id"),
            ({"trainer": ""}, "trainer"),
            ({"proposal_id": 1}, "proposal_id"),
        ):
            told = check_problem(await live.http.post(address, json=live.click() | change), 422)
            assert field in [f.field for f in told.fields]
        check_problem(await live.http.post("/api/v1/proposals/424242/feedback", json=live.click()), 404)
        assert (await live.http.get(address)).json()["items"] == []
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["closed_at"] is None


async def test_the_newest_click_can_be_taken_back_once(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        stored = (await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click())).json()
        undone = await live.http.delete(f"/api/v1/feedback/{stored['id']}")
        assert undone.status_code == 200
        assert undone.json()["undone_at"] is not None
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["closed_at"] is None
        check_problem(await live.http.delete(f"/api/v1/feedback/{stored['id']}"), 409)
        again = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(0))
        assert again.status_code == 201


async def test_a_picture_is_the_very_one_and_cached_for_good(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        proposal = await live.proposal(await live.experiment())
        (view,) = proposal.views
        answer = await live.http.get(view.url)
        assert answer.headers["content-type"] == "image/jpeg"
        assert answer.content.startswith(JPEG)
        assert "immutable" in answer.headers["cache-control"]
        assert answer.headers["etag"] == f'"{view.image}"'
        known = await live.http.get(view.url, headers={"If-None-Match": answer.headers["etag"]})
        assert (known.status_code, known.content) == (304, b"")
        told = check_problem(await live.http.get(f"/api/v1/proposals/{proposal.id}/images/back"), 404)
        assert view.camera in told.remedy
        check_problem(await live.http.get(f"/api/v1/proposals/{proposal.id}/images/..%2F..%2Fseed.db"), 404)
        for file in (tmp_path / "images").rglob("*.jpg"):
            file.unlink()
        assert "backup" in check_problem(await live.http.get(view.url), 404).remedy
