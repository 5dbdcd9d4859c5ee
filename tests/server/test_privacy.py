"""A trainer's figures are their own: no route and no event tells another trainer who said what."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from websockets.asyncio.client import ClientConnection

from server.names import SOMEBODY
from server.principal import Principal, Role
from server.privacy import Telling, veiled
from server.schemas_quality import AgreementInfo
from server.schemas_together import Judge
from tests.server.serving import event
from tests.server.test_errors import check_problem
from tests.server.test_people import House, bearer, experiment, house

HIDDEN = "Bob the trainer"
"""A name that stands nowhere else."""


async def listened(viewer: ClientConnection, until: str) -> str:
    """Everything that a stream said up to an event of this type, as one text."""
    said = ""
    while True:
        text = str(await viewer.recv())
        said += text
        if json.loads(text)["type"] == until:
            return said


async def scene(home: House, here: int) -> int:
    """Bob has judged one proposal, corrected that, and reported its motion; the proposal's id."""
    store = home.live.service.store
    async with await home.enter(await home.invite(experiment_id=here), HIDDEN) as bob:
        proposal = await home.live.proposal(here, electorate=(HIDDEN, "Ann"))
        said = await bob.post(f"/api/v1/proposals/{proposal.id}/feedback", json=home.live.click(1))
        _, execution = await store.begin_execution(
            proposal.id,
            current_observation_id=proposal.observation_id,
            operator_present=False,
            simulated=True,
            workspace_ok=True,
        )
        assert execution is not None
        correction = {"click_id": "correction-1", "value": -1}
        await bob.post(f"/api/v1/feedback/{said.json()['id']}/relabels", json=correction)
        await home.live.service.store.leave_electorates(here, [HIDDEN])
    return proposal.id


async def test_no_route_that_a_trainer_may_ask_tells_whose_click_it_was(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        async with await home.enter(await home.invite(experiment_id=here), "Ann") as ann:
            async with home.live.stream(here, additional_headers=bearer(ann)) as viewer:
                await event(viewer, "snapshot")
                proposal = await scene(home, here)
                heard = await listened(viewer, "feedback_relabelled")
            assert HIDDEN not in heard
            assert SOMEBODY in heard
            mine = home.live.click(-1)
            assert (await ann.post(f"/api/v1/proposals/{proposal}/feedback", json=mine)).status_code == 409
            told: dict[str, Any] = {}
            base = f"/api/v1/experiments/{here}"
            for path in (
                *(f"{base}/{what}" for what in ("proposals", "feedback", "history", "executions", "events")),
                *(f"/api/v1/proposals/{proposal}{what}" for what in ("", "/feedback")),
                *("/api/v1/feedback/1", "/api/v1/executions/1"),
                *(f"{base}/{what}" for what in ("curves", "episodes", "metrics", "quality/mine")),
            ):
                answer = await ann.get(path)
                assert answer.status_code == 200, (path, answer.text)
                assert HIDDEN not in answer.text, path
                told[path] = answer.json()
            everybody = (await home.owner.get(f"/api/v1/proposals/{proposal}/feedback")).json()["items"]
            assert [each["trainer"] for each in everybody] == ["Ann", HIDDEN]
            # one's own name stays, and what is said is told as ever
            seen = told[f"/api/v1/proposals/{proposal}/feedback"]["items"]
            assert [(each["trainer"] == "Ann", each["value"]) for each in seen] == [(True, -1), (False, 1)]
            # one's own figures are there before the first click that counts
            figures = told[f"{base}/quality/mine"]
            assert (figures["trainer"], figures["labels"]) == ("Ann", 0)
            for path in (f"{base}/quality", f"{base}/exports/feedback", "/api/v1/trainers", "/api/v1/audit"):
                assert (await ann.get(path)).status_code == 403


async def test_a_trainer_finds_their_own_labels_however_many_the_others_gave(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        await home.owner.patch(f"/api/v1/experiments/{here}", json={"aggregation": "unanimous"})
        invitation = await home.invite(experiment_id=here, uses=2)
        async with await home.enter(invitation, "Ann") as ann, await home.enter(invitation, HIDDEN) as bob:

            async def labels(client: Any, trainer: str) -> list[tuple[int, str]]:
                query = {"limit": 2, "trainer": trainer}
                items = (await client.get(f"/api/v1/experiments/{here}/feedback", params=query)).json()["items"]
                return [(each["proposal_id"], each["trainer"]) for each in items]

            first = await home.live.proposal(here, electorate=("Ann",))
            await ann.post(f"/api/v1/proposals/{first.id}/feedback", json=home.live.click(-1))
            for _ in range(3):
                other = await home.live.proposal(here, electorate=(HIDDEN,))
                await bob.post(f"/api/v1/proposals/{other.id}/feedback", json=home.live.click(-1))
            still_open = await home.live.proposal(here, electorate=(HIDDEN, "Ann"))
            alone = await ann.post(f"/api/v1/proposals/{still_open.id}/feedback", json=home.live.click(1))
            assert alone.status_code == 201, "one of two decides nothing, and it stays open"
            assert await labels(ann, "Ann") == [(still_open.id, "Ann"), (first.id, "Ann")]
            assert await labels(home.owner, HIDDEN) == [(other.id, HIDDEN), (other.id - 1, HIDDEN)]
            # what is said of an open one is nobody else's to know, whoever they are
            assert await labels(home.owner, "Ann") == [(first.id, "Ann")]
            refused = await ann.get(f"/api/v1/experiments/{here}/feedback", params={"trainer": HIDDEN})
            check_problem(refused, 403)


def test_a_word_for_a_name_is_the_same_within_a_proposal_and_another_in_the_next() -> None:
    ann = Principal("Ann", Role.TRAINER)
    one, same, other = (veiled(ann, Judge(trainer="Bob", proposal_id=number)).trainer for number in (1, 1, 2))
    assert one == same != other
    assert veiled(ann, Judge(trainer="Ann")).trainer == "Ann"
    assert veiled(Principal("Olga", Role.OPERATOR), Judge(trainer="Bob")).trainer == "Bob"


def test_an_event_without_a_name_is_the_same_for_all() -> None:
    told = AgreementInfo(alpha=None, proposals=1, labels=2, trainers=2, why=None)
    telling = Telling(told)
    assert json.loads(telling.to("Ann")) == json.loads(telling.to(None)) == told.model_dump()


async def test_what_others_said_is_told_once_a_proposal_is_closed_and_ones_own_before(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        here = await experiment(home)
        await home.owner.patch(f"/api/v1/experiments/{here}", json={"aggregation": "majority"})
        invitation = await home.invite(experiment_id=here, uses=3)
        async with (
            await home.enter(invitation, "Ann") as ann,
            await home.enter(invitation, "Bob") as bob,
            await home.enter(invitation, "Cyd") as cyd,
        ):
            proposal = await home.live.proposal(here, electorate=("Ann", "Bob", "Cyd"))
            path = f"/api/v1/proposals/{proposal.id}/feedback"
            elsewhere = {"looked": {"observation_id": "another", "policy_version": 0}}
            assert (await ann.post(path, json=home.live.click(-1))).status_code == 201
            check_problem(await bob.post(path, json=home.live.click(1, **elsewhere)), 409)

            async def told(client: Any) -> list[tuple[Any, ...]]:
                items = (await client.get(path)).json()["items"]
                return [(each["trainer"], each["value"], each["status"]) for each in items]

            async def audited() -> list[Any]:
                entries = (await home.owner.get("/api/v1/audit", params={"experiment": here})).json()["items"]
                return [each["subject"].get("value") for each in entries if each["action"] == "clicked"]

            async def labels() -> int:
                charts = (await ann.get(f"/api/v1/experiments/{here}/curves")).json()["charts"]
                return sum(each["name"] == "estimates" for each in charts)

            late, vote = ("Bob", 1, "late"), ("Ann", -1, "stored")
            assert [await told(each) for each in (ann, bob, cyd, home.owner)] == [[vote], [late], [], []]
            check_problem(await cyd.get("/api/v1/feedback/2"), 409)
            assert (await bob.get("/api/v1/feedback/2")).json()["value"] == 1
            assert (await audited(), await labels()) == ([None, None], 0)
            assert (await cyd.post(path, json=home.live.click(-1))).status_code == 201
            assert await told(home.owner) == [("Cyd", -1, "stored"), late, vote]
            assert len(await told(ann)) == 3
            assert (await audited(), await labels()) == ([-1, 1, -1], 1)
