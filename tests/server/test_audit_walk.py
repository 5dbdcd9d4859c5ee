"""Every route and message that changes something leaves a line in the audit; a new one must say so here, or why not."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.routing import APIRoute, iter_route_contexts

from server.app import create_app
from server.robots import Robot
from server.roles import MESSAGES
from server.schemas import ExecutionOutcome
from server.settings import Settings
from tests.server.serving import event
from tests.server.test_people import House, bearer, house

SAFE = {"GET", "HEAD", "OPTIONS"}

DECIDES_NOTHING = {
    "next_proposal": "gives a seat and a lease, which are in memory only",
    "next_practice": "deals whoever asks a card; their answer to it is a decision",
    "begin_camera_calibration": "nothing is kept before the result is, and that is a decision",
    "look_for_the_board": "as above",
    "solve_camera_calibration": "as above",
}
"""Routes that aren't safe methods and leave no line, each with its reason."""

SILENT = {
    "look": "a sign of life: renews a lease in memory",
    "frame_ack": "says that a picture was drawn",
    "ping": "a heartbeat",
}
"""Messages of the stream that leave none."""

Send = Callable[["Scene"], Awaitable[httpx.Response]]


class Scene:
    """A service with a login, an owner's client, and one row of each kind that a route may be about."""

    def __init__(self, home: House) -> None:
        self.home, self.owner, self.live = home, home.owner, home.live
        self.here = self.real = self.spare = 0
        self.person = self.invitation = 0

    async def set_up(self) -> None:
        """Three experiments: one that was started, one at a robot that claims to be real, and one to be played with."""
        for name, adapter in (("here", "kinematic"), ("real", "benchtop"), ("spare", "kinematic")):
            body = {"name": name, "task": "stacking", "adapter": adapter}
            answer = await self.post("/experiments", body)
            assert answer.status_code == 201, answer.text
            setattr(self, name, answer.json()["id"])
        self.guest = await self.home.enter(await self.home.invite(role="trainer"), "Guest")
        self.person = (await self.owner.get("/api/v1/people")).json()["items"][0]["id"]
        await self.home.invite()
        self.invitation = (await self.owner.get("/api/v1/invitations")).json()["items"][0]["id"]

    async def send(self, method: str, path: str, body: Any = None, **options: Any) -> httpx.Response:
        return await self.owner.request(method, f"/api/v1{path}", json=body, **options)

    async def post(self, path: str, body: Any = None) -> httpx.Response:
        return await self.send("POST", path, {} if body is None else body)

    async def another(self) -> int:
        """A new experiment."""
        answer = await self.post("/experiments", {"name": "another", "task": "stacking", "adapter": "kinematic"})
        return int(answer.json()["id"])

    async def proposal(self, experiment_id: int | None = None) -> int:
        """An open one, of an experiment of its own unless one is given."""
        where = await self.another() if experiment_id is None else experiment_id
        return (await self.live.proposal(where, electorate=("owner",))).id

    async def clicked(self, proposal_id: int | None = None) -> dict[str, Any]:
        at = await self.proposal() if proposal_id is None else proposal_id
        answer = await self.post(f"/proposals/{at}/feedback", self.live.click(-1))
        return dict(answer.json())

    async def moved(self) -> int:
        """An execution."""
        proposal = await self.live.proposal(await self.another(), electorate=("owner",))
        await self.post(f"/proposals/{proposal.id}/feedback", self.live.click(1))
        _, execution = await self.live.service.store.begin_execution(
            proposal.id,
            current_observation_id=proposal.observation_id,
            operator_present=False,
            simulated=True,
            workspace_ok=True,
        )
        assert execution is not None
        await self.live.service.store.end_execution(
            execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=1, task_success=False
        )
        return execution.id

    async def entries(self) -> list[dict[str, Any]]:
        """The audit, oldest first."""
        return list(reversed((await self.owner.get("/api/v1/audit", params={"limit": 200})).json()["items"]))

    async def lines(self) -> list[tuple[str, str]]:
        """Who did what, oldest first."""
        return [(each["name"], each["action"]) for each in await self.entries()]


def verb(name: str, *, at: str = "spare") -> Send:
    return lambda s: s.post(f"/experiments/{getattr(s, at)}/{name}")


async def _mark(s: Scene) -> httpx.Response:
    return await s.send("PUT", f"/proposals/{(await s.clicked())['proposal_id']}/gold", {"answer": 1})


async def _unmark(s: Scene) -> httpx.Response:
    proposal_id = (await s.clicked())["proposal_id"]
    await s.send("PUT", f"/proposals/{proposal_id}/gold", {"answer": 1})
    return await s.send("DELETE", f"/proposals/{proposal_id}/gold")


async def _relabel(s: Scene) -> httpx.Response:
    body = {"click_id": "correction-of-the-walk", "value": 1}
    return await s.post(f"/feedback/{(await s.clicked())['id']}/relabels", body)


async def _practise(s: Scene) -> httpx.Response:
    card = (await s.post(f"/experiments/{s.here}/practice")).json()
    return await s.post(f"/practice/{card['id']}/answer", {"click_id": "practice-of-the-walk", "value": 1})


async def _sign_in(s: Scene) -> httpx.Response:
    token = await s.home.invite()
    return await s.live.http.post("/api/v1/sign-in", json={"token": token, "name": "Walker", "bearer": True})


async def _home(s: Scene, what: str) -> httpx.Response:
    await s.send("PUT", f"/experiments/{s.real}/attendance", {"operator": "owner", "seconds": 5})
    return await s.post(f"/experiments/{s.real}/{what}")


async def _leave(s: Scene) -> httpx.Response:
    await s.send("PUT", f"/experiments/{s.real}/attendance", {"operator": "owner", "seconds": 5})
    return await s.send("DELETE", f"/experiments/{s.real}/attendance?operator=owner")


DECIDES: dict[str, tuple[str, Send]] = {
    "create_experiment": (
        "created",
        lambda s: s.post("/experiments", {"name": "x", "task": "stacking", "adapter": "kinematic"}),
    ),
    "update_experiment": ("updated", lambda s: s.send("PATCH", f"/experiments/{s.spare}", {"mode": "propose_only"})),
    "evaluate_experiment": (
        "evaluation_started",
        lambda s: s.post(f"/experiments/{s.here}/evaluate", {"rollouts": 1}),
    ),
    "start_experiment": ("start", verb("start")),
    "pause_experiment": ("pause", verb("pause")),
    "resume_experiment": ("resume", verb("resume")),
    "reset_episode": ("reset", verb("reset")),
    "halt_experiment": ("halt", verb("halt")),
    "rearm_experiment": ("rearm", verb("rearm")),
    "finish_experiment": ("finish", verb("finish")),
    "archive_experiment": ("archive", verb("archive")),
    "attend": (
        "attended",
        lambda s: s.send("PUT", f"/experiments/{s.real}/attendance", {"operator": "owner", "seconds": 5}),
    ),
    "leave": ("unattended", _leave),
    "home": ("home_ordered", lambda s: _home(s, "home")),
    "recover": ("recover_ordered", lambda s: _home(s, "recover")),
    "store_camera_calibration": (
        "cameras_calibrated",
        lambda s: s.send("PUT", f"/experiments/{s.real}/camera-calibration"),
    ),
    "give_feedback": ("clicked", lambda s: _response(s.proposal(), lambda p: f"/proposals/{p}/feedback", s)),
    "undo_feedback": ("undone", lambda s: _response(s.clicked(), lambda c: f"/feedback/{c['id']}", s, method="DELETE")),
    "relabel_feedback": ("relabelled", _relabel),
    "answer_practice": ("practised", _practise),
    "report_execution": (
        "execution_reported",
        lambda s: _response(
            s.moved(),
            lambda e: f"/executions/{e}/reports",
            s,
            body={"report_id": "report-1", "outcome": "success"},
        ),
    ),
    "mark_gold": ("gold_marked", _mark),
    "unmark_gold": ("gold_unmarked", _unmark),
    "invite": ("invited", lambda s: s.post("/invitations")),
    "revoke_invitation": ("invitation_revoked", lambda s: s.send("DELETE", f"/invitations/{s.invitation}")),
    "sign_in": ("signed_in", _sign_in),
    "make_token": ("token_made", lambda s: s.post("/me/tokens", {"note": "walk"})),
    "update_person": ("role_changed", lambda s: s.send("PATCH", f"/people/{s.person}", {"role": "viewer"})),
    "sign_out": ("signed_out", lambda s: s.guest.post("/api/v1/sign-out", json={})),
    "revoke_person": ("revoked", lambda s: s.send("DELETE", f"/people/{s.person}")),
}
"""What each route that changes something writes down, and a request to it; in an order in which each is possible."""


async def _response(
    before: Awaitable[Any],
    path: Callable[[Any], str],
    s: Scene,
    *,
    method: str = "POST",
    body: dict[str, Any] | None = None,
) -> httpx.Response:
    found = path(await before)
    return await s.send(method, found, None if method == "DELETE" else body or s.live.click(-1))


def changing() -> set[str]:
    """The names of all routes that may change something."""
    routes = iter_route_contexts(create_app(Settings()).routes)
    return {str(r.name) for r in routes if isinstance(r.original_route, APIRoute) and set(r.methods or ()) - SAFE}


def test_every_route_and_message_that_may_change_something_is_told_of_here() -> None:
    assert changing() == set(DECIDES) | set(DECIDES_NOTHING)
    assert not set(DECIDES) & set(DECIDES_NOTHING)
    assert set(MESSAGES) == set(SILENT) | {"feedback", "undo", "relabel", "halt"}


async def test_each_leaves_its_line_under_the_name_of_who_did_it_with_the_arm_s_cameras_made_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, plugins: None
) -> None:
    async def guide(_: Robot, __: str, **___: Any) -> dict[str, Any]:
        return {"cameras": [], "apart_mm": None, "stored": True}

    monkeypatch.setattr(Robot, "guide", guide)
    async with house(tmp_path) as home:
        scene = Scene(home)
        await scene.set_up()
        sessions = set()
        for name, (action, send) in DECIDES.items():
            before, began = len(await scene.entries()), datetime.now(UTC)
            answer = await send(scene)
            who = "Walker" if name == "sign_in" else "Guest" if name == "sign_out" else "owner"
            made = [each for each in (await scene.entries())[before:] if each["action"] == action]
            assert [each["name"] for each in made] == [who], (name, answer.status_code, answer.text)
            assert began <= datetime.fromisoformat(made[0]["at"]) <= datetime.now(UTC), name
            sessions.add((who, made[0]["session_id"]))
        assert None not in {session for _, session in sessions}
        assert len(sessions) == 3, "everything that one has done is from one session"


async def test_each_message_of_the_stream_that_decides_leaves_its_line(tmp_path: Path, plugins: None) -> None:
    async with house(tmp_path) as home:
        scene = Scene(home)
        await scene.set_up()
        proposal = await scene.proposal(scene.here)
        async with home.live.stream(scene.here, additional_headers=bearer(home.owner)) as viewer:
            await event(viewer, "snapshot")

            async def say(kind: str, **message: Any) -> dict[str, Any]:
                await viewer.send(json.dumps({"type": kind, **message}))
                return await event(viewer, "acknowledged")

            click = (await say("feedback", proposal_id=proposal, **home.live.click(-1)))["feedback"]["id"]
            assert (await scene.lines())[-1] == ("owner", "clicked")
            await say("relabel", click_id="correction-1", feedback_id=click, value=1)
            assert (await scene.lines())[-1] == ("owner", "relabelled")
            await say("undo", request_id="undo-request-1", feedback_id=click)
            assert (await scene.lines())[-1] == ("owner", "undone")
            await say("halt", request_id="halt-request-1")
            assert ("owner", "halt") in await scene.lines()
