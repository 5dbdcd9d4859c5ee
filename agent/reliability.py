"""How far each trainer can be believed, from nothing but what several trainers said of like calls.

Nobody knows the right answers. But what is right is right nearby too: a call that is good stays good some millimetres
aside. So a label is compared with what the other labels around it let expect, whoever gave them; whose labels are
seldom what was to be expected counts for less, and then so do expectations that rest on them (as in Raykar et al.,
"Learning from crowds", 2010, with neighbours in the place of a classifier). Repeating oneself proves nothing: a
trainer's own labels of the very same spot are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from agent.replay import Float32, Int64

AROUND = 4.0
"""How far neighbours are looked for, in units of the consensus tolerance."""
PRIOR = (4.0, 1.0)
"""Labels that a trainer is credited with beforehand, as expected and not."""
ROUNDS = 10
"""Each round weighs the expectations by what the one before made of the trainers."""
MOST = 0.95
"""No trainer is believed more than this to be right."""
LEAST = 0.55
"""Nor less than this: who is always wrong isn't taken for an oracle, and one alone is still listened to."""


@dataclass(frozen=True)
class Likeness:
    """Labels of one option. rows: (N,) which. apart: (N, N), 1 where two calls are just alike."""

    rows: Int64
    apart: Float32


def weights(likenesses: Sequence[Likeness], values: NDArray[np.int8], trainers: Int64) -> NDArray[np.float64]:
    """(B,) what each label's vote weighs: 1 if it is of the trainer who can be believed most.

    values: (B,) -1, 0, +1. trainers: (B,) whose they are.
    """
    names, whose = np.unique(trainers, return_inverse=True)
    if len(names) < 2:
        return np.ones(len(values))
    right = np.full(len(names), PRIOR[0] / sum(PRIOR))
    kernels = [(each.rows, _heard(each, whose[each.rows])) for each in likenesses]
    votes = values.astype(np.float64)
    for _ in range(ROUNDS):
        weight = np.log(right / (1.0 - right))
        agreed = np.zeros(len(names))
        counted = np.zeros(len(names))
        for rows, heard in kernels:
            expected = np.tanh(0.5 * (heard @ (weight[whose[rows]] * votes[rows])))
            sure = np.abs(expected) * (votes[rows] != 0)
            np.add.at(agreed, whose[rows], sure * (expected * votes[rows] > 0))
            np.add.at(counted, whose[rows], sure)
        right = np.clip((agreed + PRIOR[0]) / (counted + sum(PRIOR)), LEAST, MOST)
    weight = np.log(right / (1.0 - right))
    told: NDArray[np.float64] = (weight / weight.max())[whose]
    return told


def _heard(likeness: Likeness, whose: NDArray[np.intp]) -> NDArray[np.float64]:
    """(N, N) how much a label lets expect of another."""
    apart = likeness.apart.astype(np.float64)
    heard: NDArray[np.float64] = np.exp(-0.5 * np.maximum(apart - 1.0, 0.0)) * (apart <= AROUND)
    heard[(whose[:, None] == whose) & (apart <= 1.0)] = 0.0
    return heard
