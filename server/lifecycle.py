"""Where an experiment may go from where it is: one table, no state (DESIGN.md section 6)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from server.schemas import Lifecycle
from server.store_errors import Conflict

Verb = Literal["start", "pause", "resume", "finish", "archive", "fail", "reset", "evaluate", "halt", "rearm"]

_ENDED = (Lifecycle.CREATED, Lifecycle.FINISHED, Lifecycle.FAILED)  # nothing runs and nothing is about to

TABLE: dict[Verb, dict[Lifecycle, Lifecycle]] = {
    "start": {Lifecycle.CREATED: Lifecycle.RUNNING, Lifecycle.FAILED: Lifecycle.RUNNING},
    "resume": {Lifecycle.PAUSED: Lifecycle.RUNNING, Lifecycle.FAILED: Lifecycle.RUNNING},
    "pause": {Lifecycle.RUNNING: Lifecycle.PAUSED},
    "finish": {Lifecycle.RUNNING: Lifecycle.FINISHED, Lifecycle.PAUSED: Lifecycle.FINISHED},
    "archive": dict.fromkeys(_ENDED, Lifecycle.ARCHIVED),
    "fail": {Lifecycle.RUNNING: Lifecycle.FAILED},
    "reset": {state: state for state in (Lifecycle.RUNNING, Lifecycle.PAUSED)},
    "evaluate": {state: state for state in (Lifecycle.CREATED, Lifecycle.PAUSED, Lifecycle.FINISHED)},
    "halt": {state: state for state in Lifecycle} | {Lifecycle.RUNNING: Lifecycle.PAUSED},
    "rearm": {state: state for state in Lifecycle},
}
"""Verb -> state before -> state after. A state that is missing refuses the verb."""

MOVING: frozenset[Verb] = frozenset({"start", "resume", "reset", "evaluate"})
"""Verbs after which the robot may move; none of them is legal while halted."""


@dataclass(frozen=True)
class State:
    """A lifecycle with the latched emergency stop beside it."""

    lifecycle: Lifecycle
    halted: bool = False


def legal(state: State, verb: Verb) -> bool:
    """Whether `verb` may be applied. `halt` always is, also when halted: a stop is never refused."""
    if state.halted and verb in MOVING:
        return False
    if verb == "rearm":
        return state.halted
    return state.lifecycle in TABLE[verb]


def allowed(state: State) -> tuple[Verb, ...]:
    """The verbs that a person may use now (`fail` is the service's own)."""
    return tuple(verb for verb in TABLE if verb != "fail" and legal(state, verb))


def apply(state: State, verb: Verb) -> State:
    """The state after `verb`.

    Raises:
        Conflict: the verb is illegal here; it carries the current state and the verbs that are legal.
    """
    if not legal(state, verb):
        verbs = allowed(state)
        current = f"{state.lifecycle.value}, halted" if state.halted else state.lifecycle.value
        raise Conflict(
            f"can't {verb} an experiment that is {current}",
            remedy="use one of: " + ", ".join(verbs),
            current=state.lifecycle.value,
            allowed=verbs,
        )
    halted = True if verb == "halt" else False if verb == "rearm" else state.halted
    return State(TABLE[verb][state.lifecycle], halted)
