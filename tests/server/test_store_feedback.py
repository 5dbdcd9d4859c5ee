"""Clicks and undo, on SQLite and PostgreSQL: nothing lost, doubled, or attached to another proposal."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from server.schemas import CloseReason, ExecutionOutcome, FeedbackStatus, Verdict
from server.store import Conflict, Store
from tests.server.databases import begun, click, new, opened, running


async def _counted(store: Store, experiment_id: int) -> dict[str, int]:
    counters = (await store.experiment(experiment_id)).counters
    return counters.model_dump(include={"feedback", "good", "neutral", "bad", "late"})


async def test_a_click_closes_its_proposal_with_a_verdict(store: Store) -> None:
    experiment_id = await running(store)
    for number, (value, verdict) in enumerate(((1, Verdict.GOOD), (0, Verdict.NEUTRAL), (-1, Verdict.BAD))):
        proposal = await opened(store, experiment_id, f"o{number}")
        submission = await store.submit_feedback(proposal.id, click(value))
        assert (submission.feedback.status, submission.duplicate) == (FeedbackStatus.STORED, False)
        assert submission.closed is not None
        assert (submission.closed.verdict, submission.closed.close_reason) == (verdict, CloseReason.JUDGED)
        assert await store.proposal(proposal.id) == submission.closed
        assert await store.feedback(submission.feedback.id) == submission.feedback
    assert await _counted(store, experiment_id) == {"feedback": 3, "good": 1, "neutral": 1, "bad": 1, "late": 0}


async def test_what_was_drawn_beside_a_proposal_follows_only_a_verdict_by_which_nothing_moves(store: Store) -> None:
    experiment_id = await running(store)
    first = await opened(store, experiment_id)
    drawn = new(experiment_id)
    with pytest.raises(Conflict, match="not judged"):
        await store.open_proposal(drawn, after=first.id)
    await store.submit_feedback(first.id, click(-1))
    second = await store.open_proposal(drawn, after=first.id)
    await store.submit_feedback(second.id, click(1))
    with pytest.raises(Conflict, match="not judged"):
        await store.open_proposal(drawn, after=second.id)
    # a reset overtakes the click: the scene is another one, and so is the episode
    third = await opened(store, experiment_id)
    await store.transition(experiment_id, "reset")
    late, following = await asyncio.gather(
        store.submit_feedback(third.id, click(-1)), store.open_proposal(drawn, after=third.id), return_exceptions=True
    )
    assert not isinstance(late, BaseException)
    assert late.feedback.status is FeedbackStatus.LATE
    assert isinstance(following, Conflict)
    await store.begin_episode(experiment_id, 2)
    with pytest.raises(Conflict, match="episode"):
        await store.open_proposal(drawn, after=first.id)
    assert await store.open_proposals(experiment_id) == []


async def test_a_persons_clicks_are_found_although_a_teacher_has_the_same_name(store: Store) -> None:
    experiment_id = await running(store)
    for kind in ("person", "teacher"):
        proposal = await opened(store, experiment_id, kind)
        await store.submit_feedback(proposal.id, click(-1, trainer="anna"), kind=kind)
    found = await store.feedback_of_experiment(experiment_id, trainer="anna", told_to="anna")
    assert [each.trainer for each in found.items] == ["anna", "anna"]


async def test_the_same_click_again_is_stored_once(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    first = await store.submit_feedback(proposal.id, click(-1, "one-click"))
    again = await store.submit_feedback(proposal.id, click(-1, "one-click"))
    assert (again.feedback, again.duplicate, again.closed) == (first.feedback, True, None)
    other = await opened(store, experiment_id)
    for proposal_id, asked in (
        (other.id, click(-1, "one-click")),
        (proposal.id, click(1, "one-click")),
        (proposal.id, click(-1, "one-click", "ann")),
    ):
        with pytest.raises(Conflict, match="another content"):
            await store.submit_feedback(proposal_id, asked)
    assert (await store.feedback_of_proposal(proposal.id)).items == [first.feedback]
    assert (await store.feedback_of_proposal(other.id)).items == []


async def test_the_same_click_many_times_at_once_is_stored_once(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    answers = await asyncio.gather(*[store.submit_feedback(proposal.id, click(1, "one-click")) for _ in range(30)])
    assert sum(not answer.duplicate for answer in answers) == 1
    assert len({answer.feedback.id for answer in answers}) == 1
    assert (await _counted(store, experiment_id))["feedback"] == 1


async def test_one_of_many_clicks_at_once_decides(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    answers = await asyncio.gather(
        *[store.submit_feedback(proposal.id, click(1 if n % 2 else -1, trainer=f"trainer-{n}")) for n in range(30)]
    )
    assert sum(answer.closed is not None for answer in answers) == 1
    assert sum(answer.feedback.status is FeedbackStatus.LATE for answer in answers) == 29
    assert len((await store.feedback_of_experiment(experiment_id, limit=100)).items) == 30
    assert len(await store.labels(experiment_id)) == 1


async def test_a_late_click_is_kept_and_decides_nothing(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    closed = await store.close_proposal(proposal.id, CloseReason.TIMED_OUT)
    submission = await store.submit_feedback(proposal.id, click(1))
    assert (submission.feedback.status, submission.closed) == (FeedbackStatus.LATE, None)
    assert await store.proposal(proposal.id) == closed
    assert await _counted(store, experiment_id) == {"feedback": 0, "good": 0, "neutral": 0, "bad": 0, "late": 1}
    with pytest.raises(Conflict, match="late"):
        await store.undo_feedback(submission.feedback.id)


async def test_a_majority_of_those_who_were_there_decides(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    proposal = await opened(store, experiment_id, electorate=("ann", "bob", "cyd"))
    assert (await store.submit_feedback(proposal.id, click(1, trainer="ann"))).closed is None
    with pytest.raises(Conflict, match="has judged"):
        await store.submit_feedback(proposal.id, click(1, trainer="ann"))
    with pytest.raises(Conflict, match="not there"):
        await store.submit_feedback(proposal.id, click(1, trainer="eve"))
    assert (await store.submit_feedback(proposal.id, click(-1, trainer="bob"))).closed is None
    closed = (await store.submit_feedback(proposal.id, click(1, trainer="cyd"))).closed
    assert closed is not None
    assert closed.verdict is Verdict.GOOD
    assert [label.value for label in await store.labels(experiment_id)] == [1, -1, 1]


async def test_a_vote_is_taken_back_before_the_verdict(store: Store) -> None:
    experiment_id = await running(store, aggregation="unanimous")
    proposal = await opened(store, experiment_id, electorate=("ann", "bob"))
    vote = (await store.submit_feedback(proposal.id, click(1, trainer="ann"))).feedback
    undone = await store.undo_feedback(vote.id)
    assert (undone.reopened, undone.withdrawn) == (proposal, None)
    assert (await store.submit_feedback(proposal.id, click(1, trainer="bob"))).closed is None
    closed = (await store.submit_feedback(proposal.id, click(-1, trainer="ann"))).closed
    assert closed is not None
    assert closed.verdict is Verdict.BAD


async def test_undo_reopens_the_judged_proposal_and_withdraws_the_next(store: Store) -> None:
    experiment_id = await running(store)
    judged = await opened(store, experiment_id)
    feedback = (await store.submit_feedback(judged.id, click(-1))).feedback
    following = await opened(store, experiment_id, x=0.6)
    assert await store.undoable(experiment_id) == feedback
    undone = await store.undo_feedback(feedback.id)
    assert undone.feedback.undone_at is not None
    assert undone.reopened == judged
    assert undone.withdrawn is not None
    assert (undone.withdrawn.id, undone.withdrawn.close_reason) == (following.id, CloseReason.WITHDRAWN)
    assert await store.open_proposals(experiment_id) == [judged]
    assert await store.undoable(experiment_id) is None
    assert await store.labels(experiment_id) == []
    assert set((await _counted(store, experiment_id)).values()) == {0}
    with pytest.raises(Conflict, match="undone already"):
        await store.undo_feedback(feedback.id)
    again = await store.submit_feedback(judged.id, click(1))
    assert again.closed is not None
    assert again.closed.verdict is Verdict.GOOD
    assert [label.feedback_id for label in await store.labels(experiment_id)] == [again.feedback.id]
    assert len((await store.feedback_of_proposal(judged.id)).items) == 2  # the undone row is kept
    assert "undone" in [event.kind for event in (await store.events(experiment_id)).items]


async def test_a_retry_of_an_undone_click_does_not_bring_it_back(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    feedback = (await store.submit_feedback(proposal.id, click(1, "one-click"))).feedback
    await store.undo_feedback(feedback.id)
    again = await store.submit_feedback(proposal.id, click(1, "one-click"))
    assert again.duplicate
    assert again.feedback.undone_at is not None
    assert await store.open_proposals(experiment_id) == [proposal]


async def test_undo_goes_back_over_a_time_out_but_not_over_a_motion_or_a_new_look(store: Store) -> None:
    experiment_id = await running(store)
    first = await opened(store, experiment_id)
    feedback = (await store.submit_feedback(first.id, click(-1))).feedback
    await store.close_proposal((await opened(store, experiment_id)).id, CloseReason.TIMED_OUT)
    assert (await store.undo_feedback(feedback.id)).withdrawn is None

    newer = (await store.submit_feedback(first.id, click(-1))).feedback
    second = await opened(store, experiment_id)
    approved = (await store.submit_feedback(second.id, click(1))).feedback
    with pytest.raises(Conflict, match="newest"):
        await store.undo_feedback(newer.id)
    execution = (await begun(store, second.id))[1]
    with pytest.raises(Conflict, match="moved"):
        await store.undo_feedback(approved.id)
    assert await store.undoable(experiment_id) is None
    await store.end_execution(
        execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=3, task_success=False
    )
    with pytest.raises(Conflict, match="moved"):
        await store.undo_feedback(approved.id)

    third = await opened(store, experiment_id, "o2")
    last = (await store.submit_feedback(third.id, click(0))).feedback
    await opened(store, experiment_id, "o3")
    with pytest.raises(Conflict, match="observed anew"):
        await store.undo_feedback(last.id)


async def test_no_undo_while_the_experiment_rests_or_in_another_episode(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    feedback = (await store.submit_feedback(proposal.id, click(-1))).feedback
    await store.halt(experiment_id)
    with pytest.raises(Conflict, match="halted"):
        await store.undo_feedback(feedback.id)
    await store.rearm(experiment_id)
    with pytest.raises(Conflict, match="paused"):
        await store.undo_feedback(feedback.id)
    await store.transition(experiment_id, "resume")
    assert await store.undoable(experiment_id) == feedback
    await store.begin_episode(experiment_id, 2)
    with pytest.raises(Conflict, match="episode"):
        await store.undo_feedback(feedback.id)


async def test_undo_and_execution_race_and_exactly_one_wins(store: Store) -> None:
    experiment_id = await running(store)
    winners = set()
    for number in range(12):
        observation = f"o{number}"
        proposal = await opened(store, experiment_id, observation)
        feedback = (await store.submit_feedback(proposal.id, click(1))).feedback
        executing = begun(store, proposal.id, observation)
        undoing = store.undo_feedback(feedback.id)
        started: Any
        undone: Any
        if number % 2:
            started, undone = await asyncio.gather(executing, undoing, return_exceptions=True)
        else:
            undone, started = await asyncio.gather(undoing, executing, return_exceptions=True)
        decision, execution = started
        if isinstance(undone, Conflict):
            winners.add("execution")
            assert decision.allowed
            await store.end_execution(
                execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=1, task_success=False
            )
        else:
            winners.add("undo")
            assert (decision.allowed, execution) == (False, None)
            assert await store.open_proposals(experiment_id) == [proposal]
            await store.close_proposal(proposal.id, CloseReason.WITHDRAWN)
    assert winners == {"execution", "undo"}
    assert (await store.experiment(experiment_id)).counters.executions == 6


async def test_an_undone_decision_of_the_gate_is_asked_anew(store: Store) -> None:
    experiment_id = await running(store, mode="propose_only")
    proposal = await opened(store, experiment_id)
    feedback = (await store.submit_feedback(proposal.id, click(1))).feedback
    assert not (await begun(store, proposal.id))[0].allowed
    assert (await store.undo_feedback(feedback.id)).reopened.gate is None


async def test_trainers_are_kept_by_name_and_kind(store: Store) -> None:
    experiment_id = await running(store)
    for number, (name, kind) in enumerate((("ann", "person"), ("synthetic", "teacher"), ("ann", "person"))):
        proposal = await opened(store, experiment_id, f"o{number}")
        await store.submit_feedback(proposal.id, click(1, trainer=name), kind=kind)
    assert [(t.name, t.kind) for t in (await store.trainers()).items] == [("ann", "person"), ("synthetic", "teacher")]
