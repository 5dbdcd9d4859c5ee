"""Practice through REST: shown, judged, corrected at once; and clicks that don't count before it is passed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from server.schemas import FeedbackStatus, Verdict
from server.schemas_practice import PracticeAnswer
from server.store import Store
from tests.server.databases import click, opened, running
from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem

REQUIRED: dict[str, Any] = {"practice_required": {"proposals": 3, "accuracy": 0.66}}


async def card(live: Serving, experiment: int, trainer: str = "local") -> dict[str, Any]:
    answer = await live.http.post(f"/api/v1/experiments/{experiment}/practice", json={"trainer": trainer})
    assert answer.status_code == 200, answer.text
    return dict(answer.json())


async def answered(live: Serving, experiment: int, *, right: bool, trainer: str = "local") -> dict[str, Any]:
    """Judge the next practice proposal, rightly or not."""
    shown = await card(live, experiment, trainer)
    known = (await live.service.store.quality.practice(shown["id"])).known_answer
    body = live.click(known if right else -known, trainer=trainer)
    result = (await live.http.post(f"/api/v1/practice/{shown['id']}/answer", json=body)).json()
    assert result["right"] is right
    assert result["right_answer"] == known
    return dict(result)


@pytest.mark.parametrize("task", ["collecting_toy", "reaching", "stacking"])
async def test_each_answer_is_corrected_at_once_with_the_reason(tmp_path: Path, task: str) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment(task=task, seed=2)
        shown = await card(live, experiment)
        assert await card(live, experiment) == shown, "a reload shows the same one"
        assert not [key for key in shown if "answer" in key or "right" in key or "reason" in key]
        assert [view["camera"] for view in shown["views"]] == ["left", "right"]
        for view in shown["views"]:
            assert (await live.http.get(view["url"])).content.startswith(b"\xff\xd8")
            assert view["overlay"]["dot"] is not None
        address = f"/api/v1/practice/{shown['id']}/answer"
        check_problem(await live.http.post(address, json=live.click(1, trainer="ann")), 404)
        check_problem(await live.http.post(address, json=live.click(2)), 422)
        body = live.click(1)
        first = (await live.http.post(address, json=body)).json()
        assert (await live.http.post(address, json=body)).json() == first, "sent again: the same correction"
        check_problem(await live.http.post(address, json=body | {"value": -1}), 409)
        assert first["right"] == (first["right_answer"] == 1) == first["reason"]["good"]
        assert first["reason"]["text"].startswith("Good" if first["reason"]["good"] else "Bad")
        assert set(first["right_overlays"]) == {"left", "right"}
        assert first["progress"]["answered"] == 1
        kinds = {(await answered(live, experiment, right=True))["right_answer"] for _ in range(8)}
        assert kinds == {1, -1}, "good ones and bad ones"
        assert (await card(live, experiment))["number"] == 10
        told = (await live.http.get(f"/api/v1/experiments/{experiment}/practice")).json()
        assert (told["answered"], told["counts"], told["required"]) == (9, True, None)
        check_problem(await live.http.get("/api/v1/experiments/4242/practice"), 404)
        check_problem(await live.http.post("/api/v1/practice/4242/answer", json=body), 404)


async def test_clicks_count_only_once_practice_is_passed(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment(**REQUIRED)
        proposal = await live.proposal(experiment)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        async with live.stream(experiment) as viewer:
            body = live.click(1)
            stored = await live.http.post(address, json=body)
            assert (stored.status_code, stored.json()["status"]) == (201, "practice")
            assert (await live.http.post(address, json=body)).json() == stored.json()
            told = await event(viewer, "feedback_stored")
            assert (told["feedback"]["status"], told["undoable"]) == ("practice", False)
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["closed_at"] is None
        counters = (await live.http.get(f"/api/v1/experiments/{experiment}")).json()["counters"]
        assert (counters["feedback"], counters["late"]) == (0, 0)
        check_problem(await live.http.delete(f"/api/v1/feedback/{stored.json()['id']}"), 409)
        relabels = f"/api/v1/feedback/{stored.json()['id']}/relabels"
        assert "practice" in check_problem(await live.http.post(relabels, json=live.click(1)), 409).detail
        passed = [(await answered(live, experiment, right=r))["progress"] for r in (False, False, True, True)]
        assert [(p["passed"], p["counts"]) for p in passed] == [(False, False)] * 3 + [(True, True)]
        assert passed[-1]["newest"] == {"count": 2, "of": 3}
        await answered(live, experiment, right=False)
        again = (await live.http.get(f"/api/v1/experiments/{experiment}/practice")).json()
        assert (again["passed"], again["counts"]) == (True, True), "passed once is passed"
        assert (await live.http.post(address, json=live.click(1))).json()["status"] == "stored"
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["verdict"] == "good"
        events = (await live.http.get(f"/api/v1/experiments/{experiment}/events")).json()["items"]
        assert [e["payload"]["trainer"] for e in events if e["kind"] == "qualified"] == ["local"]


async def test_a_requirement_can_be_set_and_lifted_and_a_task_that_cant_be_drawn_says_so(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        address = f"/api/v1/experiments/{experiment}"
        changed = (await live.http.patch(address, json=REQUIRED)).json()
        assert changed["practice_required"] == REQUIRED["practice_required"]
        proposal = await live.proposal(experiment)
        refused = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(1))
        assert refused.json()["status"] == "practice"
        assert (await live.http.patch(address, json={"practice_required": None})).json()["practice_required"] is None
        counted = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(1))
        assert counted.json()["status"] == "stored"
        for wrong in ({"proposals": 0}, {"accuracy": 0}, {"accuracy": 1.5}, {"proposals": 2.5}):
            told = check_problem(await live.http.patch(address, json={"practice_required": wrong}), 422)
            assert told.fields[0].field.startswith("practice_required.")


async def test_what_is_open_waits_no_longer_for_who_has_to_practise_from_now_on(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment(aggregation="unanimous", mode="propose_only", **REQUIRED)
        address, pages = f"/api/v1/experiments/{here}", f"{here}/stream?trainer="
        for _ in range(3):
            progress = (await answered(live, here, right=True, trainer="ann"))["progress"]
        assert progress["counts"] is True
        await live.http.patch(address, json={"practice_required": None})
        async with live.stream(pages + "ann") as ann, live.stream(pages + "bob") as bob:
            for page in (ann, bob):
                await event(page, "snapshot")
            await live.http.post(f"{address}/start")
            proposal = (await event(ann, "proposal_opened"))["proposal"]
            assert proposal["electorate"] == ["ann", "bob"]
            feedback = f"/api/v1/proposals/{proposal['id']}/feedback"
            assert (await live.http.post(feedback, json=live.click(1, trainer="ann"))).status_code == 201
            assert (await live.http.patch(address, json=REQUIRED)).status_code == 200
            closed = (await event(ann, "proposal_closed"))["proposal"]
            assert (closed["id"], closed["verdict"], closed["electorate"]) == (proposal["id"], "good", ["ann"])
            following = (await event(ann, "proposal_opened"))["proposal"]
            assert following["electorate"] == ["ann"]
            # lifted: he is asked for the next one
            await live.http.patch(address, json={"practice_required": None})
            feedback = f"/api/v1/proposals/{following['id']}/feedback"
            assert (await live.http.post(feedback, json=live.click(-1, trainer="ann"))).status_code == 201
            assert (await event(ann, "proposal_opened"))["proposal"]["electorate"] == ["ann", "bob"]


async def test_nobody_waits_for_a_trainer_who_has_to_practise(store: Store) -> None:
    experiment_id = await running(store, aggregation="unanimous", **REQUIRED)
    for number, name in [(number, name) for number in range(1, 4) for name in ("ann", "cyd")]:
        content = {"answer": 1, "reason": {}, "right": {}, "views": []}
        row = await store.quality.open_practice(experiment_id, name, number, content)
        await store.quality.answer_practice(
            row.id, PracticeAnswer(click_id=f"{name}s-{number:04}", value=1, trainer=name)
        )
    proposal = await opened(store, experiment_id, electorate=("ann", "bob", "cyd", "teacher:dan"))
    assert proposal.electorate == ["ann", "cyd"], "a person is not a teacher by their name"
    bobs = await store.submit_feedback(proposal.id, click(-1, trainer="bob"))
    assert (bobs.feedback.status, bobs.closed) == (FeedbackStatus.PRACTICE, None)
    assert (await store.submit_feedback(proposal.id, click(1, trainer="ann"))).closed is None
    cyds = await store.submit_feedback(proposal.id, click(1, trainer="cyd"))
    assert cyds.closed is not None
    assert cyds.closed.verdict is Verdict.GOOD
    assert [label.value for label in await store.labels(experiment_id)] == [1, 1]


async def test_a_teacher_needs_no_practice_and_a_person_of_its_name_does(store: Store) -> None:
    experiment_id = await running(store, **REQUIRED)
    proposal = await opened(store, experiment_id, electorate=())
    said = await store.submit_feedback(proposal.id, click(1, trainer="teacher:synthetic"))
    assert (said.feedback.status, said.closed) == (FeedbackStatus.PRACTICE, None)
    taught = await store.submit_feedback(proposal.id, click(1, trainer="teacher:synthetic"), kind="teacher")
    assert taught.feedback.status is FeedbackStatus.STORED
    assert taught.closed is not None
    assert taught.closed.verdict is Verdict.GOOD
