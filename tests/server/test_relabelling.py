"""Corrections of earlier clicks: the click stays, counters and learner follow, nothing is judged or moved anew."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path
from typing import Any

import pytest

from server.messages import FeedbackRelabelled, ProposalOpened, WorkerChanged
from server.schemas import Feedback, Proposal
from server.schemas_labels import RelabelCreate
from server.store import Conflict, Store
from tests.server.databases import click, opened, running
from tests.server.serving import event, serving
from tests.server.stage import Stage, stage
from tests.server.test_errors import check_problem

CANDID: dict[str, Any] = {"algorithm": "candid", "settings": {"bad_first": 1_000_000}, "mode": "propose_only"}


def corrected(value: Any, click_id: str = "correction-1", trainer: str = "local") -> RelabelCreate:
    return RelabelCreate(click_id=click_id, value=value, trainer=trainer)


async def _counted(store: Store, experiment_id: int) -> dict[str, int]:
    kinds = {"feedback", "good", "neutral", "bad", "cant_tell", "late", "relabelled"}
    counters = (await store.experiment(experiment_id)).counters.model_dump(include=kinds)
    return {kind: number for kind, number in counters.items() if number}


async def test_a_correction_keeps_the_click_and_its_verdict_and_is_stored_once(store: Store) -> None:
    experiment_id = await running(store)
    first = await opened(store, experiment_id, "o1")
    given = (await store.submit_feedback(first.id, click(-1))).feedback
    await store.submit_feedback((await opened(store, experiment_id, "o2")).id, click(1))
    for _ in range(2):  # sent again: the same answer
        done = await store.relabel(given.id, corrected(1), anybodys=False)
        assert (done.feedback.value, done.feedback.label) == (-1, 1)
    assert done.duplicate
    again = await store.relabel(given.id, corrected("cant_tell", "correction-2"), anybodys=False)
    assert [r.value for r in again.feedback.relabels] == [1, "cant_tell"]
    assert again.feedback == await store.feedback(given.id)
    assert (await store.proposal(first.id)).verdict == "bad"
    assert [label.value for label in await store.labels(experiment_id)] == [1], "the other click's"
    assert await _counted(store, experiment_id) == {"feedback": 1, "good": 1, "cant_tell": 1, "relabelled": 2}
    with pytest.raises(Conflict, match="another content"):
        await store.relabel(given.id, corrected(0), anybodys=False)
    back = await store.relabel(given.id, corrected(0, "correction-3"), anybodys=False)
    assert back.label is not None
    first_label = (await store.labels(experiment_id))[0]
    assert (first_label.feedback_id, first_label.value) == (given.id, 0)


async def test_what_counts_for_nothing_is_not_corrected_nor_what_is_open_nor_anothers(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    panel = ("ann", "bob", "cyd")
    proposal = await opened(store, experiment_id, electorate=panel)
    anns = (await store.submit_feedback(proposal.id, click(1, trainer="ann"))).feedback
    with pytest.raises(Conflict, match="still open"):
        await store.relabel(anns.id, corrected(-1, trainer="ann"), anybodys=False)
    await store.submit_feedback(proposal.id, click(1, trainer="bob"))
    late = (await store.submit_feedback(proposal.id, click(-1, trainer="cyd"))).feedback
    with pytest.raises(Conflict, match="late"):
        await store.relabel(late.id, corrected(1, trainer="cyd"), anybodys=False)
    with pytest.raises(Conflict, match="somebody else's, not bob's"):
        await store.relabel(anns.id, corrected(-1, trainer="bob"), anybodys=False)
    assert await _counted(store, experiment_id) == {"feedback": 2, "good": 2, "late": 1}
    done = await store.relabel(anns.id, corrected(-1, trainer="bob"), anybodys=True)
    assert (done.feedback.trainer, done.feedback.relabels[0].trainer) == ("ann", "bob")
    corrected_one, bobs = await store.labels(experiment_id)
    assert corrected_one.feedback_id == anns.id
    assert corrected_one.trainer == bobs.trainer, "whoever corrects a label answers for it"
    fourth = await opened(store, experiment_id, electorate=panel)
    taken = (await store.submit_feedback(fourth.id, click(1, trainer="ann"))).feedback
    await store.undo_feedback(taken.id)
    with pytest.raises(Conflict, match="taken back"):
        await store.relabel(taken.id, corrected(-1, "correction-9", "ann"), anybodys=False)


async def held_by(s: Stage, proposal: Proposal) -> tuple[Proposal, dict[str, float]]:
    """What the learner holds after another bad click, that one left out; and the proposal that tells it."""
    for _ in range(2):  # the one drawn ahead may be of before
        at = s.now
        await s.judge(proposal, 0)
        proposal = (await s.seen.next(ProposalOpened, at)).proposal
    return proposal, proposal.skill_probabilities


async def test_the_learner_follows_at_once_and_a_new_one_starts_with_the_same_labels(
    tmp_path: Path, plugins: None
) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(**CANDID, lockstep=True)
        await s.hub.act(experiment.id, "start")
        given: list[Feedback] = []
        for value in (-1, -1, 1, "cant_tell", -1):
            proposal = await s.proposal(number=len(given) + 1)
            given.append((await s.hub.feedback(proposal.id, s.click(value)))[0])
        proposal = await s.proposal(number=6)
        assert proposal.skill_probabilities == {str(given[n].id): v for n, v in ((0, -1), (1, -1), (2, 1), (4, -1))}
        at = s.now
        for number, value in ((0, 1), (2, "cant_tell"), (3, -1), (4, 0)):
            done, _ = await s.hub.relabel(given[number].id, corrected(value, f"correction-{number}"))
            assert done.label == value
        assert len(s.seen.of(FeedbackRelabelled)) == 4
        proposal, held = await held_by(s, proposal)
        expected = {str(given[n].id): v for n, v in ((0, 1), (1, -1), (3, -1), (4, 0))}
        assert {k: v for k, v in held.items() if int(k) <= given[-1].id} == expected
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        await s.seen.next(WorkerChanged, at, where=lambda e: e.status == "restarted")
        _, anew = await held_by(s, proposal)
        assert {k: v for k, v in anew.items() if k in held} == held
        assert (await s.store.executions(experiment.id)).items == []


async def test_the_learner_tells_trainers_apart_also_after_a_restart(tmp_path: Path, plugins: None) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(**CANDID, lockstep=True)
        await s.hub.act(experiment.id, "start")
        given: list[Feedback] = []
        for trainer in ("ann", "bob", "ann"):
            proposal = await s.proposal(number=len(given) + 1)
            body = s.click(-1).model_copy(update={"trainer": trainer})
            given.append((await s.hub.feedback(proposal.id, body))[0])
        at = s.now
        assert (await s.proposal(number=4)).uncertainty == 2
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        await s.seen.next(WorkerChanged, at, where=lambda e: e.status == "restarted")
        await s.hub.relabel(given[1].id, corrected(1, trainer="ann"), anybodys=True)
        proposal, _ = await held_by(s, await s.proposal(number=4))
        assert proposal.uncertainty == 2, "ann, and whoever judged since"


async def test_can_t_tell_lets_the_next_proposal_come_and_a_correction_reaches_everyone(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        address = f"/api/v1/proposals/{proposal.id}/feedback"
        async with live.stream(experiment) as viewer:
            stored = (await live.http.post(address, json=live.click("cant_tell"))).json()
            assert (stored["value"], stored["label"], stored["status"]) == ("cant_tell", "cant_tell", "stored")
            closed = (await event(viewer, "proposal_closed"))["proposal"]
            assert (closed["close_reason"], closed["verdict"]) == ("cant_tell", None)
            await live.proposal(experiment)  # it may open: nobody waits for anything
            correction = {"click_id": "correction-1", "value": -1}
            corrections = f"/api/v1/feedback/{stored['id']}/relabels"
            first = await live.http.post(corrections, json=correction)
            again = await live.http.post(corrections, json=correction)
            assert (first.status_code, again.status_code, again.json()) == (201, 200, first.json())
            told = (await event(viewer, "feedback_relabelled"))["feedback"]
            assert told == first.json() == (await live.http.get(f"/api/v1/feedback/{stored['id']}")).json()
            over_stream = {"type": "relabel", "feedback_id": stored["id"], "click_id": "correction-2", "value": 1}
            await viewer.send(json.dumps(over_stream))
            answer = await event(viewer, "acknowledged")
            assert (answer["request_id"], answer["feedback"]["label"]) == ("correction-2", 1)
            await viewer.send(json.dumps(over_stream | {"feedback_id": 4242, "click_id": "correction-3"}))
            assert (await event(viewer, "refused"))["request_id"] == "correction-3"
        check_problem(await live.http.post(corrections, json=correction | {"value": 0}), 409)
        check_problem(await live.http.post(corrections, json={"click_id": "correction-4"}), 422)
        check_problem(await live.http.post("/api/v1/feedback/4242/relabels", json=correction), 404)
        assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["verdict"] is None
