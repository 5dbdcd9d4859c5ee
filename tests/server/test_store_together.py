"""Several trainers and several open proposals of one robot, in the store; on SQLite and PostgreSQL."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from server.models_quality import ReliabilityRow
from server.schemas import (
    Aggregation,
    CloseReason,
    ExecutionOutcome,
    ExperimentUpdate,
    FeedbackStatus,
    Proposal,
    Verdict,
)
from server.schemas_labels import RelabelCreate
from server.schemas_together import Looked, Together, TogetherUpdate
from server.store import Conflict, Store
from server.store_experiments import now
from tests.server.databases import begun, click, new, opened, running

THREE = ("ann", "bob", "cyd")


async def beside(store: Store, experiment_id: int, count: int = 3, observation: str = "o1") -> list[Proposal]:
    """So many open proposals of one robot for one view of the scene."""
    asked = (new(experiment_id, observation, x=0.5 + s / 10, slot=s, electorate=THREE) for s in range(count))
    return [await store.open_proposal(each) for each in asked]


async def voted(store: Store, proposal: Proposal, **votes: int) -> Any:
    submission = None
    for trainer, value in votes.items():
        submission = await store.submit_feedback(proposal.id, click(value, trainer=trainer))
    return submission


async def ended(store: Store, execution: Any) -> None:
    await store.end_execution(
        execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=1, task_success=False
    )


async def test_the_first_that_is_approved_closes_the_others_whose_votes_still_train(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    first, second, third = await beside(store, experiment_id)
    with pytest.raises(Conflict, match="is open"):
        await opened(store, experiment_id, slot=2)
    with pytest.raises(Conflict, match="another view"):
        await opened(store, experiment_id, "o2", slot=3)
    await voted(store, first, ann=-1)
    await voted(store, second, ann=1, bob=1)
    await voted(store, third, bob=1, cyd=1)  # approved as well, a moment later
    _, execution = await begun(store, second.id)
    closed, labels = await store.superseded_by(second.id)
    assert [(p.id, p.close_reason, p.superseded_by) for p in closed] == [
        (first.id, CloseReason.SUPERSEDED, second.id),
        (third.id, CloseReason.JUDGED, second.id),
    ]
    assert closed[1].gate is not None
    assert closed[1].gate.reason == "another proposal was approved first"
    assert [label.value for label in labels] == [-1]
    assert sorted(label.value for label in await store.labels(experiment_id)) == [-1, 1, 1, 1, 1]
    assert await store.open_proposals(experiment_id) == []
    late = await voted(store, first, bob=1)
    assert late.feedback.status is FeedbackStatus.LATE
    assert late.feedback.late_because == f"another proposal, number {second.number}, was approved first"
    # nothing of them ever moves the robot, not even from the same view
    await ended(store, execution)
    for other in (first, third):
        decision, none = await begun(store, other.id)
        assert not decision.allowed
        assert none is None
    assert (await store.experiment(experiment_id)).counters.executions == 1


async def test_who_looked_at_what_is_overtaken_may_finish_and_that_trains_and_moves_nothing(store: Store) -> None:
    experiment_id = await running(store, aggregation="first")
    first, second, third = await beside(store, experiment_id)
    await voted(store, second, ann=1)
    _, execution = await begun(store, second.id)
    looked = Looked(observation_id=first.observation_id, policy_version=first.policy_version)
    said = await store.submit_feedback(
        first.id, click(1, "click-of-bob", "bob").model_copy(update={"looked": looked}), had=True
    )
    assert (said.feedback.status, said.closed) == (FeedbackStatus.OVERTAKEN, None)
    assert said.feedback.late_because == f"another proposal, number {second.number}, was approved first"
    assert [(label.feedback_id, label.value) for label in said.labels] == [(said.feedback.id, 1)]
    # the same click again is the same answer, another one is late, and so is whoever didn't look
    again = await store.submit_feedback(
        first.id, click(1, "click-of-bob", "bob").model_copy(update={"looked": looked}), had=True
    )
    assert (again.duplicate, again.feedback) == (True, said.feedback)
    stale = Looked(observation_id="o0", policy_version=first.policy_version)
    for late, trainer, seen, had in (
        (first, "bob", looked, True),
        (third, "cyd", None, False),
        (third, "cyd", stale, True),
    ):
        kept = await store.submit_feedback(
            late.id, click(1, trainer=trainer).model_copy(update={"looked": seen}), had=had
        )
        assert kept.feedback.status is FeedbackStatus.LATE
    counters = (await store.experiment(experiment_id)).counters
    assert (counters.feedback, counters.good, counters.late, counters.executions) == (2, 2, 3, 1)
    proposal = await store.proposal(first.id)
    assert (proposal.verdict, proposal.heard, proposal.close_reason) == (None, [], CloseReason.SUPERSEDED)
    await ended(store, execution)
    for other in (first, third):
        assert (await begun(store, other.id))[1] is None
    # it is corrected and taken back as any label; the proposal stays closed
    corrected = await store.relabel(
        said.feedback.id, RelabelCreate(click_id="correction-1", value=-1, trainer="bob"), anybodys=False
    )
    assert corrected.label is not None
    assert [label.value for label in await store.labels(experiment_id)] == [1, -1]
    undone = await store.undo_feedback(said.feedback.id, by="bob")
    assert (undone.reopened.closed_at is not None, undone.withdrawn) == (True, None)
    assert [label.value for label in await store.labels(experiment_id)] == [1]
    assert (await store.experiment(experiment_id)).counters.feedback == 1
    # a stop ends it
    await store.halt(experiment_id)
    kept = await store.submit_feedback(third.id, click(1, trainer="cyd"), had=True)
    assert kept.feedback.status is FeedbackStatus.LATE


async def test_two_approvals_race_to_the_gate_and_one_moves(store: Store) -> None:
    experiment_id = await running(store)
    for number in range(6):
        first, second = await beside(store, experiment_id, 2, f"o{number}")
        await asyncio.gather(voted(store, first, ann=1), voted(store, second, bob=1))
        asked = [begun(store, p.id, f"o{number}") for p in ((first, second), (second, first))[number % 2]]
        answers = await asyncio.gather(*asked, return_exceptions=True)
        moved = [a[1] for a in answers if not isinstance(a, BaseException) and a[1] is not None]
        assert len(moved) == 1
        assert len(await store.running_executions(experiment_id)) == 1
        await ended(store, moved[0])
    assert (await store.experiment(experiment_id)).counters.executions == 6


async def test_an_undo_and_anothers_approval_race_and_one_wins(store: Store) -> None:
    """Of two, ann takes hers back just as bob completes the majority: closed with both votes, or open with his."""
    experiment_id = await running(store, aggregation="majority")
    outcomes = set()
    for number in range(10):
        proposal = await opened(store, experiment_id, f"o{number}", electorate=("ann", "bob"))
        hers = (await voted(store, proposal, ann=1)).feedback
        his = store.submit_feedback(proposal.id, click(1, trainer="bob"))
        back = store.undo_feedback(hers.id, by="ann")
        if number % 2:
            clicked, undone = await asyncio.gather(his, back)
        else:
            undone, clicked = await asyncio.gather(back, his)
        # whichever was first, both succeed: nothing has moved
        assert undone.feedback.undone_at is not None
        now_ = await store.proposal(proposal.id)
        outcomes.add(clicked.closed is not None)
        assert (now_.closed_at, now_.verdict, now_.heard) == (None, None, ["bob"])
        decision, execution = await begun(store, proposal.id, f"o{number}")
        assert (decision.allowed, execution) == (False, None)
        await store.close_proposal(proposal.id, CloseReason.WITHDRAWN)
    assert outcomes == {True, False}


async def test_each_takes_back_the_own_newest_click_and_nobody_elses(store: Store) -> None:
    experiment_id = await running(store)
    first, second = await beside(store, experiment_id, 2)
    hers = (await voted(store, first, ann=-1)).feedback
    his = (await voted(store, second, bob=-1)).feedback
    assert (await store.undoable(experiment_id, "ann"), await store.undoable(experiment_id, "bob")) == (hers, his)
    with pytest.raises(Conflict, match="somebody else's, not bob's"):
        await store.undo_feedback(hers.id, by="bob")
    # what came into its slot meanwhile is another's: it stays, and this one opens beside it
    (third,) = await beside(store, experiment_id, 1)
    undone = await store.undo_feedback(hers.id, by="ann", keep=[third.id])
    assert (undone.withdrawn, undone.reopened.id, undone.reopened.slot) == (None, first.id, 1)
    assert await store.undoable(experiment_id, "ann") is None
    assert [p.id for p in await store.open_proposals(experiment_id)] == [first.id, third.id]
    # nor does an undo withdraw what another undo has brought back
    assert (await store.undo_feedback(his.id)).withdrawn is None
    found = {p.slot: p.id for p in await store.open_proposals(experiment_id)}
    assert found == {0: third.id, 1: first.id, 2: second.id}


async def test_who_was_outvoted_takes_it_back_and_the_verdict_stays(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    proposal = await opened(store, experiment_id, electorate=THREE)
    await voted(store, proposal, ann=-1, bob=1, cyd=1)
    (bad,) = [f for f in (await store.feedback_of_proposal(proposal.id)).items if f.value == -1]
    undone = await store.undo_feedback(bad.id)
    assert (undone.reopened.verdict, undone.reopened.closed_at is not None) == (Verdict.GOOD, True)
    assert [label.value for label in await store.labels(experiment_id)] == [1, 1]
    assert (await begun(store, proposal.id))[1] is not None


async def test_a_vanished_trainer_is_not_waited_for(store: Store) -> None:
    experiment_id = await running(store, aggregation="unanimous")
    first, second = await beside(store, experiment_id, 2)
    await voted(store, first, ann=1, bob=1)
    concluded = await store.leave_electorates(experiment_id, ["cyd"])
    assert [(c.proposal.id, c.proposal.verdict, [label.value for label in c.labels]) for c in concluded] == [
        (first.id, Verdict.GOOD, [1, 1]),
        (second.id, None, []),
    ]
    assert concluded[1].proposal.electorate == ["ann", "bob"]
    # a vote that was cast stays; where nobody is left it waits, and whoever comes is asked
    await voted(store, second, ann=1)
    (left,) = await store.leave_electorates(experiment_id, ["ann", "bob"])
    assert (left.proposal.electorate, left.proposal.verdict) == (["ann"], Verdict.GOOD)
    third = await opened(store, experiment_id, electorate=("ann",))
    (left,) = await store.leave_electorates(experiment_id, ["ann"])
    assert (left.proposal.electorate, left.proposal.closed_at) == ([], None)
    (entered,) = await store.enter_electorates(experiment_id, ["bob", "cyd"])
    assert entered.proposal.electorate == ["bob", "cyd"]
    assert await store.enter_electorates(experiment_id, ["ann"]) == []
    assert (await voted(store, third, bob=-1)).closed.verdict is Verdict.BAD


async def test_fewer_than_the_least_move_nothing_however_many_have_vanished(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority", together=Together(least=2))
    proposal = await opened(store, experiment_id, electorate=(*THREE, "dan", "eve"))
    await voted(store, proposal, ann=1)
    (left,) = await store.leave_electorates(experiment_id, ["bob", "cyd", "dan", "eve"])
    assert (left.proposal.electorate, left.proposal.closed_at) == (["ann"], None)
    # whoever has come since is asked too
    (entered,) = await store.enter_electorates(experiment_id, ["ann", "fay"])
    assert entered.proposal.electorate == ["ann", "fay"]
    assert await store.enter_electorates(experiment_id, ["ann", "fay", "gil"]) == []
    assert (await voted(store, proposal, fay=1)).closed.verdict is Verdict.GOOD
    # more are needed by now: the gate counts once more
    await store.update_and_conclude(experiment_id, ExperimentUpdate(together=TogetherUpdate(least=3)))
    decision, none = await begun(store, proposal.id)
    assert (none, decision.reason) == (None, "its votes don't approve it by the rule of now")


async def test_an_absent_veto_and_the_first_who_comes_are_not_enough_where_more_are_needed(store: Store) -> None:
    experiment_id = await running(store, aggregation="unanimous", together=Together(least=3))
    first, second = await beside(store, experiment_id, 2)
    await voted(store, first, ann=1, bob=1)
    await voted(store, second, bob=1)
    concluded = await store.leave_electorates(experiment_id, ["cyd"])
    assert [c.proposal.closed_at for c in concluded] == [None, None]
    _, concluded = await store.update_and_conclude(experiment_id, ExperimentUpdate(together=TogetherUpdate(least=2)))
    assert [(c.proposal.id, c.proposal.verdict) for c in concluded] == [(first.id, Verdict.GOOD)]
    await store.leave_electorates(experiment_id, ["ann"])
    assert (await voted(store, second, dan=1)).closed.verdict is Verdict.GOOD
    third = await opened(store, experiment_id, slot=2, electorate=())
    assert (await voted(store, third, eve=1)).closed is None
    assert (await voted(store, third, fay=-1)).closed.verdict is Verdict.BAD


async def test_a_new_rule_holds_for_what_is_open_and_for_nothing_that_is_closed(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    first, second, third = await beside(store, experiment_id)
    await voted(store, first, ann=1, bob=-1, cyd=0)
    assert ((await store.proposal(first.id)).verdict, (await store.proposal(first.id)).rule) == ("neutral", "majority")
    await voted(store, second, ann=-1)
    await voted(store, third, ann=1)
    _, concluded = await store.update_and_conclude(experiment_id, ExperimentUpdate(aggregation=Aggregation.UNANIMOUS))
    assert [(c.proposal.id, c.proposal.verdict, c.proposal.rule) for c in concluded] == [
        (second.id, Verdict.BAD, Aggregation.UNANIMOUS)
    ]
    _, concluded = await store.update_and_conclude(experiment_id, ExperimentUpdate(aggregation=Aggregation.FIRST))
    assert [(c.proposal.id, c.proposal.verdict) for c in concluded] == [(third.id, Verdict.GOOD)]
    assert [label.value for label in concluded[0].labels] == [1]
    assert (await store.proposal(first.id)).verdict is Verdict.NEUTRAL
    assert (await store.update_and_conclude(experiment_id, ExperimentUpdate(name="again")))[1] == []


async def test_reliability_alone_approves_only_where_the_setting_says_so(store: Store) -> None:
    experiment_id = await running(store, aggregation="weighted")
    proposal = await opened(store, experiment_id, electorate=THREE)
    await voted(store, proposal, ann=1)
    (ann,) = (await store.trainers()).items
    row = ReliabilityRow(
        experiment_id=experiment_id, trainer_id=ann.id, weight=0.95, labels=40, informative=40, at=now()
    )
    await store._database.write(lambda session: session.add(row))
    assert (await voted(store, proposal, bob=-1)).closed is None
    alone = ExperimentUpdate(together=TogetherUpdate(weighted_approves=True))
    experiment, concluded = await store.update_and_conclude(experiment_id, alone)
    assert (experiment.together.weighted_approves, experiment.together.lease_seconds) == (True, 60.0)
    assert [(c.proposal.verdict, c.proposal.rule) for c in concluded] == [(Verdict.GOOD, Aggregation.WEIGHTED)]


@pytest.mark.parametrize(("observation", "version"), [("o0", 7), ("o1", 6)])
async def test_a_click_on_what_isnt_shown_any_more_is_kept_and_decides_nothing(
    store: Store, observation: str, version: int
) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    looked = Looked(observation_id=observation, policy_version=version)
    stale = await store.submit_feedback(proposal.id, click(1).model_copy(update={"looked": looked}))
    assert (stale.feedback.status, stale.closed) == (FeedbackStatus.LATE, None)
    assert stale.feedback.late_because is not None
    assert await store.open_proposals(experiment_id) == [proposal]
    fresh = Looked(observation_id="o1", policy_version=7)
    assert (await store.submit_feedback(proposal.id, click(1).model_copy(update={"looked": fresh}))).closed is not None
