"""Interquartile mean with a bootstrap interval, beside the paper's mean and standard error. By SciPy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array

CONFIDENCE = 0.95
RESAMPLES = 2000
"""Of rliable's order (Agarwal et al., 2021, use 2,000 for curves); the interval's ends then move by under a percent."""


@dataclass(frozen=True)
class Summary:
    """n seeds at one point.

    sem: standard error of the mean. low, high: ends of the bootstrap interval of the interquartile mean. These are
    None from one seed, of which nothing says how much it spreads.
    """

    n: int
    mean: float
    sem: float | None
    iqm: float
    low: float | None
    high: float | None


def summary(values: Array) -> Summary:
    """Sum up (n,) values, one a seed.

    Raises:
        ValueError: there is none, or one is not finite.
    """
    (only,) = summaries(np.asarray(values, dtype=np.float64)[:, None])
    return only


def summaries(values: Array) -> list[Summary]:
    """Sum up (n, m): n seeds at each of m points; every point is resampled with the same dice.

    Raises:
        ValueError: there are no seeds, or a value is not finite.
    """
    # over half a second to import: not in a process that only lists studies
    from scipy import stats  # noqa: PLC0415

    n = len(values)
    if n == 0 or not np.isfinite(values).all():
        raise ValueError(f"{n} values, of which {int(np.isfinite(values).sum())} are finite")
    mean, middle = values.mean(axis=0), stats.trim_mean(values, 0.25, axis=0)
    if n == 1:
        return [Summary(1, float(m), None, float(q), None, None) for m, q in zip(mean, middle, strict=True)]
    sem = stats.sem(values, axis=0)
    found = stats.bootstrap(
        (values,),
        lambda sample, axis: stats.trim_mean(sample, 0.25, axis=axis),
        axis=0,
        vectorized=True,
        confidence_level=CONFIDENCE,
        n_resamples=RESAMPLES,
        method="percentile",  # as rliable does; BCa is undefined where all seeds agree, which is where we want to end
        rng=np.random.default_rng(0),
    ).confidence_interval
    columns = np.stack([mean, sem, middle, found.low, found.high], axis=1)
    return [Summary(n, *map(float, column)) for column in columns]
