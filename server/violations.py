"""What follows from a safety violation: who is asked, and whether the experiment goes on by itself."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Response(StrEnum):
    """What the experiment does after an execution."""

    NOTHING = "nothing"
    NEW_EPISODE = "new_episode"
    PAUSE = "pause"
    HALT = "halt"


def respond(kinds: Iterable[str], *, simulated: bool, taught: bool) -> Response:
    """The response to the kinds of violation of one execution, of which the gravest counts.

    Damage latches the emergency stop until an operator has looked, unless nobody is there and nothing can break: a
    teacher judges a simulated robot. What needs a hand pauses a real robot; a simulated one puts itself right.
    """
    found = set(kinds)
    if "damage" in found:
        return Response.NEW_EPISODE if simulated and taught else Response.HALT
    if "manual_reset" in found:
        return Response.NEW_EPISODE if simulated else Response.PAUSE
    return Response.NOTHING
