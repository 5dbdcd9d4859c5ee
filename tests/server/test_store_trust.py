"""Calibration and the critic's own approvals as the database has them, on SQLite and PostgreSQL."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from server.auto_approval import Decision
from server.schemas import CloseReason, ExperimentUpdate, Mode, Proposal, Verdict
from server.schemas_trust import AutoApproval, VerdictSource
from server.store import NotFound, Store
from tests.server.databases import begun, click, created, opened, running

SURE = {"predicted_feedback": 0.95, "uncertainty": 0.02}
NEVER_AUDITED = {"audit_every": 100, "after_feedback": 1}
ALWAYS_AUDITED = {"audit_every": 1, "after_feedback": 1}

_x = itertools.count(1)


async def judged(store: Store, experiment_id: int, predicted: float, value: int, **fields: Any) -> Proposal:
    """A proposal of which so much was predicted, and a trainer said `value`."""
    known = {"x": next(_x) / 10_000, "predicted_feedback": predicted} | fields
    proposal = await opened(store, experiment_id, **known)
    await store.submit_feedback(proposal.id, click(value))
    return proposal


async def sure(store: Store, experiment_id: int, observation: str = "o1") -> Proposal:
    """An open proposal of a critic that is sure."""
    return await opened(store, experiment_id, observation, x=next(_x) / 10_000, **SURE)


async def ruled(store: Store, gold_rate: float = 0.0, **rule: Any) -> int:
    """A running experiment with a rule and one feedback."""
    experiment_id = await running(store, auto_approval=rule, seed=1, gold_rate=gold_rate)
    await judged(store, experiment_id, 0.0, 1)
    return experiment_id


async def journal(store: Store, experiment_id: int, kind: str) -> list[dict[str, Any]]:
    """Payloads of all events of a kind."""
    events = (await store.events(experiment_id, limit=200)).items
    return [event.payload for event in events if event.kind == kind]


# --- calibration ----------------------------------------------------------------------------------------------------


async def test_calibration_is_of_what_was_predicted_then_and_said_first(store: Store) -> None:
    experiment_id = await running(store)
    for predicted, value in ((0.9, 1), (0.9, 1), (0.9, -1), (0.1, 0)):
        await judged(store, experiment_id, predicted, value)
    # the critic has learned from the answer by now: asked again of the same, it proves nothing
    first = await judged(store, experiment_id, -0.5, -1, x=0.7)
    again = await judged(store, experiment_id, -1.0, -1, x=0.7)
    assert first.digest == again.digest
    # undone, late, timed out and still open: nothing was said
    await opened(store, experiment_id, x=0.8, predicted_feedback=0.0)
    undone = (await store.submit_feedback((await store.proposals(experiment_id)).items[0].id, click(-1))).feedback
    await store.undo_feedback(undone.id)
    await store.close_proposal(undone.proposal_id, CloseReason.TIMED_OUT)
    await store.submit_feedback(undone.proposal_id, click(1))
    await judged(store, await running(store), 0.3, 1)  # another experiment's

    told = await store.calibration(experiment_id, newest=200)
    assert [b.count for b in told.bins] == [1, 1, 3]
    assert [b.predicted for b in told.bins] == pytest.approx([-0.5, 0.1, 0.9])
    assert [b.label for b in told.bins] == pytest.approx([-1.0, 0.0, 1 / 3])
    assert (told.labels, told.needed, told.error) == (5, 20, None)  # too few to claim an error
    assert [b.count for b in (await store.calibration(experiment_id, newest=2)).bins] == [1, 1]

    for _ in range(15):
        await judged(store, experiment_id, 0.9, 1)
    told = await store.calibration(experiment_id, newest=200)
    # 18 at 0.9 with mean label 16/18, one at 0.1 and 0, one at -0.5 and -1
    assert told.labels == 20
    assert told.error == pytest.approx((18 * (0.9 - 16 / 18) + 0.1 + 0.5) / 20)


async def test_nothing_is_told_of_an_experiment_that_is_not_there(store: Store) -> None:
    for asked in (store.calibration(999, 200), store.auto_approvals(999)):
        with pytest.raises(NotFound):
            await asked
    empty = await store.calibration((await created(store)).id, 200)
    assert (empty.labels, empty.bins, empty.error) == (0, [], None)


# --- auto-approval --------------------------------------------------------------------------------------------------


async def test_an_approval_is_a_stored_verdict_of_the_critic_and_no_feedback(store: Store) -> None:
    experiment_id = await ruled(store, **NEVER_AUDITED)
    proposal = await sure(store, experiment_id)
    considered = await store.consider(proposal.id, simulated=True)
    assert considered.decision is Decision.APPROVE
    stored = await store.proposal(proposal.id)
    assert stored == considered.proposal
    assert (stored.verdict, stored.verdict_source, stored.close_reason) == (
        Verdict.GOOD,
        VerdictSource.CRITIC,
        CloseReason.JUDGED,
    )
    assert (await store.feedback_of_proposal(proposal.id)).items == []
    assert len(await store.labels(experiment_id)) == 1
    counters = (await store.experiment(experiment_id)).counters
    assert (counters.auto_approved, counters.feedback, counters.good) == (0, 1, 1)  # nothing has come of it yet
    (event,) = await journal(store, experiment_id, "auto_approved")
    assert event["proposal"] == proposal.id
    assert event["digest"] == proposal.digest
    assert (event["predicted_feedback"], event["uncertainty"]) == (0.95, 0.02)
    assert event["rule"]["predicted_at_least"] == 0.9
    # it is the critic's, so it says nothing of how well the critic is calibrated
    assert (await store.calibration(experiment_id, 200)).labels == 1
    # and it is approved once
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.ASK
    decision, execution = await begun(store, proposal.id)
    assert decision.allowed
    assert execution.parameters == proposal.parameters
    assert (await store.experiment(experiment_id)).counters.auto_approved == 1
    assert (await store.auto_approvals(experiment_id)).approved == 1
    # asked again, nothing more moves and nothing more is counted
    assert (await begun(store, proposal.id))[1] is None
    assert (await store.experiment(experiment_id)).counters.auto_approved == 1


async def test_the_gate_shuts_the_critic_out_on_a_real_robot_and_without_the_rule_it_approved_by(store: Store) -> None:
    cases: tuple[tuple[dict[str, Any], ExperimentUpdate | None], ...] = (
        ({"simulated": False, "operator_present": True}, None),
        ({}, ExperimentUpdate.model_validate({"auto_approval": None})),
        # stricter by now: what met the old rule is no approval by this one
        ({}, ExperimentUpdate.model_validate({"auto_approval": NEVER_AUDITED | {"predicted_at_least": 1.0}})),
    )
    for fields, change in cases:
        experiment_id = await ruled(store, **NEVER_AUDITED)
        proposal = await sure(store, experiment_id)
        assert (await store.consider(proposal.id, simulated=True)).decision is Decision.APPROVE
        if change is not None:
            await store.update_experiment(experiment_id, change)
        decision, execution = await begun(store, proposal.id, **fields)
        assert not decision.allowed
        assert "critic" in decision.reason
        assert execution is None
        assert (await store.auto_approvals(experiment_id)).approved == 0  # nothing has moved by it


async def test_the_gate_shuts_the_critic_out_once_its_rule_is_suspended(store: Store) -> None:
    experiment_id = await ruled(store, **NEVER_AUDITED | {"audit_every": 2})
    approved: list[Proposal] = []
    audited = 0
    # the first robot's approval waits for the gate, while audits at the second one go against the critic
    while not approved or not audited:
        proposal = await sure(store, experiment_id)
        decision = (await store.consider(proposal.id, simulated=True)).decision
        assert decision is not Decision.ASK
        if decision is Decision.APPROVE:
            approved.append(proposal)
        else:
            audited += 1
            await store.submit_feedback(proposal.id, click(-1))
    following = await sure(store, experiment_id)
    considered = await store.consider(following.id, simulated=True)
    assert considered.suspended
    decision, execution = await begun(store, approved[-1].id)
    assert (decision.allowed, execution) == (False, None)
    assert "critic" in decision.reason
    assert (await store.auto_approvals(experiment_id)).approved == 0


async def test_a_rule_covers_the_proposals_that_open_once_it_is_set(store: Store) -> None:
    experiment_id = await ruled(store, **NEVER_AUDITED)
    waiting = await sure(store, experiment_id)
    await store.update_experiment(experiment_id, ExperimentUpdate(auto_approval=AutoApproval(**NEVER_AUDITED)))
    assert (await store.consider(waiting.id, simulated=True)).decision is Decision.ASK
    await store.submit_feedback(waiting.id, click(1))
    proposal = await sure(store, experiment_id)
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.APPROVE


async def test_who_is_not_asked_for_approves_nothing(store: Store) -> None:
    silent = await running(store)
    proposal = await sure(store, silent)
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.ASK
    for changes, simulated in (({}, False), ({"mode": Mode.PROPOSE_ONLY}, True)):
        experiment_id = await ruled(store, **NEVER_AUDITED)
        if changes:
            await store.update_experiment(experiment_id, ExperimentUpdate.model_validate(changes))
        proposal = await sure(store, experiment_id)
        considered = await store.consider(proposal.id, simulated=simulated)
        assert considered.decision is Decision.ASK
        assert considered.proposal == await store.proposal(proposal.id) == proposal
    # neither while the emergency stop is latched
    experiment_id = await ruled(store, **NEVER_AUDITED)
    proposal = await sure(store, experiment_id)
    await store.halt(experiment_id)
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.ASK


async def test_what_a_trainer_took_back_stays_the_trainers(store: Store) -> None:
    experiment_id = await ruled(store, **NEVER_AUDITED)
    proposal = await sure(store, experiment_id)
    clicked = (await store.submit_feedback(proposal.id, click(-1))).feedback
    assert (await store.proposal(proposal.id)).verdict_source is VerdictSource.TRAINERS
    reopened = (await store.undo_feedback(clicked.id)).reopened
    assert reopened.verdict_source is None
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.ASK
    assert (await store.proposal(proposal.id)).verdict is None


async def test_an_audited_proposal_waits_for_a_trainer_and_is_counted_once_judged(store: Store) -> None:
    experiment_id = await ruled(store, **ALWAYS_AUDITED)
    for value in (1, 1, -1):
        proposal = await sure(store, experiment_id)
        assert (await store.consider(proposal.id, simulated=True)).decision is Decision.AUDIT
        assert (await store.consider(proposal.id, simulated=True)).decision is Decision.ASK
        waiting = await store.proposal(proposal.id)
        assert (waiting.audit, waiting.verdict) == (True, None)
        await store.submit_feedback(proposal.id, click(value))
    record = await store.auto_approvals(experiment_id)
    assert (record.approved, record.audited, record.agreed) == (0, 3, 2)
    assert record.agreement == pytest.approx(2 / 3)
    assert record.interval == pytest.approx((0.2077, 0.9385), abs=1e-4)
    assert len(await journal(store, experiment_id, "auto_approval_audit")) == 3


async def test_a_known_answer_looks_like_an_audit_where_the_critic_is_sure_and_counts_as_none(store: Store) -> None:
    experiment_id = await ruled(store, **NEVER_AUDITED, gold_rate=0.5)
    looks = []
    for number in range(12):
        fields = {"x": next(_x) / 10_000, "rule_answer": -1, **SURE}
        proposal = await opened(store, experiment_id, f"g{number}", **fields)
        looks.append((await store.consider(proposal.id, simulated=True)).proposal.audit)
        if looks[-1]:  # the critic has approved the others
            await store.submit_feedback(proposal.id, click(-1))
    gold = {each.number for each in (await store.quality.gold(experiment_id, None, 50)).items}
    assert looks == [number + 2 in gold for number in range(12)]
    assert len(gold) >= 3
    record = await store.auto_approvals(experiment_id)
    assert (record.audited, record.agreed, record.suspended) == (0, 0, None)


async def test_it_suspends_itself_where_trainers_disagree_until_it_is_set_anew(store: Store) -> None:
    experiment_id = await ruled(store, **ALWAYS_AUDITED)
    for number, value in enumerate((1, -1, 0)):
        audited = await sure(store, experiment_id, f"a{number}")
        considered = await store.consider(audited.id, simulated=True)
        assert (considered.decision, considered.suspended) == (Decision.AUDIT, False)
        await store.submit_feedback(audited.id, click(value))
    following = await sure(store, experiment_id)
    considered = await store.consider(following.id, simulated=True)  # 1 of 3: at most 0.79
    assert (considered.decision, considered.suspended) == (Decision.ASK, True)
    why = (await store.experiment(experiment_id)).auto_approval_suspended
    assert why is not None
    assert "1 of 3" in why
    assert (await store.auto_approvals(experiment_id)).suspended == why
    (event,) = await journal(store, experiment_id, "auto_approval_suspended")
    assert (event["audited"], event["agreed"]) == (3, 1)
    # it stays so, and is told once
    assert not (await store.consider(following.id, simulated=True)).suspended
    await store.submit_feedback(following.id, click(1))

    rule = AutoApproval(**NEVER_AUDITED)
    anew = await store.update_experiment(experiment_id, ExperimentUpdate(auto_approval=rule))
    assert (anew.auto_approval, anew.auto_approval_suspended) == (rule, None)
    record = await store.auto_approvals(experiment_id)
    assert (record.audited, record.agreement, record.interval) == (0, None, (0.0, 1.0))
    proposal = await sure(store, experiment_id)
    assert (await store.consider(proposal.id, simulated=True)).decision is Decision.APPROVE
