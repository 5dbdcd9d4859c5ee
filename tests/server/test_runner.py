"""One experiment's loop, by what a trainer sees of it: real workers, a real database."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from server.messages import (
    ExecutionEnded,
    ExecutionStarted,
    FeedbackUndone,
    MetricsAdded,
    ProposalClosed,
    ProposalOpened,
)
from server.schemas import (
    CloseReason,
    EvaluationCreate,
    ExecutionOutcome,
    ExperimentUpdate,
    FeedbackStatus,
    Lifecycle,
    Mode,
    Phase,
    Proposal,
    Verdict,
)
from server.seeds import episode_seed
from server.store import Conflict
from tests.server.stage import Stage, stage

SLOW = {"step_seconds": 0.5}
"""A skill takes some eight seconds, and is stopped in the midst of it."""


async def test_bad_neutral_good_and_undo(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        first = await s.proposal()
        assert first.number == 1
        assert first.subgoal == "pick up the red block"
        assert {view.camera for view in first.views} == {"left", "right"}

        # bad and neutral: nothing moves, another idea for the very same observation
        at = s.now
        await s.judge(first, -1)
        second = await s.proposal(at)
        await s.judge(second, 0)
        third = await s.proposal(number=3)
        assert first.observation_id == second.observation_id == third.observation_id
        assert [v.image for v in first.views] == [v.image for v in third.views]
        assert not s.seen.of(ExecutionStarted)

        # undo: the judged one is open again, the newer one withdrawn, and a click on that is late
        undoable = (await s.hub.snapshot(experiment.id, "boot")).undoable
        assert undoable is not None
        at = s.now
        await s.hub.undo(undoable.id)
        assert (await s.seen.next(FeedbackUndone, at)).feedback.id == undoable.id
        assert (await s.proposal(at)).id == second.id
        late, _ = await s.hub.feedback(third.id, s.click(1))
        assert late.status is FeedbackStatus.LATE

        # good: exactly the approved call runs, and the scene is looked at anew
        at = s.now
        await s.judge(second, 1)
        ended = await s.seen.next(ExecutionEnded, at)
        assert ended.execution.proposal_id == second.id
        assert ended.execution.parameters == second.parameters
        closed = await s.seen.next(ProposalClosed, at)
        assert closed.proposal.verdict is Verdict.GOOD
        assert closed.proposal.gate is not None
        assert closed.proposal.gate.allowed
        fourth = await s.proposal(at)
        assert fourth.observation_id != second.observation_id

        counters = (await s.hub.view(experiment.id)).counters
        assert (counters.feedback, counters.good, counters.bad, counters.neutral, counters.late) == (2, 1, 1, 0, 1)
        assert counters.executions == 1
        # the undone click is no label
        assert [label.value for label in await s.store.labels(experiment.id)] == [-1, 1]
        points = await s.seen.until(lambda: s.seen.of(MetricsAdded)[2:])
        assert {"predicted_feedback", "label", "successes", "good_share"} <= set(points[-1].point.values)


async def test_modes_timeout_pause_and_reset(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(mode="propose_only")
        await s.hub.act(experiment.id, "start")
        first = await s.proposal()

        # propose only: a good click is a label and nothing else
        at = s.now
        await s.judge(first, 1)
        closed = await s.seen.next(ProposalClosed, at)
        assert closed.proposal.gate is not None
        assert not closed.proposal.gate.allowed
        second = await s.proposal(at)
        assert second.observation_id == first.observation_id
        # nothing has moved, so even a good one can be taken back
        assert (await s.hub.snapshot(experiment.id, "boot")).undoable is not None

        # the mode changes live
        await s.hub.update(experiment.id, ExperimentUpdate(mode=Mode.EXECUTE_APPROVED))
        at = s.now
        await s.judge(second, 1)
        await s.seen.next(ExecutionEnded, at)
        third = await s.proposal(at)

        # time-out: no verdict, no label, no motion; it may be set while a proposal waits
        at = s.now
        await s.hub.update(experiment.id, ExperimentUpdate(feedback_timeout=0.01))
        out = await s.seen.next(ProposalClosed, at, where=lambda e: e.proposal.id == third.id)
        assert out.proposal.close_reason is CloseReason.TIMED_OUT
        assert out.proposal.verdict is None
        await s.hub.update(experiment.id, ExperimentUpdate(feedback_timeout=None))

        # pause withdraws; a click that comes then is kept as late; the episode goes on at resume
        paused = await s.hub.act(experiment.id, "pause")
        assert paused.lifecycle is Lifecycle.PAUSED
        newest = s.seen.of(ProposalOpened)[-1].proposal
        late, _ = await s.hub.feedback(newest.id, s.click(-1))
        assert late.status is FeedbackStatus.LATE
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert view.phase is Phase.IDLE
        assert await s.store.open_proposals(experiment.id) == []
        at = s.now
        await s.hub.act(experiment.id, "resume")
        resumed = await s.proposal(at)
        assert resumed.episode == third.episode
        assert resumed.observation_id == third.observation_id

        # reset: a new episode
        at = s.now
        await s.hub.act(experiment.id, "reset")
        fresh = await s.proposal(at)
        assert fresh.episode == third.episode + 1
        assert len(await s.store.labels(experiment.id)) == 2

        finished = await s.hub.act(experiment.id, "finish")
        assert finished.lifecycle is Lifecycle.FINISHED
        await s.hub.idle(experiment.id)
        assert s.hub.worker_pids(experiment.id) == {}
        assert (await s.store.latest_checkpoint(experiment.id)) is not None


async def teach(data_dir: Path, feedback: int, **changes: Any) -> tuple[list[Proposal], Stage, int]:
    async with stage(data_dir) as s:
        experiment = await s.experiment(teacher="synthetic", seed=5, **changes)
        await s.hub.act(experiment.id, "start", until=feedback)
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert view.lifecycle is Lifecycle.PAUSED
        assert view.counters.feedback == feedback
        return [event.proposal for event in s.seen.of(ProposalOpened)], s, experiment.id


async def test_with_a_teacher_a_seed_repeats_the_whole_run(tmp_path: Path) -> None:
    one, _, _ = await teach(tmp_path / "one", 12)
    two, _, _ = await teach(tmp_path / "two", 12)
    assert len(one) == 12
    essence = [(p.episode, p.state, p.skill, p.parameters, p.predicted_feedback, p.policy_version) for p in one]
    assert essence == [(p.episode, p.state, p.skill, p.parameters, p.predicted_feedback, p.policy_version) for p in two]
    # the learner had worked off what each label owed before the next proposal
    assert [p.policy_version for p in one] == [5 * n for n in range(12)]


async def test_an_evaluation_moves_by_stored_approvals_and_trains_nothing(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="synthetic")
        evaluation = await s.hub.evaluate(experiment.id, EvaluationCreate(rollouts=3, seed=100))
        with pytest.raises(Conflict, match="evaluat"):
            await s.hub.act(experiment.id, "start")
        with pytest.raises(Conflict, match="goes on"):
            await s.hub.evaluate(experiment.id, EvaluationCreate())
        await s.hub.idle(experiment.id)
        stored = (await s.store.evaluations(experiment.id)).items
        assert [e.id for e in stored] == [evaluation.id]
        assert stored[0].ended_at is not None
        assert stored[0].rollouts == 3
        assert stored[0].low_level_steps > 0
        executions = (await s.store.executions(experiment.id)).items
        assert len(executions) == 3 * 6, "an unlearned policy uses up every horizon"
        for execution in executions:
            proposal = await s.store.proposal(execution.proposal_id)
            assert proposal.purpose == "evaluation"
            assert proposal.verdict is Verdict.GOOD
            assert proposal.gate is not None
            assert proposal.gate.allowed
        view = await s.hub.view(experiment.id)
        assert view.counters.feedback == view.counters.executions == 0
        assert await s.store.labels(experiment.id) == []

        # training goes on afterwards, with an episode of its own
        await s.hub.act(experiment.id, "start", until=3)
        await s.hub.idle(experiment.id)
        assert (await s.hub.view(experiment.id)).counters.feedback == 3


async def test_a_halted_evaluation_is_stored_as_what_it_did(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings=SLOW)
        await s.hub.evaluate(experiment.id, EvaluationCreate(rollouts=100))
        await s.seen.next(ExecutionStarted)
        await s.hub.act(experiment.id, "halt")
        await s.hub.idle(experiment.id)
        stored = (await s.store.evaluations(experiment.id)).items[0]
        assert stored.ended_at is not None
        assert stored.rollouts == 0
        assert s.seen.of(ExecutionEnded)[-1].execution.outcome is ExecutionOutcome.STOPPED


async def test_episode_ends_at_its_horizon(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(task="reaching")
        await s.hub.act(experiment.id, "start")
        for number in range(1, 6):
            proposal = await s.proposal(number=number)
            assert proposal.episode == (1 if number <= 4 else 2) or s.seen.of(ExecutionEnded)[-1].execution.task_success
            await s.judge(proposal, 1)


def test_episode_seeds_differ_between_experiments_and_episodes() -> None:
    seeds = {episode_seed(experiment, number) for experiment in range(30) for number in range(30)}
    assert len(seeds) == 900
    assert all(0 <= seed < 2**31 for seed in seeds)
    assert episode_seed(3, 4) == episode_seed(3, 4)
