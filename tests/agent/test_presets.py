"""Every preset, on real tasks: it repeats exactly, resumes exactly, forgets without a trace and stays in bounds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch

from agent.algorithm import Algorithm, CheckpointError, Label, Suggestion
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from robot_adapters.base import check_call
from tests.agent.problems import judged, of_task

FEW: dict[str, Any] = {"hidden_size": 16, "batch_size": 16, "train_frequency": 1, "gradient_steps": 2}


def of_preset(preset: str, task: str, number: int = 0) -> Seed:
    learner = SEED(of_task(task), SeedSettings(**{**SEED.presets[preset], **FEW}), number)
    assert isinstance(learner, Seed)
    return learner


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def work_off(learner: Algorithm) -> None:
    while learner.owed_updates:
        learner.update()


def drawn(learner: Seed, states: Sequence[Label]) -> list[Suggestion]:
    """Proposals in the states of some labels, sampled and deterministic."""
    return [learner.propose(label.state, deterministic=sure) for label in states for sure in (False, True)]


preset_and_task = pytest.mark.parametrize(
    ("preset", "task"),
    [(preset, task) for preset in SEED.presets for task in ("stacking", "reaching", "collecting_toy")],
)


@preset_and_task
def test_a_preset_repeats_and_resumes_bit_for_bit(preset: str, task: str, tmp_path: Path) -> None:
    stored = judged(task, 40)
    learner, twin = of_preset(preset, task), of_preset(preset, task)
    for each in (learner, twin):
        each.add(stored[:20])
        drawn(each, stored[:2])
        for _ in range(13):
            each.update()
    learner.save(tmp_path / "a.ckpt")
    other = of_preset(preset, task, number=99)
    other.load(tmp_path / "a.ckpt")
    other.restore(stored[:20])
    before = drawn(learner, stored[:3])
    assert drawn(twin, stored[:3]) == before
    assert drawn(other, stored[:3]) == before
    for each in (learner, twin, other):
        each.add(stored[20:])
        work_off(each)
    after = drawn(learner, stored[-3:])
    assert drawn(twin, stored[-3:]) == after
    assert drawn(other, stored[-3:]) == after
    for ours, theirs in zip(learner._networks.parameters(), other._networks.parameters(), strict=True):
        assert torch.equal(ours, theirs)


@preset_and_task
def test_a_preset_forgets_without_a_trace(preset: str, task: str, tmp_path: Path) -> None:
    stored, learner = judged(task, 30), of_preset(preset, task)
    learner.add(stored)
    learner.forget(7)
    learner.save(tmp_path / "a.ckpt")
    other = of_preset(preset, task, number=1)
    other.load(tmp_path / "a.ckpt")
    other.restore([label for label in stored if label.id != 7])
    work_off(learner)
    work_off(other)
    assert drawn(learner, stored[5:8]) == drawn(other, stored[5:8])


@preset_and_task
def test_a_preset_looks_without_disturbing_and_stays_in_bounds(preset: str, task: str) -> None:
    stored, looked, plain = judged(task, 20), of_preset(preset, task), of_preset(preset, task)
    for each in (looked, plain):
        each.add(stored)
        work_off(each)
    looked.propose(stored[0].state, deterministic=True)
    assert [looked.propose(label.state) for label in stored] == [plain.propose(label.state) for label in stored]
    for suggestion in drawn(looked, stored):
        check_call(suggestion.call, of_task(task).skills)
        assert sum(suggestion.skill_probabilities.values()) == pytest.approx(1)


def test_a_checkpoint_of_another_grounding_is_refused(tmp_path: Path) -> None:
    of_preset("recommended", "stacking").save(tmp_path / "a.ckpt")
    settings = SeedSettings(**{**SEED.presets["recommended"], **FEW, "grounded_actor": False})
    with pytest.raises(CheckpointError, match="grounded_actor: file has"):
        SEED(of_task("stacking"), settings, 0).load(tmp_path / "a.ckpt")


@preset_and_task
def test_a_preset_learns_from_corrections_as_if_they_had_been_said_at_once(preset: str, task: str) -> None:
    stored = judged(task, 40)
    known = {label.id: label for label in stored}
    changed = {label_id: replace(known[label_id], value=-known[label_id].value) for label_id in (3, 8, 21)}
    right = [changed.get(label.id, label) for label in stored if label.id != 30]
    learner, twin = of_preset(preset, task), of_preset(preset, task)
    learner.add(stored[:20])
    learner.forget(30)  # not there yet
    learner.add(stored[20:])
    learner.forget(30)
    learner.forget(8)
    for label in changed.values():
        learner.relabel(label)
    twin.add(right)
    assert len(learner._replay) == len(twin._replay) == 39
    assert learner._replay.counts() == twin._replay.counts()
    for _ in range(10):
        assert learner.update() == twin.update()
    assert drawn(learner, stored[:3]) == drawn(twin, stored[:3])
