"""What trainers seldom give but a lab does: a foreign checkpoint, a hidden object, sparse tasks, odd labels."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from agent.config import SEED, SeedSettings
from server.schemas import Lifecycle
from server.schemas_together import Looked
from server.store_curves import curves
from server.worker import CommandFailed, Worker
from tests.agent.problems import of_task
from tests.server.stage import PATIENCE, SMALL, Stage, stage


async def failure(s: Stage, experiment_id: int) -> str:
    await s.hub.idle(experiment_id)
    view = await s.hub.view(experiment_id)
    assert view.lifecycle is Lifecycle.FAILED
    return str(view.failure)


@pytest.mark.usefixtures("plugins")
async def test_a_state_with_a_hole_fails_by_name_and_goes_on_once_it_is_seen(tmp_path: Path) -> None:
    flag = tmp_path / "hidden"
    async with stage(tmp_path / "data") as s:
        settings = {"flag": str(flag), "draw": False}
        experiment = await s.experiment(adapter="blinded", adapter_settings=settings)
        await s.hub.act(experiment.id, "start")
        first = await s.proposal()
        flag.touch()
        await s.judge(first, 1)  # the robot moves, so it looks again
        why = await failure(s, experiment.id)
        assert "block_b_position[1] = nan" in why
        assert "check what perceives this value" in why
        flag.unlink()
        at = s.now
        await s.hub.act(experiment.id, "resume")
        second = await s.proposal(at)
        assert (await s.hub.view(experiment.id)).counters.feedback == 1
        assert all(abs(x) < 10 for x in second.state)


def of_another_task(path: Path) -> None:
    SEED(of_task("reaching"), SeedSettings.model_validate(SMALL), 0).save(path)


def of_another_architecture(path: Path) -> None:
    SEED(of_task("stacking"), SeedSettings.model_validate(SMALL | {"hidden_size": 32}), 0).save(path)


def of_another_version(path: Path) -> None:
    contents = bytearray(path.read_bytes())
    contents[8] += 1  # behind the magic
    path.write_bytes(contents)


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (of_another_task, "task: file has reaching, wanted stacking"),
        (of_another_architecture, "hidden: file has [32, 32], wanted [16, 16]"),
        (of_another_version, "has the format version 2, this program reads 1"),
    ],
)
async def test_a_checkpoint_of_something_else_is_told_and_the_labels_rebuild_the_learner(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spoil: Callable[[Path], None], told: str
) -> None:
    monkeypatch.setattr("server.recollection.LABELS_AT_ONCE", 1)  # as a million come, in parts
    async with stage(tmp_path) as s:
        experiment = await s.experiment(teacher="synthetic")
        await s.hub.act(experiment.id, "start", until=2)
        await s.hub.idle(experiment.id)
        [path] = sorted((tmp_path / "checkpoints" / str(experiment.id)).iterdir())
        spoil(path)
    async with stage(tmp_path) as s:
        await s.hub.act(experiment.id, "resume", until=4)
        await s.hub.idle(experiment.id)
        assert (await s.hub.view(experiment.id)).counters.feedback == 4
        # the steps of the first two labels were taken again, and those of the third, before the fourth proposal
        assert (await s.store.proposals(experiment.id)).items[0].policy_version == 15
        events = (await s.store.events(experiment.id, limit=200)).items
        [unusable] = [event for event in events if event.kind == "checkpoint_unusable"]
        assert told in unusable.payload["detail"]


@pytest.mark.usefixtures("plugins")
async def test_a_task_whose_one_skill_has_no_parameters_is_judged_moved_and_charted(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(task="waving", lockstep=True)
        await s.hub.act(experiment.id, "start")
        for number, value in ((1, -1), (2, 1), (3, -1)):
            proposal = await s.proposal(number=number)
            assert (proposal.skill, proposal.parameters) == ("release", {})
            assert [(view.overlay.dot, view.overlay.line) for view in proposal.views] == [(None, None)] * 2
            await s.judge(proposal, value)
        await s.proposal(number=4)
        [moved] = (await s.store.executions(experiment.id)).items
        assert (moved.skill, moved.parameters, moved.outcome) == ("release", {}, "succeeded")
        drawn = await s.store.read(lambda session: curves(session, experiment.id, 100))
        assert {"critic_loss", "skills", "good_share"} <= {chart.name for chart in drawn.charts}
        assert [curve.name for chart in drawn.charts if chart.name == "skills" for curve in chart.curves] == ["release"]


@pytest.mark.parametrize(("preset", "when_good"), [("paper_sim", 20), ("recommended", 2)])
async def test_who_calls_everything_bad_and_then_everything_good_is_still_proposed_to(
    tmp_path: Path, preset: str, when_good: int
) -> None:
    """when_good: how many proposals differ at least; `recommended` makes again what is good in this very scene."""
    async with stage(tmp_path) as s:
        experiment = await s.experiment(preset=preset, mode="propose_only", lockstep=True)
        await s.hub.act(experiment.id, "start")
        for value, different in ((-1, 20), (1, when_good)):
            proposed = set()
            for _ in range(30):
                proposal = await s.proposal(number=(await s.hub.view(experiment.id)).counters.feedback + 1)
                proposed.add(proposal.digest)
                await s.judge(proposal, value)
            assert len(proposed) >= different, value
        view = await s.hub.view(experiment.id)
        assert (view.lifecycle, view.counters.good, view.counters.bad) == (Lifecycle.RUNNING, 30, 30)


async def test_a_label_for_the_proposal_of_an_old_policy_is_kept_and_teaches_nothing(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(mode="propose_only", lockstep=True)
        await s.hub.act(experiment.id, "start")
        old = await s.proposal()
        given = await s.judge(old, -1)
        new = await s.proposal(number=2)
        assert (new.observation_id, new.policy_version) == (old.observation_id, old.policy_version + 5)
        looked = Looked(observation_id=new.observation_id, policy_version=old.policy_version)
        late, _ = await s.hub.feedback(new.id, s.click(1).model_copy(update={"looked": looked}))
        assert (late.status, late.late_because) == ("late", "it was made for a proposal of another policy")
        assert await s.store.open_proposals(experiment.id) == [new]
        assert [label.feedback_id for label in await s.store.labels(experiment.id)] == [given.id]
        looked = Looked(observation_id=new.observation_id, policy_version=new.policy_version)
        await s.hub.feedback(new.id, s.click(1).model_copy(update={"looked": looked}))
        third = await s.proposal(number=3)
        assert third.policy_version == new.policy_version + 5, "it learned from one of the two"
        counters = (await s.hub.view(experiment.id)).counters
        assert (counters.feedback, counters.good, counters.bad, counters.late) == (2, 1, 1, 1)


async def test_cuda_asked_for_where_there_is_none_is_told_with_the_setting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CUDA_VISIBLE_DEVICES", "")
    learner = await Worker.spawn("learner", "server.workers.learner")
    try:
        built = {"task": "stacking", "algorithm": "seed", "settings": SMALL, "seed": 0, "lockstep": True, "threads": 1}
        with pytest.raises(CommandFailed, match="SEED_LEARNER_DEVICE is cuda") as error:
            await learner.call("configure", deadline=PATIENCE, device="cuda", **built)
        assert "auto or cpu" in error.value.remedy
        await learner.call("configure", deadline=PATIENCE, device="auto", **built)
    finally:
        await learner.close()


async def test_labels_that_come_in_parts_are_taken_together_or_not_at_all() -> None:
    learner = await Worker.spawn("learner", "server.workers.learner")
    try:
        built = {"task": "stacking", "algorithm": "seed", "settings": SMALL, "seed": 0, "lockstep": True}
        await learner.call("configure", deadline=PATIENCE, threads=1, device="cpu", **built)
        stored = {"state": [0.5] * 6, "skill": "pick", "parameters": [0.5, 0.0, -0.09], "value": 1, "trainer": 1}
        parts = [[stored | {"id": number} for number in ids] for ids in ((1, 2), (3,), ())]
        bad = [stored | {"id": 4, "skill": "juggle"}]
        await learner.call("restore", deadline=PATIENCE, labels=parts[0], more=True)
        with pytest.raises(CommandFailed, match="feedback 4 doesn't fit"):
            await learner.call("restore", deadline=PATIENCE, labels=bad, more=False)
        taken = [
            await learner.call("restore", deadline=PATIENCE, labels=part, more=more)
            for part, more in zip(parts, (True, True, False), strict=True)
        ]
        assert [told["last_label_id"] for told in taken] == [0, 0, 3]
        assert [told["owed_updates"] for told in taken[:2]] == [0, 0]
        assert taken[2]["owed_updates"] == 3 * SeedSettings.model_validate(SMALL).gradient_steps
    finally:
        await learner.close()


async def test_feedback_about_what_the_task_no_longer_has_is_told() -> None:
    """A task of one's own is edited while its experiment rests: what is stored is about the task as it was."""
    learner = await Worker.spawn("learner", "server.workers.learner")
    try:
        built = {"task": "stacking", "algorithm": "seed", "settings": SMALL, "seed": 0, "lockstep": True}
        built |= {"threads": 1, "device": "cpu"}
        await learner.call("configure", deadline=PATIENCE, **built)
        stored = {"id": 7, "state": [0.5] * 6, "skill": "pick", "parameters": [0.5, 0.0, -0.09]}
        stored |= {"value": 1, "trainer": 1}
        for change, told in (
            ({"skill": "juggle"}, "no skill 'juggle'"),
            ({"parameters": [0.5, 0.0]}, "pick takes 3 parameters, got 2"),
            ({"parameters": [0.5, 0.2, -0.09]}, r"pick.y = 0.2 is outside"),
            ({"state": [0.5, 0.0]}, "its state has 2 numbers, the task's has 6"),
        ):
            with pytest.raises(CommandFailed, match=f"feedback 7 doesn't fit the task 'stacking': .*{told}") as error:
                await learner.call("restore", deadline=PATIENCE, labels=[stored | {"id": 3}, stored | change])
            assert "put it back as it was and resume, or create a new experiment" in error.value.remedy
        restored = await learner.call("restore", deadline=PATIENCE, labels=[stored])
        assert (restored["last_label_id"], restored["owed_updates"]) == (7, 5)
        with pytest.raises(CommandFailed, match=r"not finite: block_b_position\[0\] = nan"):
            await learner.call("propose", deadline=PATIENCE, state=[0.5] * 3 + [math.nan] * 3, deterministic=False)
    finally:
        await learner.close()
