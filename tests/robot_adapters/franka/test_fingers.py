"""Commands to the fingers at a double for a driver's hand: the newest wins, and a stop takes back what hasn't begun."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from robot_adapters.franka.fingers import Fingers
from tests.live import wait_for


class Broken(Exception):
    """What the double's driver raises."""


class HandDouble:
    """A double for a driver's hand whose looks or commands last as long as a test says."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.looks = self.stops = 0
        self.apart = 0.08
        self.fails = False
        self._looks_end, self._commands_end = threading.Event(), threading.Event()
        self.free()

    def width(self) -> float:
        self.looks += 1
        self._looks_end.wait()
        return self.apart

    def grasp(self) -> None:
        self._begin("grasp", 0.04)

    def open(self) -> None:
        self._begin("open", 0.08)

    def stop(self) -> None:
        self.stops += 1
        self._commands_end.set()

    def hold_looks(self) -> None:
        """From now on a look lasts; returns once the fingers' thread waits in one."""
        self._looks_end.clear()
        before = self.looks
        wait_for(lambda: self.looks > before, "a look at the width")

    def hold_commands(self) -> None:
        """From now on a command lasts."""
        self._commands_end.clear()

    def free(self) -> None:
        """Whatever lasts ends."""
        self._looks_end.set()
        self._commands_end.set()

    def _begin(self, what: str, apart: float) -> None:
        self.begun.append(what)
        self._commands_end.wait()
        if self.fails:
            self.apart = 0.06
            raise Broken("jammed")
        self.apart = apart


@pytest.fixture
def hand() -> HandDouble:
    return HandDouble()


@pytest.fixture
def fingers(hand: HandDouble) -> Iterator[Fingers]:
    made = Fingers(lambda: hand, (Broken,))
    yield made
    hand.free()
    made.close()


def looked_twice(hand: HandDouble) -> None:
    """The thread of the fingers has come round: what it was to do it has done."""
    before = hand.looks
    wait_for(lambda: hand.looks >= before + 2, "two looks at the width")


@pytest.mark.parametrize("what", ["open", "grasp"])
def test_a_command_that_waits_behind_a_look_of_a_hand_double_never_runs_after_a_stop(
    what: str, fingers: Fingers, hand: HandDouble
) -> None:
    hand.hold_looks()
    fingers.ask(what)
    assert fingers.state.busy
    fingers.stop()
    hand.free()
    looked_twice(hand)
    assert hand.begun == []
    assert hand.stops == 0  # nothing moved: a real hand would let go of what it holds
    assert not fingers.state.busy


def test_the_newest_command_to_a_hand_double_wins(fingers: Fingers, hand: HandDouble) -> None:
    hand.hold_looks()
    fingers.ask("open")
    fingers.ask("grasp")
    hand.free()
    wait_for(lambda: not fingers.state.busy, "the fingers to be done")
    assert hand.begun == ["grasp"]
    assert fingers.state.width == 0.04


def test_a_stop_of_a_hand_double_that_moves_reaches_its_driver_at_once(fingers: Fingers, hand: HandDouble) -> None:
    hand.hold_commands()
    fingers.ask("grasp")
    wait_for(lambda: hand.begun, "the grasp to begin")
    fingers.ask("open")
    fingers.stop()
    looked_twice(hand)
    assert (hand.stops, hand.begun) == (1, ["grasp"])


def test_a_command_that_a_hand_double_fails_at_is_told_by_the_width(fingers: Fingers, hand: HandDouble) -> None:
    hand.fails = True
    fingers.ask("grasp")
    wait_for(lambda: not fingers.state.busy, "the fingers to be done")
    assert fingers.state.width == 0.06
    assert fingers.state.there
