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


WEIGHTED = Aggregation.WEIGHTED
EXPERT = {"ann": 0.95}
"""Strength 2.94, and each of the others 0.69."""


@pytest.mark.parametrize(
    ("electorate", "votes", "weights", "expected", "alone"),
    [
        (3, (1, 1), {}, G, G),  # nobody is measured: a majority
        (3, (1, -1), {}, None, None),
        (3, (1, -1, 0), {}, N, N),
        (2, (1, -1), {}, N, N),
        (3, (1,), EXPERT, None, G),  # more than half of the strength, but one head of three
        (3, (1, 1), EXPERT, G, G),
        (3, (1, -1, -1), EXPERT, N, G),  # half of the heads never said good
        (3, (-1,), EXPERT, B, B),  # nothing moves by a bad: the strength is enough
        (3, (-1, 1, 1), EXPERT, B, B),
        (3, (-1, 1, 1), {"ann": 0.5}, G, G),  # at chance: no strength
        (3, (-1, 1, 1), {"ann": 0.05}, G, G),  # nor is a label that is usually wrong turned round
        (3, (1, 1, 1), dict.fromkeys(NAMES, 0.5), N, N),  # nobody is worth anything: nothing moves
        (1, (1,), {"ann": 0.4}, N, N),
        (4, (1, 1, -1, -1), {"ann": 0.8, "bob": 0.8}, N, G),
        (3, (None, 1, -1), EXPERT, N, N),  # who can't tell isn't asked
        (3, (None, 1, 1), EXPERT, G, G),
    ],
)
def test_weighted_examples(
    electorate: int, votes: tuple[int, ...], weights: dict[str, float], expected: Verdict | None, alone: Verdict | None
) -> None:
    cast, asked = dict(zip(NAMES, votes, strict=False)), NAMES[:electorate]
    assert verdict(WEIGHTED, cast, asked, weights=weights) == expected
    assert verdict(WEIGHTED, cast, asked, weights=weights, alone=True) == alone


@pytest.mark.parametrize("weights", [{}, EXPERT, {"ann": 0.9, "bob": 0.6, "cyd": 0.2}])
@pytest.mark.parametrize("alone", [False, True])
def test_a_weighted_verdict_is_certain_and_its_good_has_the_heads_unless_it_may_do_without(
    weights: dict[str, float], alone: bool
) -> None:
    for size in (1, 2, 3, 4):
        for values in itertools.product((-1, 0, 1), repeat=size):
            found = []
            for order in (NAMES[:size], NAMES[:size][::-1]):
                cast = [{n: values[NAMES.index(n)] for n in order[:heard]} for heard in range(size + 1)]
                told = [verdict(WEIGHTED, votes, NAMES[:size], weights=weights, alone=alone) for votes in cast]
                assert told[0] is None
                assert {v for v in told if v is not None} == {told[-1]}
                found.append(told[-1])
            assert len(set(found)) == 1, "the order of votes doesn't matter"
            if not alone:
                assert (found[0] is G) <= (2 * values.count(1) > size)


@pytest.mark.parametrize(
    ("rule", "electorate", "votes", "expected"),
    [
        (MAJORITY, 1, (1,), None),  # the others have gone: whoever comes is waited for
        (MAJORITY, 2, (1, 1), G),
        (MAJORITY, 2, (1, -1), N),
        (MAJORITY, 3, (1, 1), G),
        (MAJORITY, 3, (1, None), None),
        (MAJORITY, 3, (1, None, None), N),  # nobody is left who could say so
        (UNANIMOUS, 1, (1,), None),
        (UNANIMOUS, 1, (-1,), B),  # only a motion needs more heads
        (UNANIMOUS, 2, (1, None), N),
        (FIRST, 1, (1,), None),
        (FIRST, 1, (1, 1), G),
        (FIRST, 1, (1, -1), B),
        (FIRST, 1, (1, 0), N),
        (FIRST, 1, (None, 1, None, 1), G),
        (FIRST, 1, (-1,), B),
    ],
)
def test_nothing_is_good_before_at_least_two_say_so(
    rule: Aggregation, electorate: int, votes: tuple[int | None, ...], expected: Verdict | None
) -> None:
    cast = dict(zip(NAMES, votes, strict=False))
    assert verdict(rule, cast, NAMES[:electorate], least=2) == expected


@pytest.mark.parametrize("rule", list(Aggregation))
def test_good_always_has_the_least_it_needs(rule: Aggregation) -> None:
    for size, least in itertools.product((1, 2, 3, 4), repeat=2):
        for values in itertools.product((-1, 0, 1, None), repeat=size):
            found = verdict(rule, dict(zip(NAMES, values, strict=False)), NAMES[:size], least=least)
            assert found is not G or values.count(1) >= least
