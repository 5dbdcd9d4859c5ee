"""Who is there to judge an experiment, and which proposal each has before them: seats, and leases on proposals.

A trainer is seated by a connection, or, without one, by asking for a proposal or by clicking. Two connections of one
trainer are one seat. A lease is renewed by every sign that they look; where it runs out the proposal goes back to the
others, nobody waits for them any more, and they get one again as soon as they are back. All of it is in memory: what
is open doesn't outlive a restart.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from server import assigning
from server.aggregation import may_join
from server.messages import JudgesChanged, StreamEvent
from server.schemas import Aggregation, Proposal
from server.schemas_together import Judge, Together

BLINK = 1.0
"""s in which nobody has thought about what they have just got: another one may still be put in its place."""


@dataclass
class Seat:
    """One trainer. Times are of the monotonic clock, s.

    connections: how many pages are open. left: since when none is; it stays None while one is.
    fresh_until: so long what they got may still be changed for another one; 0 once they have looked at it.
    away: they had something before them and showed no sign of life for as long as a lease, or closed their pages.
    out: away although a page of theirs is open; nobody waits for them. It ends with a sign of life, and not with a
    page that connects again by itself.
    counts: whether their clicks do; who has to practise first gets no proposal.
    finishing: what they may still judge until `finish_by`, although another's approval has closed it. finished: the
    id of the newest one that they have.
    """

    looked: float
    connections: int = 0
    left: float | None = None
    proposal: int | None = None
    fresh_until: float = 0.0
    away: bool = False
    out: bool = False
    counts: bool = True
    finishing: Proposal | None = None
    finish_by: float = 0.0
    finished: int | None = None


class Seating:
    """The seats of one experiment. Used from the event loop only; nothing in it waits."""

    def __init__(self, publish: Callable[[StreamEvent], None], *, clock: Callable[[], float] = time.monotonic) -> None:
        self._publish = publish
        self._clock = clock
        self._seats: dict[str, Seat] = {}
        self._timer: asyncio.TimerHandle | None = None
        self._told: dict[str, tuple[int | None, bool, bool, bool]] = {}
        self._rule, self._together = Aggregation.FIRST, Together()
        self.opened: Callable[[], Sequence[Proposal]] = list
        """The open proposals of all robots."""
        self.on_change: Callable[[], None] = lambda: None
        """Called when another number of proposals may be wanted."""
        self.on_arrived: Callable[[], None] = lambda: None
        """Called when somebody has come who may judge."""
        self.on_vanished: Callable[[list[str]], None] = lambda _: None
        """Called with the trainers who are waited for no longer: gone, away, or not to judge before they practise."""

    # --- what others ask ----------------------------------------------------------------------------------------

    @property
    def judges(self) -> list[Judge]:
        """Everyone who is there, and what they have before them."""
        return [self._judge(name, seat) for name, seat in sorted(self._seats.items())]

    @property
    def names(self) -> list[str]:
        """Who is there, or has been until just now, and may judge: an electorate."""
        return sorted(name for name, seat in self._seats.items() if seat.counts and not seat.out)

    @property
    def short(self) -> bool:
        """Whether an open proposal asks fewer than have to say good, while somebody else is there."""
        least, there = self._together.least, set(self.names)
        return any(may_join(p.electorate, least) and there - set(p.electorate) for p in self.opened())

    def wanted(self, standing: int) -> int:
        """How many proposals of one robot are to be open, where so many robots stand still.

        Whoever finishes another one gets theirs once they have: it comes from what is learned until then.
        """
        busy = sum(s.counts and not s.away and s.finishing is None for s in self._seats.values())
        return assigning.wanted(busy, standing, parallel=self._together.parallel)

    def proposal_of(self, trainer: str) -> int | None:
        """What this trainer has before them."""
        seat = self._seats.get(trainer)
        return None if seat is None else seat.proposal

    def others_at(self, trainer: str) -> set[int]:
        """What others have, where each has a proposal of their own."""
        if not self._together.parallel:
            return set()
        return {seat.proposal for name, seat in self._seats.items() if name != trainer and seat.proposal is not None}

    def why_not(self, trainer: str, proposal: Proposal) -> str | None:
        """Why a click of this trainer on an open proposal can't count: it is with somebody else."""
        if not self._exclusive:
            return None
        if self.proposal_of(trainer) == proposal.id:
            return None
        holder = next((name for name, seat in self._seats.items() if seat.proposal == proposal.id), None)
        return None if holder is None else "it is before another trainer now, and waits for what they say of it"

    def finishing(self, trainer: str) -> Proposal | None:
        """The closed proposal that this trainer may still judge."""
        seat = self._seats.get(trainer)
        return None if seat is None else seat.finishing

    # --- what happens -------------------------------------------------------------------------------------------

    def follow(self, rule: Aggregation, together: Together, *, going: bool = True) -> None:
        """Go by these settings from now on. going: the experiment runs; else there is nothing to finish."""
        if not going and any(seat.finishing is not None for seat in self._seats.values()):
            for seat in self._seats.values():
                if seat.finishing is not None:
                    seat.finishing = seat.proposal = None
            self._settle()
        if (rule, together) != (self._rule, self._together):
            self._rule, self._together = rule, together
            self._settle(arrived=self.short)  # more have to say good than before

    def arrive(self, trainer: str, *, counts: bool = True) -> None:
        """A page of theirs is open."""
        seat = self._seated(trainer, counts=counts)
        seat.connections += 1
        seat.left, seat.away = None, seat.out
        if not seat.out:
            seat.looked, seat.fresh_until = self._clock(), 0.0
        self._count(trainer, seat, counts)
        self._settle(arrived=True)

    def depart(self, trainer: str, *, ago: float = 0.0) -> None:
        """One of their pages is closed: what they have goes back, and after a while they are waited for no longer.

        ago: seconds since it was, where it could be noticed only now.
        """
        seat = self._seats.get(trainer)
        if seat is None or not seat.connections:
            return
        seat.connections -= 1
        if not seat.connections:
            seat.left = self._clock() - ago
            if seat.finishing is None:  # else it is nobody else's, and they may be back in a moment
                seat.away, seat.proposal = True, None
            self._settle()

    def look(self, trainer: str, *, counts: bool | None = None) -> None:
        """A sign that they are at it, from a page or without one. counts: whether their clicks do; None: as before."""
        arrived = trainer not in self._seats
        seat = self._seated(trainer, counts=counts is not False)
        arrived |= seat.out or (counts is True and not seat.counts)
        seat.looked, seat.fresh_until, seat.away, seat.out = self._clock(), 0.0, False, False
        if counts is not None:
            self._count(trainer, seat, counts)
        if not seat.connections:
            seat.left = self._clock()
        self._settle(arrived=arrived)

    def stir(self, trainer: str) -> None:
        """A sign of life of somebody who has a seat."""
        if trainer in self._seats:
            self.look(trainer)

    def recount(self, counts: Mapping[str, bool]) -> None:
        """Whose clicks count from now on, of those who are there."""
        known = {name: self._seats[name] for name in counts if name in self._seats}
        arrived = any(counts[name] and not seat.counts for name, seat in known.items())
        for name, seat in known.items():
            self._count(name, seat, counts[name])
        self._settle(arrived=arrived)

    def reopened(self, proposal: Proposal) -> None:
        """A click on it was taken back, and it is open again: of those who were asked then, some may have gone."""
        there = {*self.names, *proposal.heard}
        if absent := [name for name in proposal.electorate if name not in there]:
            self.on_vanished(absent)

    def overtaken(self, closed: Sequence[Proposal]) -> None:
        """Another's approval has closed these: whoever has one before them may finish it."""
        seconds = self._together.finish_seconds
        by_id = {proposal.id: proposal for proposal in closed}
        for name, seat in self._seats.items():
            mine = by_id.get(seat.proposal or 0)
            if mine is not None and seconds and seat.counts and seat.finished != mine.id and name not in mine.heard:
                seat.finishing, seat.finish_by = mine, self._clock() + seconds
        self._wind()
        self._tell()

    def finished(self, trainer: str, proposal_id: int) -> None:
        """They have judged one that another's approval has closed."""
        seat = self._seated(trainer)
        seat.finished = proposal_id
        if seat.proposal == proposal_id:
            seat.finishing = seat.proposal = None

    def give(self, trainer: str, proposal_id: int) -> None:
        """Put a proposal before them that they have just opened again."""
        seat = self._seated(trainer)
        if not seat.connections and seat.left is None:
            seat.left = self._clock()
        seat.looked, seat.fresh_until, seat.away, seat.out = self._clock(), 0.0, False, False
        seat.proposal, seat.finishing = proposal_id, None
        self._settle()

    def deal(self) -> None:
        """Give everyone something who has nothing that waits for them, as far as there is something."""
        opened = {p.id: p for p in self.opened()}
        exclusive, together = self._exclusive, self._together
        taken: set[int] = set()
        for name, seat in self._seats.items():
            if seat.finishing is not None and seat.counts:
                continue
            seat.finishing = None
            mine = opened.get(seat.proposal) if seat.proposal is not None else None
            if (
                mine is None
                or not seat.counts
                or not assigning.may_judge(name, mine, self._rule, together.least)
                or (exclusive and mine.id in taken)
            ):
                seat.proposal = None
            else:
                taken.add(mine.id)
        held = {name: seat.proposal for name, seat in self._seats.items() if seat.proposal is not None}
        for name, seat in self._seats.items():
            if seat.proposal is None and seat.counts and not seat.away:
                waiting = list(opened.values())
                found = assigning.choose(
                    name, waiting, held, self._rule, parallel=together.parallel, least=together.least
                )
                if found is not None:
                    held[name] = self._hand(seat, found)
        for name, seat in sorted(self._seats.items(), key=lambda each: -each[1].fresh_until):  # the newest first
            # who has no page open couldn't be told
            if seat.proposal is not None and seat.connections and seat.fresh_until > self._clock():
                found = assigning.lighter(name, list(opened.values()), held, self._rule, least=together.least)
                if found is not None:
                    held[name] = self._hand(seat, found)
        self._wind()
        self._tell()

    # --- inside -------------------------------------------------------------------------------------------------

    @property
    def _exclusive(self) -> bool:
        return assigning.is_exclusive(self._rule, parallel=self._together.parallel, least=self._together.least)

    def _seated(self, trainer: str, *, counts: bool = True) -> Seat:
        return self._seats.setdefault(trainer, Seat(looked=self._clock(), counts=counts))

    def _count(self, name: str, seat: Seat, counts: bool) -> None:
        before, seat.counts = seat.counts, counts
        if before and not counts:
            self.on_vanished([name])

    def _gone_at(self, seat: Seat) -> float:
        """When they are gone, as they have no page open. Whoever asks without one says nothing while they think."""
        together, thinks = self._together, seat.proposal is not None and seat.finishing is None
        assert seat.left is not None
        return seat.left + (max(together.vanish_seconds, together.lease_seconds) if thinks else together.vanish_seconds)

    def _hand(self, seat: Seat, proposal: Proposal) -> int:
        """Put it before them as something new."""
        seat.proposal, seat.looked = proposal.id, self._clock()
        seat.fresh_until = seat.looked + BLINK
        return proposal.id

    def _due(self, seat: Seat) -> float:
        """When what they have goes back."""
        return seat.looked + self._together.lease_seconds if seat.finishing is None else seat.finish_by

    def _settle(self, *, arrived: bool = False) -> None:
        if arrived:
            self.on_arrived()
        self.deal()
        self.on_change()

    def _wind(self) -> None:
        """Have the clock ring when the next lease runs out, or somebody has been gone for long enough."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        due = [self._due(seat) for seat in self._seats.values() if seat.proposal is not None]
        due += [self._gone_at(seat) for seat in self._seats.values() if seat.left is not None]
        if due:
            wait = max(0.0, min(due) - self._clock())
            self._timer = asyncio.get_running_loop().call_later(wait, self.ring)

    def ring(self) -> None:
        """Take back what nobody looks at, and let go of those who are gone."""
        now, silent = self._clock(), []
        for name, seat in self._seats.items():
            if seat.proposal is None or self._due(seat) > now:
                continue
            # who let one go by that nothing waited for isn't away yet, unless they don't look at the next one either
            if seat.finishing is None:
                seat.out = True
                silent.append(name)
            seat.away = seat.out or (seat.left is not None and seat.connections == 0)
            seat.proposal = seat.finishing = None
        gone = [name for name, seat in self._seats.items() if seat.left is not None and self._gone_at(seat) <= now]
        for name in gone:
            del self._seats[name]
        if without := sorted({*silent, *gone}):
            self.on_vanished(without)
        self._settle()

    def _judge(self, name: str, seat: Seat) -> Judge:
        until = None
        if seat.proposal is not None:
            left = max(0.0, self._due(seat) - self._clock())
            until = datetime.now(UTC) + timedelta(seconds=round(left))
        return Judge(
            trainer=name,
            proposal_id=seat.proposal,
            until=until,
            finishing=seat.finishing is not None,
            here=seat.left is None,
            away=seat.away,
        )

    def _tell(self) -> None:
        # without the times, which change with every look
        now = {
            name: (seat.proposal, seat.finishing is not None, seat.left is None, seat.away)
            for name, seat in self._seats.items()
        }
        if now != self._told:
            self._told = now
            self._publish(JudgesChanged(judges=self.judges))
