"""The synthetic trainer votes by the task's rule, through the door that people use."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robot_adapters import registry
from robot_adapters.base import SkillCall
from server.schemas import Lifecycle
from server.teacher import UnknownTeacher, teacher
from tests.server.stage import stage


@pytest.mark.parametrize("name", ["reaching", "stacking"])
def test_it_likes_the_true_call_and_nothing_far_from_it(name: str) -> None:
    task = registry.task(name)
    synthetic = teacher("synthetic", task)
    state = np.array([0.5, 0.0, -0.092, 0.65, 0.1, -0.087][: sum(f.size for f in task.state_fields)])
    true = task.true_call(state)
    assert synthetic.judge(state, true) == 1
    assert synthetic.judge(state, SkillCall(true.skill, tuple(p + 0.15 for p in true.parameters))) == -1


def test_an_unknown_teacher_is_told_with_those_there_are() -> None:
    with pytest.raises(UnknownTeacher) as unknown:
        teacher("socrates", registry.task("stacking"))
    assert "synthetic" in unknown.value.remedy


async def test_its_clicks_are_rows_of_its_own_trainer(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="synthetic")
        assert experiment.lockstep
        await s.hub.act(experiment.id, "start", until=12)
        await s.hub.idle(experiment.id)
        assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.PAUSED
        trainers = (await s.store.trainers()).items
        assert [(t.name, t.kind) for t in trainers] == [("teacher:synthetic", "teacher")]
        task = registry.task("stacking")
        proposals = (await s.store.proposals(experiment.id)).items
        assert len(proposals) == 12
        for proposal in proposals:
            clicks = (await s.store.feedback_of_proposal(proposal.id)).items
            call = SkillCall(proposal.skill, tuple(proposal.parameters.values()))
            assert [c.value for c in clicks] == [task.judge(np.array(proposal.state), call)]
        metrics = (await s.store.metrics(experiment.id)).items
        assert [m.feedback for m in metrics] == list(range(1, 13))
