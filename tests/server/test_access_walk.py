"""Every route by role, over HTTP and the stream: each is answered to those who may, and refused to everyone else."""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import timedelta
from pathlib import Path

import pytest
from fastapi.routing import APIRoute, iter_route_contexts
from starlette.requests import HTTPConnection
from websockets.exceptions import InvalidStatus

from server import roles
from server.app import create_app
from server.doors import Doors
from server.principal import SERVICE, Principal, Role
from server.schemas_people import InvitationCreate, SignIn
from server.settings import Settings
from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem

NOBODY, GUEST = "nobody", "guest"
EVERYONE = (NOBODY, *(role.value for role in Role), GUEST)
"""Nobody, each role with an invitation to everything, and an operator who was invited to another experiment."""
UNKNOWN = 987654321
"""An id that no row has: what is allowed finds nothing there, and so does nothing."""


def addresses() -> Iterator[tuple[str, str, str]]:
    """Name, method and path of every route that is asked for over HTTP."""
    for each in iter_route_contexts(create_app(Settings()).routes):
        if isinstance(each.original_route, APIRoute):
            for method in sorted(each.methods or ()):
                yield str(each.name), method, str(each.path)


def expected(name: str, who: str, *, of_an_experiment: bool) -> int:
    """401, 403, or 0: anything but these."""
    need = roles.NEEDS[name]
    if need.role is None:
        return 0
    if who == NOBODY:
        return 401
    if who == GUEST:
        here = need.shared and not of_an_experiment
        return 0 if here and Role.OPERATOR.covers(need.role) else 403
    return 0 if Role(who).covers(need.role) else 403


async def test_every_route_answers_those_who_may_and_refuses_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(tmp_path) as live:
        known, elsewhere = await scene(live)
        believe_the_header(monkeypatch, elsewhere)
        wrong = []
        for name, method, path in addresses():
            for who in EVERYONE:
                # those who are to be refused ask for what is there, and those who may for what isn't
                refused = expected(name, who, of_an_experiment="_id}" in path)
                ids = known if refused else dict.fromkeys(known, UNKNOWN)
                address = path.replace(":page", "").format(**ids | OTHERS)
                answer = await live.http.request(method, address, headers={"x-who": who}, json={})
                if refused:
                    check_problem(answer, refused)
                elif answer.status_code in (401, 403):
                    wrong.append((who, method, path, answer.text))
        assert wrong == []


async def test_the_stream_opens_to_those_who_may(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with serving(tmp_path) as live:
        known, elsewhere = await scene(live)
        believe_the_header(monkeypatch, elsewhere)
        opened = {}
        for who in EVERYONE:
            try:
                async with live.stream(known["experiment_id"], additional_headers={"x-who": who}):
                    opened[who] = 101
            except InvalidStatus as refused:
                opened[who] = refused.response.status_code
        assert opened == {NOBODY: 401, GUEST: 403} | {role.value: 101 for role in Role}


async def test_each_message_of_a_stream_is_refused_to_those_who_only_watch(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment()
        path = f"/api/v1/proposals/{(await live.proposal(here)).id}/feedback"
        click = (await live.http.post(path, json=live.click(-1))).json()["id"]
        proposal = await live.proposal(here, electorate=(Role.VIEWER.value,))
        believe_the_header(monkeypatch, here)
        before = (await live.http.get(f"/api/v1/experiments/{here}", headers={"x-who": Role.OWNER.value})).json()
        messages = {
            "feedback": {"click_id": "click-of-a-viewer", "proposal_id": proposal.id, "value": 1},
            "relabel": {"click_id": "correction-of-one", "feedback_id": click, "value": 1},
            "undo": {"request_id": "undo-of-a-viewer", "feedback_id": click},
            "halt": {"request_id": "halt-of-a-viewer"},
            "look": {},
        }
        assert set(messages) == {kind for kind, role in roles.MESSAGES.items() if role is not Role.VIEWER}
        address = f"{here}/stream?trainer={Role.VIEWER.value}"
        async with live.stream(address, additional_headers={"x-who": Role.VIEWER.value}) as viewer:
            for kind, body in messages.items():
                await viewer.send(json.dumps({"type": kind, **body}))
                refused = await event(viewer, "refused")
                assert (refused["problem"]["status"], refused["request_id"]) == (
                    403,
                    body.get("click_id", body.get("request_id")),
                ), kind
            # what they may say is answered as ever
            await viewer.send(json.dumps({"type": "ping"}))
            await event(viewer, "pong")
        after = (await live.http.get(f"/api/v1/experiments/{here}", headers={"x-who": Role.OWNER.value})).json()
        assert after == before, "and nothing has changed"


async def test_whoever_was_invited_to_one_experiment_sees_nothing_of_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(tmp_path) as live:
        known, elsewhere = await scene(live)
        believe_the_header(monkeypatch, elsewhere)
        as_guest = {"x-who": GUEST}
        listed = (await live.http.get("/api/v1/experiments", headers=as_guest)).json()["items"]
        assert [each["id"] for each in listed] == [elsewhere]
        assert (await live.http.get(f"/api/v1/experiments/{elsewhere}", headers=as_guest)).status_code == 200
        # whether a row is there or not, the answer is the same
        for row in (known["proposal_id"], UNKNOWN):
            told = check_problem(await live.http.get(f"/api/v1/proposals/{row}", headers=as_guest), 403)
            assert told.type == "/problems/not-invited"


OTHERS = {"number": 1, "camera": "left", "name": "none", "file": "none", "path": "", "index": "0"}
"""What addresses ask for beside the ids of rows."""


async def scene(live: Serving) -> tuple[dict[str, int], int]:
    """An experiment with a row of each kind that an address can name, by the parameter's name; and another one."""
    here, elsewhere = await live.experiment(), await live.experiment()
    proposal = await live.proposal(here)
    click = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(1))
    _, execution = await live.service.store.begin_execution(
        proposal.id,
        current_observation_id=proposal.observation_id,
        operator_present=False,
        simulated=True,
        workspace_ok=True,
    )
    assert execution is not None
    incident = await live.service.store.add_incident(here, execution_id=None, kind="halt", detail="", frames=[])
    practice = await live.http.post(f"/api/v1/experiments/{here}/practice", json={})
    known = {"proposal_id": proposal.id, "feedback_id": click.json()["id"], "incident_id": incident.id}
    known |= {"experiment_id": here, "practice_id": practice.json()["id"], "execution_id": execution.id}
    invitation, token = await live.service.store.people.invite(InvitationCreate(), SERVICE)
    person, _ = await live.service.store.people.sign_in(SignIn(token=token, name="somebody"), lasts=timedelta(hours=1))
    return known | {"invitation_id": invitation.id, "person_id": person.id}, elsewhere


def believe_the_header(monkeypatch: pytest.MonkeyPatch, elsewhere: int) -> None:
    """Let a request say itself who sends it."""

    async def who(_: Doors, connection: HTTPConnection) -> Principal | None:
        name = connection.headers.get("x-who", NOBODY)
        if name == NOBODY:
            return None
        if name == GUEST:
            return Principal(GUEST, Role.OPERATOR, session_id=9, experiment_id=elsewhere)
        return Principal(name, Role(name), session_id=9)

    monkeypatch.setattr(Doors, "who", who)
