"""What the critic expects over the table: of a learner that lives, of one that is read back, and why there is none."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import numpy as np

from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem

TAUGHT: dict[str, Any] = {"teacher": "synthetic", "task": "stacking", "seed": 2}


async def taught(live: Serving, until: int, **fields: Any) -> tuple[str, int]:
    """An experiment that a teacher judged so often, paused; its address, and its newest closed proposal."""
    experiment = await live.experiment(**TAUGHT | fields)
    address = f"/api/v1/experiments/{experiment}"
    async with live.stream(experiment) as viewer:
        await live.http.post(f"{address}/start")
        while (await event(viewer, "metrics_added"))["point"]["feedback"] < until:
            pass
        await live.http.post(f"{address}/pause")
        await live.service.hub.idle(experiment)
    return address, (await live.http.get(f"{address}/history")).json()["items"][0]["proposal"]["id"]


async def test_a_learner_and_its_checkpoint_tell_the_same_and_what_was_said_lies_beside(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        address, proposal = await taught(live, 12)
        where = f"/api/v1/proposals/{proposal}/critic"
        told = (await live.http.get(where, params={"points": 9, "skill": "pick"})).json()
        assert told["source"] == "learner"
        values = np.array(told["values"])
        assert values.shape == (len(told["y"]), len(told["x"]))
        assert max(values.shape) == 9
        assert values.std() > 0
        bounds = {
            p["name"]: p for p in (await live.http.get("/api/v1/tasks/stacking")).json()["skills"][0]["parameters"]
        }
        assert (told["x"][0], told["x"][-1]) == (bounds["x"]["low"], bounds["x"]["high"])
        history = (await live.http.get(f"{address}/history", params={"skill": "pick", "limit": 200})).json()["items"]
        assert [each["proposal_id"] for each in told["labels"]] == [e["proposal"]["id"] for e in history][::-1]
        assert any(each["alike"] for each in told["labels"])
        assert len(told["keypoints"]) == 1
        await live.http.post(f"{address}/finish")
        await live.service.hub.idle(int(address.rsplit("/", 1)[1]))
        read = (await live.http.get(where, params={"points": 9, "skill": "pick"})).json()
        assert read["source"] == "checkpoint"
        assert read["policy_version"] == told["policy_version"]
        assert read["values"] == told["values"]
    async with serving(tmp_path) as live:  # after a restart, twice at once
        both = await asyncio.gather(*(live.http.get(where, params={"points": 9, "skill": "pick"}) for _ in range(2)))
        assert [answer.json()["values"] for answer in both] == [told["values"]] * 2


async def test_what_is_held_the_same_everywhere_can_be_chosen(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        _, proposal = await taught(live, 6)
        where = f"/api/v1/proposals/{proposal}/critic"
        low = (await live.http.get(where, params={"points": 5, "skill": "place", "other": "z=-0.05"})).json()
        assert low["others"]["z"] == -0.05
        high = (await live.http.get(where, params={"points": 5, "skill": "place", "other": "z=0.0"})).json()
        assert low["values"] != high["values"]
        for wrong in ({"skill": "fly"}, {"points": 4}, {"points": 65}, {"other": "z"}, {"other": "z=nan"}):
            check_problem(await live.http.get(where, params=wrong), 422)
        for other in ("z=9", "x=0.5", "q=1"):
            told = check_problem(await live.http.get(where, params={"other": other}), 422)
            assert [field.field for field in told.fields] == ["other"]
        check_problem(await live.http.get("/api/v1/proposals/999/critic"), 404)


async def test_where_there_is_no_critic_it_says_why(tmp_path: Path, plugins: None) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        untrained = await live.proposal(experiment)
        told = check_problem(await live.http.get(f"/api/v1/proposals/{untrained.id}/critic"), 409)
        assert "judge a few" in told.remedy
        _, proposal = await taught(live, 3, algorithm="scripted", settings={})
        told = check_problem(await live.http.get(f"/api/v1/proposals/{proposal}/critic"), 409)
        assert "scripted" in told.detail


async def test_what_it_would_do_with_other_skills_is_told_and_drawn_while_a_proposal_is_open(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        body = {"task": "stacking", "adapter": "kinematic", "algorithm": "seed", "settings": {"hidden_size": 16}}
        experiment = await live.experiment(**body)
        async with live.stream(experiment) as viewer:
            await live.http.post(f"/api/v1/experiments/{experiment}/start")
            proposal = (await event(viewer, "proposal_opened"))["proposal"]
        where = f"/api/v1/proposals/{proposal['id']}/considered"
        items = (await live.http.get(where)).json()["items"]
        assert [each["probability"] for each in items] == sorted(proposal["skill_probabilities"].values(), reverse=True)
        (own,), (other,) = ([each for each in items if each["proposed"] is it] for it in (True, False))
        assert (own["skill"], own["parameters"]) == (proposal["skill"], proposal["parameters"])
        assert own["overlays"] == {view["camera"]: view["overlay"] for view in proposal["views"]}
        assert set(other["overlays"]) == {"left", "right"}
        assert other["overlays"]["left"]["dot"] is not None
        specs = {spec["name"]: spec for spec in (await live.http.get("/api/v1/tasks/stacking")).json()["skills"]}
        for parameter in specs[other["skill"]]["parameters"]:
            assert parameter["low"] <= other["parameters"][parameter["name"]] <= parameter["high"]
        assert (await live.http.get(where)).json()["items"] == items  # to ask changes nothing
        await live.http.post(f"/api/v1/experiments/{experiment}/finish")
        await live.service.hub.idle(experiment)
        closed = (await live.http.get(where)).json() if (await live.http.get(where)).is_success else {"items": []}
        assert not any(each["overlays"] for each in closed["items"] if not each["proposed"])
        check_problem(await live.http.get("/api/v1/proposals/999/considered"), 404)
