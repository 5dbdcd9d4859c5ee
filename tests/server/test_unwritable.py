"""A store that can't be written while an experiment runs: nothing is hidden, nothing is lost, and it goes on after."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from server.messages import ExecutionEnded, ExperimentChanged, ProposalClosed
from server.schemas import ExecutionOutcome, Lifecycle, Phase
from server.store import Conflict, Full, Store
from tests.server.serving import event, serving
from tests.server.stage import stage

SLOW = {"step_seconds": 0.5}
"""A skill takes some eight seconds, and is stopped in the midst of it."""


class Disk:
    """The disk under a store: while it is full, every write fails, or those of the named methods."""

    def __init__(self, store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
        self._database: Any = store._database
        self._store: Any = store
        self._patch = monkeypatch

    def fill(self, *methods: str) -> None:
        async def refuse(*_: Any, **__: Any) -> Any:
            raise Full("database or disk is full")

        if not methods:
            self._patch.setattr(self._database, "write", refuse)
        for method in methods:
            self._patch.setattr(self._store, method, refuse)

    def free(self) -> None:
        self._patch.undo()


async def test_a_stop_on_a_full_disk_holds_is_told_and_is_stored_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment(adapter_settings=SLOW)
        await s.hub.act(experiment.id, "start")
        await s.judge(await s.proposal(), 1)
        await s.seen.until(lambda: s.seen.frames)
        disk.fill()
        at = s.now
        halted = await s.hub.act(experiment.id, "halt")
        assert (halted.halted, halted.lifecycle) == (True, Lifecycle.PAUSED)
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.halted)
        await s.hub.idle(experiment.id)
        assert not (await s.store.experiment(experiment.id)).halted
        view = await s.hub.view(experiment.id)
        assert (view.halted, view.lifecycle, view.phase) == (True, Lifecycle.PAUSED, Phase.IDLE)
        for verb in ("resume", "rearm"):
            with pytest.raises(Full):  # neither could be stored
                await s.hub.act(experiment.id, verb)
        assert (await s.hub.view(experiment.id)).halted

        at = s.now
        disk.free()
        await s.seen.next(ExecutionEnded, at)
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.halted)
        assert (await s.store.experiment(experiment.id)).halted
        # what the arm did is known too, and not lost
        [execution] = (await s.store.executions(experiment.id)).items
        assert execution.outcome is ExecutionOutcome.STOPPED
        with pytest.raises(Conflict, match="latched"):
            await s.hub.act(experiment.id, "resume")
        assert not (await s.hub.act(experiment.id, "rearm")).halted
        at = s.now
        await s.hub.act(experiment.id, "resume")
        await s.proposal(at)


async def test_a_stop_that_only_this_process_knows_can_be_lifted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:
        monkeypatch.setattr("server.owed.RETRY", 3600.0)
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        await s.proposal()
        disk.fill("halt")
        await s.hub.act(experiment.id, "halt")
        await s.hub.idle(experiment.id)
        # the stop was overtaken: the database never hears of it, and it is latched here
        s.hub._runners[experiment.id].standing.owed._writes.clear()
        assert not (await s.store.experiment(experiment.id)).halted
        with pytest.raises(Conflict, match="latched") as refused:
            await s.hub.act(experiment.id, "reset")
        assert "rearm" in refused.value.allowed
        armed = await s.hub.act(experiment.id, "rearm")
        assert (armed.halted, armed.lifecycle) == (False, Lifecycle.PAUSED)
        at = s.now
        await s.hub.act(experiment.id, "resume")
        await s.proposal(at)
        kinds = [e.kind for e in (await s.store.events(experiment.id, limit=200)).items]
        assert kinds.index("halt") < kinds.index("rearm")


async def test_a_loop_that_dies_of_a_full_disk_says_so_and_goes_on_after(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment(mode="propose_only")
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        disk.fill()
        with pytest.raises(Full):
            await s.judge(proposal, -1)
        assert (await s.hub.view(experiment.id)).phase is Phase.AWAITING_FEEDBACK  # the click may be sent again
        disk.free()
        disk.fill("begin_execution", "transition", "close_proposal", "end_episode")
        at = s.now
        await s.judge(proposal, 1)
        told = await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.failure is not None)
        assert told.experiment.lifecycle is Lifecycle.FAILED
        assert "free space" in str(told.experiment.failure)
        await s.hub.idle(experiment.id)
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.phase) == (Lifecycle.FAILED, Phase.IDLE)
        assert (await s.hub.snapshot(experiment.id, "boot")).experiment == view
        assert (await s.store.experiment(experiment.id)).lifecycle is Lifecycle.RUNNING
        with pytest.raises(Full):
            await s.hub.act(experiment.id, "resume")

        at = s.now
        disk.free()
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.lifecycle is Lifecycle.FAILED)
        assert (await s.store.experiment(experiment.id)).lifecycle is Lifecycle.FAILED
        at = s.now
        resumed = await s.hub.act(experiment.id, "resume")
        assert (resumed.lifecycle, resumed.failure) == (Lifecycle.RUNNING, None)
        following = await s.proposal(at)
        at = s.now
        await s.judge(following, -1)
        await s.proposal(at)
        assert len(await s.store.labels(experiment.id)) == 2


async def test_an_open_proposal_of_a_dead_loop_is_put_away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with stage(tmp_path) as s:
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        disk.fill()
        at = s.now
        with pytest.raises(Full):
            await s.hub.act(experiment.id, "reset")
        assert (await s.hub.act(experiment.id, "halt")).halted
        closed = await s.seen.next(ProposalClosed, at)
        assert closed.proposal.id == proposal.id
        await s.hub.idle(experiment.id)
        disk.free()
        await s.hub.act(experiment.id, "rearm")
        at = s.now
        await s.hub.act(experiment.id, "resume")
        assert (await s.proposal(at)).id != proposal.id


async def test_an_outcome_that_cannot_be_stored_blocks_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with stage(tmp_path) as s:
        monkeypatch.setattr("server.owed.RETRY", 3600.0)
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        disk.fill("end_execution")
        at = s.now
        await s.judge(proposal, 1)
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.lifecycle is Lifecycle.FAILED)
        await s.hub.idle(experiment.id)
        disk.free()
        at = s.now
        await s.hub.act(experiment.id, "resume")
        ended = await s.seen.next(ExecutionEnded, at)
        assert ended.execution.outcome in (ExecutionOutcome.SUCCEEDED, ExecutionOutcome.FAILED)  # as it was
        following = await s.proposal(at)
        await s.judge(following, 1)
        await s.seen.next(ExecutionEnded, at, where=lambda e: e.execution.proposal_id == following.id)


@pytest.mark.usefixtures("plugins")
async def test_damage_that_cannot_be_stored_latches_the_stop_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment(adapter="clumsy")
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        disk.fill("end_execution", "transition", "halt", "close_proposal", "end_episode")
        at = s.now
        await s.judge(proposal, 1)
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.halted)
        await s.hub.idle(experiment.id)
        disk.free()
        with pytest.raises(Conflict, match="latched"):
            await s.hub.act(experiment.id, "resume")
        # what could not be stored was, before anything else
        stored = await s.store.experiment(experiment.id)
        assert (stored.halted, stored.lifecycle, stored.counters.violations) == (True, Lifecycle.PAUSED, 1)


async def test_what_never_got_its_end_written_is_settled_by_the_next_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:
        disk = Disk(s.store, monkeypatch)
        experiment = await s.experiment()
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()

        async def lost(*_: Any, **__: Any) -> Any:
            raise Conflict("the outcome is lost", remedy="none")

        monkeypatch.setattr(s.store, "end_execution", lost)
        at = s.now
        await s.judge(proposal, 1)
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.lifecycle is Lifecycle.FAILED)
        await s.hub.idle(experiment.id)
        disk.free()
        assert len(await s.store.running_executions(experiment.id)) == 1
        at = s.now
        await s.hub.act(experiment.id, "resume")
        ended = await s.seen.next(ExecutionEnded, at)
        assert ended.execution.outcome is ExecutionOutcome.INTERRUPTED
        await s.proposal(at)


async def test_a_checkpoint_that_cannot_be_written_is_told_and_stops_nothing(tmp_path: Path) -> None:
    async with stage(tmp_path, checkpoint_every=1) as s:
        experiment = await s.experiment()
        # the name that the first checkpoint gets is taken by a directory: `replace` fails in the service itself
        await s.hub.act(experiment.id, "start")
        first = await s.proposal()
        folder = tmp_path / "checkpoints" / str(experiment.id)
        for version in range(40):
            for label in range(4):
                (folder / f"{version:08d}-{label:08d}.ckpt").mkdir(parents=True)
        at = s.now
        await s.judge(first, -1)
        await s.judge(await s.proposal(at), -1)
        await s.proposal(number=3)
        await s.hub.act(experiment.id, "pause")
        await s.hub.idle(experiment.id)
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.PAUSED
        assert "checkpoint_failed" in [e.kind for e in (await s.store.events(experiment.id, limit=200)).items]
        assert await s.store.latest_checkpoint(experiment.id) is None


async def test_ready_says_what_is_not_stored_and_what_does_not_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(tmp_path) as live:
        disk = Disk(live.service.store, monkeypatch)
        experiment = await live.experiment()
        address = f"/api/v1/experiments/{experiment}"
        async with live.stream(experiment) as viewer:
            await live.http.post(f"{address}/start")
            await event(viewer, "proposal_opened")
            assert (await live.http.get("/ready")).status_code == 200
            disk.fill()
            halted = await live.http.post(f"{address}/halt")
            assert (halted.status_code, halted.json()["halted"]) == (200, True)
            unready = await live.http.get("/ready")
            assert unready.status_code == 503
            assert "stored" in unready.json()["checks"]["workers"]
            disk.free()
        assert (await live.http.post(f"{address}/rearm")).json()["lifecycle"] == "paused"
        assert (await live.http.get("/ready")).status_code == 200
        # running in the database, and nobody runs it
        await live.service.store.transition(experiment, "resume")
        unready = await live.http.get("/ready")
        assert unready.status_code == 503
        assert f"experiment {experiment}" in unready.json()["checks"]["workers"]
