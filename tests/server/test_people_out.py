"""With a login: access that runs out, limits that hold up no emergency stop, and answers a trainer mustn't know."""

from __future__ import annotations

import asyncio
import socket
from datetime import UTC, datetime, timedelta
from pathlib import Path

import httpx
import pytest
from sqlalchemy import create_engine, update
from sqlalchemy.orm import Session
from websockets.exceptions import ConnectionClosed

from server import export
from server.models import MetricRow
from server.models_people import PersonRow
from server.principal import SERVICE
from server.schemas_people import InvitationCreate, SignIn
from server.store import Store
from server.store_people import WrongToken
from server.stream import SIGNED_OUT
from tests.server.serving import event
from tests.server.test_errors import check_problem
from tests.server.test_people import bearer, experiment, house


async def test_whose_access_runs_out_is_out_of_an_open_stream_too(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        async with await home.enter(await home.invite(access_hours=1), "Ann") as ann:
            headers = {"Authorization": ann.headers["Authorization"]}
            async with home.live.stream(here, additional_headers=headers) as page:
                await event(page, "snapshot")
                over = datetime.now(UTC) - timedelta(seconds=1)
                ending = update(PersonRow).where(PersonRow.name == "Ann").values(access_until=over)
                await home.live.service.store._database.write(lambda session: session.execute(ending))
                with pytest.raises(ConnectionClosed):
                    await event(page, "something that never comes", patience=30)
                assert page.close_code == SIGNED_OUT


async def test_a_new_owner_token_made_elsewhere_ends_what_the_owner_has_open(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        headers = {"Authorization": home.owner.headers["Authorization"]}
        async with home.live.stream(here, additional_headers=headers) as page:
            await event(page, "snapshot")
            await home.live.service.store.people.owner_token()  # as `seed owner-token` does in a process of its own
            with pytest.raises(ConnectionClosed):
                await event(page, "something that never comes", patience=30)
            assert page.close_code == SIGNED_OUT


async def test_the_owner_s_printed_token_signs_in_once_and_opens_nothing_by_itself(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        people, http = home.live.service.store.people, home.live.http
        printed = await people.owner_token()
        async with home.client(printed) as program:
            assert (await program.get("/api/v1/people")).status_code == 401
        entered = await http.post("/api/v1/sign-in", json={"token": printed, "bearer": True})
        assert entered.json()["role"] == "owner"
        for body in ({"token": printed}, {"token": printed, "bearer": True}):
            check_problem(await http.post("/api/v1/sign-in", json=body), 401)
        async with home.client(entered.json()["token"]) as owner:
            assert (await owner.get("/api/v1/people")).status_code == 200
            # whoever loses the way in gets another one, and this one ends
            again = await people.owner_token()
            assert (await owner.get("/api/v1/people")).status_code == 401
        assert (await http.post("/api/v1/sign-in", json={"token": again})).status_code == 200


async def test_an_owner_s_token_of_an_earlier_version_or_of_a_file_stays_until_another_is_made(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        people, http = home.live.service.store.people, home.live.http
        body = {"token": home.owner_token, "bearer": True}
        assert await people.old_way_in()
        for _ in range(2):
            assert (await home.owner.get("/api/v1/people")).status_code == 200
            assert (await http.post("/api/v1/sign-in", json=body)).status_code == 200
        await people.owner_token()
        assert not await people.old_way_in()
        assert (await home.owner.get("/api/v1/people")).status_code == 401
        check_problem(await http.post("/api/v1/sign-in", json=body), 401)
        await people.own_by(home.owner_token)  # a start with a file that holds it
        assert (await home.owner.get("/api/v1/people")).status_code == 200


async def test_wrong_tokens_of_others_at_an_address_shut_out_nobody_who_has_a_right_one(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        async with home.client("wrong" * 8) as stranger:
            answers = [(await stranger.get("/api/v1/people")).status_code for _ in range(25)]
        assert answers[-1] == 429
        assert (await home.owner.get("/api/v1/people")).status_code == 200
        assert (await home.owner.post(f"/api/v1/experiments/{here}/halt", json={})).status_code == 200


async def test_an_emergency_stop_is_taken_however_much_was_asked_before(tmp_path: Path) -> None:
    async with house(tmp_path, rate_limit="20/minute") as home:
        here = await experiment(home)
        answers = [(await home.owner.get("/api/v1/me")).status_code for _ in range(25)]
        assert answers[-1] == 429
        halted = await home.owner.post(f"/api/v1/experiments/{here}/halt", json={})
        assert (halted.status_code, halted.json()["halted"]) == (200, True)
        # a stranger's isn't
        strange = [
            (await home.live.http.post(f"/api/v1/experiments/{here}/halt", json={})).status_code for _ in range(25)
        ]
        assert (strange[0], strange[-1]) == (401, 429)


async def test_a_trainer_reads_no_known_answer_in_the_journal(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        proposal = await home.live.proposal(here)
        await home.owner.post(f"/api/v1/proposals/{proposal.id}/feedback", json=home.live.click(-1))
        marked = await home.owner.put(f"/api/v1/proposals/{proposal.id}/gold", json={"answer": -1})
        assert marked.status_code == 204, marked.text
        async with await home.enter(await home.invite(experiment_id=here), "Ann") as ann:
            for who, told in ((home.owner, True), (ann, False)):
                page = (await who.get(f"/api/v1/experiments/{here}/events", params={"limit": 200})).json()
                assert ("gold_marked" in {each["kind"] for each in page["items"]}) is told


async def test_a_download_breaks_off_where_its_reader_is_let_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(export, "CHUNK", 10)
    async with house(tmp_path) as home, await home.enter(await home.invite(role="viewer"), "Ann") as ann:
        here = await experiment(home)
        # more than all buffers on the way hold, so that the service still sends while somebody is let out
        points, wide = 150, {f"measure_{number}": float(number) for number in range(5000)}
        engine = create_engine(f"sqlite:///{tmp_path / 'seed.db'}")
        with Session(engine) as session, session.begin():
            at = datetime.now(UTC)
            session.add_all(MetricRow(experiment_id=here, feedback=n, at=at, data=wide) for n in range(points))
        engine.dispose()
        path = f"/api/v1/experiments/{here}/exports/metrics?format=jsonl"
        async with home.owner.stream("GET", path) as whole:
            assert len([line async for line in whole.aiter_lines()]) == points
        address = httpx.URL(home.live.url)
        with socket.socket() as narrow:
            narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            narrow.connect((address.host, address.port))
            narrow.setblocking(False)
            reader, writer = await asyncio.open_connection(sock=narrow, limit=4096)
            said = f"GET {path} HTTP/1.1\r\nHost: {address.netloc.decode()}\r\n" + "".join(
                f"{name}: {value}\r\n" for name, value in bearer(ann).items()
            )
            writer.write(f"{said}Connection: close\r\n\r\n".encode())
            assert (await reader.readline()).endswith(b" 200 OK\r\n")
            while await reader.readline() != b"\r\n":
                pass
            rest = bytearray(await reader.readexactly(10_000))
            ann_id = (await home.owner.get("/api/v1/people")).json()["items"][0]["id"]
            assert (await home.owner.delete(f"/api/v1/people/{ann_id}")).status_code == 200
            while some := await reader.read(1 << 20):
                rest += some
            writer.close()
        assert rest.count(b'"measure_4999"') < points
        assert not rest.endswith(b"\r\n0\r\n\r\n"), "a part doesn't look like the whole"
        assert (await ann.get(path)).status_code == 401


async def test_two_visitors_behind_one_proxy_are_counted_apart(tmp_path: Path) -> None:
    async with house(tmp_path, rate_limit="10/hour") as home:
        invitation = await home.invite()

        async def ask(address: str) -> int:
            # the proxy of this machine says for whom it asks
            return (await home.live.http.get("/api/v1/me", headers={"X-Forwarded-For": address})).status_code

        async def enter(address: str, token: str, name: str) -> int:
            body = {"token": token, "name": name}
            headers = {"X-Forwarded-For": address}
            return (await home.live.http.post("/api/v1/sign-in", json=body, headers=headers)).status_code

        assert [await ask("192.0.2.1") for _ in range(12)] == [200] * 10 + [429] * 2
        assert await ask("192.0.2.2") == 200
        # nor does one who tries too many wrong tokens keep the other from coming in
        answers = set()
        for _ in range(25):
            wrong = {"Authorization": f"Bearer {'wrong' * 8}", "X-Forwarded-For": "192.0.2.3"}
            answers.add((await home.live.http.get("/api/v1/people", headers=wrong)).status_code)
        assert answers == {401, 429}
        assert await enter("192.0.2.2", invitation, "Ann") == 200


async def test_the_last_use_of_an_invitation_lets_one_in_however_many_come_at_once(store: Store) -> None:
    invitation, token = await store.people.invite(InvitationCreate(uses=2), SERVICE)

    async def enter(name: str) -> str | None:
        try:
            person, _ = await store.people.sign_in(SignIn(token=token, name=name), lasts=timedelta(hours=1))
        except WrongToken:
            return None
        return person.name

    assert await enter("first") == "first"
    came = await asyncio.gather(*(enter(f"at once {number}") for number in range(8)))
    let_in = [name for name in came if name is not None]
    assert len(let_in) == 1
    assert (await store.people.invitation(invitation.id)).used == 2
    people = [each.name for each in (await store.people.people(None, 50)).items]
    assert sorted(people) == sorted(["first", *let_in])
