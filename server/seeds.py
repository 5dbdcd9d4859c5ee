"""Randomness that a run can be repeated with: all of it comes from the experiment's seed and a number."""

from __future__ import annotations

import numpy as np

_JUDGING, _AUDITING, _GOLD, _PRACTICE = 1, 2, 3, 4


def episode_seed(experiment_seed: int, number: int) -> int:
    """The seed of an episode: the same for the same experiment seed and episode number, unrelated between any two."""
    return int(np.random.SeedSequence([experiment_seed, number]).generate_state(1)[0]) >> 1


def judging(experiment_seed: int, number: int) -> np.random.Generator:
    """A synthetic trainer's dice for the proposal of this number: after a restart they fall as they would have."""
    return np.random.default_rng(np.random.SeedSequence([experiment_seed, number, _JUDGING]))


def auditing(experiment_seed: int, block: int) -> np.random.Generator:
    """The lot that draws which proposal of a block is held back to check the critic."""
    return np.random.default_rng(np.random.SeedSequence([experiment_seed, block, _AUDITING]))


def gold(experiment_seed: int, number: int) -> np.random.Generator:
    """The lot that draws whether the proposal of this number measures trainers instead of moving anything."""
    return np.random.default_rng(np.random.SeedSequence([experiment_seed, number, _GOLD]))


def practice(experiment_seed: int, trainer: int, number: int) -> np.random.Generator:
    """What a trainer's practice proposal of this number is made from."""
    return np.random.default_rng(np.random.SeedSequence([experiment_seed, trainer, number, _PRACTICE]))
