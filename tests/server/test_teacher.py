"""Synthetic trainers vote by the task's rule, with the failings they are given, through the door that people use."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robot_adapters import registry
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from server.messages import ProposalClosed
from server.schemas import CloseReason, Lifecycle
from server.seeds import judging
from server.teacher import Case, Judgement, Oracle, QFunction, SyntheticSettings, Teacher, UnknownTeacher, teacher
from tests.server.stage import Stage, stage

START = {"reaching": (0.5, 0.0, 0.0, 0.0), "stacking": (0.5, 0.0, -0.092, 0.65, 0.1, -0.087)}
MANY = 2000


def case(state: Array, call: SkillCall, number: int = 1, seed: int = 0) -> Case:
    return Case(state, call, judging(seed, number))


def judged(kind: str, settings: dict[str, Any], call: SkillCall, seed: int = 0) -> list[Judgement]:
    """What this teacher says to a call in Stacking, proposed many times."""
    task = registry.task("stacking")
    one = teacher(kind, task, settings)
    return [one.judge(case(np.array(START["stacking"]), call, n, seed)) for n in range(MANY)]


def true_call(task: Task) -> SkillCall:
    return task.true_call(np.array(START[task.name]))


@pytest.mark.parametrize("name", ["reaching", "stacking"])
def test_it_likes_the_true_call_and_nothing_far_from_it(name: str) -> None:
    task = registry.task(name)
    synthetic = teacher("synthetic", task, {})
    state = np.array(START[name])
    true = task.true_call(state)
    assert synthetic.judge(case(state, true)) == Judgement(1)
    far = SkillCall(true.skill, tuple(p + 0.15 for p in true.parameters))
    assert synthetic.judge(case(state, far)) == Judgement(-1)


def test_an_unknown_teacher_is_told_with_those_there_are() -> None:
    with pytest.raises(UnknownTeacher) as unknown:
        teacher("socrates", registry.task("stacking"), {})
    assert "synthetic" in unknown.value.remedy


def test_noise_flips_as_often_as_it_says_and_the_same_ones_again() -> None:
    task = registry.task("stacking")
    values = [j.value for j in judged("noisy", {"noise": 0.2}, true_call(task))]
    # four standard deviations of a binomial share
    assert abs(values.count(-1) / MANY - 0.2) < 4 * (0.2 * 0.8 / MANY) ** 0.5
    assert 0 not in values
    assert values == [j.value for j in judged("noisy", {"noise": 0.2}, true_call(task))]
    assert values != [j.value for j in judged("noisy", {"noise": 0.2}, true_call(task), seed=1)]
    # other settings leave the dice alone
    assert values == [
        j.value for j in judged("noisy", {"noise": 0.2, "delay": 3.0, "delay_spread": 1.0}, true_call(task))
    ]


def test_near_the_border_of_the_box_it_clicks_neutral() -> None:
    task = registry.task("stacking")
    skipping = teacher("skipping", task, {"skip_within": 0.004})
    state = np.array(START["stacking"])
    x, y, z = true_call(task).parameters
    # the box of the pick is x +-15 mm
    told = [skipping.judge(case(state, SkillCall("pick", (x + dx / 1000, y, z)))).value for dx in range(25)]
    assert told == [1] * 11 + [1] * (told[11] == 1) + [0] * (7 + (told[11] == 0)) + [-1] * 6
    assert [abs(task.margin(state, SkillCall("pick", (x + dx / 1000, y, z)))) < 0.004 for dx in range(25)] == [
        value == 0 for value in told
    ]
    assert skipping.judge(case(state, SkillCall("place", (x, y, z)))).value == -1, "another skill is plainly bad"


def test_delays_are_about_their_median_and_seeded() -> None:
    settings = {"delay": 2.0, "delay_spread": 0.5}
    call = true_call(registry.task("stacking"))
    delays = [j.delay for j in judged("delayed", settings, call)]
    logs = np.log(delays)
    assert abs(logs.mean() - np.log(2.0)) < 4 * 0.5 / MANY**0.5
    assert 0.45 < logs.std() < 0.55
    assert delays == [j.delay for j in judged("delayed", settings, call)]
    assert {j.delay for j in judged("delayed", {"delay": 2.0, "delay_spread": 0.0}, call)} == {2.0}


async def taught(s: Stage, feedback: int, **fields: Any) -> list[tuple[int, int]]:
    """(proposal number, label) of a whole run."""
    experiment = await s.experiment(**fields)
    await s.hub.act(experiment.id, "start", until=feedback)
    await s.hub.idle(experiment.id)
    assert (await s.hub.view(experiment.id)).lifecycle is Lifecycle.PAUSED
    return await labels(s, experiment.id)


async def labels(s: Stage, experiment_id: int) -> list[tuple[int, int]]:
    found: list[tuple[int, Any]] = []
    for proposal in (await s.store.proposals(experiment_id, limit=200)).items:
        found += [(proposal.number, c.value) for c in (await s.store.feedback_of_proposal(proposal.id)).items]
    return sorted(found)


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


async def test_the_same_seed_gives_the_same_labels_also_across_a_restart(tmp_path: Path) -> None:
    fields = {"teacher": "noisy", "teacher_settings": {"noise": 0.5}, "seed": 4}
    async with stage(tmp_path / "one") as s:
        one = await taught(s, 12, **fields)
        assert {value for _, value in one} == {-1, 1}
    async with stage(tmp_path / "two") as s:
        assert await taught(s, 12, **fields) == one
    async with stage(tmp_path / "in parts") as s:
        first = await taught(s, 7, **fields)
        assert first == one[:7]
    async with stage(tmp_path / "in parts") as s:
        await s.hub.act(1, "resume", until=8)
        await s.hub.idle(1)
        # the learner starts again from its checkpoint; the dice are those of the proposal's number all the same
        task, dice = registry.task("stacking"), judging(4, 8)
        newest = (await s.store.proposals(1, limit=1)).items[0]
        rule = task.judge(np.array(newest.state), SkillCall(newest.skill, tuple(newest.parameters.values())))
        assert (await labels(s, 1))[-1] == (8, -rule if dice.random() < 0.5 else rule)


@pytest.mark.parametrize("verb", ["pause", "halt", "finish"])
async def test_a_teacher_that_thinks_is_interrupted(tmp_path: Path, verb: Any) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="delayed", teacher_settings={"delay": 600.0})
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        await s.hub.act(experiment.id, verb)
        async with asyncio.timeout(60):  # nowhere near the ten minutes
            await s.hub.idle(experiment.id)
        assert (await s.store.proposal(proposal.id)).close_reason is CloseReason.WITHDRAWN
        assert await labels(s, experiment.id) == []
        if verb != "finish":
            if verb == "halt":
                await s.hub.act(experiment.id, "rearm")
            await s.hub.act(experiment.id, "resume")
            assert (await s.proposal(number=2)).id != proposal.id


async def test_a_reset_gives_a_thinking_teacher_another_proposal(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="delayed", teacher_settings={"delay": 600.0})
        await s.hub.act(experiment.id, "start")
        first = await s.proposal()
        await s.hub.act(experiment.id, "reset")
        second = await s.proposal(number=2)
        assert second.episode == first.episode + 1


async def test_a_teacher_slower_than_the_time_out_loses_the_proposal(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        slow = {"delay": 600.0, "delay_spread": 0.0}
        experiment = await s.experiment(teacher="delayed", teacher_settings=slow, feedback_timeout=0.05)
        await s.hub.act(experiment.id, "start")
        await s.proposal(number=3)
        closed = s.seen.of(ProposalClosed)
        assert {event.proposal.close_reason for event in closed} == {CloseReason.TIMED_OUT}
        assert await labels(s, experiment.id) == []


async def test_a_delayed_teacher_says_what_a_quick_one_says(tmp_path: Path) -> None:
    async with stage(tmp_path / "quick") as s:
        quick = await taught(s, 10, teacher="synthetic", seed=2)
    async with stage(tmp_path / "slow") as s:
        slow = {"delay": 0.01, "delay_spread": 1.0}
        assert await taught(s, 10, teacher="delayed", teacher_settings=slow, seed=2) == quick


class Critic:
    """What a teacher by a critic would be: it needs what the protocol hands over, and nothing else."""

    def take(self, q: QFunction) -> None:
        self._q = q

    def judge(self, case: Case) -> Judgement:
        assert case.low_level is not None
        return Judgement(1 if self._q(case.low_level, np.array(case.call.parameters)) > 0 else -1)


def test_the_protocol_has_room_for_a_teacher_by_a_critic() -> None:
    critic = Critic()
    by_value: Teacher = critic
    assert isinstance(critic, Oracle)
    assert not isinstance(teacher("synthetic", registry.task("stacking"), SyntheticSettings().model_dump()), Oracle)
    critic.take(lambda state, action: float(state[0] - action[0]))
    state, low_level = np.array(START["stacking"]), np.array([0.6, 0.0, 0.0, 0.0, *START["stacking"]])
    call = SkillCall("pick", (0.5, 0.0, -0.09))
    assert by_value.judge(Case(state, call, judging(0, 1), low_level)).value == 1
    assert by_value.judge(Case(state, call, judging(0, 1), low_level - 0.2)).value == -1
