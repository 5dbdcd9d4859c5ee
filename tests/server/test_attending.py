"""At what claims to be a real robot: only who attends it sets it going, and whoever is let out attends nothing."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import update

from server.models_people import PersonRow
from tests.server.serving import event, serving
from tests.server.test_errors import check_problem
from tests.server.test_people import House, bearer, house

REAL = {"name": "real", "task": "stacking", "adapter": "benchtop"}
LONG = 30
"""Seconds, the longest lease: what ends in this test ends by something else."""


@dataclass
class Lab:
    """A robot that claims to be real, and two operators: Anna attends it, Ben doesn't."""

    home: House
    robot: int
    anna: httpx.AsyncClient
    ben: httpx.AsyncClient

    @property
    def path(self) -> str:
        return f"/api/v1/experiments/{self.robot}"

    async def attend(self) -> None:
        answer = await self.anna.put(f"{self.path}/attendance", json={"operator": "whoever", "seconds": LONG})
        assert answer.json()["operator"] == "Anna", answer.text

    async def person(self, name: str) -> str:
        people = (await self.home.owner.get("/api/v1/people")).json()["items"]
        return next(f"/api/v1/people/{each['id']}" for each in people if each["name"] == name)

    async def audit(self) -> list[tuple[str, str]]:
        """Who did what at the robot, oldest first."""
        entries = (await self.home.owner.get("/api/v1/audit", params={"experiment": self.robot, "limit": 200})).json()
        return [(each["name"], each["action"]) for each in reversed(entries["items"])]


@asynccontextmanager
async def lab(tmp_path: Path) -> AsyncIterator[Lab]:
    async with house(tmp_path) as home:
        answer = await home.owner.post("/api/v1/experiments", json=REAL)
        invitation = await home.invite(role="operator", uses=2)
        async with await home.enter(invitation, "Anna") as anna, await home.enter(invitation, "Ben") as ben:
            yield Lab(home, int(answer.json()["id"]), anna, ben)


@pytest.mark.parametrize("what", ["home", "recover"])
async def test_who_is_not_at_the_robot_moves_it_by_nobody_s_attendance(
    what: str, tmp_path: Path, plugins: None
) -> None:
    async with lab(tmp_path) as at:
        await at.attend()
        refused = check_problem(await at.ben.post(f"{at.path}/{what}"), 409)
        assert "Anna attends the robot" in refused.detail
        assert refused.remedy == "leave it to Anna"
        # with a login nobody says who they are
        check_problem(await at.ben.post(f"{at.path}/{what}", params={"operator": "Anna"}), 409)
        # there isn't even a process that could move anything
        assert at.home.live.service.hub.worker_pids(at.robot) == {}
        await at.anna.post(f"{at.path}/{what}")
        assert ("Anna", f"{what}_ordered") in await at.audit()
        assert ("Ben", f"{what}_ordered") not in await at.audit()


async def test_without_a_login_an_order_is_for_who_says_that_they_attend(tmp_path: Path, plugins: None) -> None:
    async with serving(tmp_path) as live:
        path = f"/api/v1/experiments/{await live.experiment(adapter='benchtop')}"
        await live.http.put(f"{path}/attendance", json={"operator": "anna", "seconds": LONG})
        for others in ({}, {"operator": "ben"}):
            check_problem(await live.http.post(f"{path}/home", params=others), 409)
        await live.http.post(f"{path}/home", params={"operator": "anna"})
        entries = (await live.http.get("/api/v1/audit", params={"limit": 200})).json()["items"]
        assert [each["name"] for each in entries if each["action"] == "home_ordered"] == ["anna"]


async def test_nobody_else_sets_going_what_somebody_may_have_their_hands_at(tmp_path: Path, plugins: None) -> None:
    async with lab(tmp_path) as at:
        await at.attend()
        for verb in ("start", "rearm", "reset"):
            assert "Anna attends the robot" in check_problem(await at.ben.post(f"{at.path}/{verb}"), 409).detail
        execute = {"mode": "execute_approved"}
        assert "Anna attends" in check_problem(await at.ben.patch(at.path, json=execute), 409).detail
        state = (await at.ben.get(at.path)).json()
        assert (state["lifecycle"], state["mode"]) == ("created", "propose_only")
        # what makes it move less is anybody's
        assert (await at.ben.patch(at.path, json={"mode": "propose_only"})).status_code == 200
        assert (await at.ben.post(f"{at.path}/halt")).json()["halted"] is True
        check_problem(await at.ben.post(f"{at.path}/rearm"), 409)
        assert (await at.anna.post(f"{at.path}/rearm")).json()["halted"] is False
        assert (await at.anna.patch(at.path, json=execute)).json()["mode"] == "execute_approved"


async def _revoked(at: Lab) -> None:
    assert (await at.home.owner.delete(await at.person("Anna"))).status_code == 200


async def _made_a_viewer(at: Lab) -> None:
    assert (await at.home.owner.patch(await at.person("Anna"), json={"role": "viewer"})).status_code == 200


async def _signed_out(at: Lab) -> None:
    assert (await at.anna.post("/api/v1/sign-out", json={})).status_code == 204


async def _access_over(at: Lab) -> None:
    over = update(PersonRow).where(PersonRow.name == "Anna").values(access_until=datetime.now(UTC) - timedelta(1))
    await at.home.live.service.store._database.write(lambda session: session.execute(over))


@pytest.mark.parametrize("let_out", [_revoked, _made_a_viewer, _signed_out, _access_over])
async def test_who_is_let_out_attends_no_robot_any_more(let_out: Any, tmp_path: Path, plugins: None) -> None:
    async with lab(tmp_path) as at:
        await at.attend()  # for longer than the test waits
        async with at.home.live.stream(at.robot, additional_headers=bearer(at.ben)) as page:
            assert (await event(page, "snapshot"))["operator"] == "Anna"
            await let_out(at)
            assert (await event(page, "attendance_changed", patience=25))["operator"] is None
        # the gate is shut for want of anybody, and the robot is free for another
        answer = await at.ben.put(f"{at.path}/attendance", json={"operator": "Ben", "seconds": LONG})
        assert answer.json()["operator"] == "Ben"
        assert "unattended" in {action for _, action in await at.audit()}
