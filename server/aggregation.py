"""What the trainers' feedback on one proposal adds up to: pure functions (DESIGN.md section 4, 6).

A vote of None is "can't tell from this view": an abstention. Whoever gave it has been heard and isn't waited for, and
counts neither for nor against: what is asked for more than half, or for all, is those who could tell.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from server.schemas import Aggregation, Verdict

_OF_VALUE = {1: Verdict.GOOD, 0: Verdict.NEUTRAL, -1: Verdict.BAD}


def verdict(rule: Aggregation, votes: Mapping[str, int | None], electorate: Sequence[str]) -> Verdict | None:
    """The verdict of `votes` (trainer -> value, in the order they came), or None while it is open.

    first: the first vote that isn't an abstention, whoever gives it. majority: the value that more than half of the
    electorate gave; neutral as soon as no value can get there (a tie). unanimous: one bad vetoes at once; otherwise all
    have to be heard, and it is good only if all said good. For the latter two only the electorate's votes are counted,
    and those of it who abstain count as if they weren't in it. Where nobody could tell there is no verdict: see
    `nobody_could_tell`.
    """
    if rule is Aggregation.FIRST:
        return next((_OF_VALUE[value] for value in votes.values() if value is not None), None)
    members = [name for name in dict.fromkeys(electorate) if votes.get(name, 0) is not None]
    heard = [value for name in members if (value := votes.get(name)) is not None]
    if not heard:
        return None
    missing = len(members) - len(heard)
    if rule is Aggregation.MAJORITY:
        counts = Counter(heard)
        value, most = counts.most_common(1)[0]
        if 2 * most > len(members):
            return _OF_VALUE[value]
        return Verdict.NEUTRAL if 2 * (most + missing) <= len(members) else None
    if -1 in heard:
        return Verdict.BAD
    if missing:
        return None
    return Verdict.GOOD if all(value == 1 for value in heard) else Verdict.NEUTRAL


def nobody_could_tell(votes: Mapping[str, int | None], electorate: Sequence[str]) -> bool:
    """Whether all of the electorate have abstained, and nobody has judged: it closes without a verdict.

    A trainer who is alone and can't tell gets the next proposal by this. Where there is no electorate, nobody else is
    waited for.
    """
    return bool(votes) and all(votes.get(name, 0) is None for name in electorate) and set(votes.values()) == {None}
