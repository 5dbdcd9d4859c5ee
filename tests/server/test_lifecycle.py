"""Every verb in every state, against a table written out by hand."""

from __future__ import annotations

import itertools
from typing import get_args

import pytest

from server import lifecycle
from server.lifecycle import State, Verb
from server.schemas import Lifecycle
from server.store_errors import Conflict

VERBS: tuple[Verb, ...] = get_args(Verb)

# state: verb -> state, for an experiment that isn't halted; what isn't here is illegal
EXPECTED = {
    "created": {"start": "running", "archive": "archived", "evaluate": "created"},
    "running": {"halt": "paused", "pause": "paused", "finish": "finished", "fail": "failed", "reset": "running"},
    "paused": {"resume": "running", "finish": "finished", "reset": "paused", "evaluate": "paused"},
    "finished": {"archive": "archived", "evaluate": "finished"},
    "failed": {"start": "running", "resume": "running", "archive": "archived"},
    "archived": {},
}
MOVING = {"start", "resume", "reset", "evaluate"}


@pytest.mark.parametrize(("state", "verb"), list(itertools.product(Lifecycle, VERBS)))
def test_every_verb_in_every_state(state: Lifecycle, verb: Verb) -> None:
    expected = {"halt": state.value, **EXPECTED[state.value]}
    if verb in expected:
        after = lifecycle.apply(State(state), verb)
        assert after == State(Lifecycle(expected[verb]), halted=verb == "halt")
    else:
        with pytest.raises(Conflict) as caught:
            lifecycle.apply(State(state), verb)
        assert caught.value.current == state.value
        assert set(caught.value.allowed) == expected.keys() - {"fail"}
        assert caught.value.remedy


@pytest.mark.parametrize(("state", "verb"), list(itertools.product(Lifecycle, VERBS)))
def test_nothing_but_rearm_ends_a_halt_and_nothing_moves_meanwhile(state: Lifecycle, verb: Verb) -> None:
    expected = {verb: after for verb, after in EXPECTED[state.value].items() if verb not in MOVING}
    expected = {"halt": state.value, **expected, "rearm": state.value}
    if verb in expected:
        after = lifecycle.apply(State(state, halted=True), verb)
        assert after == State(Lifecycle(expected[verb]), halted=verb != "rearm")
    else:
        with pytest.raises(Conflict) as caught:
            lifecycle.apply(State(state, halted=True), verb)
        assert set(caught.value.allowed) == expected.keys() - {"fail"}


def test_the_table_holds_every_verb() -> None:
    assert set(lifecycle.TABLE) == set(VERBS)
