"""Statistics against values worked out by hand, and where there is nothing to be worked out."""

from __future__ import annotations

import numpy as np
import pytest

from agent.study.statistics import summaries, summary


def test_the_interquartile_mean_leaves_out_a_quarter_on_either_side() -> None:
    told = summary(np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 100.0]))
    assert told.iqm == pytest.approx((2 + 3 + 4 + 5) / 4)
    assert told.mean == pytest.approx(121 / 8)
    # the square root of the unbiased variance over n
    assert told.sem == pytest.approx(np.std([0, 1, 2, 3, 4, 5, 6, 100], ddof=1) / np.sqrt(8))
    assert told.low is not None
    assert told.high is not None
    assert 0 <= told.low < told.iqm < told.high <= 100


def test_an_interval_covers_what_it_should() -> None:
    # a normal sample: the interval of its trimmed mean is about that of the mean, 1.96 standard errors, or wider
    rng = np.random.default_rng(0)
    told = summary(rng.normal(size=400))
    assert told.low is not None
    assert told.high is not None
    assert told.sem is not None
    assert 1.8 < (told.high - told.low) / 2 / told.sem < 2.6


def test_one_seed_has_no_spread() -> None:
    told = summary(np.array([0.7]))
    assert (told.n, told.mean, told.iqm) == (1, 0.7, 0.7)
    assert (told.sem, told.low, told.high) == (None, None, None)


def test_seeds_that_agree_have_an_interval_of_no_width() -> None:
    told = summary(np.ones(5))
    assert (told.mean, told.sem, told.iqm, told.low, told.high) == (1.0, 0.0, 1.0, 1.0, 1.0)


def test_several_points_are_summed_up_at_once_and_the_same_again() -> None:
    values = np.array([[0.0, 1.0], [1.0, 1.0], [2.0, 1.0]])
    first, second = summaries(values)
    assert first == summary(values[:, 0])
    assert (second.low, second.high) == (1.0, 1.0)


@pytest.mark.parametrize("values", [[], [0.5, float("nan")]])
def test_nothing_and_no_number_are_refused(values: list[float]) -> None:
    with pytest.raises(ValueError, match="finite"):
        summary(np.array(values))
