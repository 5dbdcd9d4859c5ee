"""`--set PART.NAME=VALUE`: settings of a new experiment's parts, given on the command line."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, NoReturn

PARTS = {"algorithm": "settings", "adapter": "adapter_settings", "teacher": "teacher_settings"}
"""Part -> the experiment's field that has its settings."""


def settings_from(changes: Iterable[str]) -> dict[str, dict[str, Any]]:
    """The fields of an experiment that these changes make up. A value is JSON; what isn't, is text.

    A longer name goes deeper: `adapter.layout.block_a_x=[0.5,0.55]`.

    Raises:
        ValueError: one isn't of the form PART.NAME=VALUE, or names a part that has no settings.
    """
    fields: dict[str, dict[str, Any]] = {}
    for change in changes:
        name, equals, text = change.partition("=")
        part, *path = name.split(".")
        if not equals or not path or not all(path):
            raise ValueError(f"--set {change}: this isn't PART.NAME=VALUE")
        if part not in PARTS:
            raise ValueError(f"--set {change}: {part!r} is none of {', '.join(PARTS)}")
        place = fields.setdefault(PARTS[part], {})
        for step in path[:-1]:
            inner = place.setdefault(step, {})
            place = inner if isinstance(inner, dict) else _taken(change, step)
        place[path[-1]] = _value(text)
    return fields


def _taken(change: str, step: str) -> NoReturn:
    raise ValueError(f"--set {change}: {step} has a value already")


def _value(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return text
