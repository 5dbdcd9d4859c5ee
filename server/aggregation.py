"""What the trainers' feedback on one proposal adds up to: pure functions (DESIGN.md section 4, 6).

A vote of None is "can't tell from this view": an abstention. Whoever gave it has been heard and isn't waited for, and
counts neither for nor against: what is asked for more than half, or for all, is those who could tell.

No rule but `first` says anything before it is certain: a verdict comes as soon as no vote that is still missing could
change it, so it doesn't depend on the order in which they came.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from server.schemas import Aggregation, Verdict

_OF_VALUE = {1: Verdict.GOOD, 0: Verdict.NEUTRAL, -1: Verdict.BAD}

UNKNOWN = 2 / 3
"""Reliability of a trainer of whom nothing is known: right twice as often as wrong, as `server.reliability` starts."""
SUREST = 0.99
"""No trainer is believed more than this: nobody outvotes any number of others."""
SHARE = 0.5
"""`weighted`: the value whose trainers hold more than this share of the electorate's strength is the verdict."""
_CLOSE = 1e-9
"""Sums of strengths that differ by less are equal: a tie must not hang on the order in which they were added."""


def verdict(
    rule: Aggregation,
    votes: Mapping[str, int | None],
    electorate: Sequence[str],
    *,
    weights: Mapping[str, float] | None = None,
    alone: bool = False,
    least: int = 1,
) -> Verdict | None:
    """The verdict of `votes` (trainer -> value, in the order they came), or None while it is open.

    first: the first vote that isn't an abstention, whoever gives it. majority: the value that more than half of the
    electorate gave; neutral as soon as no value can get there (a tie). unanimous: one bad vetoes at once; otherwise all
    have to be heard, and it is good only if all said good. weighted: the value whose trainers hold more than `SHARE` of
    the electorate's strength; neutral as soon as none can get there. Its good needs more than half of the heads as
    well, unless `alone`: what is only estimated moves no robot by itself.
    For all but the first only the electorate's votes are counted, and those of it who abstain count as if they weren't
    in it. Where nobody could tell there is no verdict: see `nobody_could_tell`.

    least: nothing is good before so many trainers have said so, however few are left to be asked. Where more may still
    come (`may_join`) it waits for them; else it is neutral. By `first` any other answer decides meanwhile.

    weights: trainer -> probability that their label is true (`server.store_quality.weights`); missing: `UNKNOWN`.
    """
    if rule is Aggregation.FIRST:
        return _first(votes, least)
    found = _by_electorate(rule, votes, electorate, weights, alone=alone)
    if found is not Verdict.GOOD:
        return found
    good = sum(votes.get(name) == 1 for name in electorate)
    if good >= least:
        return found
    missing = sum(name not in votes for name in electorate)
    return None if good + missing >= least or may_join(electorate, least) else Verdict.NEUTRAL


def may_join(electorate: Sequence[str], least: int) -> bool:
    """Whether who wasn't there when a proposal opened may judge it: fewer are asked than have to say good."""
    return len(electorate) < max(1, least)


def _first(votes: Mapping[str, int | None], least: int) -> Verdict | None:
    good = 0
    for value in votes.values():
        if value is None:
            continue
        good += value == 1
        if value != 1 or good >= least:
            return _OF_VALUE[value]
    return None


def _by_electorate(
    rule: Aggregation,
    votes: Mapping[str, int | None],
    electorate: Sequence[str],
    weights: Mapping[str, float] | None,
    *,
    alone: bool,
) -> Verdict | None:
    members = [name for name in dict.fromkeys(electorate) if votes.get(name, 0) is not None]
    heard = {name: value for name in members if (value := votes.get(name)) is not None}
    if not heard:
        return None
    if rule is Aggregation.UNANIMOUS:
        if -1 in heard.values():
            return Verdict.BAD
        if len(heard) < len(members):
            return None
        return Verdict.GOOD if all(value == 1 for value in heard.values()) else Verdict.NEUTRAL
    heads = dict.fromkeys(members, 1.0)
    if rule is Aggregation.MAJORITY:
        return _more_than_half(heard, {1: [heads], 0: [heads], -1: [heads]})
    strengths = {name: strength((weights or {}).get(name, UNKNOWN)) for name in members}
    return _more_than_half(heard, {1: [strengths] if alone else [strengths, heads], 0: [strengths], -1: [strengths]})


def nobody_could_tell(votes: Mapping[str, int | None], electorate: Sequence[str]) -> bool:
    """Whether all of the electorate have abstained, and nobody has judged: it closes without a verdict.

    A trainer who is alone and can't tell gets the next proposal by this. Where there is no electorate, nobody else is
    waited for.
    """
    return bool(votes) and all(votes.get(name, 0) is None for name in electorate) and set(votes.values()) == {None}


def strength(weight: float) -> float:
    """How much a vote weighs: the log odds that it is true, which is best for independent voters; 0 at chance or worse.

    Nitzan and Paroush (1982), "Optimal decision rules in uncertain dichotomous choice situations". An unknown trainer's
    is 0.69, that of one who is right in nine of ten 2.2. Against the weight of the worst nothing is held: a label that
    is usually wrong isn't turned round.
    """
    sure = min(max(weight, 0.5), SUREST)
    return math.log(sure / (1 - sure))


def _more_than_half(heard: Mapping[str, int], needed: Mapping[int, Sequence[Mapping[str, float]]]) -> Verdict | None:
    """The value that has more than half by every measure it needs; neutral once none can get there any more.

    needed: value -> measures, each of them trainer -> how much a vote counts, over all who are asked.
    """
    for value, measures in needed.items():
        said = [name for name, said in heard.items() if said == value]
        if said and all(_over(sum(measure[name] for name in said), measure) for measure in measures):
            return _OF_VALUE[value]
    for value, measures in needed.items():
        against = [name for name, said in heard.items() if said != value]
        if all(_over(sum(measure.values()) - sum(measure[name] for name in against), measure) for measure in measures):
            return None
    return Verdict.NEUTRAL


def _over(part: float, measure: Mapping[str, float]) -> bool:
    return part > SHARE * sum(measure.values()) + _CLOSE
