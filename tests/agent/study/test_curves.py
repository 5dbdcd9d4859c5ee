"""Curves of several seeds at common points, and the paper's beside them."""

from __future__ import annotations

import dataclasses

import pytest

from agent.study import paper
from agent.study.curves import abreast, curve
from agent.study.evaluations import Row
from agent.study.plan import SCENARIOS, Axis, Measure


def row(steps: int, succeeded: int = 0, successes: int = 0) -> Row:
    """An evaluation of 10 rollouts after so many low-level steps."""
    return Row(0, steps, steps, 0, 0, successes, 0, 0, 10, succeeded, 0.0)


def test_a_seed_counts_with_its_last_evaluation_and_no_further_than_all_came() -> None:
    quick = [row(0), row(10, 4), row(20, 10)]
    slow = [row(0), row(15, 2)]
    found = curve([quick, slow], Axis.LOW_LEVEL_STEPS, Measure.SUCCESS_RATE)
    assert found is not None
    assert found.x.tolist() == [0, 10, 15]
    assert found.values.tolist() == [[0, 0.4, 0.4], [0, 0, 0.2]]


def test_successes_are_counted_where_the_figure_counts_them() -> None:
    found = curve([[row(0), row(7, 10, successes=3)]], Axis.DECISIONS, Measure.SUCCESSES)
    assert found is not None
    assert found.values.tolist() == [[0, 3]]


def test_runs_far_behind_the_others_are_in_no_curve_yet() -> None:
    def run(evaluations: int) -> list[Row]:
        return [dataclasses.replace(row(10 * number), evaluation=number) for number in range(evaluations + 1)]

    def chosen(*lengths: int) -> list[int]:
        found = abreast([run(length) if length >= 0 else [] for length in lengths], evaluations=8)
        return [rows[-1].evaluation for rows in found]

    assert chosen(-1, -1) == []
    assert chosen(0, 0, -1) == [0, 0]
    assert chosen(5, 3, 2, 0) == [5, 3]
    assert chosen(8, 8, 5, 0) == [8, 8], "what came to its end isn't cut short by what did not"


def test_there_is_no_curve_before_every_seed_was_measured() -> None:
    assert curve([[row(0)], []], Axis.DECISIONS, Measure.SUCCESSES) is None
    assert curve([], Axis.DECISIONS, Measure.SUCCESSES) is None


def test_a_long_run_is_thinned_out_but_keeps_its_end() -> None:
    found = curve([[row(step) for step in range(1000)]], Axis.DECISIONS, Measure.SUCCESSES, points=50)
    assert found is not None
    assert len(found.x) == 51
    assert (found.x[0], found.x[-1]) == (0, 999)


@pytest.mark.parametrize("name", SCENARIOS)
def test_the_papers_curves_lie_within_its_figures(name: str) -> None:
    scenario = SCENARIOS[name]
    found = paper.curves(name)
    assert {each.algorithm for each in found} <= set(scenario.algorithms)
    for each in found:
        assert len(each.x) == len(each.y)
        assert list(each.x) == sorted(each.x)
        assert scenario.measure is Measure.SUCCESSES or max(each.y) <= 1
    # TAMER's line of no success was read to the end of the longest task's axis
    assert max(each.x[-1] for each in found if each.algorithm == "seed") <= scenario.usual_budget


def test_the_paper_says_of_stacking_what_its_text_says() -> None:
    (seed,) = [each for each in paper.curves("stacking") if each.algorithm == "seed"]
    assert dict(zip(seed.x, seed.y, strict=True))[800_000] == 0.95
    assert paper.violation_ratios("sweeping") == {"tamer": 0.0025, "maple-aff": 0.085, "seed": 0.0111}
