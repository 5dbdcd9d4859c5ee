"""The critic's own approvals through the real service: who may set them, what moves by them, and what never does."""

from __future__ import annotations

from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest_asyncio
from websockets.asyncio.client import ClientConnection

from server.schemas import ExperimentUpdate
from server.schemas_trust import AutoApproval
from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem

CONFIDENT: dict[str, Any] = {"algorithm": "confident", "settings": {}, "lockstep": True}
RULE = {"after_feedback": 1, "audit_every": 3}


@pytest_asyncio.fixture
async def live(tmp_path: Path, plugins: None) -> AsyncIterator[Serving]:
    """A service that finds the plug-ins of the tests."""
    async with serving(tmp_path) as service:
        yield service


async def asked(stream: ClientConnection) -> None:
    """Wait until a trainer is waited for, anew: in lockstep every click is followed by other phases."""
    elsewhere = False
    while True:
        phase = (await event(stream, "experiment_changed"))["experiment"]["phase"]
        if elsewhere and phase == "awaiting_feedback":
            return
        elsewhere |= phase != "awaiting_feedback"


async def newest(live: Serving, address: str) -> dict[str, Any]:
    """The newest proposal."""
    return dict((await live.http.get(f"{address}/proposals", params={"limit": 1})).json()["items"][0])


async def clicked(live: Serving, address: str, value: int) -> dict[str, Any]:
    """Judge the open proposal; what it was."""
    proposal = await newest(live, address)
    assert proposal["closed_at"] is None
    answer = await live.http.post(f"/api/v1/proposals/{proposal['id']}/feedback", json=live.click(value))
    assert answer.status_code == 201, answer.text
    return proposal


async def test_only_a_simulated_robot_and_an_ensemble_may_have_a_rule(live: Serving) -> None:
    body = {"name": "test", "task": "stacking", "adapter": "kinematic", "auto_approval": {}}
    for changes in (
        CONFIDENT | {"adapter": "benchtop"},
        CONFIDENT | {"settings": {"critics": 1}},
        {"algorithm": "scripted"},  # knows no critics
        {"preset": "paper_sim", "settings": {"critics": 1}},
    ):
        told = check_problem(await live.http.post("/api/v1/experiments", json=body | changes), 422)
        assert [field.field for field in told.fields] == ["auto_approval"], changes
    wrongs: tuple[dict[str, Any], ...] = (
        {"audit_every": 0},
        {"audit_every": 101},
        {"predicted_at_least": 1.5},
        {"uncertainty_at_most": -1},
        # no number is made of what is none
        {"predicted_at_least": True},
        {"predicted_at_least": "0.5"},
        {"uncertainty_at_most": "0.1"},
        {"agreement_at_least": True},
    )
    for wrong in wrongs:
        told = check_problem(await live.http.post("/api/v1/experiments", json=body | {"auto_approval": wrong}), 422)
        assert next(iter(wrong)) in told.fields[0].field

    made = await live.http.post("/api/v1/experiments", json=body | {"preset": "recommended"})
    assert made.json()["auto_approval"] == {
        "predicted_at_least": 0.9,
        "uncertainty_at_most": 0.1,
        "after_feedback": 50,
        "audit_every": 10,
        "agreement_at_least": 0.9,
    }
    address = f"/api/v1/experiments/{await live.experiment(adapter='benchtop', **CONFIDENT)}"
    assert (await live.http.get(address)).json()["auto_approval"] is None  # off unless asked for
    told = check_problem(await live.http.patch(address, json={"auto_approval": RULE}), 422)
    assert [field.field for field in told.fields] == ["auto_approval"]
    assert (await live.http.patch(address, json={"auto_approval": None})).status_code == 200
    address = f"/api/v1/experiments/{await live.experiment(**CONFIDENT)}"
    on = await live.http.patch(address, json={"auto_approval": {"audit_every": 5}})
    assert on.json()["auto_approval"]["audit_every"] == 5
    assert on.json()["auto_approval"]["after_feedback"] == 50
    assert (await live.http.patch(address, json={"name": "other"})).json()["auto_approval"] is not None
    assert (await live.http.patch(address, json={"auto_approval": None})).json()["auto_approval"] is None


async def test_the_critic_moves_a_simulated_robot_trains_nothing_and_is_checked(live: Serving) -> None:
    number = await live.experiment(**CONFIDENT, auto_approval=RULE)
    address = f"/api/v1/experiments/{number}"
    async with live.stream(number) as stream:
        await live.http.post(f"{address}/start")
        await asked(stream)
        first = await clicked(live, address, 1)  # below after_feedback a trainer is asked
        assert (first["audit"], first["uncertainty"]) == (False, 0.02)
        for _ in range(3):
            await asked(stream)
            assert (await clicked(live, address, 1))["audit"]
        await asked(stream)
        assert (await live.http.post(f"{address}/halt")).json()["halted"]
        await live.service.hub.idle(number)

        record = (await live.http.get(f"{address}/auto-approval")).json()
        assert (record["audited"], record["agreed"], record["suspended"]) == (3, 3, None)
        proposals = (await live.http.get(f"{address}/proposals", params={"limit": 200})).json()["items"]
        by_critic = {p["id"] for p in proposals if p["verdict_source"] == "critic"}
        # one of each three is audited: between two audits lie none to four
        assert record["approved"] == len(by_critic) >= 4
        executions = (await live.http.get(f"{address}/executions", params={"limit": 200})).json()["items"]
        approved = {p["id"]: (p["verdict"], p["parameters"]) for p in proposals}
        for execution in executions:
            assert approved[execution["proposal_id"]] == ("good", execution["parameters"])
        assert by_critic <= {execution["proposal_id"] for execution in executions}
        events = (await live.http.get(f"{address}/events", params={"limit": 200})).json()["items"]
        order = [(e["kind"], e["payload"]["proposal"]) for e in events if "proposal" in e["payload"]]
        for proposal in by_critic:  # stored before it moved
            assert order.index(("auto_approved", proposal)) < order.index(("execution_started", proposal))
        # the four clicks are all there is to learn from
        assert [label.value for label in await live.service.store.labels(number)] == [1, 1, 1, 1]
        counters = (await live.http.get(address)).json()["counters"]
        assert (counters["feedback"], counters["auto_approved"]) == (4, len(by_critic))
        assert (await live.http.get(f"{address}/calibration")).json()["labels"] == 4


async def test_a_critic_that_is_wrongly_sure_is_found_out(live: Serving) -> None:
    settings = {"settings": {"bad_first": 1_000_000}}
    number = await live.experiment(**CONFIDENT | settings, auto_approval=RULE)
    address = f"/api/v1/experiments/{number}"
    async with live.stream(number) as stream:
        await live.http.post(f"{address}/start")
        await asked(stream)
        await clicked(live, address, -1)
        await asked(stream)
        assert (await clicked(live, address, -1))["audit"]
        # from here on every proposal is asked about again, as if there were no rule
        for _ in range(4):
            await asked(stream)
            assert not (await clicked(live, address, -1))["audit"]
        told = (await live.http.get(f"{address}/auto-approval")).json()
        assert "0 of 1" in told["suspended"]
        assert (await live.http.get(address)).json()["auto_approval_suspended"] == told["suspended"]


async def test_a_real_robot_waits_for_a_person_even_with_a_rule_in_the_database(live: Serving) -> None:
    number = await live.experiment(adapter="benchtop", **CONFIDENT)
    address = f"/api/v1/experiments/{number}"
    # the API refuses it; but the adapter may have been a simulator when the rule was set
    rule = AutoApproval.model_validate(RULE)
    await live.service.store.update_experiment(number, ExperimentUpdate(auto_approval=rule))
    async with live.stream(number) as stream:
        await live.http.post(f"{address}/start")
        for _ in range(3):
            await asked(stream)
            proposal = await clicked(live, address, -1)
            assert (proposal["predicted_feedback"], proposal["audit"]) == (0.95, False)
    proposals = (await live.http.get(f"{address}/proposals")).json()["items"]
    assert "critic" not in {p["verdict_source"] for p in proposals}
    assert (await live.http.get(f"{address}/executions")).json()["items"] == []


async def test_an_unknown_experiment_has_no_trust(live: Serving) -> None:
    for what in ("calibration", "auto-approval"):
        check_problem(await live.http.get(f"/api/v1/experiments/999/{what}"), 404)
    number = await live.experiment()
    told = check_problem(await live.http.get(f"/api/v1/experiments/{number}/calibration", params={"newest": 1}), 422)
    assert told.fields[0].field.endswith("newest")
