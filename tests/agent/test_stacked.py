"""Learners trained in one pass learn what each would learn alone, whoever else is in it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from agent.algorithm import AgentError, Label
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from agent.stacked import StackedSeeds
from tests.agent.problems import judged, of_task

SMALL: dict[str, Any] = {"hidden_size": 16, "batch_size": 16, "gradient_steps": 3}
SEEDS = (4, 5, 6)
CLOSE = 1e-4
"""Rounding, after some twenty steps of Adam, whose first ones turn any small difference into one of its step size."""


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def settings(preset: str, **more: Any) -> SeedSettings:
    return SeedSettings(**{**SEED.presets[preset], **SMALL, **more})


def alone(preset: str, task: str, given: list[list[Label]], seed: int) -> Seed:
    learner = Seed(of_task(task), settings(preset), seed)
    for part in given:
        learner.add(part)
        while learner.owed_updates:
            learner.update()
    return learner


def assert_alike(one: Seed, other: Seed) -> None:
    assert one.policy_version == other.policy_version
    for (name, ours), (_, theirs) in zip(
        one._networks.named_parameters(), other._networks.named_parameters(), strict=True
    ):
        torch.testing.assert_close(ours, theirs, rtol=10 * CLOSE, atol=CLOSE, msg=name)


@pytest.mark.parametrize(("preset", "task"), [("paper_sim", "stacking"), ("recommended", "cooking_hotdog")])
def test_each_learns_what_it_would_learn_alone(preset: str, task: str) -> None:
    """Each from labels of its own."""
    given = [[judged(task, 6, seed=seed)[:3], judged(task, 6, seed=seed)[3:]] for seed in SEEDS]
    stack = StackedSeeds.fresh(of_task(task), settings(preset), SEEDS)
    for part in (0, 1):
        for learner, labels in zip(stack.learners, given, strict=True):
            learner.add(labels[part])
        stack.work_off()
    state = judged(task, 1, seed=9)[0].state
    for learner, labels, seed in zip(stack.learners, given, SEEDS, strict=True):
        single = alone(preset, task, labels, seed)
        assert learner.policy_version == 18
        assert_alike(learner, single)
        ours, theirs = (each.propose(state, deterministic=True) for each in (learner, single))
        assert ours.call.skill == theirs.call.skill
        np.testing.assert_allclose(ours.call.parameters, theirs.call.parameters, atol=1e-3)


def test_learners_that_owe_differently_are_trained_apart() -> None:
    given = judged("stacking", 4)
    stack = StackedSeeds.fresh(of_task("stacking"), settings("paper_sim"), SEEDS)
    first, second, third = stack.learners
    for learner in (first, second):
        learner.add(given[:2])
    assert [told is None for told in stack.update()] == [False, False, True]
    stack.work_off()
    second.add(given[2:])
    third.add(given[:2])
    stack.work_off()
    assert [learner.policy_version for learner in stack.learners] == [6, 12, 6]
    assert_alike(first, alone("paper_sim", "stacking", [given[:2]], SEEDS[0]))
    assert_alike(second, alone("paper_sim", "stacking", [given[:2], given[2:]], SEEDS[1]))
    assert_alike(third, alone("paper_sim", "stacking", [given[:2]], SEEDS[2]))


def test_a_learner_leaves_the_stack_as_it_is(tmp_path: Path) -> None:
    """It may go on alone, be saved, and be loaded; the others learn on as if it were there."""
    given = judged("stacking", 4)
    stack = StackedSeeds.fresh(of_task("stacking"), settings("paper_sim"), SEEDS[:2])
    for learner in stack.learners:
        learner.add(given[:2])
    stack.work_off()
    stack.learners[0].save(tmp_path / "a.ckpt")
    for learner in stack.learners:
        learner.add(given[2:])
    stack.learners[0].update()
    stack.work_off()
    other = Seed(of_task("stacking"), settings("paper_sim"), 99)
    other.load(tmp_path / "a.ckpt")
    other.restore(given)
    while other.owed_updates:
        other.update()
    assert_alike(other, stack.learners[0])
    assert_alike(stack.learners[1], alone("paper_sim", "stacking", [given[:2], given[2:]], SEEDS[1]))


def test_a_diverged_learner_stops_the_pass_before_anything_changed() -> None:
    stack = StackedSeeds.fresh(of_task("stacking"), settings("paper_sim"), SEEDS[:2])
    for learner in stack.learners:
        learner.add(judged("stacking", 2))
    stack.update()
    with torch.no_grad():
        stack.learners[1]._networks.log_parameter_temperature.fill_(1e30)
    before = [p.clone() for p in stack.learners[0]._networks.parameters()]
    with pytest.raises(AgentError, match="diverged at gradient step 1"):
        stack.update()
    assert all(torch.equal(a, b) for a, b in zip(before, stack.learners[0]._networks.parameters(), strict=True))
    assert stack.learners[0].policy_version == 1


def test_nobody_owes_anything_at_the_start() -> None:
    stack = StackedSeeds.fresh(of_task("stacking"), settings("paper_sim"), SEEDS)
    assert stack.update() == [None, None, None]


def test_a_batch_drawn_with_others_is_the_one_drawn_alone() -> None:
    """Bit for bit, moved and mirrored as it would be: each has its own dice."""
    stack = StackedSeeds.fresh(of_task("collecting_toy"), settings("recommended"), SEEDS)
    singles = [Seed(of_task("collecting_toy"), settings("recommended"), seed) for seed in SEEDS]
    for seed, learner, single in zip(SEEDS, stack.learners, singles, strict=True):
        for each in (learner, single):
            each.add(judged("collecting_toy", 5, seed=seed))
    for (batch, noise), single in zip(Seed.drawn(stack.learners), singles, strict=True):
        expected, dice = single.draw()
        assert torch.equal(noise, dice)
        for name in ("states", "skills", "parameters", "targets", "keypoints"):
            np.testing.assert_array_equal(getattr(batch, name), getattr(expected, name), err_msg=name)
