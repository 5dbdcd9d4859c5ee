"""A learner that gets its newest labels first and the older ones later is in the end as if it always had them all."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch

from agent.algorithm import Recollecting
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from tests.agent.problems import labels, problem

STATE = np.array([0.5, 1.0, 1.5])
STORED = labels(60)


def resumed(path: Path) -> Seed:
    """From a checkpoint that has heard labels 1 to 40, and nothing else."""
    torch.set_num_threads(1)
    small = {**SEED.presets["recommended"], "hidden_size": 16, "batch_size": 16, "gradient_steps": 2}
    learner = SEED(problem(), SeedSettings(**small), 0)
    assert isinstance(learner, Seed)
    if not path.exists():
        learner.add(STORED[:40])
        while learner.owed_updates:
            learner.update()
        learner.save(path)
    learner.load(path)
    return learner


@pytest.mark.parametrize("newest", [5, 20, 35])
def test_older_labels_that_come_later_make_no_difference(newest: int, tmp_path: Path) -> None:
    at_once, later = resumed(tmp_path / "a.ckpt"), resumed(tmp_path / "a.ckpt")
    assert isinstance(later, Recollecting)
    at_once.restore(STORED)
    later.restore(STORED[-newest:])
    rest = STORED[:-newest]
    for end in range(len(rest), 0, -10):
        later.recollect(rest[max(0, end - 10) : end])
    assert later.owed_updates == at_once.owed_updates == 2 * 20, "those newer than the checkpoint, whenever they come"
    assert later.last_label_id == at_once.last_label_id == 60
    assert [later.update() for _ in range(5)] == [at_once.update() for _ in range(5)]
    assert later.propose(STATE) == at_once.propose(STATE)


def test_what_was_corrected_or_taken_back_meanwhile_stays_so(tmp_path: Path) -> None:
    at_once, later = resumed(tmp_path / "a.ckpt"), resumed(tmp_path / "a.ckpt")
    corrected = STORED[9].__class__(10, STATE, STORED[9].call, 1)
    at_once.restore([*STORED[:9], corrected, *STORED[10:-1]])
    later.restore(STORED[30:])
    later.forget(60)
    later.relabel(corrected)  # before it came
    later.recollect([*STORED[:30], STORED[-1]])
    assert [later.update() for _ in range(5)] == [at_once.update() for _ in range(5)]
    assert later.propose(STATE) == at_once.propose(STATE)
