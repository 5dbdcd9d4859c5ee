"""Who gets which proposal, and for how long: the pure rules, and the seats by a clock of the test's own."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from datetime import UTC, datetime

import pytest

from server.assigning import MOST_SLOTS, choose, may_judge, wanted
from server.messages import JudgesChanged, StreamEvent
from server.schemas import Aggregation, Proposal
from server.schemas_together import Together
from server.seating import BLINK, Seating

FIRST, MAJORITY = Aggregation.FIRST, Aggregation.MAJORITY
ALL = ("ann", "bob", "cyd")


def proposal(
    number: int, *, electorate: tuple[str, ...] = ALL, heard: tuple[str, ...] = (), robot: int = 0
) -> Proposal:
    return Proposal(
        id=number,
        experiment_id=1,
        robot=robot,
        episode=1,
        number=number,
        observation_id="o1",
        state=[0.0],
        skill="pick",
        parameters={},
        digest="d",
        predicted_feedback=0.0,
        skill_probabilities={},
        policy_version=0,
        views=[],
        opened_at=datetime.now(UTC),
        electorate=list(electorate),
        heard=list(heard),
    )


def test_each_gets_what_nobody_is_at_oldest_first() -> None:
    opened = [proposal(1), proposal(2), proposal(3)]
    found = choose("ann", opened, {}, FIRST, parallel=True)
    assert found is not None
    assert found.id == 1
    found = choose("bob", opened, {"ann": 1, "cyd": 2}, FIRST, parallel=True)
    assert found is not None
    assert found.id == 3
    # one vote decides, so in parallel two are never at the same one; else they share
    assert choose("bob", opened[:1], {"ann": 1}, FIRST, parallel=True) is None
    for rule, parallel in ((FIRST, False), (MAJORITY, True), (MAJORITY, False)):
        found = choose("bob", opened[:1], {"ann": 1}, rule, parallel=parallel)
        assert found is not None


def test_of_many_the_one_whose_verdict_is_nearest_is_asked_about() -> None:
    opened = [proposal(1), proposal(2, heard=("bob",))]
    found = choose("ann", opened, {}, MAJORITY, parallel=True)
    assert found is not None
    assert found.id == 2


def test_nobody_is_asked_twice_nor_a_stranger_whose_vote_would_not_count() -> None:
    assert not may_judge("ann", proposal(1, heard=("ann",)), FIRST)
    assert not may_judge("eve", proposal(1), MAJORITY)
    assert may_judge("eve", proposal(1), FIRST)
    assert may_judge("eve", proposal(1, electorate=()), MAJORITY)
    closed = proposal(1).model_copy(update={"closed_at": datetime.now(UTC)})
    assert not may_judge("ann", closed, FIRST)


@pytest.mark.parametrize(
    ("trainers", "standing", "parallel", "expected"),
    [
        *((0, 1, True, 1), (1, 1, True, 1), (5, 1, True, 5), (5, 2, True, 3), (5, 0, True, 5)),
        *((99, 1, True, MOST_SLOTS), (5, 1, False, 1), (0, 0, False, 1)),
    ],
)
def test_as_many_are_open_as_there_are_trainers_for_them(
    trainers: int, standing: int, parallel: bool, expected: int
) -> None:
    assert wanted(trainers, standing, parallel=parallel) == expected


@dataclass
class Room:
    """Seats whose clock the test turns."""

    together: Together
    rule: Aggregation = FIRST
    now: float = 0.0
    opened: list[Proposal] = field(default_factory=list)
    vanished: list[str] = field(default_factory=list)
    told: list[StreamEvent] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.seats = Seating(self.told.append, clock=lambda: self.now)
        self.seats.opened = lambda: self.opened
        self.seats.on_vanished = self.vanished.extend
        self.seats.follow(self.rule, self.together)

    def later(self, seconds: float) -> None:
        self.now += seconds
        self.seats.ring()

    @property
    def at(self) -> dict[str, int | None]:
        return {judge.trainer: judge.proposal_id for judge in self.seats.judges}


PARALLEL = Together(parallel=True, lease_seconds=30, vanish_seconds=10)


async def test_a_lease_lasts_while_they_look_and_goes_back_when_they_do_not() -> None:
    room = Room(PARALLEL, opened=[proposal(1)])
    room.seats.arrive("ann")
    room.seats.arrive("bob")
    assert room.at == {"ann": 1, "bob": None}
    assert room.seats.why_not("bob", room.opened[0]) is not None
    room.later(20)
    room.seats.look("ann")
    room.seats.look("bob")
    room.later(20)
    assert room.at == {"ann": 1, "bob": None}
    room.seats.look("bob")
    room.later(11)  # ann has looked at it for the last time half a minute ago
    assert room.at == {"ann": None, "bob": 1}
    assert room.seats.why_not("ann", room.opened[0]) is not None
    assert [judge.away for judge in room.seats.judges] == [True, False]
    assert room.seats.wanted(1) == 1, "nothing is drawn for who is away"
    room.opened.append(proposal(2))
    room.seats.look("ann")
    assert room.at == {"ann": 2, "bob": 1}
    assert room.vanished == ["ann"], "what was open waited for her no longer"


async def test_who_leaves_gives_it_back_at_once_and_is_waited_for_a_while() -> None:
    room = Room(PARALLEL, opened=[proposal(1)])
    room.seats.arrive("ann")
    room.seats.arrive("ann")  # two pages of one trainer are one trainer
    room.seats.arrive("bob")
    room.seats.depart("ann")
    assert room.at == {"ann": 1, "bob": None}
    room.seats.depart("ann")
    assert room.at == {"ann": None, "bob": 1}
    assert room.seats.names == ["ann", "bob"], "an electorate still has her"
    room.later(9)
    assert room.vanished == []
    room.seats.arrive("ann")
    room.later(60)
    assert room.vanished == ["bob"], "his lease is over; she has none"
    room.vanished.clear()
    room.seats.look("bob")
    room.seats.depart("ann")
    room.later(10)
    assert (room.vanished, room.seats.names) == (["ann"], ["bob"])
    room.seats.depart("bob", ago=7)  # nobody was told when
    room.later(2)
    assert room.vanished == ["ann"]
    room.later(1)
    assert room.vanished == ["ann", "bob"]


async def test_without_a_page_every_sign_of_life_is_a_seat_for_a_while() -> None:
    room = Room(PARALLEL, opened=[proposal(1)])
    room.seats.look("ann")
    assert room.at == {"ann": 1}
    room.later(29)
    room.seats.look("ann")
    room.later(29)
    assert room.at == {"ann": 1}, "she thinks: nothing has to be said meanwhile"
    room.later(1)
    assert room.at == {}
    assert room.vanished == ["ann"]
    room.opened.clear()
    room.seats.look("ann")
    room.later(9)
    assert room.at == {"ann": None}
    room.later(1)
    assert room.at == {}, "who has nothing to think about asks again, or has gone"


async def test_who_has_to_practise_gets_nothing_and_is_in_no_electorate() -> None:
    room = Room(PARALLEL, opened=[proposal(1)])
    room.seats.arrive("ann", counts=False)
    room.seats.arrive("bob")
    assert (room.at, room.seats.names, room.seats.wanted(1)) == ({"ann": None, "bob": 1}, ["bob"], 1)
    room.opened.append(proposal(2))
    room.seats.look("ann", counts=True)
    assert room.at == {"ann": 2, "bob": 1}
    room.seats.recount({"ann": False, "bob": True, "cyd": True})  # practice is required from now on
    assert (room.at, room.seats.names, room.vanished) == ({"ann": None, "bob": 1}, ["bob"], ["ann"])
    room.seats.recount({"ann": True, "bob": True})
    assert room.at == {"ann": 2, "bob": 1}


async def test_who_gives_no_sign_of_life_is_neither_asked_nor_waited_for_until_the_next_one() -> None:
    together = Together(lease_seconds=30, vanish_seconds=10)
    room = Room(together, opened=[proposal(1, electorate=("ann", "bob"))], rule=MAJORITY)
    for name in ("ann", "bob"):
        room.seats.arrive(name)
    room.later(20)
    room.seats.look("ann")
    room.later(10)
    assert (room.vanished, room.seats.names) == (["bob"], ["ann"])
    assert [(judge.trainer, judge.here, judge.away) for judge in room.seats.judges] == [
        ("ann", True, False),
        ("bob", True, True),
    ]
    # a connection that comes again by itself is no sign of life
    room.seats.depart("bob")
    room.seats.arrive("bob")
    assert (room.seats.names, room.at["bob"]) == (["ann"], None)
    room.opened.append(proposal(2, electorate=tuple(room.seats.names)))
    room.seats.deal()
    assert room.at == {"ann": 1, "bob": None}
    room.seats.look("bob")
    assert room.seats.names == ["ann", "bob"]
    # nothing waits for anybody: nobody is away
    room.opened.clear()
    room.seats.deal()
    room.later(3600)
    assert room.seats.names == ["ann", "bob"]


async def test_they_spread_over_what_opens_and_who_looks_already_keeps_theirs() -> None:
    room = Room(Together(), opened=[proposal(1)])
    for name in ALL:
        room.seats.arrive(name)
    room.seats.look("ann")
    room.opened.append(proposal(2, robot=1))
    room.seats.deal()
    assert room.at == {"ann": 1, "bob": 2, "cyd": 1}, "as even as it gets, and no further"
    room.opened.append(proposal(3, robot=2))
    room.seats.deal()
    assert room.at == {"ann": 1, "bob": 2, "cyd": 3}
    # they meet at the last one; after a blink, or a look, it is theirs
    room.opened = [proposal(3, robot=2)]
    room.seats.deal()
    room.seats.look("bob")
    room.now += BLINK
    room.opened.append(proposal(4))
    room.seats.deal()
    assert room.at == {"ann": 3, "bob": 3, "cyd": 3}


async def test_nobody_is_moved_who_is_asked_about_each_or_has_no_page_to_be_told_by() -> None:
    for rule, together in ((MAJORITY, Together()), (FIRST, Together(least=2))):
        room = Room(together, rule, opened=[proposal(1)])
        room.seats.arrive("ann")
        room.seats.arrive("bob")
        room.opened.append(proposal(2, robot=1))
        room.seats.deal()
        assert room.at == {"ann": 1, "bob": 1}
        room.opened[0] = proposal(1, heard=("ann",))
        room.seats.deal()
        assert room.at == {"ann": 2, "bob": 1}
    room = Room(Together(), opened=[proposal(1)])
    room.seats.look("ann")
    room.seats.look("bob")
    room.opened.append(proposal(2, robot=1))
    room.seats.deal()
    assert room.at == {"ann": 1, "bob": 1}


async def test_a_proposal_that_is_gone_is_replaced_and_everyone_is_told_once() -> None:
    room = Room(PARALLEL, opened=[proposal(1), proposal(2)])
    room.seats.arrive("ann")
    room.seats.arrive("bob")
    before = len(room.told)
    room.seats.deal()
    assert len(room.told) == before
    room.opened[:] = [proposal(2), proposal(3)]
    room.seats.deal()
    newest = room.told[-1]
    assert len(room.told) == before + 1
    assert isinstance(newest, JudgesChanged)
    assert [(judge.trainer, judge.proposal_id) for judge in newest.judges] == [("ann", 3), ("bob", 2)]
    assert all(judge.until is not None for judge in newest.judges)


async def test_the_clock_rings_by_itself() -> None:
    gone = asyncio.Event()
    seats = Seating(lambda _: None)
    seats.on_vanished = lambda _: gone.set()
    seats.follow(FIRST, Together(vanish_seconds=0.01))
    seats.arrive("ann")
    seats.depart("ann")
    await asyncio.wait_for(gone.wait(), 30)
    assert seats.judges == []


async def test_what_another_approval_overtook_stays_until_it_is_judged_or_its_time_is_over() -> None:
    room = Room(Together(parallel=True, lease_seconds=60, vanish_seconds=30, finish_seconds=20))
    room.opened = [proposal(1), proposal(2), proposal(3)]
    for name in ALL:
        room.seats.arrive(name)
    overtaken, room.opened = room.opened[1:], [proposal(4)]
    room.seats.overtaken(overtaken)
    told = room.told[-1]
    assert isinstance(told, JudgesChanged)
    assert [judge.trainer for judge in told.judges if judge.finishing] == ["bob", "cyd"]
    room.seats.deal()
    assert room.at == {"ann": 4, "bob": 2, "cyd": 3}
    assert room.seats.wanted(1) == 1  # who finishes needs nothing new yet
    assert room.seats.finishing("bob") == overtaken[0]
    room.seats.finished("bob", 2)
    room.opened.append(proposal(5))
    room.seats.look("bob")
    assert room.at == {"ann": 4, "bob": 5, "cyd": 3}
    # a page that is lost for a moment loses nothing
    room.seats.depart("cyd")
    room.seats.arrive("cyd")
    assert room.seats.finishing("cyd") == overtaken[1]
    room.opened.append(proposal(6))
    room.later(20)
    assert (room.at["cyd"], room.seats.finishing("cyd")) == (6, None)


async def test_nothing_is_finished_once_the_experiment_stands_or_where_no_time_is_given() -> None:
    for finish_seconds in (0.0, 20.0):
        together = Together(parallel=True, finish_seconds=finish_seconds)
        room = Room(together, opened=[proposal(1), proposal(2)])
        room.seats.arrive("ann")
        room.seats.arrive("bob")
        overtaken, room.opened = room.opened[1:], []
        room.seats.overtaken(overtaken)
        room.seats.deal()
        assert room.at == {"ann": None, "bob": 2 if finish_seconds else None}
        room.seats.follow(FIRST, together, going=False)
        assert room.at == {"ann": None, "bob": None}
