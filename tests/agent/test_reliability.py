"""Several trainers who don't agree: whom SEED believes, seen by where it goes on looking."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from robot_adapters.base import Array, SkillCall
from tests.agent.problems import judged, of_task

STATE = np.array([0.5, 0.0, 0.1, 0.0])
SPOT = np.array([0.4, -0.1, 0.0])
"""m, far from everything that was judged before."""
STRICT, ODD = 7, 4_000_000_001
"""One whose labels fit together, and one who is against the other's here and there. The numbers mean nothing."""


def seed(**settings: Any) -> Seed:
    """A small one of the preset `recommended`, about Reaching."""
    torch.set_num_threads(1)
    small = {**SEED.presets["recommended"], "hidden_size": 16, "batch_size": 16}
    learner = SEED(of_task("reaching"), SeedSettings(**{**small, **settings}), 0)
    assert isinstance(learner, Seed)
    return learner


def reach(at: Array) -> SkillCall:
    return SkillCall("reach", (float(at[0]), float(at[1]), float(at[2])))


def quarrel() -> list[Label]:
    """Twelve places where both judged: all bad says one, and every other one good, says the other."""
    labels: list[Label] = []
    for number in range(12):
        at = np.array([0.55 + 0.02 * (number % 4), 0.1 + 0.02 * (number // 4), 0.05])
        for trainer, value in ((STRICT, -1), (ODD, 1 if number % 2 else -1)):
            labels.append(Label(len(labels) + 1, STATE, reach(at), value, trainer=trainer))
    return [*labels, Label(len(labels) + 1, STATE, SkillCall("release"), -1, trainer=STRICT)]


def looked_for(learner: Seed, labels: Sequence[Label], spot_by: int) -> float:
    """How far, in m, it is from SPOT, once this trainer called it good, to where the learner wants to go next."""
    learner.add([*labels, Label(99, STATE, reach(SPOT), 1, trainer=spot_by)])
    return float(np.linalg.norm(np.array(learner.propose(STATE).call.parameters) - SPOT))


def test_a_good_label_counts_if_its_trainers_labels_fit_those_around_them() -> None:
    assert looked_for(seed(), quarrel(), STRICT) < 0.03
    assert looked_for(seed(), quarrel(), ODD) > 0.05, "it goes on looking elsewhere"


def test_all_count_the_same_where_that_is_wanted() -> None:
    for trainer in (STRICT, ODD):
        assert looked_for(seed(trainer_reliability=False), quarrel(), trainer) < 0.03


def test_two_doubted_labels_say_as_little_as_one_and_a_believed_one_decides() -> None:
    again = Label(98, STATE, reach(SPOT + 0.002), 1, trainer=ODD)
    assert looked_for(seed(), [*quarrel(), again], ODD) > 0.05
    assert looked_for(seed(), [*quarrel(), again], STRICT) < 0.03


def test_where_trainers_agree_both_are_believed() -> None:
    agreed = [replace(label, value=-1) for label in quarrel()]
    for trainer in (STRICT, ODD):
        assert looked_for(seed(), agreed, trainer) < 0.03


def test_it_is_the_same_after_a_restart_and_a_label_taken_back_no_longer_speaks_against_its_trainer() -> None:
    again = seed()
    again.restore(quarrel())
    assert looked_for(again, (), ODD) > 0.05
    reconciled = seed()
    reconciled.add(quarrel())
    for label in quarrel():
        if label.value == 1:
            reconciled.forget(label.id)
    assert looked_for(reconciled, (), ODD) < 0.03


@pytest.mark.parametrize("trainer", [0, ODD])
def test_with_a_single_trainer_it_changes_nothing(trainer: int) -> None:
    values = [1, -1, -1, 1, 1, -1, 1, -1, -1, -1]
    labels = [replace(each, value=v, trainer=trainer) for each, v in zip(judged("reaching", 10), values, strict=True)]
    proposed = []
    for weighed in (True, False):
        learner = seed(trainer_reliability=weighed)
        learner.add(labels)
        for _ in range(5):
            learner.update()
        proposed.append(learner.propose(STATE))
    assert proposed[0] == proposed[1]
