"""Nobody goes by a name that the service writes itself; who did so in an earlier version gains nothing by it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import create_engine, text
from websockets.exceptions import InvalidStatus

from server.names import SOMEBODY
from server.schemas import ExperimentUpdate
from tests.server.serving import event, serving
from tests.server.test_errors import check_problem
from tests.server.test_people import bearer, experiment, house

REQUIRED = ExperimentUpdate.model_validate({"practice_required": {"proposals": 2, "accuracy": 1.0}})
SERVICES = ("teacher:ann", "Teacher: Ann", " critic", "trainers", "EVALUATION", "evaluation 2", "somebody-1a2b3c")


async def test_nobody_signs_in_by_a_name_that_the_service_writes_itself(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        token = await home.invite()
        for name in SERVICES:
            told = check_problem(await home.live.http.post("/api/v1/sign-in", json={"token": token, "name": name}), 422)
            assert told.detail.startswith("name: ")
            assert "another name" in str(told.remedy)
        assert (await home.owner.get("/api/v1/invitations")).json()["items"][0]["used"] == 0
        async with await home.enter(token, "Critter the teacher") as fine:
            assert (await fine.get("/api/v1/me")).json()["name"] == "Critter the teacher"


async def test_without_a_login_nobody_acts_by_such_a_name_either(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment()
        proposal = await live.proposal(here)
        click = f"/api/v1/proposals/{proposal.id}/feedback"
        for name in SERVICES:
            refused: dict[str, Any] = {
                click: live.click(1, trainer=name),
                f"/api/v1/experiments/{here}/next": {"trainer": name},
                f"/api/v1/experiments/{here}/practice": {"trainer": name},
            }
            for path, body in refused.items():
                told = check_problem(await live.http.post(path, json=body), 422)
                assert told.detail.startswith("trainer: "), path
            attending = {"operator": name, "seconds": 5}
            told = check_problem(await live.http.put(f"/api/v1/experiments/{here}/attendance", json=attending), 422)
            assert told.detail.startswith("operator: ")
        with pytest.raises(InvalidStatus) as closed:
            async with live.stream(f"{here}/stream?trainer=teacher:ann"):
                pass
        assert closed.value.response.status_code == 422
        async with live.stream(here) as viewer:
            await event(viewer, "snapshot")
            message = {"type": "feedback", "proposal_id": proposal.id, **live.click(1, trainer="critic")}
            await viewer.send(json.dumps(message))
            assert (await event(viewer, "refused"))["problem"]["detail"].startswith("trainer: ")
        assert (await live.http.get(click)).json()["items"] == []
        assert (await live.http.get("/api/v1/trainers")).json()["items"] == []


async def test_who_had_such_a_name_before_is_veiled_and_practises_as_everybody_does(tmp_path: Path) -> None:
    """A database of an earlier version, in which somebody came in as a teacher, is made by renaming them in it."""
    named = "teacher:ted"
    async with house(tmp_path) as home:
        here = await experiment(home)
        tokens = [bearer(await home.enter(await home.invite(), name)) for name in ("Ted", "Ann")]
    engine = create_engine(f"sqlite:///{tmp_path / 'seed.db'}")
    with engine.begin() as connection:
        assert connection.execute(text("UPDATE person SET name = :n WHERE name = 'Ted'"), {"n": named}).rowcount == 1
    engine.dispose()
    async with serving(tmp_path, login=True) as live:
        ted, ann = tokens
        first = await live.proposal(here, electorate=(named, "Ann"))
        said = await live.http.post(f"/api/v1/proposals/{first.id}/feedback", json=live.click(-1), headers=ted)
        assert (said.status_code, said.json()["trainer"], said.json()["status"]) == (201, named, "stored")
        for path in (f"/proposals/{first.id}", f"/proposals/{first.id}/feedback", f"/experiments/{here}/history"):
            told = (await live.http.get(f"/api/v1{path}", headers=ann)).text
            assert named not in told, path
            assert SOMEBODY in told, path
        await live.service.store.update_and_conclude(here, REQUIRED)
        second = await live.proposal(here, electorate=(named, "Ann"))
        assert second.electorate == []
        said = await live.http.post(f"/api/v1/proposals/{second.id}/feedback", json=live.click(1), headers=ted)
        assert said.json()["status"] == "practice"
