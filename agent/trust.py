"""How far a critic's word may be taken: pure functions over what it predicted and what trainers then said.

No torch and no numpy: the service computes these from its database, a study from its own records.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

BINS = 10
"""Bins of equal width over [-1, 1]: the usual number in reliability diagrams (Guo et al., 2017, use 10 to 15)."""
Z_95 = 1.959964
"""Standard normal quantile of a two-sided 95 % interval."""


@dataclass(frozen=True)
class Bin:
    """Predictions in [low, high), the last one in [low, high]: their number, their mean, and the mean label."""

    low: float
    high: float
    count: int
    predicted: float
    label: float


@dataclass(frozen=True)
class Reliability:
    """bins: those that hold anything, ascending. error: expected calibration error; None without any prediction."""

    bins: tuple[Bin, ...]
    count: int
    error: float | None


def reliability(judged: Sequence[tuple[float, float]], bins: int = BINS) -> Reliability:
    """The reliability curve of (predicted feedback, label) pairs, labels in [-1, 1].

    The critic regresses the label itself (paper, eq. 1), -1, 0 or +1, so what it should predict is the mean label:
    neutral counts as the 0 that it is trained on, nothing is made binary. A prediction beyond [-1, 1] is in the
    outermost bin, with its own value. The error is the mean over all predictions of |mean prediction - mean label| of
    their bin, in units of feedback: from 0 to about 2.
    """
    members: list[list[tuple[float, float]]] = [[] for _ in range(bins)]
    for predicted, label in judged:
        at = math.floor((predicted + 1) / 2 * bins)
        members[min(max(at, 0), bins - 1)].append((predicted, label))
    made = tuple(_bin(number, bins, held) for number, held in enumerate(members) if held)
    count = len(judged)
    error = sum(b.count * abs(b.predicted - b.label) for b in made) / count if count else None
    return Reliability(made, count, error)


def wilson(successes: float, count: int, z: float = Z_95) -> tuple[float, float]:
    """Wilson's score interval of a share: sound for few trials and for shares near 1, where the usual one isn't.

    Raises:
        ValueError: not 0 <= successes <= count.
    """
    if not 0 <= successes <= count:
        raise ValueError(f"{successes} of {count} is no share")
    if count == 0:
        return 0.0, 1.0
    share, square = successes / count, z * z / count
    middle = (share + square / 2) / (1 + square)
    half = z / (1 + square) * math.sqrt(share * (1 - share) / count + square / (4 * count))
    # exact at the ends: rounding would leave n of n a hair below 1, and so below a share of 1 that is asked for
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    high = 1.0 if successes == count else min(1.0, middle + half)
    return low, high


def _bin(number: int, bins: int, held: Sequence[tuple[float, float]]) -> Bin:
    width, count = 2 / bins, len(held)
    return Bin(
        low=-1 + number * width,
        high=-1 + (number + 1) * width,
        count=count,
        predicted=math.fsum(predicted for predicted, _ in held) / count,
        label=math.fsum(label for _, label in held) / count,
    )
