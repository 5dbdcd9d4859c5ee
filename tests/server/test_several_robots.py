"""Several robots in one experiment: one queue of proposals, one learner, and whatever befalls one leaves the others."""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from pydantic import BaseModel

from server.crew import Crew
from server.messages import ExecutionEnded, ExecutionStarted, ProposalClosed, WorkerChanged
from server.schemas import CloseReason, Execution, ExecutionOutcome, Lifecycle, Proposal
from server.store import Conflict, NotFound
from server.worker import CommandFailed
from tests.server.stage import Stage, stage

SLOW = {"step_seconds": 0.4}
"""A skill takes some seven seconds: one robot moves on while another is killed."""
ENDLESS = {"step_seconds": 1.0}
"""A skill would take twenty seconds: it is stopped long before."""


async def queue(s: Stage, experiment_id: int, robots: int, ready: Callable[[Proposal], bool] = lambda _: True) -> Any:
    """The open proposals by robot, once so many robots have one that is `ready`."""
    async with asyncio.timeout(60):
        while True:
            s.seen._changed.clear()
            opened = (await s.hub.snapshot(experiment_id, "boot")).proposals
            found = {proposal.robot: proposal for proposal in opened if ready(proposal)}
            if len(found) == robots:
                assert [p.number for p in opened] == sorted(p.number for p in opened), "oldest first"
                return found
            await s.seen._changed.wait()


async def moving(s: Stage, after: int, *robots: int) -> dict[int, Execution]:
    """The executions of these robots, once pictures of each have come."""

    def shown() -> dict[int, Execution] | None:
        started = [e for e in s.seen.events[after:] if isinstance(e, ExecutionStarted)]
        found = {e.execution.robot: e.execution for e in started}
        seen = {(header.robot, header.execution_id) for header, _ in s.seen.frames}
        return found if all(r in found and (r, found[r].id) in seen for r in robots) else None

    found: dict[int, Execution] = await s.seen.until(shown)
    return found


async def test_while_one_robot_moves_others_are_judged_and_a_stop_reaches_them_all(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=3, adapter_settings=ENDLESS)
        await s.hub.act(experiment.id, "start")
        first = await queue(s, experiment.id, 3)
        assert set(s.hub.worker_pids(experiment.id)) == {"robot 1", "robot 2", "robot 3", "learner"}
        assert sorted(p.episode for p in first.values()) == [1, 2, 3]
        assert len({tuple(p.state) for p in first.values()}) == 3, "each begins an episode of its own"

        at = s.now
        await s.judge(first[0], 1)
        running = (await moving(s, at, 0))[0]
        # robot 1 goes on; the trainer doesn't wait for it
        await s.judge(first[1], -1)
        second = (await queue(s, experiment.id, 2, lambda p: p.id != first[1].id))[1]
        assert second.observation_id == first[1].observation_id
        snapshot = await s.hub.snapshot(experiment.id, "boot")
        assert [e.id for e in snapshot.executions] == [running.id]
        assert snapshot.proposal is not None
        assert snapshot.proposal == snapshot.proposals[0]
        # what nobody was there for is for whoever has come since
        assert snapshot.proposal == first[2].model_copy(update={"electorate": ["local"]})

        # and its motion is none since which the click on another robot's proposal can't be taken back
        assert snapshot.undoable is not None
        await s.hub.undo(snapshot.undoable.id)
        again = await queue(s, experiment.id, 2)
        assert again[1].id == first[1].id
        await s.judge(again[1], 1)
        both = await moving(s, at, 0, 1)
        assert {(e.proposal_id, tuple(e.parameters.items())) for e in both.values()} == {
            (first[robot].id, tuple(first[robot].parameters.items())) for robot in (0, 1)
        }

        await s.hub.act(experiment.id, "halt")
        await s.hub.idle(experiment.id)
        ended = [e.execution for e in s.seen.of(ExecutionEnded)]
        assert {e.id for e in ended} == {e.id for e in both.values()}
        assert {e.outcome for e in ended} == {ExecutionOutcome.STOPPED}
        assert (await s.store.proposal(first[2].id)).close_reason is CloseReason.WITHDRAWN
        with pytest.raises(Conflict, match="latched"):
            await s.hub.act(experiment.id, "resume")
        await s.hub.act(experiment.id, "rearm")
        assert len(s.seen.of(ExecutionStarted)) == 2, "nothing moves by that"

        await s.hub.act(experiment.id, "resume")
        at = s.now
        for proposal in (await queue(s, experiment.id, 3)).values():
            await s.judge(proposal, 1)
        assert set(await moving(s, at, 0, 1, 2)) == {0, 1, 2}
        counters = (await s.hub.view(experiment.id)).counters
        assert (counters.feedback, counters.good, counters.executions) == (5, 5, 5)
        assert [label.value for label in await s.store.labels(experiment.id)] == [1] * 5


async def test_a_robot_that_starts_while_a_stop_is_latched_does_not_move(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=2)
        crew = Crew(experiment, s.store, s.settings, on_frame=None, on_change=lambda _: None, on_told=lambda _: None)
        try:
            await asyncio.gather(*(robot.post.fill() for robot in crew.robots))
            crew.stop()
            await crew.robots[1].post.clear()
            await crew.robots[1].post.fill()
            for robot in crew.robots:
                with pytest.raises(CommandFailed, match="latched"):
                    await robot.reset(1)
            await crew.rearm(crew.stops)
            # nor does lifting a stop wait for a robot that is still being built, and it is lifted there all the same
            await crew.robots[1].post.clear()
            building = asyncio.create_task(crew.robots[1].post.fill())
            while "robot 2" not in crew.pids:  # noqa: ASYNC110 - nothing tells of a process before it is built
                await asyncio.sleep(0)
            crew.stop()
            await crew.rearm(crew.stops)
            assert not crew.robots[1].post.ready
            await building
            sights = [await robot.reset(seed) for seed, robot in enumerate(crew.robots)]
            assert sights[0].state != sights[1].state
        finally:
            await crew.close()


async def test_a_dead_robot_is_mended_alone(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=3, adapter_settings=SLOW)
        await s.hub.act(experiment.id, "start")
        waiting = await queue(s, experiment.id, 3)
        at = s.now
        await s.judge(waiting[0], 1)
        await s.judge(waiting[1], 1)
        running = await moving(s, at, 0, 1)
        pids = s.hub.worker_pids(experiment.id)
        os.kill(pids["robot 2"], signal.SIGKILL)
        ended = (await s.seen.next(ExecutionEnded, at)).execution
        assert (ended.id, ended.outcome) == (running[1].id, ExecutionOutcome.INTERRUPTED)
        # the others neither stop, nor is what waits of theirs withdrawn
        fresh = (await queue(s, experiment.id, 2, lambda p: p.robot > 0))[1]
        assert fresh.episode == 4
        others = await s.seen.next(ExecutionEnded, at, where=lambda e: e.execution.id == running[0].id)
        assert others.execution.outcome in (ExecutionOutcome.SUCCEEDED, ExecutionOutcome.FAILED), "it came to its end"
        assert (await queue(s, experiment.id, 3))[2].id == waiting[2].id
        assert not [e for e in s.seen.of(ProposalClosed) if e.proposal.close_reason is CloseReason.INTERRUPTED]
        told = [(e.worker, e.robot, e.status) for e in s.seen.events[at:] if isinstance(e, WorkerChanged)]
        assert told == [("robot", 1, status) for status in ("died", "starting", "restarted")]
        now = s.hub.worker_pids(experiment.id)
        assert {name for name in pids if now[name] != pids[name]} == {"robot 2"}
        at = s.now
        await s.judge(fresh, 1)
        assert (await moving(s, at, 1))[1].proposal_id == fresh.id


async def test_the_death_of_the_learner_that_all_share_is_mended_once(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=2)
        await s.hub.act(experiment.id, "start")
        waiting = await queue(s, experiment.id, 2)
        at = s.now
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        assert await s.worker("restarted", at) == "learner"
        told = [(e.worker, e.status) for e in s.seen.events[at:] if isinstance(e, WorkerChanged)]
        assert told == [("learner", status) for status in ("died", "starting", "restarted")]
        assert await queue(s, experiment.id, 2) == waiting
        for proposal in waiting.values():
            await s.judge(proposal, -1)
        following = await queue(s, experiment.id, 2, lambda p: p.id not in {w.id for w in waiting.values()})
        assert {p.observation_id for p in following.values()} == {p.observation_id for p in waiting.values()}
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.RUNNING


async def test_a_reset_is_of_one_robot_or_of_all(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=2)
        await s.hub.act(experiment.id, "start")
        first = await queue(s, experiment.id, 2)
        with pytest.raises(NotFound, match="no robot 2") as refused:
            await s.hub.act(experiment.id, "reset", robot=2)
        assert refused.value.remedy.endswith("0 to 1")
        await s.hub.act(experiment.id, "reset", robot=1)
        while (await s.hub.view(experiment.id)).counters.episodes < 3:
            pass
        # again, while the fresh start is still being looked at: nothing of it is left waiting
        await s.hub.act(experiment.id, "reset", robot=1)
        second = await queue(s, experiment.id, 2, lambda p: p.robot == 0 or p.episode == 4)
        assert second[0].id == first[0].id
        await s.hub.act(experiment.id, "reset")
        third = await queue(s, experiment.id, 2, lambda p: p.id not in {p.id for p in second.values()})
        assert sorted(p.episode for p in third.values()) == [5, 6]


async def test_in_step_people_judge_in_an_order_of_their_own_and_a_death_does_not_wait_for_them(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=2, lockstep=True, feedback_timeout=None)
        await s.hub.act(experiment.id, "start")
        first = await queue(s, experiment.id, 2)
        at = s.now
        os.kill(s.hub.worker_pids(experiment.id)["robot 2"], signal.SIGKILL)
        second = await queue(s, experiment.id, 2, lambda p: p.robot == 0 or p.id != first[1].id)
        assert (second[0].id, second[1].episode) == (first[0].id, 3)
        assert await s.worker("restarted", at) == "robot"

        await s.judge(second[1], 1)
        assert not s.seen.of(ExecutionStarted), "the round goes on when all are judged"
        await s.judge(second[0], 1)
        assert set(await moving(s, at, 0, 1)) == {0, 1}
        labels = await s.store.labels(experiment.id)
        assert [label.parameters for label in labels] == [tuple(second[r].parameters.values()) for r in (1, 0)]


async def rows(data_dir: Path, feedback: int, **changes: Any) -> list[list[Any]]:
    """Everything that a taught run of two robots stores, without what differs by nature: times and random ids."""
    async with stage(data_dir, checkpoint_every=5) as s:
        experiment = await s.experiment(**({"teacher": "synthetic", "seed": 5, "num_envs": 2} | changes))
        await s.hub.act(experiment.id, "start", until=feedback)
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.counters.feedback) == (Lifecycle.PAUSED, feedback)
        proposals = (await s.store.proposals(experiment.id, limit=200)).items
        executions = (await s.store.executions(experiment.id, limit=200)).items
        clicks = (await s.store.feedback_of_experiment(experiment.id, limit=200)).items
        events = (await s.store.events(experiment.id, limit=500)).items
        metrics = (await s.store.metrics(experiment.id, limit=200)).items
        checkpoints = (await s.store.checkpoints(experiment.id, limit=200)).items
        tables: tuple[Sequence[BaseModel], ...] = (proposals, executions, clicks, metrics, checkpoints)
        drop = {"started_at", "ended_at", "received_at", "click_id", "opened_at", "closed_at", "observation_id"}
        drop |= {"views", "at", "created_at"}
        kept = [[row.model_dump(exclude=drop) for row in rows] for rows in tables]
        return [*kept, [(e.id, e.kind, e.payload) for e in events]]


async def test_in_step_a_seed_repeats_the_whole_run_row_by_row(tmp_path: Path) -> None:
    # always the wrong way round: nearly everything is executed, by both at the same time
    contrary: dict[str, Any] = {"teacher": "noisy", "teacher_settings": {"noise": 0.8}}
    one = await rows(tmp_path / "one", 15, **contrary)
    two = await rows(tmp_path / "two", 15, **contrary)
    assert one == two
    proposals, executions, clicks, metrics, checkpoints, _ = one
    assert len(proposals) == len(clicks) == 15, "never more than was asked for, also where that ends within a round"
    assert {e["robot"] for e in executions} == {0, 1}
    # what a round's two labels owe has been worked off before the next round, and before anything is told of it
    assert [p["policy_version"] for p in reversed(proposals)] == [10 * (n // 2) for n in range(15)]
    assert sorted(c["policy_version"] for c in checkpoints) == [30, 60, 75]
    values = {m["feedback"]: m["values"] for m in metrics}
    good = [click["value"] == 1 for click in reversed(clicks)]
    assert {n: each["good_share"] for n, each in values.items()} == {n: sum(good[:n]) / n for n in range(1, 16)}


async def test_each_at_its_own_pace_teachers_store_no_more_than_asked_for(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="synthetic", num_envs=2, lockstep=False)
        await s.hub.act(experiment.id, "start", until=5)
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.counters.feedback) == (Lifecycle.PAUSED, 5)
        assert len((await s.store.feedback_of_experiment(experiment.id)).items) == 5
        assert await s.store.open_proposals(experiment.id) == []
