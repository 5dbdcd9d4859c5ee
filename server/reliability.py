"""How often each trainer is right, from who said what: Dawid and Skene's model, with known answers where there are any.

Dawid and Skene (1979), "Maximum likelihood estimation of observer error-rates using the EM algorithm". A call is truly
good or bad; each trainer says good, neutral or bad with odds of their own for either. Pseudo-counts keep a trainer of
few labels near the average one, as in Bayesian classifier combination (Kim and Ghahramani, 2012).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from agent.trust import wilson

Array = NDArray[np.float64]

CORRECT, OTHER = 2.0, 1.0
"""Pseudo-counts of a right answer, and of each other one: an unknown trainer is right twice as often as wrong."""
STEPS, CLOSE = 200, 1e-7
"""EM steps at most, and how little the probabilities may still change at its end."""


@dataclass(frozen=True)
class Said:
    """One trainer's click on one proposal: -1, 0 or +1."""

    proposal: int
    trainer: int
    value: int


@dataclass(frozen=True)
class Reliability:
    """One trainer's. Informative: good or bad, on a proposal that others judged too, or whose answer is known.

    right: how many of the informative labels are expected to be true; interval: 95 % of their share, None without any.
    """

    labels: int
    informative: int
    right: float
    interval: tuple[float, float] | None

    @property
    def accuracy(self) -> float | None:
        """Share of the informative labels that are expected to be true."""
        return self.right / self.informative if self.informative else None

    @property
    def weight(self) -> float:
        """Probability that the next label is true: the share, drawn towards an unknown trainer's 2/3 by few labels."""
        return (self.right + CORRECT) / (self.informative + CORRECT + OTHER)


@dataclass(frozen=True)
class Estimate:
    """truth: proposal -> probability that it is good. trainers: by their id."""

    truth: Mapping[int, float]
    trainers: Mapping[int, Reliability]


def estimate(
    said: Sequence[Said], known: Mapping[int, int], *, correct: float = CORRECT, other: float = OTHER
) -> Estimate:
    """The truth of each proposal, and how far each trainer is to be trusted. known: proposal -> +1 or -1."""
    if not said:
        return Estimate({}, {})
    proposals, item = np.unique([s.proposal for s in said], return_inverse=True)
    trainers, who = np.unique([s.trainer for s in said], return_inverse=True)
    value = np.array([s.value for s in said])
    fixed = np.array([known.get(int(p), 0) for p in proposals])
    prior = np.full((2, 3), other)
    prior[0, 0] = prior[1, 2] = correct
    truth = _converged(item, who, value, fixed, np.tile(prior, (len(trainers), 1, 1)))
    heard = np.bincount(item)
    informative = (value != 0) & ((heard[item] > 1) | (fixed[item] != 0))
    right = np.where(value > 0, truth[item, 1], truth[item, 0])
    return Estimate(
        {int(p): float(good) for p, good in zip(proposals, truth[:, 1], strict=True)},
        {int(t): _reliability(informative[who == n], right[who == n]) for n, t in enumerate(trainers)},
    )


def _converged(
    item: NDArray[np.intp],
    who: NDArray[np.intp],
    value: NDArray[np.int64],
    fixed: NDArray[np.int64],
    prior: Array,
) -> Array:
    """(N, 2) probabilities that each proposal is bad and good, after EM. prior: counts by trainer, truth, label."""
    # each starts as its good and bad labels say
    truth = np.full((len(fixed), 2), 0.5)
    np.add.at(truth, item, np.stack((value < 0, value > 0), axis=1))
    truth = _clamped(truth, fixed)
    weight = float(prior.min())
    for _ in range(STEPS):
        counts = prior.copy()
        np.add.at(counts.swapaxes(1, 2), (who, value + 1), truth[item])
        odds = np.log(counts) - np.log(counts.sum(axis=2, keepdims=True))
        share = np.log(truth.sum(axis=0) + weight) - np.log(len(truth) + 2 * weight)
        evidence = np.tile(share, (len(truth), 1))
        np.add.at(evidence, item, odds[who, :, value + 1])
        updated = _clamped(np.exp(evidence - evidence.max(axis=1, keepdims=True)), fixed)
        change = float(np.abs(updated - truth).max())
        truth = updated
        if change < CLOSE:
            break
    return truth


def _clamped(truth: Array, fixed: NDArray[np.int64]) -> Array:
    truth = truth / truth.sum(axis=1, keepdims=True)
    truth[fixed < 0] = (1.0, 0.0)
    truth[fixed > 0] = (0.0, 1.0)
    return truth


def _reliability(informative: NDArray[np.bool_], right: Array) -> Reliability:
    count, expected = int(informative.sum()), float(right[informative].sum())
    return Reliability(len(right), count, expected, wilson(min(expected, count), count) if count else None)
