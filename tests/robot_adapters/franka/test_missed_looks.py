"""When a hand counts as gone, at a stand-in for a driver's hand."""

from __future__ import annotations

import itertools

import pytest

from robot_adapters.franka.fingers import MISSES, Fingers
from tests.live import wait_for


class TimedOut(Exception):
    """What a driver raises whose read found nothing in time."""


class Hand:
    """Tells a new width at each look, but for so many looks after `miss`."""

    def __init__(self) -> None:
        self.missing = 0
        self.looks = itertools.count(1)

    def width(self) -> float:
        if self.missing:
            self.missing -= 1
            raise TimedOut("nothing came")
        return next(self.looks) / 1e4

    def grasp(self) -> None:
        """At once."""

    def open(self) -> None:
        """Likewise."""

    def stop(self) -> None:
        """Likewise."""


@pytest.mark.parametrize("missed", [1, MISSES - 1])
def test_looks_that_find_nothing_are_forgiven_where_the_next_one_does(missed: int) -> None:
    hand = Hand()
    fingers = Fingers(lambda: hand, (TimedOut,))
    for _ in range(2):  # and forgotten then
        hand.missing = missed
        wait_for(lambda: not hand.missing, "the looks that find nothing")
        before = fingers.state.width
        wait_for(lambda: fingers.state.width > before, "a look that finds something")  # noqa: B023
        assert fingers.state.there
    fingers.close()


def test_a_hand_that_is_never_seen_again_is_gone() -> None:
    hand = Hand()
    fingers = Fingers(lambda: hand, (TimedOut,))
    hand.missing = 1_000_000
    wait_for(lambda: not fingers.state.there, "the hand to be gone")
    fingers.ask("grasp")
    assert not fingers.state.busy
    fingers.close()
