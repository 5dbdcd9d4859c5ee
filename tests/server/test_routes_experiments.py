"""Experiments over HTTP: create, page through, change, and the verbs of their lifecycle."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from server.store_errors import StoreError
from tests.server.serving import EXPERIMENT, event, serving
from tests.server.test_errors import check_problem


async def test_an_experiment_is_created_read_changed_and_listed(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        created = (await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"seed": 7})).json()
        assert created["lifecycle"] == "created"
        assert created["phase"] == "idle"
        assert created["lockstep"] is False
        address = f"/api/v1/experiments/{created['id']}"
        assert (await live.http.get(address)).json() == created
        changed = await live.http.patch(address, json={"name": "renamed", "mode": "propose_only"})
        assert changed.status_code == 200
        assert changed.json()["mode"] == "propose_only"
        assert (await live.http.get(address)).json()["name"] == "renamed"
        check_problem(await live.http.patch(address, json={"seed": 8}), 422)
        check_problem(await live.http.patch(address, json={"mode": "fly"}), 422)
        assert (await live.http.get(address)).json()["seed"] == 7


async def test_a_teacher_makes_an_experiment_lockstep_unless_it_says_otherwise(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        taught = await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"teacher": "synthetic"})
        assert taught.json()["lockstep"] is True
        free = await live.http.post(
            "/api/v1/experiments", json=EXPERIMENT | {"teacher": "synthetic", "lockstep": False}
        )
        assert free.json()["lockstep"] is False


async def test_pages_go_through_all_experiments_once(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        made = [await live.experiment(name=f"number {n}") for n in range(5)]
        seen: list[int] = []
        cursor: dict[str, str] = {}
        while True:
            page = (await live.http.get("/api/v1/experiments", params={"limit": "2"} | cursor)).json()
            seen += [item["id"] for item in page["items"]]
            if page["next_cursor"] is None:
                break
            cursor = {"cursor": page["next_cursor"]}
        assert seen == sorted(made, reverse=True)


async def test_an_illegal_verb_is_a_conflict_that_names_state_and_allowed_verbs(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        for verb in ("pause", "resume", "rearm"):
            told = check_problem(await live.http.post(f"/api/v1/experiments/{experiment}/{verb}"), 409).model_dump()
            assert told["current"], told
            assert "start" in told["allowed"], told
            assert verb not in told["allowed"], told
        assert (await live.http.get(f"/api/v1/experiments/{experiment}")).json()["lifecycle"] == "created"


async def test_a_field_that_start_or_resume_would_ignore_is_refused(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        address = f"/api/v1/experiments/{await live.experiment()}"
        for verb in ("start", "resume"):
            told = check_problem(await live.http.post(f"{address}/{verb}", json={"until": 5}), 422)
            assert ["until" in field.field for field in told.fields] == [True]
        assert (await live.http.get(address)).json()["lifecycle"] == "created"
        assert (await live.http.post(f"{address}/start", json={})).json()["lifecycle"] == "running"


async def test_the_emergency_stop_is_latched_until_someone_rearms(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        address = f"/api/v1/experiments/{await live.experiment()}"
        assert (await live.http.post(f"{address}/halt")).json()["halted"] is True
        assert (await live.http.post(f"{address}/halt")).json()["halted"] is True
        check_problem(await live.http.post(f"{address}/start"), 409)
        check_problem(await live.http.post(f"{address}/evaluate", json={}), 409)
        assert (await live.http.post(f"{address}/rearm")).json()["halted"] is False
        journal = (await live.http.get(f"{address}/events")).json()["items"]
        assert [e["kind"] for e in journal if "halt" in e["kind"] or "rearm" in e["kind"]]


async def test_the_same_idempotency_key_creates_once(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        headers = {"Idempotency-Key": "creation-0001"}
        both = await asyncio.gather(
            *(live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=headers) for _ in range(4))
        )
        assert {answer.status_code for answer in both} == {201}
        assert len({answer.text for answer in both}) == 1
        again = dict(reversed(EXPERIMENT.items()))
        assert (await live.http.post("/api/v1/experiments", json=again, headers=headers)).json() == both[0].json()
        other = await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"seed": 9}, headers=headers)
        check_problem(other, 409)
        assert len((await live.http.get("/api/v1/experiments")).json()["items"]) == 1
        short = await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers={"Idempotency-Key": "x"})
        assert "Idempotency-Key" in [f.field for f in check_problem(short, 422).fields]
        # an answer that was an error isn't kept: the client may correct its body
        wrong = {"Idempotency-Key": "creation-0002"}
        check_problem(await live.http.post("/api/v1/experiments", json=EXPERIMENT | {"task": "x"}, headers=wrong), 422)
        assert (await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=wrong)).status_code == 201


async def test_an_experiment_and_the_answer_to_its_retry_are_stored_together(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(tmp_path) as live:
        headers = {"Idempotency-Key": "creation-0003"}

        def broken(*_: object, **__: object) -> None:
            raise StoreError("the database failed", remedy="try again")

        with monkeypatch.context() as crash:
            crash.setattr("server.store_records.remember", broken)
            check_problem(await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=headers), 503)
        assert (await live.http.get("/api/v1/experiments")).json()["items"] == []
        made = await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=headers)
        again = await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=headers)
        assert again.json() == made.json()
        assert len((await live.http.get("/api/v1/experiments")).json()["items"]) == 1


async def test_the_first_experiment_is_made_once_where_there_is_none(tmp_path: Path) -> None:
    for _ in range(2):
        async with serving(tmp_path, create_first_experiment=True) as live:
            (first,) = (await live.http.get("/api/v1/experiments")).json()["items"]
            assert (first["name"], first["task"], first["adapter"]) == ("Stacking", "stacking", "robosuite")
            assert first["lifecycle"] == "created"


async def test_a_verb_a_click_and_an_evaluation_go_all_the_way(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        address = f"/api/v1/experiments/{await live.experiment(mode='propose_only')}"
        async with live.stream(int(address.rpartition("/")[2])) as stream:
            started = await live.http.post(f"{address}/start")
            assert started.json()["lifecycle"] == "running"
            proposal = (await event(stream, "proposal_opened"))["proposal"]
            picture = await live.http.get(proposal["views"][0]["url"])
            assert picture.content.startswith(b"\xff\xd8")
            clicked = await live.http.post(f"/api/v1/proposals/{proposal['id']}/feedback", json=live.click(-1))
            assert clicked.status_code == 201
            following = (await event(stream, "proposal_opened"))["proposal"]
            assert following["id"] != proposal["id"]
            check_problem(await live.http.post(f"{address}/evaluate", json={"rollouts": 1}), 409)
            assert (await live.http.post(f"{address}/pause")).json()["lifecycle"] == "paused"
            headers = {"Idempotency-Key": "evaluation-1"}
            begun = await live.http.post(f"{address}/evaluate", json={"rollouts": 1}, headers=headers)
            assert begun.status_code == 202
            again = await live.http.post(f"{address}/evaluate", json={"rollouts": 1}, headers=headers)
            assert again.json() == begun.json()
            await live.service.hub.idle(int(address.rpartition("/")[2]))
            (stored,) = (await live.http.get(f"{address}/evaluations")).json()["items"]
            assert stored["ended_at"] is not None
            assert (await live.http.post(f"{address}/finish")).json()["lifecycle"] == "finished"
            archived = await live.http.post(f"{address}/archive")
            assert archived.json().get("lifecycle") == "archived", archived.text
            assert (await live.http.get(f"{address}/metrics")).json()["items"]
            assert (await live.http.get(f"{address}/checkpoints")).json()["items"]
            (trainer,) = [t for t in (await live.http.get("/api/v1/trainers")).json()["items"] if t["kind"] == "person"]
            assert trainer["name"] == "local"
