"""Reliability and Wilson's interval against values computed by hand."""

from __future__ import annotations

import pytest

from agent.trust import reliability, wilson


def test_reliability_is_the_mean_label_of_each_bin_and_the_error_their_weighted_gap() -> None:
    judged = [(-0.9, -1.0), (-0.85, -1.0), (0.1, 0.0), (0.7, 1.0), (0.9, 1.0), (0.9, -1.0)]
    told = reliability(judged)
    assert [b.low for b in told.bins] == pytest.approx([-1.0, 0.0, 0.6, 0.8])
    assert [b.high for b in told.bins] == pytest.approx([-0.8, 0.2, 0.8, 1.0])
    assert [b.count for b in told.bins] == [2, 1, 1, 2]
    assert [b.predicted for b in told.bins] == pytest.approx([-0.875, 0.1, 0.7, 0.9])
    assert [b.label for b in told.bins] == pytest.approx([-1.0, 0.0, 1.0, 0.0])
    # (2 * 0.125 + 1 * 0.1 + 1 * 0.3 + 2 * 0.9) / 6
    assert told.error == pytest.approx(2.45 / 6)
    assert told.count == 6


def test_neutral_counts_as_the_zero_that_the_critic_is_trained_on() -> None:
    # half neutral, half good: a critic that predicts 0.5 is calibrated, though no label is 0.5
    assert reliability([(0.5, 0.0), (0.5, 1.0)]).error == 0.0
    # neither good nor bad, always: a prediction of 0 is right
    assert reliability([(0.0, 0.0)] * 3).error == 0.0


def test_every_prediction_is_in_one_bin_also_at_and_beyond_the_borders() -> None:
    told = reliability([(-1.0, -1), (-1.4, -1), (0.0, 0), (1.0, 1), (1.3, 1)], bins=2)
    assert [(b.low, b.high, b.count) for b in told.bins] == [(-1.0, 0.0, 2), (0.0, 1.0, 3)]
    assert [b.predicted for b in told.bins] == pytest.approx([-1.2, 2.3 / 3])
    assert [b.label for b in told.bins] == pytest.approx([-1.0, 2 / 3])


def test_without_predictions_nothing_is_claimed() -> None:
    told = reliability([])
    assert (told.bins, told.count, told.error) == ((), 0, None)


@pytest.mark.parametrize(
    ("successes", "count", "low", "high"),
    # 9 of 10 and 0 of 10 are the values that tables print
    [(9, 10, 0.5958, 0.9821), (0, 10, 0.0, 0.2775), (10, 10, 0.7225, 1.0), (0, 1, 0.0, 0.7935), (0, 0, 0.0, 1.0)],
)
def test_wilson(successes: int, count: int, low: float, high: float) -> None:
    assert wilson(successes, count) == pytest.approx((low, high), abs=1e-4)


def test_wilson_reaches_exactly_to_the_end_where_all_trials_agree() -> None:
    for count in range(1, 501):
        assert wilson(count, count)[1] == 1.0
        assert wilson(0, count)[0] == 0.0


def test_wilson_refuses_what_is_no_share() -> None:
    for successes, count in ((3, 2), (-1, 2)):
        with pytest.raises(ValueError, match="no share"):
            wilson(successes, count)
