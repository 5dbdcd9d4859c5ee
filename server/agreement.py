"""How far trainers agree: Krippendorff's alpha over good, neutral and bad, whoever judged what.

Krippendorff (2011), "Computing Krippendorff's Alpha-Reliability". A few lines of our own: the package `krippendorff`,
to which a test holds them, makes nine numbers of each proposal, several times over.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

VALUES = (-1, 0, 1)
"""In their order: bad and good are further apart than either is from neutral."""

Ints = NDArray[np.int64] | NDArray[np.int32] | NDArray[np.int8]


@dataclass(frozen=True)
class Agreement:
    """alpha: 1 is perfect, 0 what chance gives, negative worse; None where `why` says that it can't be told.

    proposals: those that two or more trainers judged; labels: their labels; trainers: whose.
    """

    alpha: float | None
    proposals: int
    labels: int
    trainers: int
    why: str | None = None


def agreement(proposal: Ints, trainer: Ints, value: Ints) -> Agreement:
    """Ordinal alpha of what each trainer said of a proposal, one word each (`store_clicks.words`).

    Each (N,): ids, and -1, 0 or +1. Who can't tell, or wasn't there, is missing.
    """
    _, item = np.unique(proposal, return_inverse=True)
    counts = how_many(item, value)
    pairable = counts.sum(axis=1) > 1
    heard = trainer[pairable[item]]
    counts = counts[pairable]
    of = (len(counts), int(counts.sum()), len(np.unique(heard)))
    if not len(counts):
        return Agreement(None, *of, "no proposal was judged by two trainers yet")
    if np.count_nonzero(counts.sum(axis=0)) < 2:
        return Agreement(None, *of, "all labels are the same: whether that is agreement or habit can't be told")
    return Agreement(ordinal_alpha(counts), *of)


def how_many(of: NDArray[np.int64], value: Ints) -> NDArray[np.int64]:
    """(M, 3): how often -1, 0 and +1 were said of each of 0..M-1."""
    size = int(of.max()) + 1 if len(of) else 0
    return np.bincount(of * len(VALUES) + value + 1, minlength=size * len(VALUES)).reshape(size, len(VALUES))


def ordinal_alpha(counts: NDArray[np.int64]) -> float:
    """Of how many said each value, values ascending: (units, values), two or more a unit, and not all the same."""
    shares = counts / (counts.sum(axis=1, keepdims=True) - 1)
    together = counts.T @ shares - np.diag(shares.sum(axis=0))
    total = together.sum(axis=0)
    by_chance = (np.outer(total, total) - np.diag(total)) / (total.sum() - 1)
    middle = np.cumsum(total) - total / 2
    apart = np.subtract.outer(middle, middle) ** 2
    return float(1 - (together * apart).sum() / (by_chance * apart).sum())
