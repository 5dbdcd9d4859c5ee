"""With a login: who comes in, by what, for how long, and what is written down of what they decide."""

from __future__ import annotations

import asyncio
import csv
import io
import json
import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import create_engine, text
from sqlalchemy.exc import DBAPIError
from websockets.exceptions import ConnectionClosed, InvalidStatus

from server.doors import COOKIE
from server.store import Store
from server.store_people import new_token
from server.stream import HASTE_LIMIT, SIGNED_OUT
from tests.server.databases import click, opened, running
from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem


@dataclass
class House:
    """A service that asks who you are, its owner's client, and clients of others."""

    live: Serving
    owner: httpx.AsyncClient
    owner_token: str

    async def invite(self, **fields: Any) -> str:
        """A new invitation's token."""
        answer = await self.owner.post("/api/v1/invitations", json=fields)
        assert answer.status_code == 201, answer.text
        assert answer.json()["path"].endswith(f"/join#{answer.json()['token']}")
        return str(answer.json()["token"])

    async def enter(self, token: str, name: str | None = None) -> httpx.AsyncClient:
        """A program's client that has come in by this token."""
        body = {"token": token, "bearer": True} | ({} if name is None else {"name": name})
        answer = await self.live.http.post("/api/v1/sign-in", json=body)
        assert answer.status_code == 200, answer.text
        return self.client(str(answer.json()["token"]))

    def client(self, token: str) -> httpx.AsyncClient:
        """A client with a bearer token."""
        return httpx.AsyncClient(base_url=self.live.url, headers={"Authorization": f"Bearer {token}"}, timeout=60)


def bearer(client: httpx.AsyncClient) -> dict[str, str]:
    """The header by which a stream is this client's."""
    return {"Authorization": client.headers["Authorization"]}


@asynccontextmanager
async def house(tmp_path: Path, **settings: Any) -> AsyncIterator[House]:
    async with serving(tmp_path, login=True, **settings) as live:
        token = await live.service.store.people.owner_token(new_token())
        async with httpx.AsyncClient(
            base_url=live.url, headers={"Authorization": f"Bearer {token}"}, timeout=60
        ) as owner:
            yield House(live, owner, token)


async def experiment(home: House) -> int:
    answer = await home.owner.post(
        "/api/v1/experiments", json={"name": "test", "task": "stacking", "adapter": "kinematic"}
    )
    assert answer.status_code == 201, answer.text
    return int(answer.json()["id"])


async def test_an_invitation_lets_in_as_many_as_it_says_under_their_own_names(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        token = await home.invite(role="trainer", uses=2, experiment_id=here)
        assert check_problem(await home.live.http.get("/api/v1/experiments"), 401).type == "/problems/not-signed-in"
        async with await home.enter(token, "Ann") as ann, await home.enter(token, "Bob"):
            gone = await home.live.http.post("/api/v1/sign-in", json={"token": token, "name": "Cleo"})
            assert check_problem(gone, 401).remedy == "ask whoever invited you for a new link"
            me = (await ann.get("/api/v1/me")).json()
            assert (me["login"], me["name"], me["role"], me["experiment_id"]) == (True, "Ann", "trainer", here)
            # whatever the body says, the click is Ann's
            proposal = await home.live.proposal(here)
            said = await ann.post(
                f"/api/v1/proposals/{proposal.id}/feedback", json=home.live.click(-1, trainer="somebody else")
            )
            assert said.json()["trainer"] == "Ann"
            assert check_problem(await ann.post(f"/api/v1/experiments/{here}/pause", json={}), 403)
            assert check_problem(await ann.get("/api/v1/audit"), 403)


async def test_names_are_given_once_and_not_the_services_own(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        token = await home.invite(uses=5)
        async with await home.enter(token, "Ann"):
            for name, why in ((None, "asks for a name"), ("Ann", "taken"), ("owner", "taken"), ("service", "taken")):
                body = {"token": token} | ({} if name is None else {"name": name})
                refused = check_problem(await home.live.http.post("/api/v1/sign-in", json=body), 409)
                assert why in refused.detail
        assert (await home.owner.get("/api/v1/invitations")).json()["items"][0]["used"] == 1


async def test_nobody_gives_away_more_than_they_may_and_the_last_owner_stays(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        async with await home.enter(await home.invite(role="operator"), "Olga") as olga:
            assert (await olga.post("/api/v1/invitations", json={"role": "operator"})).status_code == 201
            assert check_problem(await olga.post("/api/v1/invitations", json={"role": "owner"}), 403)
            people = (await olga.get("/api/v1/people")).json()["items"]
            owner = next(each["id"] for each in people if each["name"] == "owner")
            assert check_problem(await olga.delete(f"/api/v1/people/{owner}"), 403)
        assert "last owner" in check_problem(await home.owner.delete(f"/api/v1/people/{owner}"), 409).detail
        assert (
            "last owner"
            in check_problem(await home.owner.patch(f"/api/v1/people/{owner}", json={"role": "viewer"}), 409).detail
        )


async def test_who_is_let_out_is_out_at_once_wherever_they_are(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        async with await home.enter(await home.invite(), "Ann") as ann:
            headers = {"Authorization": ann.headers["Authorization"]}
            async with home.live.stream(here, additional_headers=headers) as page:
                await event(page, "snapshot")
                there = (await home.owner.get(f"/api/v1/experiments/{here}/people")).json()["items"]
                assert [(each["name"], each["role"], each["streams"]) for each in there] == [("Ann", "trainer", 1)]
                people = (await home.owner.get("/api/v1/people")).json()["items"]
                assert people[0]["online"] == [here]
                assert (await home.owner.delete(f"/api/v1/people/{people[0]['id']}")).status_code == 200
                with pytest.raises(ConnectionClosed):
                    await event(page, "something that never comes")
                assert page.close_code == SIGNED_OUT
            assert (await ann.get("/api/v1/experiments")).status_code == 401
            with pytest.raises(InvalidStatus) as refused:
                async with home.live.stream(here, additional_headers=headers):
                    pass
            assert refused.value.response.status_code == 401


async def test_a_page_has_a_cookie_that_no_script_reads_and_no_other_site_uses(tmp_path: Path) -> None:
    async with house(tmp_path) as home, httpx.AsyncClient(base_url=home.live.url) as page:
        answer = await page.post("/api/v1/sign-in", json={"token": home.owner_token})
        assert answer.json()["token"] is None
        kept = answer.headers["set-cookie"]
        assert kept.startswith(f"{COOKIE}=")
        assert "HttpOnly" in kept
        assert "SameSite=strict" in kept
        assert "Secure" not in kept  # plain HTTP here; behind TLS see tests/e2e/test_people.py
        assert (await page.get("/api/v1/people")).status_code == 200
        # without the page's own origin the cookie changes nothing
        assert check_problem(await page.post("/api/v1/invitations", json={}), 403).type.endswith("foreign-origin")
        own, foreign = {"Origin": home.live.url}, {"Origin": "http://evil.example"}
        assert (await page.post("/api/v1/invitations", json={}, headers=own)).status_code == 201
        assert check_problem(await page.post("/api/v1/invitations", json={}, headers=foreign), 403)
        assert (await page.post("/api/v1/sign-out", headers=own)).status_code == 204
        page.cookies.set(COOKIE, kept.partition("=")[2].partition(";")[0])
        assert (await page.get("/api/v1/people")).status_code == 401


async def test_wrong_tokens_are_tried_a_few_times_and_requests_have_a_rate(tmp_path: Path) -> None:
    async with house(tmp_path, rate_limit="40/minute") as home:
        answers = [(await home.client("wrong" * 8).get("/api/v1/people")).status_code for _ in range(25)]
        assert set(answers[:20]) == {401}
        assert set(answers[20:]) == {429}
        told = [await home.live.http.get("/api/v1/me") for _ in range(20)][-1]
        assert check_problem(told, 429).type == "/problems/too-often"
        assert int(told.headers["Retry-After"]) >= 1


async def test_a_session_that_sends_too_fast_is_told_so_and_can_always_stop_the_robot(tmp_path: Path) -> None:
    async with house(tmp_path, rate_limit="30/hour") as home:
        here = await experiment(home)
        headers = {"additional_headers": bearer(home.owner)}
        async with home.live.stream(here, **headers) as hasty, home.live.stream(here, **headers) as calm:
            await event(hasty, "snapshot")
            await event(calm, "snapshot")
            for _ in range(30):
                await hasty.send('{"type": "ping"}')
            for _ in range(30):
                await event(hasty, "pong")
            # both streams are of one session
            click = home.live.click(1) | {"type": "feedback", "proposal_id": 1}
            await calm.send(json.dumps(click))
            told = await event(calm, "refused")
            assert (told["request_id"], told["problem"]["status"]) == (click["click_id"], 429)
            assert "wait" in told["problem"]["remedy"]
            await hasty.send('{"type": "halt", "request_id": "halt-request-1"}')
            assert (await event(hasty, "acknowledged"))["request_id"] == "halt-request-1"
            # who goes on costs the others, and is let go
            for _ in range(HASTE_LIMIT):
                await hasty.send('{"type": "ping"}')
            with pytest.raises(ConnectionClosed) as closed:
                await event(hasty, "never")
            assert (closed.value.rcvd and closed.value.rcvd.reason) == "too many messages"
            # other sessions have a count of their own
            async with (
                await home.enter(await home.invite(), "Ann") as ann,
                home.live.stream(here, additional_headers=bearer(ann)) as other,
            ):
                await other.send('{"type": "ping"}')
                await event(other, "pong")


async def test_every_decision_is_in_the_audit_with_who_and_from_which_session(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        async with (
            await home.enter(await home.invite(experiment_id=here), "Ann") as ann,
            await home.enter(await home.invite(role="operator"), "=Olga") as olga,
        ):
            proposal = await home.live.proposal(here)
            said = await ann.post(f"/api/v1/proposals/{proposal.id}/feedback", json=home.live.click(1))
            await home.live.service.store.begin_execution(
                proposal.id,
                current_observation_id=proposal.observation_id,
                operator_present=False,
                simulated=True,
                workspace_ok=True,
            )
            await ann.post(
                f"/api/v1/feedback/{said.json()['id']}/relabels", json={"click_id": "correction-1", "value": -1}
            )
            await olga.patch(f"/api/v1/experiments/{here}", json={"mode": "propose_only"})
            await olga.post(f"/api/v1/experiments/{here}/halt", json={})
            entries = (await olga.get("/api/v1/audit", params={"experiment": here, "limit": 200})).json()["items"]
            told = [(each["name"], each["action"]) for each in reversed(entries)]
            assert told == [
                ("owner", "created"),
                ("owner", "invited"),
                ("Ann", "signed_in"),
                ("service", "start"),
                ("Ann", "clicked"),
                ("service", "gate"),
                ("service", "execution_started"),
                ("Ann", "relabelled"),
                ("=Olga", "updated"),
                ("=Olga", "halt"),
            ]
            by_action = {each["action"]: each for each in entries}
            assert by_action["execution_started"]["subject"]["approved_by"] == ["Ann"]
            assert by_action["clicked"]["subject"] == {"proposal": proposal.id, "value": 1, "status": "stored"}
            assert by_action["clicked"]["session_id"] == by_action["signed_in"]["session_id"] is not None
            table = (await olga.get("/api/v1/exports/audit")).text
            rows = list(csv.DictReader(io.StringIO(table)))
            assert [row["action"] for row in rows if row["experiment_id"] == str(here)] == [a for _, a in told]
            # no spreadsheet takes a name for a formula
            assert {row["name"] for row in rows} == {"owner", "Ann", "'=Olga", "service"}


async def test_without_a_login_the_audit_names_whoever_clicked(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        assert (await live.http.get("/api/v1/me")).json()["login"] is False
        proposal = await live.proposal(await live.experiment())
        await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(-1, trainer="Ann"))
        entries = (await live.http.get("/api/v1/audit")).json()["items"]
        assert next((e["name"], e["action"], e["session_id"]) for e in entries) == ("Ann", "clicked", None)
        assert check_problem(await live.http.post("/api/v1/invitations", json={}), 409)
        assert check_problem(await live.http.post("/api/v1/sign-in", json={"token": "x" * 43}), 409)


async def test_the_audit_is_neither_changed_nor_deleted(store: Store, url: str) -> None:
    proposal = await opened(store, await running(store))
    await store.submit_feedback(proposal.id, click(-1))
    engine = create_engine(url)
    for statement in ("UPDATE audit SET name = 'nobody'", "DELETE FROM audit"):
        with pytest.raises(DBAPIError, match="append-only"), engine.begin() as connection:
            connection.execute(text(statement))
    with engine.connect() as connection:
        assert connection.scalar(text("SELECT count(*) FROM audit WHERE action = 'clicked'")) == 1
    engine.dispose()


async def test_tokens_are_neither_stored_nor_logged(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    async with house(tmp_path) as home:
        invitation = await home.invite()
        async with await home.enter(invitation, "Ann") as ann:
            bearer = ann.headers["Authorization"].split()[1]
            own = (await ann.post("/api/v1/me/tokens", json={"note": "notebook"})).json()["token"]
            async with home.client(own) as program:
                assert (await program.get("/api/v1/me")).json()["name"] == "Ann"
        wrong = await home.live.http.post("/api/v1/sign-in", json={"token": f"{invitation}!"})
        assert invitation not in wrong.text
    stored = b"".join(await asyncio.to_thread(lambda: [file.read_bytes() for file in tmp_path.rglob("seed.db*")]))
    assert b"Ann" in stored
    for token in (home.owner_token, invitation, bearer, own):
        assert token not in caplog.text
        assert token.encode() not in stored


async def test_strangers_are_not_told_why_something_is_not_ready(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        await home.live.service.store.transition(here, "start")
        await home.live.service.store.transition(here, "fail", "the secret gripper broke")
        assert "secret" not in (await home.live.http.get("/ready")).text
        assert "secret" in (await home.owner.get("/ready")).text


async def test_the_same_key_of_another_person_is_another_key(tmp_path: Path) -> None:
    async with house(tmp_path) as home, await home.enter(await home.invite(role="operator"), "Olga") as olga:
        body = {"name": "mine", "task": "stacking", "adapter": "kinematic"}
        key = {"Idempotency-Key": "the-same-key"}
        made = [await who.post("/api/v1/experiments", json=body, headers=key) for who in (olga, home.owner, olga)]
        ids = [answer.json()["id"] for answer in made]
        assert ids[0] == ids[2] != ids[1]
