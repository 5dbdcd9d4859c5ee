"""SIGKILL at any moment: no acknowledged click is lost or doubled, no motion is repeated, and it goes on afterwards."""

from __future__ import annotations

import asyncio
import os
import random
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

from server.hub import Act
from server.messages import (
    EvaluationChanged,
    ExecutionEnded,
    ExecutionStarted,
    FeedbackStored,
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
    Verdict,
)
from server.store import Conflict, Store
from tests.server.stage import Stage, stage

SLOW = {"step_seconds": 0.3}
"""A skill takes some five seconds: it still moves when it is killed or stopped, however busy the machine is."""


def kill(s: Stage, experiment_id: int, role: str) -> None:
    os.kill(s.hub.worker_pids(experiment_id)[role], signal.SIGKILL)


async def test_a_robot_worker_killed_in_mid_skill(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings=SLOW)
        await s.hub.act(experiment.id, "start")
        approved = await s.proposal()
        await s.judge(approved, 1)
        await s.seen.until(lambda: s.seen.frames)
        at = s.now
        kill(s, experiment.id, "robot")
        ended = await s.seen.next(ExecutionEnded, at)
        assert ended.execution.outcome is ExecutionOutcome.INTERRUPTED
        assert [await s.worker(status, at) for status in ("died", "restarted")] == ["robot", "robot"]

        # it goes on with a new episode, and never tries the interrupted motion again
        fresh = await s.proposal(at)
        assert fresh.episode == approved.episode + 1
        await s.judge(fresh, 1)
        await s.seen.next(ExecutionEnded, where=lambda e: e.execution.proposal_id == fresh.id)
        assert [e.execution.proposal_id for e in s.seen.of(ExecutionStarted)] == [approved.id, fresh.id]
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.RUNNING


async def test_a_robot_worker_killed_while_a_person_thinks(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        waiting = await s.proposal()
        at = s.now
        kill(s, experiment.id, "robot")
        closed = await s.seen.next(ProposalClosed, at)
        assert closed.proposal.id == waiting.id
        assert closed.proposal.close_reason is CloseReason.INTERRUPTED
        fresh = await s.proposal(at)
        assert fresh.episode == waiting.episode + 1


async def test_a_learner_killed_while_a_person_thinks_knows_every_label_again(tmp_path: Path) -> None:
    async with stage(tmp_path, checkpoint_every=3) as s:
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        for number in range(1, 6):
            proposal = await s.proposal(number=number)
            await s.judge(proposal, -1)
        waiting = await s.proposal(number=6)
        at = s.now
        kill(s, experiment.id, "learner")
        await s.worker("died", at)
        # the open proposal is still open: a click counts although nobody learns just now
        await s.judge(waiting, 0)
        await s.worker("restarted", at)
        await s.proposal(at)
        await s.hub.act(experiment.id, "pause")
        await s.hub.idle(experiment.id)
        # 6 labels owe 5 steps each; what the checkpoint had is not taken twice
        evaluation = await s.hub.evaluate(experiment.id, EvaluationCreate(rollouts=1))
        assert evaluation.policy_version == 30
        assert (await s.store.latest_checkpoint(experiment.id)) is not None
        await s.seen.next(EvaluationChanged, where=lambda e: e.evaluation.ended_at is not None)
        assert not [e for e in s.seen.of(ProposalClosed) if e.proposal.close_reason is CloseReason.INTERRUPTED]


async def test_a_damaged_checkpoint_is_rebuilt_from_the_labels(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="synthetic")
        await s.hub.act(experiment.id, "start", until=4)
        await s.hub.idle(experiment.id)
        [checkpoint] = sorted((tmp_path / "checkpoints" / str(experiment.id)).iterdir())
        checkpoint.write_bytes(checkpoint.read_bytes()[:-100])
    async with stage(tmp_path) as s:
        await s.hub.act(experiment.id, "resume", until=6)
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.counters.feedback) == (Lifecycle.PAUSED, 6)
        # all four labels' steps were taken again before the fifth proposal
        newest = (await s.store.proposals(experiment.id)).items[0]
        assert newest.policy_version == 25
        kinds = [event.kind for event in (await s.store.events(experiment.id, limit=200)).items]
        assert "checkpoint_unusable" in kinds


async def test_a_worker_that_dies_again_and_again_fails_the_experiment(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        for _ in range(4):
            at = s.now
            await s.seen.next(ProposalOpened, max(0, at - 1))
            await s.seen.until(lambda: "robot" in s.hub.worker_pids(experiment.id))
            kill(s, experiment.id, "robot")
            await s.worker("died", at)
        await s.hub.idle(experiment.id)
        failed = await s.hub.view(experiment.id)
        assert failed.lifecycle is Lifecycle.FAILED
        assert failed.failure is not None
        assert "died 4 times" in failed.failure
        at = s.now
        await s.hub.act(experiment.id, "resume")
        await s.proposal(at)


async def test_a_robot_worker_that_ignores_the_emergency_stop_is_killed(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings=SLOW)
        await s.hub.act(experiment.id, "start")
        await s.judge(await s.proposal(), 1)
        await s.seen.until(lambda: s.seen.frames)
        os.kill(s.hub.worker_pids(experiment.id)["robot"], signal.SIGSTOP)
        await s.hub.act(experiment.id, "halt")
        ended = await s.seen.next(ExecutionEnded)
        assert ended.execution.outcome is ExecutionOutcome.INTERRUPTED
        await s.hub.idle(experiment.id)
        assert (await s.hub.view(experiment.id)).halted


async def test_a_random_walk_of_clicks_verbs_and_deaths_breaks_nothing(tmp_path: Path) -> None:
    chance = random.Random(3)
    verbs: list[Act] = ["pause", "resume", "resume", "resume", "reset", "halt", "rearm", "rearm"]
    acknowledged: dict[str, tuple[int, Any]] = {}
    async with stage(tmp_path, checkpoint_every=5) as s:
        experiment = await s.experiment(adapter_settings={"step_seconds": 0.002})
        await s.hub.act(experiment.id, "start")
        await s.proposal()
        for _ in range(150):
            # no more deaths than an experiment survives
            what = chance.choices(("click", "undo", "verb", "mode", "kill", "think"), (55, 10, 14, 5, 1, 15))[0]
            try:
                if what == "click":
                    # mostly the newest, sometimes one that is closed by now
                    proposal = chance.choice(s.seen.of(ProposalOpened)[-3:]).proposal
                    click = s.click(chance.choice((-1, 0, 1)))
                    await s.hub.feedback(proposal.id, click)
                    acknowledged[click.click_id] = (proposal.id, click.value)
                elif what == "undo":
                    await s.hub.undo(s.seen.of(FeedbackStored)[-1].feedback.id)
                elif what == "verb":
                    await s.hub.act(experiment.id, chance.choice(verbs))
                elif what == "mode":
                    await s.hub.update(experiment.id, ExperimentUpdate(mode=chance.choice(list(Mode))))
                elif what == "kill" and (pids := s.hub.worker_pids(experiment.id)):
                    os.kill(chance.choice(list(pids.values())), signal.SIGKILL)
                else:
                    await asyncio.sleep(chance.uniform(0, 0.1))
            except (Conflict, IndexError):
                continue  # refused: that is an answer
        # whatever happened, it can go on
        view = await s.hub.view(experiment.id)
        if view.halted:
            await s.hub.act(experiment.id, "rearm")
        at = s.now
        await s.hub.act(experiment.id, "pause" if view.lifecycle is Lifecycle.RUNNING else "resume")
        if view.lifecycle is Lifecycle.RUNNING:
            await s.hub.act(experiment.id, "resume")
        await s.proposal(at)
        started = [event.execution.proposal_id for event in s.seen.of(ExecutionStarted)]
    assert len(acknowledged) > 30
    await check(tmp_path, experiment.id, acknowledged, started)


async def test_the_server_killed_at_random_moments(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(adapter_settings={"step_seconds": 0.005})
    chance = random.Random(11)
    acknowledged: dict[str, tuple[int, Any]] = {}
    started: list[int] = []
    for life in range(4):
        said = await asyncio.to_thread(live_and_die, tmp_path, experiment.id, life, chance)
        for kind, *rest in said:
            if kind == "stored":
                assert rest[0] not in acknowledged
                acknowledged[rest[0]] = (int(rest[1]), int(rest[2]))
            elif kind == "started":
                started.append(int(rest[0]))
        await check(tmp_path, experiment.id, acknowledged, started)
    assert len(acknowledged) > 20
    assert started


def live_and_die(data_dir: Path, experiment_id: int, life: int, chance: random.Random) -> list[list[str]]:
    """Run a service until it has said enough, and kill it; everything that it said."""
    command = [sys.executable, "-m", "tests.server.crash_server", str(data_dir), str(experiment_id), str(life)]
    # odd lives end while the arm moves, the others at any click
    enough = chance.randint(5, 20)
    last = "moving" if life % 2 else "stored"
    said: list[list[str]] = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        for line in server.stdout:
            said.append(line.split())
            if len(said) >= enough and said[-1][0] == last:
                server.kill()
                break
        # what it had said before it died, and nobody had read yet
        said += [line.split() for line in server.stdout if line.endswith("\n")]
    return said


async def check(
    data_dir: Path, experiment_id: int, acknowledged: dict[str, tuple[int, Any]], started: list[int]
) -> None:
    """The invariants of DESIGN.md section 5, on what the dead service left behind."""
    assert len(started) == len(set(started)), "no motion is repeated"
    store = await Store.open(None, data_dir, backup=False)
    await store.recover()
    clicks: dict[str, tuple[int, Any]] = {}
    counted = 0
    proposals = (await store.proposals(experiment_id, limit=500)).items
    for proposal in proposals:
        assert proposal.closed_at is not None
        for feedback in (await store.feedback_of_proposal(proposal.id)).items:
            clicks[feedback.click_id] = (feedback.proposal_id, feedback.value)
            counted += feedback.status is FeedbackStatus.STORED and feedback.undone_at is None
    assert clicks.items() >= acknowledged.items(), "no acknowledged click is lost or moved"
    by_id = {proposal.id: proposal for proposal in proposals}
    executions = (await store.executions(experiment_id, limit=500)).items
    assert len({e.proposal_id for e in executions}) == len(executions)
    assert {e.proposal_id for e in executions} >= set(started)
    for execution in executions:
        assert execution.outcome is not None
        assert by_id[execution.proposal_id].verdict is Verdict.GOOD
        assert by_id[execution.proposal_id].parameters == execution.parameters
    assert (await store.experiment(experiment_id)).lifecycle is Lifecycle.PAUSED
    counters = (await store.experiment(experiment_id)).counters
    assert counters.feedback == len(await store.labels(experiment_id)) == counted
    await store.close()
