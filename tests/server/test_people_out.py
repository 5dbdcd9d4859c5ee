"""With a login: access that runs out, limits that hold up no emergency stop, and answers a trainer mustn't know."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from sqlalchemy import update
from websockets.exceptions import ConnectionClosed

from server.models_people import PersonRow
from server.stream import SIGNED_OUT
from tests.server.serving import event
from tests.server.test_errors import check_problem
from tests.server.test_people import experiment, house


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
