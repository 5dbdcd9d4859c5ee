"""What votes add up to: worked examples, and properties over every order of votes."""

from __future__ import annotations

import itertools

import pytest

from server.aggregation import nobody_could_tell, verdict
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


@pytest.mark.parametrize(
    ("rule", "electorate", "votes", "expected"),
    [
        (FIRST, 1, (None,), None),
        (FIRST, 3, (None, 1), G),
        (MAJORITY, 3, (1, None), None),
        (MAJORITY, 3, (None, 1, 1), G),
        (MAJORITY, 3, (None, None, -1), B),
        (MAJORITY, 3, (None, 1, -1), N),
        (UNANIMOUS, 3, (1, None), None),
        (UNANIMOUS, 3, (1, None, 1), G),
        (UNANIMOUS, 3, (None, -1), B),
        (MAJORITY, 2, (None, None), None),
        (UNANIMOUS, 2, (None, None), None),
    ],
)
def test_who_cant_tell_is_heard_and_not_counted(
    rule: Aggregation, electorate: int, votes: tuple[int | None, ...], expected: Verdict | None
) -> None:
    assert verdict(rule, dict(zip(NAMES, votes, strict=False)), NAMES[:electorate]) == expected


@pytest.mark.parametrize("rule", [FIRST, MAJORITY, UNANIMOUS])
@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_all_votes_end_it_and_no_abstention_turns_a_verdict(rule: Aggregation, size: int) -> None:
    for values in itertools.product((-1, 0, 1, None), repeat=size):
        cast = [dict(zip(NAMES, values[:n], strict=False)) for n in range(size + 1)]
        found = [verdict(rule, votes, NAMES[:size]) for votes in cast]
        stuck = [nobody_could_tell(votes, NAMES[:size]) for votes in cast]
        assert (found[-1] is None) == stuck[-1] == (set(values) == {None})
        assert not any(stuck[:-1])
        assert len({v for v in found if v is not None}) <= 1
        if rule is not FIRST:
            told = [value for value in values if value is not None]
            assert (found[-1] is G) <= (told.count(1) * 2 > len(told))


def test_one_who_cant_tell_waits_for_whoever_else_is_there() -> None:
    assert nobody_could_tell({"ann": None}, ("ann",))
    assert nobody_could_tell({"ann": None}, ())
    assert not nobody_could_tell({"ann": None}, ("ann", "bob"))
    assert not nobody_could_tell({}, ())
    assert not nobody_could_tell({"ann": None, "bob": 0}, ("ann", "bob"))
