"""The proposals of one robot that are open, since when, and those that were until a moment ago."""

from __future__ import annotations

import time
from collections.abc import Iterator

from server.schemas import Proposal

REMEMBERED = 64
"""Closed proposals that late clicks of a crowd find without the store."""


class Opened:
    """By id, and in the order of their numbers."""

    def __init__(self) -> None:
        self._open: dict[int, Proposal] = {}
        self._since: dict[int, float] = {}
        self._closed: dict[int, Proposal] = {}

    def __len__(self) -> int:
        return len(self._open)

    def __contains__(self, proposal_id: int) -> bool:
        return proposal_id in self._open

    def __iter__(self) -> Iterator[Proposal]:
        """Oldest first, as they are now: some may be closed meanwhile."""
        return iter(sorted(self._open.values(), key=lambda proposal: proposal.number))

    def get(self, proposal_id: int) -> Proposal | None:
        """An open one."""
        return self._open.get(proposal_id)

    def find(self, proposal_id: int) -> Proposal | None:
        """One that is open, or was a moment ago."""
        return self.get(proposal_id) or self._closed.get(proposal_id)

    @property
    def free_slot(self) -> int:
        """The first one in which nothing is open."""
        taken = {proposal.slot for proposal in self._open.values()}
        return next(slot for slot in range(len(taken) + 1) if slot not in taken)

    def put(self, proposal: Proposal) -> None:
        """It is open from now on."""
        self._open[proposal.id] = proposal
        self._since[proposal.id] = time.monotonic()

    def change(self, proposal: Proposal) -> None:
        """It is as open as before, and something else of it is new."""
        self._open[proposal.id] = proposal

    def close(self, proposal_id: int) -> None:
        """It isn't open any more, if it was."""
        if (closed := self._open.pop(proposal_id, None)) is not None:
            self._closed = dict([*self._closed.items(), (proposal_id, closed)][-REMEMBERED:])
        self._since.pop(proposal_id, None)

    def overdue(self, limit: float | None) -> list[int]:
        """Those that have been open for so many seconds; None: they have all the time."""
        if limit is None:
            return []
        over = time.monotonic() - limit
        return [proposal_id for proposal_id, since in self._since.items() if since <= over]

    def left(self, limit: float | None) -> float | None:
        """Seconds until the oldest has been open for so long; None: nothing is, or they have all the time."""
        if limit is None or not self._since:
            return None
        return max(0.0, min(self._since.values()) + limit - time.monotonic())
