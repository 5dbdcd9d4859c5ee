"""Nothing that anybody can ask or hear tells what was said of a proposal on which others are still asked.

Two services that are alike but for what was said answer every question to every role: no two answers may differ.
"""

from __future__ import annotations

import asyncio
import json
import re
from contextlib import AsyncExitStack
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.asyncio.client import ClientConnection

from server import store_quality
from tests.server.serving import event
from tests.server.test_access_walk import addresses
from tests.server.test_people import bearer, house

READERS = ("viewer", "trainer", "operator")
SAME_FOR_ALL = {"custom_swagger_ui_html", "swagger_ui_redirect", "page", "health", "ready"}
"""Routes that know of no experiment."""
TIMES = {"boot_id", "pace", "seq"}
"""Fields that no two services have in common, beside what is written as a date."""
DATE = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d[0-9.]*(Z|[+-]\d\d:\d\d)?")
ASKED: dict[str, tuple[str, ...]] = {
    "compare_experiments": tuple(f"?experiment=1&measure={m}" for m in ("estimate_error", "good_share", "successes")),
    "list_history": ("", "?label=good", "?label=bad", "?verdict=bad"),
    "list_feedback": ("", "?trainer=Ann", "?trainer=Bob"),
    "export_feedback": ("?format=csv", "?format=jsonl"),
    "get_own_figures": ("", "?trainer=Ann", "?trainer=Bob", "?trainer=Cyd"),
}
"""The questions of a route that has more than one."""
SPOKEN = {"feedback_stored", "feedback_undone", "proposal_changed", "proposal_closed", "experiment_changed"}
"""Events that follow what somebody says."""

Told = dict[tuple[str, str], Any]


async def test_no_answer_and_no_event_differs_by_what_was_said_of_an_open_proposal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for patience in ("FRESH", "SHARE"):  # figures are told anew each time, not as they were a moment ago
        monkeypatch.setattr(store_quality, patience, 0)
    bad, good = [await told_after(tmp_path / str(value), value) for value in (-1, 1)]
    assert bad.keys() == good.keys()
    answered = [where for (who, where), (status, _) in bad.items() if who == "operator" and status == 200]
    assert len(answered) > 100, "most of what there is to ask is there"
    tell = sorted(f"{who}: {where}" for who, where in bad if bad[who, where] != good[who, where])
    assert not tell, "\n".join(tell)


async def told_after(data_dir: Path, value: int) -> Told:
    """What each reader is told before and after a vote, one that was taken back, a late one and one for practice."""
    async with house(data_dir) as home, AsyncExitStack() as left_at_the_end:
        body = {"name": "test", "task": "stacking", "adapter": "kinematic", "seed": 7, "aggregation": "majority"}
        body |= {"together": {"vanish_seconds": 600}, "practice_required": {"proposals": 1, "accuracy": 1.0}}
        answer = await home.owner.post("/api/v1/experiments", json=body)
        here = int(answer.json()["id"])

        async def enter(name: str, role: str = "trainer") -> httpx.AsyncClient:
            client = await home.enter(await home.invite(role=role), name)
            return await left_at_the_end.enter_async_context(client)

        readers = {role: await enter(f"a {role}", role) for role in READERS}
        streams = {}
        for role, reader in readers.items():
            connecting = home.live.stream(here, additional_headers=bearer(reader))
            streams[role] = await left_at_the_end.enter_async_context(connecting)
        ann, bob, cyd, dan, eve = [await enter(name) for name in ("Ann", "Bob", "Cyd", "Dan", "Eve")]
        for who in (ann, bob, dan, eve):
            shown = (await who.post(f"/api/v1/experiments/{here}/practice", json={})).json()
            known = (await home.live.service.store.quality.practice(shown["id"])).known_answer
            right = {"click_id": f"practice-{shown['id']:04}", "value": known}
            assert (await who.post(f"/api/v1/practice/{shown['id']}/answer", json=right)).json()["progress"]["passed"]
        electorate = ("Ann", "Bob", "Cyd", "Dan", "Eve", "a trainer")
        # a single one, so that nothing depends on how much later another came
        closed = (await home.live.proposal(here, ("Ann",))).id
        assert (await say(ann, closed, "before-all", -1)).status_code == 201
        at = (await home.live.proposal(here, electorate)).id
        ids = {"experiment_id": here, "proposal_id": at, "name": "stacking", "number": 1, "camera": "left"}
        told = await all_told(readers, ids, "before", feedback=(1,))

        assert (await say(ann, at, "vote-of-ann", value)).status_code == 201
        taken = (await say(dan, at, "vote-of-dan", value)).json()
        assert (await dan.delete(f"/api/v1/feedback/{taken['id']}")).status_code == 200
        for text in ("late-of-bob-1", "late-of-bob-2"):
            looked = {"observation_id": "another", "policy_version": 0}
            assert (await say(bob, at, text, value, looked=looked)).status_code == 409
        practised = await say(cyd, at, "practice-of-cyd", value)
        assert practised.json()["status"] == "practice", practised.text
        assert (await home.owner.get(f"/api/v1/proposals/{at}")).json()["closed_at"] is None

        told |= await all_told(readers, ids, "after", feedback=range(1, practised.json()["id"] + 1))
        last = {"mode": "propose_only"}
        assert (await home.owner.patch(f"/api/v1/experiments/{here}", json=last)).status_code == 200
        for role, stream in streams.items():
            told[role, "stream"] = (200, await heard(stream))
            address = home.live.stream(here, additional_headers=bearer(readers[role]))
            async with address as later:
                told[role, "snapshot"] = (200, _plain(await event(later, "snapshot")))
        return told


async def all_told(readers: dict[str, httpx.AsyncClient], ids: dict[str, Any], when: str, feedback: Any) -> Told:
    """What each is answered to every question that there is."""
    others = {"execution_id": 1, "incident_id": 1, "practice_id": 1, "index": 0, "file": "none"}
    told = {}
    for name, method, path in addresses():
        if method != "GET" or name in SAME_FOR_ALL:
            continue
        for feedback_id in feedback if "{feedback_id}" in path else (1,):
            for query in ASKED.get(name, ("",)):
                address = path.format(**ids, **others, feedback_id=feedback_id) + query
                for role, reader in readers.items():
                    answer = await reader.get(address)
                    assert answer.status_code < 500, (address, answer.text)
                    told[role, f"{when}: {address}"] = (answer.status_code, _content(answer))
    return told


async def say(who: httpx.AsyncClient, proposal_id: int, click_id: str, value: int, **more: object) -> httpx.Response:
    body = {"click_id": click_id, "value": value, **more}
    return await who.post(f"/api/v1/proposals/{proposal_id}/feedback", json=body)


async def heard(stream: ClientConnection) -> list[Any]:
    """What was spoken of until the last change, in the order it came."""
    words = []
    async with asyncio.timeout(60):
        while True:
            message = await stream.recv()
            if not isinstance(message, str) or (word := json.loads(message))["type"] not in SPOKEN:
                continue
            words.append(_plain(word))
            if word["type"] == "experiment_changed" and word["experiment"]["mode"] == "propose_only":
                return words


def _content(answer: httpx.Response) -> Any:
    if "json" in answer.headers.get("content-type", "") and "ndjson" not in answer.headers["content-type"]:
        return _plain(answer.json())
    return DATE.sub("then", answer.content.decode(errors="replace"))


def _plain(node: Any) -> Any:
    """The same without what depends on when it happened."""
    if isinstance(node, dict):
        return {key: _plain(each) for key, each in node.items() if key not in TIMES}
    if isinstance(node, list):
        return [_plain(each) for each in node]
    return DATE.sub("then", node) if isinstance(node, str) else node
