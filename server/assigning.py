"""Which proposal each trainer gets: one queue of all robots and slots. Pure functions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from server.aggregation import may_join
from server.schemas import Aggregation, Proposal

MOST_SLOTS = 16
"""Open proposals of one robot at most: more trainers than that share them."""


def may_judge(trainer: str, proposal: Proposal, rule: Aggregation, least: int = 1) -> bool:
    """Whether this trainer's vote on an open proposal is still asked for. least: so many have to say good."""
    if proposal.closed_at is not None or trainer in proposal.heard:
        return False
    return rule is Aggregation.FIRST or trainer in proposal.electorate or may_join(proposal.electorate, least)


def is_exclusive(rule: Aggregation, *, parallel: bool, least: int = 1) -> bool:
    """Whether a proposal is only for the one who has it: one vote decides, and there are others for the others."""
    return parallel and rule is Aggregation.FIRST and least == 1


def choose(
    trainer: str,
    opened: Sequence[Proposal],
    held: Mapping[str, int],
    rule: Aggregation,
    *,
    parallel: bool,
    least: int = 1,
) -> Proposal | None:
    """The proposal for a trainer who has none: one that nobody is at, else the one with the fewest at it.

    Of those alike the one whose verdict is nearest, else the oldest. None where nothing is left for them.

    held: trainer -> id of the proposal that they have.
    """
    at = {p.id: sum(held_id == p.id for name, held_id in held.items() if name != trainer) for p in opened}
    theirs = [p for p in opened if may_judge(trainer, p, rule, least)]
    if is_exclusive(rule, parallel=parallel, least=least):
        theirs = [p for p in theirs if not at[p.id]]
    return min(theirs, key=lambda p: (at[p.id], -len(p.heard), p.number), default=None)


def lighter(
    trainer: str, opened: Sequence[Proposal], held: Mapping[str, int], rule: Aggregation, *, least: int = 1
) -> Proposal | None:
    """What a trainer who has only just got theirs is given instead: one that fewer others are at. None: they keep it.

    Only where one answer decides: by the other rules everyone is asked about each, and nothing is won.
    """
    if rule is not Aggregation.FIRST or least > 1:
        return None
    others = Counter(held_id for name, held_id in held.items() if name != trainer)
    found = choose(trainer, opened, held, rule, parallel=False)
    return found if found is not None and others[found.id] < others[held[trainer]] else None


def wanted(trainers: int, standing: int, *, parallel: bool) -> int:
    """How many proposals of one robot are to be open, where so many trainers share so many robots that stand still."""
    if not parallel:
        return 1
    return max(1, min(MOST_SLOTS, -(-trainers // max(1, standing))))
