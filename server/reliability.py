"""How often each trainer is right, from who said what: Dawid and Skene's model, with known answers where there are any.

Dawid and Skene (1979), "Maximum likelihood estimation of observer error-rates using the EM algorithm". A call is truly
good or bad; each trainer says good, neutral or bad with odds of their own for either. Pseudo-counts keep a trainer of
few labels near the average one, as in Bayesian classifier combination (Kim and Ghahramani, 2012).
"""

from __future__ import annotations

from collections.abc import Mapping
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
    """Who said what: ids of proposal and trainer, and -1, 0 or +1; (N,) each."""

    proposal: NDArray[np.int64]
    trainer: NDArray[np.int32]
    value: NDArray[np.int8]


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
    """truth: (M,) probability that each of the `proposals`, by id, is good. trainers: by their id."""

    proposals: NDArray[np.int64]
    truth: Array
    trainers: Mapping[int, Reliability]


def estimate(said: Said, known: Mapping[int, int], *, correct: float = CORRECT, other: float = OTHER) -> Estimate:
    """The truth of each proposal, and how far each trainer is to be trusted. known: proposal -> +1 or -1."""
    proposals, item = np.unique(said.proposal, return_inverse=True)
    trainers, who = np.unique(said.trainer, return_inverse=True)
    if not len(proposals):
        return Estimate(proposals, np.zeros(0), {})
    fixed = np.array([known.get(proposal, 0) for proposal in proposals.tolist()])
    prior = np.full((2, 3), other)
    prior[0, 0] = prior[1, 2] = correct
    truth = _converged(item, who * 3 + said.value + 1, fixed, np.tile(prior, len(trainers)))
    informative = (said.value != 0) & ((np.bincount(item) > 1) | (fixed != 0))[item]
    right = np.where(said.value > 0, truth[1, item], truth[0, item])
    labels = np.bincount(who)
    count, expected = (np.bincount(who[informative], w, len(trainers)) for w in (None, right[informative]))
    return Estimate(
        proposals,
        truth[1],
        {
            trainer: _reliability(int(labels[n]), int(count[n]), float(expected[n]))
            for n, trainer in enumerate(trainers.tolist())
        },
    )


def _converged(item: NDArray[np.intp], word: NDArray[np.intp], fixed: NDArray[np.int64], prior: Array) -> Array:
    """(2, M) probabilities that each proposal is bad and good, after EM.

    item, word: (N,) which proposal, and three times the trainer, plus 0 for bad, 1 for neutral, 2 for good. fixed: (M,)
    answers. prior: (2, words) pseudo-counts by truth.
    """
    size, words = len(fixed), prior.shape[1]
    # each starts as its good and bad labels say
    truth = _clamped(0.5 + np.stack([np.bincount(item[word % 3 == said], minlength=size) for said in (0, 2)]), fixed)
    weight = float(prior.min())
    for _ in range(STEPS):
        counts = (prior + [np.bincount(word, each[item], words) for each in truth]).reshape(2, -1, 3)
        odds = (np.log(counts) - np.log(counts.sum(axis=2, keepdims=True))).reshape(2, -1)
        share = np.log(truth.sum(axis=1, keepdims=True) + weight) - np.log(size + 2 * weight)
        evidence = share + [np.bincount(item, each[word], size) for each in odds]
        updated = _clamped(np.exp(evidence - evidence.max(axis=0)), fixed)
        change = float(np.abs(updated - truth).max())
        truth = updated
        if change < CLOSE:
            break
    return truth


def _clamped(truth: Array, fixed: NDArray[np.int64]) -> Array:
    truth = truth / truth.sum(axis=0)
    truth[:, fixed < 0] = ((1.0,), (0.0,))
    truth[:, fixed > 0] = ((0.0,), (1.0,))
    return truth


def _reliability(labels: int, informative: int, right: float) -> Reliability:
    interval = wilson(min(right, informative), informative) if informative else None
    return Reliability(labels, informative, right, interval)
