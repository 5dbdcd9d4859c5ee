"""Known answers among the proposals, everybody's figures, and the feedback as a table: through REST and real runs."""

from __future__ import annotations

import asyncio
import csv
import json
from pathlib import Path
from typing import Any

from server.messages import ProposalClosed, ProposalOpened
from server.schemas import CloseReason, ExecutionOutcome, Proposal
from server.schemas_quality import GoldMark
from server.store import Store
from tests.server.databases import begun, click, opened, running
from tests.server.serving import Serving, serving
from tests.server.stage import Stage, stage
from tests.server.test_errors import check_problem

CANDID: dict[str, Any] = {"algorithm": "candid", "settings": {"bad_first": 1_000_000}, "lockstep": True}


async def judged(s: Stage, count: int, value: int) -> list[Proposal]:
    """The next proposals of an experiment that runs, each answered with the same value."""
    found: list[Proposal] = []
    while len(found) < count:
        found.append(await s.proposal(number=len(found) + 1))
        await s.judge(found[-1], value)
    await s.seen.next(ProposalClosed, where=lambda e: e.proposal.id == found[-1].id)
    return found


async def test_a_known_answer_moves_nothing_trains_nothing_and_shows_on_no_wire(tmp_path: Path, plugins: None) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(**CANDID, gold_rate=0.5, seed=3)
        await s.hub.act(experiment.id, "start")
        shown = await judged(s, 12, 1)  # every one is called good, and all of them are bad
        last = await s.proposal(number=13)
        known = (await s.store.quality.gold(experiment.id, None, 50)).items
        assert 3 <= len(known) <= 9
        gold = {each.proposal_id for each in known}
        assert gold < {proposal.id for proposal in shown}
        assert {(g.known_answer, g.source, g.answers[0].right) for g in known} == {(-1, "rule", False)}
        executed = {execution.proposal_id for execution in (await s.store.executions(experiment.id)).items}
        assert executed == {proposal.id for proposal in shown} - gold
        clicks = (await s.store.feedback_of_experiment(experiment.id)).items
        assert set(map(int, last.skill_probabilities)) == {c.id for c in clicks if c.proposal_id not in gold}
        assert (await s.hub.view(experiment.id)).counters.feedback == 12
        told = [e for e in s.seen.events if isinstance(e, ProposalOpened | ProposalClosed)]
        assert not any("known" in (text := e.model_dump_json()) or "gold" in text for e in told)
        same = {tuple(sorted(e.proposal.model_dump())) for e in told}
        assert len(same) == 1, "the same fields, gold or not"


async def test_the_lot_depends_on_seed_and_number_only_and_without_a_rate_there_is_none(store: Store) -> None:
    drawn = []
    for rate in (0.3, 0.3, 0.0):
        experiment_id = await running(store, gold_rate=rate, seed=5)
        for number in range(20):
            proposal = await opened(store, experiment_id, f"o{number}", rule_answer=-1)
            await store.submit_feedback(proposal.id, click(-1))
        known = (await store.quality.gold(experiment_id, None, 50)).items
        drawn.append([each.number for each in known])
        assert len(await store.labels(experiment_id)) == 20 - len(known)
    assert drawn[0] == drawn[1] != []
    assert drawn[2] == []
    unclear = await running(store, gold_rate=0.5, seed=5)
    for number in range(20):
        await store.submit_feedback((await opened(store, unclear, f"o{number}")).id, click(-1))
    assert (await store.quality.gold(unclear, None, 50)).items == [], "where the rule isn't clear there is no answer"


async def test_a_marked_proposal_is_shown_again_as_it_was_and_never_moves_anything(store: Store) -> None:
    experiment_id = await running(store, gold_rate=0.5, seed=1)
    first = await opened(store, experiment_id, "o1", x=0.61)
    await store.submit_feedback(first.id, click(-1))
    await store.quality.mark_gold(first.id, GoldMark(answer=1))
    again = []
    for number in range(2, 30):
        proposal = await opened(store, experiment_id, f"o{number}", policy_version=number)
        assert proposal.policy_version == number, "an old one would stand out"
        known = proposal.parameters["x"] == 0.61
        await store.submit_feedback(proposal.id, click(1))
        decision, execution = await begun(store, proposal.id, proposal.observation_id)
        assert (execution is None) == known
        if known:
            again.append(proposal)
            assert (proposal.state, proposal.digest) == (first.state, first.digest)
            assert proposal.observation_id not in ("o1", f"o{number}"), "an id that was there before would stand out"
            assert [v.image for v in proposal.views] == [v.image for v in first.views]
            assert decision.reason == "held back"
        else:
            assert execution is not None
            ended: dict[str, Any] = {"end_reason": None, "low_level_steps": 1, "task_success": False}
            await store.end_execution(execution.id, ExecutionOutcome.SUCCEEDED, **ended)
    told = (await store.quality.gold(experiment_id, None, 50)).items
    assert [(g.proposal_id, g.source, g.answers[0].right) for g in told] == [
        (p.id, "operator", True) for p in reversed(again)
    ]
    assert len(again) >= 4
    assert len({proposal.observation_id for proposal in again}) == len(again)
    await store.quality.unmark_gold(first.id)
    for number in range(30, 40):
        proposal = await opened(store, experiment_id, f"o{number}")
        assert proposal.parameters["x"] != 0.61
        await store.close_proposal(proposal.id, CloseReason.WITHDRAWN)


async def _panel(live: Serving, proposals: int) -> int:
    """An experiment in which ann is right, bob mostly, and cyd never; ann's click decides, the others' come late."""
    experiment = await live.experiment()
    for number in range(proposals):
        truth = 1 if number % 3 == 0 else -1
        proposal = await live.proposal(experiment)
        bobs = -truth if number % 5 == 0 else truth
        for name, value in (("ann", truth), ("bob", bobs), ("cyd", -truth)):
            await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(value, trainer=name))
    return experiment


async def test_everybody_is_measured_in_the_background_and_told_apart(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await _panel(live, 20)
        address = f"/api/v1/experiments/{experiment}/quality"
        await live.service.store.quality.measure(experiment)
        told = (await live.http.get(address)).json()
        ann, bob, cyd = told["trainers"]
        assert [t["trainer"] for t in told["trainers"]] == ["ann", "bob", "cyd"]
        assert (ann["labels"], ann["good"], ann["bad"], ann["late"]) == (20, 7, 13, 0)
        assert (bob["labels"], bob["late"], bob["with_verdicts"]) == (0, 20, {"count": 16, "of": 20})
        assert cyd["with_verdicts"] == {"count": 0, "of": 20}
        assert ann["with_others"] == {"count": 16, "of": 40}
        weights = {t["trainer"]: t["estimate"]["weight"] for t in told["trainers"]}
        assert weights["ann"] > weights["bob"] > 0.6
        assert weights["cyd"] < 0.3
        low, high = bob["estimate"]["interval"]
        assert low < bob["estimate"]["accuracy"] < high
        assert (told["agreement"]["proposals"], told["agreement"]["trainers"]) == (20, 3)
        assert told["agreement"]["alpha"] < 0.2
        mine = (await live.http.get(f"{address}/mine", params={"trainer": "bob"})).json()
        assert mine == bob | {"estimate": None}
        nothing = (await live.http.get(f"{address}/mine", params={"trainer": "dan"})).json()
        assert (nothing["trainer"], nothing["labels"], nothing["gold"]) == ("dan", 0, {"count": 0, "of": 0})
        check_problem(await live.http.get("/api/v1/experiments/4242/quality"), 404)


async def test_nobody_looks_better_by_clicking_on_after_the_verdict(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        for number in range(10):
            said = 1 if number % 2 else -1
            proposal = await live.proposal(experiment)
            # ann decides, from two tabs; bob says the contrary, and then, again and again, what was decided
            for name, value in (("ann", said), ("ann", said), ("bob", -said), *[("bob", said)] * 3):
                await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(value, trainer=name))
        await live.service.store.quality.measure(experiment)
        told = (await live.http.get(f"/api/v1/experiments/{experiment}/quality")).json()
        ann, bob = told["trainers"]
        assert bob["with_verdicts"] == ann["with_others"] == {"count": 0, "of": 10}
        assert (ann["late"], bob["late"]) == (10, 40)
        assert told["agreement"]["alpha"] < 0
        assert told["agreement"]["labels"] == 20
        assert [each["estimate"]["informative"] for each in (ann, bob)] == [10, 10]
        assert abs(ann["estimate"]["weight"] - bob["estimate"]["weight"]) < 1e-9


async def test_what_cant_be_told_yet_is_said_and_an_estimate_comes_by_itself(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        empty = (await live.http.get(f"/api/v1/experiments/{experiment}/quality")).json()
        assert empty["trainers"] == []
        assert empty["agreement"]["alpha"] is None
        assert "two trainers" in empty["agreement"]["why"]
        running_one = await live.experiment()
        await live.http.post(f"/api/v1/experiments/{running_one}/start")
        async with live.stream(running_one) as viewer:
            message = json.loads(await viewer.recv())
            while not message.get("proposal"):
                received = await viewer.recv()
                message = json.loads(received) if isinstance(received, str) else {}
            proposal = message["proposal"]["id"]
        for name in ("ann", "bob"):  # the second one is late
            await live.http.post(f"/api/v1/proposals/{proposal}/feedback", json=live.click(-1, trainer=name))
        deadline = asyncio.get_running_loop().time() + 60
        while asyncio.get_running_loop().time() < deadline:
            told = (await live.http.get(f"/api/v1/experiments/{running_one}/quality")).json()["trainers"]
            if len(told) == 2 and all(t["estimate"]["at"] for t in told):
                break
        assert all(t["estimate"]["informative"] == 1 for t in told)


async def test_beside_others_of_the_same_robot_a_known_answer_is_of_the_same_scene(store: Store) -> None:
    together = {"parallel": True}
    experiment_id = await running(store, gold_rate=0.5, seed=1, aggregation="majority", together=together)
    first = await opened(store, experiment_id, "o1", x=0.61)
    await store.submit_feedback(first.id, click(-1))
    await store.quality.mark_gold(first.id, GoldMark(answer=1))
    beside = [
        await opened(store, experiment_id, "o2", slot=slot, x=0.4 + slot / 1000, rule_answer=-1) for slot in range(12)
    ]
    assert {proposal.observation_id for proposal in beside} == {"o2"}
    assert len({tuple(proposal.state) for proposal in beside}) == 1
    for proposal in beside:
        await store.close_proposal(proposal.id, CloseReason.WITHDRAWN)
    known = (await store.quality.gold(experiment_id, None, 50)).items
    assert {each.source for each in known} == {"rule"}


async def test_the_table_holds_every_click_with_its_history(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        kept = []
        for value in (-1, "cant_tell", 0):
            proposal = await live.proposal(experiment)
            address = f"/api/v1/proposals/{proposal.id}/feedback"
            kept.append((await live.http.post(address, json=live.click(value))).json())
            await live.http.post(address, json=live.click(1, trainer="=late()"))
        for n, value in ((0, 1), (1, "cant_tell")):
            body: dict[str, Any] = {"click_id": f"correction-{n}", "value": value}
            await live.http.post(f"/api/v1/feedback/{kept[0]['id']}/relabels", json=body)
        await live.http.delete(f"/api/v1/feedback/{kept[2]['id']}")
        table = f"/api/v1/experiments/{experiment}/exports/feedback"
        answer = await live.http.get(table, params={"format": "jsonl"})
        rows = [json.loads(line) for line in answer.text.splitlines()]
        assert [(r["act"], r["answer"], r["label_now"], r["status"]) for r in rows] == [
            ("click", -1, "cant_tell", "stored"),
            ("relabel", 1, "cant_tell", "stored"),
            ("relabel", "cant_tell", "cant_tell", "stored"),
            ("click", 1, 1, "late"),
            ("click", "cant_tell", "cant_tell", "stored"),
            ("click", 1, 1, "late"),
            ("click", None, None, "stored"),  # taken back: what is open again isn't told of
            ("click", None, None, "late"),  # neither is what came too late on it
        ]
        assert rows[6]["undone_at"] is not None
        assert rows[0]["parameters"] == {"x": 0.5, "y": 0.0, "z": -0.09}
        written = await live.http.get(table)
        assert written.headers["content-type"] == "text/csv; charset=utf-8"
        assert f"experiment-{experiment}-feedback.csv" in written.headers["content-disposition"]
        cells = list(csv.DictReader(written.text.splitlines()))
        assert [c["answer"] for c in cells] == ["" if r["answer"] is None else str(r["answer"]) for r in rows]
        assert cells[3]["trainer"] == "'=late()", "no spreadsheet takes it for a formula"
        check_problem(await live.http.get("/api/v1/experiments/4242/exports/feedback"), 404)
        check_problem(await live.http.get(table, params={"format": "xls"}), 422)
