"""What the trainers' feedback on one proposal adds up to: pure functions (DESIGN.md section 4, 6)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from server.schemas import Aggregation, Verdict

_OF_VALUE = {1: Verdict.GOOD, 0: Verdict.NEUTRAL, -1: Verdict.BAD}


def verdict(rule: Aggregation, votes: Mapping[str, int], electorate: Sequence[str]) -> Verdict | None:
    """The verdict of `votes` (trainer -> value, in the order they came), or None while it is open.

    first: the first vote, whoever gives it. majority: the value that more than half of the electorate gave; neutral as
    soon as no value can get there (a tie). unanimous: one bad vetoes at once; otherwise all have to be heard, and it
    is good only if all said good. For the latter two only the electorate's votes are counted.
    """
    if rule is Aggregation.FIRST:
        return _OF_VALUE[next(iter(votes.values()))] if votes else None
    members = list(dict.fromkeys(electorate))
    heard = [votes[name] for name in members if name in votes]
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
