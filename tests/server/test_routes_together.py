"""Judging together over HTTP: the rule, live, and that nobody learns what others say of what is still to judge."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from websockets.asyncio.client import ClientConnection

from tests.server.serving import EXPERIMENT, event, serving
from tests.server.test_errors import check_problem


async def test_the_rule_and_who_judges_what_are_set_at_the_start_and_live(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        for rule in ("first", "majority", "unanimous", "weighted"):
            body = EXPERIMENT | {"aggregation": rule, "together": {"lease_seconds": 5}}
            made = (await live.http.post("/api/v1/experiments", json=body)).json()
            assert (made["aggregation"], made["together"]["lease_seconds"]) == (rule, 5)
            assert made["together"]["weighted_approves"] is False
        address = f"/api/v1/experiments/{made['id']}"
        change: dict[str, Any] = {"aggregation": "unanimous", "together": {"parallel": True}}
        assert (await live.http.patch(address, json=change)).status_code == 200
        now = (await live.http.get(address)).json()
        assert (now["aggregation"], now["together"]["parallel"], now["together"]["lease_seconds"]) == (
            "unanimous",
            True,
            5,
        )
        for wrong, field in (({"lease_seconds": 0}, "lease_seconds"), ({"parallel": "yes"}, "parallel")):
            told = check_problem(await live.http.patch(address, json={"together": wrong}), 422)
            assert field in told.fields[0].field
        assert (await live.http.get(address)).json()["together"] == now["together"]


async def test_the_robot_moves_once_the_least_that_is_needed_have_said_good(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment(together={"least": 2})
        address, pages = f"/api/v1/experiments/{here}", f"{here}/stream?trainer="
        async with live.stream(pages + "ann") as ann, live.stream(pages + "bob") as bob:
            for page in (ann, bob):
                await event(page, "snapshot")
            await live.http.post(f"{address}/start")
            proposal = (await event(bob, "proposal_opened"))["proposal"]["id"]

            async def good(page: ClientConnection, trainer: str) -> None:
                click = live.click(1, trainer=trainer, proposal_id=proposal)
                await page.send(json.dumps(click | {"type": "feedback"}))

            await good(ann, "ann")
            assert (await event(ann, "acknowledged"))["feedback"]["status"] == "stored"
            assert (await live.http.get(f"/api/v1/proposals/{proposal}")).json()["closed_at"] is None
            await good(bob, "bob")
            closed = (await event(ann, "proposal_closed"))["proposal"]
            assert (closed["id"], closed["verdict"]) == (proposal, "good")
            assert (await event(ann, "execution_started"))["execution"]["proposal_id"] == proposal
        taught = EXPERIMENT | {"teacher": "synthetic", "together": {"least": 2}}
        told = check_problem(await live.http.post("/api/v1/experiments", json=taught), 422)
        assert told.fields[0].field == "together.least"


async def test_a_script_without_a_page_keeps_its_proposal_for_a_lease(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment(together={"parallel": True, "vanish_seconds": 0})
        address = f"/api/v1/experiments/{here}"
        async with live.stream(f"{here}/stream") as viewer:
            await live.http.post(f"{address}/start")
            await event(viewer, "proposal_opened")
            first = (await live.http.post(f"{address}/next", json={"trainer": "ann"})).json()
            second = (await live.http.post(f"{address}/next", json={"trainer": "bob"})).json()
            assert first["proposal"]["id"] is not None
            assert second["proposal"] is None or second["proposal"]["id"] != first["proposal"]["id"]
            click = live.click(-1, trainer="bob")
            late = await live.http.post(f"/api/v1/proposals/{first['proposal']['id']}/feedback", json=click)
            assert "before another trainer" in check_problem(late, 409).detail


async def test_two_trainers_of_two_robots_are_each_at_another_one(tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.setattr("server.seating.BLINK", 3600.0)  # however long the second robot takes to start here
    async with serving(tmp_path) as live:
        here = await live.experiment(num_envs=2)
        address, pages = f"/api/v1/experiments/{here}", f"{here}/stream?trainer="
        async with live.stream(pages + "ann") as ann, live.stream(pages + "bob") as bob:

            async def apart(but: set[int]) -> dict[str, int]:
                """What each has, once they have different ones and none of these."""
                while True:
                    told = (await event(ann, "judges_changed"))["judges"]
                    at = {judge["trainer"]: judge["proposal_id"] for judge in told if judge["proposal_id"]}
                    if len(set(at.values()) - but) == 2:
                        return at

            for page in (ann, bob):
                await event(page, "snapshot")
            await live.http.post(f"{address}/start")
            first = await apart(set())
            # and the robot of whoever refuses has its next one judged by them
            click = live.click(-1, trainer="bob", proposal_id=first["bob"])
            await bob.send(json.dumps(click | {"type": "feedback"}))
            second = await apart({first["bob"]})
            assert second["ann"] == first["ann"]


async def test_nobody_is_told_a_vote_before_the_proposal_is_closed(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment(aggregation="majority")
        base, asked = f"/api/v1/experiments/{experiment}", ("ann", "bob", "cyd")
        proposal = await live.proposal(experiment, asked)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        hers = (await live.http.post(address, json=live.click(1, trainer=asked[0]))).json()
        mine = f"/api/v1/feedback/{hers['id']}"
        assert (await live.http.get(mine, params={"trainer": asked[0]})).json()["value"] == 1
        told = check_problem(await live.http.get(mine, params={"trainer": asked[1]}), 409)
        assert "once it is closed" in told.detail
        counters = (await live.http.get(base)).json()["counters"]
        assert (counters["feedback"], counters["good"]) == (0, 0)
        assert (await live.http.get(address)).json()["items"] == []
        table = await live.http.get(f"{base}/exports/feedback", params={"format": "jsonl"})
        assert '"answer": null' in table.text
        taken = (await live.http.delete(mine, params={"trainer": asked[0]})).json()
        assert taken["undone_at"] is not None
        assert check_problem(await live.http.get(mine, params={"trainer": asked[1]}), 409)
        # once it is closed all is told, and counted
        for name in asked[:2]:
            assert (await live.http.post(address, json=live.click(-1, trainer=name))).status_code == 201
        assert (await live.http.get(mine, params={"trainer": asked[1]})).json()["value"] == 1
        counters = (await live.http.get(base)).json()["counters"]
        assert (counters["feedback"], counters["good"], counters["bad"]) == (2, 0, 2)
