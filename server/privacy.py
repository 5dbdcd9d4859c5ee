"""What trainers are told of each other: how many have judged and what came of it, never which of them said what.

A trainer's own figures are theirs, and everybody's are for those who run the experiment. Who could read of each click
whose it is could work the others' figures out, so whoever isn't an operator gets an opaque word in the place of every
other trainer's name: the same one within a proposal, another one in the next.
"""

from __future__ import annotations

import hashlib
import json
import secrets
from collections.abc import Collection, Mapping
from typing import Any, TypeVar

from pydantic import BaseModel

from server.names import SERVICES, SOMEBODY, TEACHER
from server.principal import Principal, Role

M = TypeVar("M", bound=BaseModel)

NAMED = frozenset({"trainer", "by"})
"""Fields that hold a trainer's name."""
LISTED = frozenset({"heard", "electorate", "approved_by", "trainers"})
"""Fields that hold several."""
_secret = secrets.token_bytes(16)
_people: set[str] = set()
"""People who have a name of the service's own, from a time when nothing kept them from it."""


def learn(misnamed: Collection[str]) -> None:
    """From now on these are people's names, and are veiled as all others."""
    _people.update(misnamed)


def reader(who: Principal) -> str | None:
    """For whom names have to be veiled, and whose own stays; None: for nobody, they may know."""
    return None if who.role.covers(Role.OPERATOR) else who.name


def veiled(who: Principal, model: M) -> M:
    """The same, without the names of other trainers, unless whoever asks may know them."""
    me = reader(who)
    return model if me is None else type(model).model_validate(_veil(model.model_dump(), me, None))


class Telling:
    """One event as text, for everybody who is to hear of it; each form of it is written once."""

    def __init__(self, event: BaseModel | str) -> None:
        """Tell of an event. As text: what `to(None)` has said."""
        self._event = event
        self._plain: dict[str, Any] | None = None
        self._names: set[str] = set()
        self._veiled: dict[str, str] = {}

    def to(self, me: str | None) -> str:
        """As `me` may hear it; None: with every name."""
        if not isinstance(self._event, str):
            self._event = self._event.model_dump_json()
        if me is None:
            return self._event
        if self._plain is None:
            self._plain = json.loads(self._event)
            self._names = _names(self._plain)
        known = me if me in self._names else ""
        if known not in self._veiled:
            self._veiled[known] = json.dumps(_veil(self._plain, known, None), separators=(",", ":"))
        return self._veiled[known]


def _veil(node: Any, me: str, scope: object) -> Any:
    if isinstance(node, list | tuple):
        return [_veil(each, me, scope) for each in node]
    if not isinstance(node, Mapping):
        return node
    scope = _scope(node, scope)
    return {
        key: _name(value, me, scope)
        if key in NAMED and isinstance(value, str)
        else [_name(each, me, scope) for each in value]
        if key in LISTED and isinstance(value, list | tuple)
        else _veil(value, me, scope)
        for key, value in node.items()
    }


def _scope(node: Mapping[str, Any], outer: object) -> object:
    """What the words for names hold for: a proposal, or a line of the journal."""
    if node.get("proposal_id") is not None:
        return node["proposal_id"]
    return node["id"] if "observation_id" in node or "payload" in node else outer


def _name(name: Any, me: str, scope: object) -> Any:
    if not isinstance(name, str) or name == me or (_is_nobodys(name) and name not in _people):
        return name
    return SOMEBODY + hashlib.blake2s(f"{scope}:{name}".encode(), key=_secret, digest_size=3).hexdigest()


def _is_nobodys(name: str) -> bool:
    return name in SERVICES or name.startswith(TEACHER)


def _names(node: Any) -> set[str]:
    if isinstance(node, list | tuple):
        return set().union(*map(_names, node))
    if not isinstance(node, Mapping):
        return set()
    found: set[str] = set()
    for key, value in node.items():
        if key in NAMED and isinstance(value, str):
            found.add(value)
        elif key in LISTED and isinstance(value, list):
            found.update(each for each in value if isinstance(each, str))
        else:
            found |= _names(value)
    return found
