"""What an operator can mend: a learner that diverges or hangs, a plug-in that is gone, a teacher's click taken back."""

from __future__ import annotations

import asyncio
import os
import signal
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import text

from robot_adapters.base import AdapterError
from server.messages import FeedbackStored, ProposalOpened, WorkerChanged
from server.schemas import EvaluationCreate, Lifecycle
from server.teacher import UnknownTeacher
from tests.server.stage import Stage, stage


async def failed(s: Stage, experiment_id: int) -> str:
    await s.hub.idle(experiment_id)
    view = await s.hub.view(experiment_id)
    assert view.lifecycle is Lifecycle.FAILED
    return str(view.failure)


@pytest.mark.usefixtures("plugins")
async def test_a_learner_that_diverged_is_replaced_when_someone_resumes(tmp_path: Path) -> None:
    flag = tmp_path / "diverge"
    async with stage(tmp_path / "data", checkpoint_every=2) as s:
        fields = {"algorithm": "diverging", "settings": {"flag": str(flag)}}
        experiment = await s.experiment(**fields, lockstep=True, mode="propose_only")
        await s.hub.act(experiment.id, "start")
        for number in (1, 2, 3):
            await s.judge(await s.proposal(number=number), -1)
        fourth = await s.proposal(number=4)
        old = s.hub.worker_pids(experiment.id)
        flag.touch()
        await s.judge(fourth, -1)
        why = await failed(s, experiment.id)
        assert "diverged" in why
        assert "Resume: it learns anew from the last checkpoint" in why
        assert "lower learning_rate" in why
        assert s.hub.worker_pids(experiment.id) == {"robot": old["robot"]}

        # it fails again as long as the cause is there, and then goes on with all four labels
        await s.hub.act(experiment.id, "resume")
        assert "diverged" in await failed(s, experiment.id)
        flag.unlink()
        at = s.now
        await s.hub.act(experiment.id, "resume")
        fifth = await s.proposal(at)
        assert s.hub.worker_pids(experiment.id)["learner"] != old["learner"]
        at = s.now
        await s.judge(fifth, -1)
        assert (await s.proposal(at)).policy_version == 5


async def test_a_learner_that_hangs_is_told_of_and_replaced_soon(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with stage(tmp_path) as s:  # its learner_deadline is a minute
        experiment = await s.experiment(mode="propose_only")
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        monkeypatch.setattr("server.crew.QUICK", 0.5)
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGSTOP)
        at = s.now
        await s.judge(proposal, -1)
        async with asyncio.timeout(30):
            died = await s.seen.next(WorkerChanged, at, where=lambda e: e.status == "died")
        monkeypatch.undo()
        assert died.worker == "learner"
        await s.seen.next(WorkerChanged, at, where=lambda e: e.status == "restarted")
        # what was drawn before it hung, or what the new one draws: either way the trainer goes on
        await s.seen.next(ProposalOpened, at)
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.RUNNING


@pytest.mark.parametrize("part", ["task", "adapter", "teacher"])
async def test_an_experiment_whose_plug_in_is_gone_can_be_halted_and_put_away(tmp_path: Path, part: str) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()

        def remove(session: Any) -> None:
            session.execute(text(f"UPDATE experiment SET {part} = 'gone'"))

        await s.store._database.write(remove)
        with pytest.raises((AdapterError, UnknownTeacher), match="'gone'"):
            await s.hub.act(experiment.id, "start")
        with pytest.raises((AdapterError, UnknownTeacher), match="'gone'"):
            await s.hub.evaluate(experiment.id, EvaluationCreate())
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.failure) == (Lifecycle.CREATED, None)
        assert (await s.store.evaluations(experiment.id)).items == []
        assert (await s.hub.act(experiment.id, "halt")).halted
        assert not (await s.hub.act(experiment.id, "rearm")).halted
        assert (await s.hub.act(experiment.id, "archive")).lifecycle is Lifecycle.ARCHIVED
        await s.hub.idle(experiment.id)


async def test_a_teachers_clicks_can_be_taken_back_one_after_another(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        patience = {"delay": 5.0, "delay_spread": 0.0}  # time to take a click back before the next one
        experiment = await s.experiment(teacher="delayed", teacher_settings=patience, mode="propose_only")
        await s.hub.act(experiment.id, "start")
        clicks = []
        for _ in range(2):
            at = s.now
            clicks.append((await s.seen.next(FeedbackStored, at)).feedback)
        await s.proposal(number=3)
        for click in reversed(clicks):
            at = s.now
            await s.hub.undo(click.id)
            assert (await s.proposal(at)).id == click.proposal_id
        # both are left to whoever took them back; the teacher goes on with what comes after
        reopened = (await s.hub.snapshot(experiment.id, "boot")).proposal
        assert reopened is not None
        at = s.now
        await s.judge(reopened, -1)
        following = await s.proposal(at)
        assert following.number == 4
        taught = await s.seen.next(FeedbackStored, at, where=lambda e: e.feedback.proposal_id == following.id)
        assert taught.feedback.trainer.startswith("teacher")
