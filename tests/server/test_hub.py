"""What routes, stream and command line ask of the hub: verbs, clicks from outside, the emergency stop, the end."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from server.messages import ExecutionEnded, ExecutionStarted, ExperimentChanged, FeedbackStored, ProposalOpened
from server.schemas import EvaluationCreate, ExecutionOutcome, FeedbackStatus, Lifecycle, Phase
from server.store import Conflict, NotFound
from tests.server.stage import stage

SLOW = {"step_seconds": 0.3}
"""A skill takes some five seconds: time to stop it, and still to wait for the end of another."""


async def test_verbs_out_of_place_are_refused_and_change_nothing(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        for verb in ("pause", "resume", "finish", "reset", "rearm"):
            with pytest.raises(Conflict) as refused:
                await s.hub.act(experiment.id, verb)
            assert "start" in refused.value.allowed
        with pytest.raises(NotFound):
            await s.hub.act(77, "start")
        with pytest.raises(NotFound):
            await s.hub.act(77, "halt")
        with pytest.raises(NotFound):
            await s.hub.feedback(77, s.click(1))
        with pytest.raises(NotFound):
            await s.hub.undo(77)
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.CREATED
        assert (await s.hub.act(experiment.id, "archive")).lifecycle is Lifecycle.ARCHIVED
        with pytest.raises(Conflict):
            await s.hub.evaluate(experiment.id, EvaluationCreate())


async def test_clicks_are_stored_once_and_where_they_belong(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        other = await s.experiment()
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        with pytest.raises(NotFound):
            await s.hub.feedback(proposal.id, s.click(1), experiment_id=other.id)

        click = s.click(-1, "the-very-same")
        answers = await asyncio.gather(*(s.hub.feedback(proposal.id, click) for _ in range(5)))
        assert len({feedback.id for feedback, _ in answers}) == 1
        assert [duplicate for _, duplicate in answers].count(False) == 1
        with pytest.raises(Conflict):
            await s.hub.feedback(proposal.id, s.click(1, "the-very-same"))
        newer = await s.proposal(number=2)
        with pytest.raises(Conflict):
            await s.hub.feedback(newer.id, click)
        late, _ = await s.hub.feedback(proposal.id, s.click(1), experiment_id=experiment.id)
        assert late.status is FeedbackStatus.LATE
        counters = (await s.hub.view(experiment.id)).counters
        assert (counters.feedback, counters.late) == (1, 1)
        assert len([e for e in s.seen.of(FeedbackStored) if e.feedback.status is FeedbackStatus.STORED]) == 1

        # what a viewer is shown when it connects
        snapshot = await s.hub.snapshot(experiment.id, "boot")
        assert snapshot.boot_id == "boot"
        assert snapshot.proposal is not None
        assert snapshot.proposal.id == newer.id
        assert snapshot.experiment.phase is Phase.AWAITING_FEEDBACK
        assert [e.phase for e in (await s.hub.views()).items] == [Phase.IDLE, Phase.AWAITING_FEEDBACK]


async def test_halt_stops_the_arm_and_stays_latched(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings=SLOW)
        await s.hub.act(experiment.id, "start")
        approved = await s.proposal()
        await s.judge(approved, 1)
        await s.seen.until(lambda: s.seen.frames)
        assert (await s.hub.snapshot(experiment.id, "boot")).execution is not None

        at = s.now
        halted = await s.hub.act(experiment.id, "halt")
        assert halted.halted
        assert halted.lifecycle is Lifecycle.PAUSED
        stopped = await s.seen.next(ExecutionEnded)
        assert stopped.execution.outcome is ExecutionOutcome.STOPPED
        assert [e for e in s.seen.events[at:] if isinstance(e, ExperimentChanged) and e.experiment.halted]
        await s.hub.idle(experiment.id)

        # latched: neither resume nor a second stop changes that, and re-arming alone moves nothing
        assert (await s.hub.act(experiment.id, "halt")).halted
        for verb in ("resume", "reset"):
            with pytest.raises(Conflict):
                await s.hub.act(experiment.id, verb)
        with pytest.raises(Conflict):
            await s.hub.evaluate(experiment.id, EvaluationCreate())
        armed = await s.hub.act(experiment.id, "rearm")
        assert (armed.halted, armed.lifecycle) == (False, Lifecycle.PAUSED)
        assert len(s.seen.of(ExecutionStarted)) == 1

        at = s.now
        await s.hub.act(experiment.id, "resume")
        again = await s.proposal(at)
        assert again.observation_id != approved.observation_id
        at = s.now
        await s.judge(again, 1)
        assert (await s.seen.next(ExecutionEnded, at)).execution.outcome is not ExecutionOutcome.STOPPED


async def test_halts_that_come_together_are_all_taken(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        await s.proposal()
        halted = await asyncio.gather(*(s.hub.act(experiment.id, "halt") for _ in range(5)))
        assert {(h.halted, h.lifecycle) for h in halted} == {(True, Lifecycle.PAUSED)}


async def test_halt_works_before_anything_runs_and_while_workers_start(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        created = await s.experiment()
        assert (await s.hub.act(created.id, "halt")).halted
        with pytest.raises(Conflict):
            await s.hub.act(created.id, "start")

        starting = await s.experiment()
        await s.hub.act(starting.id, "start")
        await s.worker("starting")
        await s.hub.act(starting.id, "halt")
        await s.hub.idle(starting.id)
        view = await s.hub.view(starting.id)
        assert (view.lifecycle, view.halted, view.failure) == (Lifecycle.PAUSED, True, None)
        assert not s.seen.of(ProposalOpened)
        await s.hub.act(starting.id, "rearm")
        await s.hub.act(starting.id, "resume")
        assert (await s.proposal()).number == 1


async def test_a_robot_that_cannot_be_built_fails_the_experiment_with_a_remedy(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings={"draw": True})
        images = tmp_path / "images"
        images.write_text("in the way of the directory")
        await s.hub.act(experiment.id, "start")
        await s.hub.idle(experiment.id)
        failed = await s.hub.view(experiment.id)
        assert failed.lifecycle is Lifecycle.FAILED
        assert failed.failure is not None
        assert "writable" in failed.failure
        images.unlink()
        await s.hub.act(experiment.id, "resume")
        await s.proposal()


async def test_closing_pauses_what_runs_and_stops_what_moves(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings={"step_seconds": 1.0})
        await s.hub.act(experiment.id, "start")
        await s.judge(await s.proposal(), 1)
        await s.seen.until(lambda: s.seen.frames)
        pids = s.hub.worker_pids(experiment.id)
        await s.hub.close()
        assert not [pid for pid in pids.values() if running(pid)]
        stored = await s.store.experiment(experiment.id)
        assert stored.lifecycle is Lifecycle.PAUSED
        executions = (await s.store.executions(experiment.id)).items
        # the slow skill alone would have gone on for a minute
        assert [e.outcome for e in executions] == [ExecutionOutcome.STOPPED]


def running(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()
