"""A trainer can't tell a known answer from any other proposal: by no route and no message, before and after judging it.

By its shape: which fields there are, which are null, and every word, number, yes or no that is the same more than once.
"""

from __future__ import annotations

import asyncio
import json
from collections import defaultdict
from collections.abc import Iterator, Mapping
from datetime import datetime
from email.utils import parsedate_to_datetime
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.routing import APIRoute, iter_route_contexts

from server.app import create_app
from server.principal import Role
from server.roles import NEEDS
from server.settings import Settings
from tests.server.serving import event
from tests.server.test_people import House, bearer, house

PROPOSALS = 12
DIFFERENT = frozenset(
    {"id", "number", "digest", "click_id", "feedback_id", "proposal_id", "url", "image", "title", "detail"}
    | {"skill", "parameters", "skill_probabilities", "state", "overlay", "overlays", "seq", "policy_version"}
    | {"x", "y", "values", "others", "keypoints", "labels", "items", "predicted_feedback", "subgoal", "instance"}
)
"""Fields whose content is another one of every proposal."""
ABOUT = ("proposal_id", "feedback_id")


def shape(told: Any, name: str = "") -> Any:
    """What it looks like, whatever it is about."""
    if isinstance(told, Mapping) and name not in DIFFERENT:
        return tuple((key, shape(told[key], key)) for key in sorted(told))
    if isinstance(told, list) and name not in DIFFERENT:
        return tuple(sorted({repr(shape(each, name)) for each in told}))
    return type(told).__name__ if name in DIFFERENT or _dated(told) else told


def _dated(told: Any) -> bool:
    try:
        return isinstance(told, str) and bool(datetime.fromisoformat(told))
    except ValueError:
        return False


def of_a_proposal() -> Iterator[str]:
    """The path of every route about a proposal, or a click on one, that a trainer may read."""
    for each in iter_route_contexts(create_app(Settings()).routes):
        route = each.original_route
        if isinstance(route, APIRoute) and "GET" in (each.methods or ()):
            needed = NEEDS[str(each.name)].role
            if any(f"{{{about}}}" in str(each.path) for about in ABOUT) and needed and Role.TRAINER.covers(needed):
                yield str(each.path)


def words(text: str) -> bool:
    """Whether it gives the matter a name; the experiment's own rate may be known."""
    return "gold" in text.replace("gold_rate", "") or "known_answer" in text


async def looks(ann: httpx.AsyncClient, proposal: Mapping[str, Any], feedback_id: int | None) -> dict[str, Any]:
    """What each of those routes says of a proposal, by its shape."""
    seen: dict[str, Any] = {}
    for path in of_a_proposal():
        if "feedback_id" in path and feedback_id is None:
            continue
        address = path.format(proposal_id=proposal["id"], feedback_id=feedback_id, camera="left")
        answer = await ann.get(address)
        headers = tuple(sorted(key for key in answer.headers if key != "content-length"))
        if answer.headers["content-type"] == "image/jpeg":
            assert parsedate_to_datetime(answer.headers["last-modified"]) == datetime.fromisoformat(
                proposal["opened_at"]
            ).replace(microsecond=0), "an old file would give it away"
            seen[path] = (answer.status_code, headers)
        else:
            assert not words(answer.text), path
            seen[path] = (answer.status_code, headers, shape(answer.json()))
    return seen


async def counts(ann: httpx.AsyncClient, experiment: int) -> tuple[int, ...]:
    """How much each route about the whole experiment has to tell of."""
    here = f"/api/v1/experiments/{experiment}"
    counters = (await ann.get(here)).json()["counters"]
    listed = {}
    for what in ("proposals", "feedback", "history", "metrics"):
        answer = await ann.get(f"{here}/{what}", params={"limit": 200})
        assert not words(answer.text), what
        listed[what] = len(answer.json()["items"])
    for what in ("events", "episodes", "incidents", "checkpoints", "timeline", "curves", "auto-approval", "executions"):
        assert not words((await ann.get(f"{here}/{what}")).text), what
    calibration = (await ann.get(f"{here}/calibration")).json()
    stretches = (await ann.get(f"{here}/timeline")).json()["stretches"]
    own = (await ann.get(f"{here}/quality/mine")).json()
    assert own["gold"] == {"count": 0, "of": 0}, "nothing is told of them yet"
    labels = ("feedback", "good", "neutral", "bad", "cant_tell")
    told = sum(each["good"] + each["bad"] for each in stretches)
    return (*(counters[each] for each in labels), *listed.values(), told, calibration["labels"])


async def whole(home: House, ann: httpx.AsyncClient, mode: str, value: int) -> dict[bool, list[Any]]:
    """Judge a run of proposals alike; what was seen of those whose answer was known, and of the others."""
    body = {"name": "hidden", "task": "stacking", "adapter": "kinematic", "algorithm": "scripted", "seed": 3}
    body |= {"settings": {"bad_first": 1_000_000}, "gold_rate": 0.5, "mode": mode, "lockstep": True}
    experiment = (await home.owner.post("/api/v1/experiments", json=body)).json()["id"]
    here, seen = f"/api/v1/experiments/{experiment}", dict[int, Any]()
    before: tuple[int, ...] | None = None
    async with home.live.stream(experiment, additional_headers=bearer(ann)) as viewer:
        await event(viewer, "snapshot")
        await home.owner.post(f"{here}/start")
        messages: defaultdict[int, list[Any]] = defaultdict(list)
        for number in range(1, PROPOSALS + 1):
            proposal = (await _heard(viewer, messages, "proposal_opened"))["proposal"]
            assert proposal["number"] == number
            open_ = await looks(ann, proposal, None)
            click = home.live.click(value)
            answer = await ann.post(f"/api/v1/proposals/{proposal['id']}/feedback", json=click)
            await _heard(viewer, messages, "metrics_added")
            now = await counts(ann, experiment)
            grown = None if before is None else tuple(b - a for a, b in zip(before, now, strict=True))
            before = now
            closed = await looks(ann, proposal, answer.json()["id"])
            seen[proposal["id"]] = (shape(proposal), open_, shape(answer.json()), closed, grown)
        await home.owner.post(f"{here}/pause")
    versions = [each["policy_version"] for each in (await ann.get(f"{here}/proposals?limit=200")).json()["items"]]
    assert versions == sorted(versions, reverse=True)
    gold = {each["proposal_id"] for each in (await home.owner.get(f"{here}/gold")).json()["items"]}
    sides: dict[bool, list[Any]] = {True: [], False: []}
    # nothing was counted before the first, and of the last the stream may have more to tell
    for proposal_id, told in list(seen.items())[1:-1]:
        sides[proposal_id in gold].append((*told, tuple(messages[proposal_id])))
    return sides


async def _heard(viewer: Any, messages: defaultdict[int, list[Any]], kind: str) -> dict[str, Any]:
    """The next message of a kind; those about a proposal are kept, by their shape."""
    async with asyncio.timeout(120):
        while True:
            received = await viewer.recv()
            if not isinstance(received, str):
                continue
            assert not words(received)
            message: dict[str, Any] = json.loads(received)
            about = (message.get("proposal") or {}).get("id") or (message.get("feedback") or {}).get("proposal_id")
            if about is not None:
                messages[about].append((message["type"], shape(message)))
            if message["type"] == kind:
                return message


@pytest.mark.parametrize(("mode", "value"), [("execute_approved", -1), ("propose_only", 1)])
async def test_whatever_a_trainer_may_read_is_the_same_of_both(
    tmp_path: Path, plugins: None, mode: str, value: int
) -> None:
    async with house(tmp_path) as home, await home.enter(await home.invite(role="trainer"), "Ann") as ann:
        sides = await whole(home, ann, mode, value)
    assert min(map(len, sides.values())) >= 3
    # of the proposal, the routes about it while it is open, the answer to the click, the routes, the counts, the stream
    for part in range(6):
        known, others = ({repr(told[part]) for told in sides[side]} for side in (True, False))
        assert known <= others, part
