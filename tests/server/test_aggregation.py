"""What votes add up to: worked examples, and properties over every order of votes."""

from __future__ import annotations

import itertools

import pytest

from server.aggregation import verdict
from server.schemas import Aggregation, Verdict

FIRST, MAJORITY, UNANIMOUS = Aggregation.FIRST, Aggregation.MAJORITY, Aggregation.UNANIMOUS
G, N, B = Verdict.GOOD, Verdict.NEUTRAL, Verdict.BAD
NAMES = ("ann", "bob", "cyd", "dan")


@pytest.mark.parametrize(
    ("rule", "electorate", "votes", "expected"),
    [
        (FIRST, 1, (), None),
        (FIRST, 1, (1,), G),
        (FIRST, 3, (-1, 1, 1), B),
        (FIRST, 0, (0,), N),
        (MAJORITY, 1, (1,), G),
        (MAJORITY, 3, (1,), None),
        (MAJORITY, 3, (1, 1), G),  # the third can't change it
        (MAJORITY, 3, (1, -1), None),
        (MAJORITY, 3, (1, -1, -1), B),
        (MAJORITY, 3, (1, -1, 0), N),  # a tie of all
        (MAJORITY, 2, (1, -1), N),  # a tie
        (MAJORITY, 4, (1, 1), None),
        (MAJORITY, 4, (1, 1, -1), None),
        (MAJORITY, 4, (1, 1, -1, -1), N),
        (MAJORITY, 4, (1, 1, -1, 0), N),  # the most votes, but not of more than half
        (MAJORITY, 4, (1, -1, 0), N),  # nobody can get more than half any more
        (UNANIMOUS, 3, (1,), None),
        (UNANIMOUS, 3, (-1,), B),  # one veto
        (UNANIMOUS, 3, (1, -1), B),
        (UNANIMOUS, 3, (1, 1), None),
        (UNANIMOUS, 3, (1, 1, 1), G),
        (UNANIMOUS, 3, (1, 0, 1), N),
        (UNANIMOUS, 3, (1, 0), None),
        (MAJORITY, 0, (), None),
        (UNANIMOUS, 0, (), None),
    ],
)
def test_worked_examples(rule: Aggregation, electorate: int, votes: tuple[int, ...], expected: Verdict | None) -> None:
    assert verdict(rule, dict(zip(NAMES, votes, strict=False)), NAMES[:electorate]) == expected


@pytest.mark.parametrize("rule", [MAJORITY, UNANIMOUS])
def test_a_stranger_has_no_vote(rule: Aggregation) -> None:
    assert verdict(rule, {"stranger": -1}, ("ann",)) is None
    assert verdict(rule, {"stranger": -1, "ann": 1}, ("ann",)) is G


@pytest.mark.parametrize("rule", [MAJORITY, UNANIMOUS])
@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_a_verdict_comes_with_all_votes_and_never_changes_after(rule: Aggregation, size: int) -> None:
    for values in itertools.product((-1, 0, 1), repeat=size):
        found = [verdict(rule, dict(zip(NAMES, values[:n], strict=False)), NAMES[:size]) for n in range(size + 1)]
        assert found[0] is None
        assert found[-1] is not None
        decided = [v for v in found if v is not None]
        assert set(decided) == {found[-1]}
        assert (found[-1] is G) <= (sum(v == 1 for v in values) * 2 > size)  # nothing moves without more than half
