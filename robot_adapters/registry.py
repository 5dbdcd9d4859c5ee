"""Finds tasks and adapters by their entry points: those of this project exactly as foreign ones."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, cast

from robot_adapters.base import AdapterError, AdapterFactory
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.layout import changed

TASKS = "seed.tasks"
ADAPTERS = "seed.adapters"

log = logging.getLogger(__name__)


class UnknownName(AdapterError):
    """No installed package offers a task or adapter of this name, or what it offers can't be loaded."""


def tasks() -> dict[str, type[Task]]:
    """Every task that can be loaded, by name. Constructors take no arguments."""
    return cast("dict[str, type[Task]]", dict(_load_all(TASKS)))


def adapters() -> dict[str, AdapterFactory]:
    """Every adapter factory that can be loaded, by name. No simulator or driver is imported by this."""
    return cast("dict[str, AdapterFactory]", dict(_load_all(ADAPTERS)))


def task(name: str, layout: Mapping[str, Any] | None = None) -> Task:
    """The task called `name`, with some ranges of its start layout replaced by those in `layout`.

    Raises:
        UnknownName: there is none; the remedy lists those there are.
        InvalidLayout: the task has no such range, or its value is none.
    """
    build = cast("Callable[..., Task]", _find(TASKS, "task", name))
    built = build()
    return build(changed(built.layout, layout)) if layout else built


def adapter(name: str) -> AdapterFactory:
    """The factory of the adapter called `name`.

    Raises:
        UnknownName: there is none; the remedy lists those there are.
    """
    return cast("AdapterFactory", _find(ADAPTERS, "adapter", name))


def _find(group: str, kind: str, name: str) -> object:
    known = _load_all(group)
    if name not in known:
        names = ", ".join(sorted(known)) or "none is installed"
        raise UnknownName(
            f"there is no {kind} called {name!r}",
            remedy=f"use one of: {names}. One of your own is found by an entry point of the group {group}",
        )
    return known[name]


@cache
def _load_all(group: str) -> dict[str, object]:
    """Name -> loaded object. Read once: packages don't come and go while a process runs."""
    found: dict[str, object] = {}
    for point in entry_points(group=group):
        loaded = _load(point)
        if loaded is None:
            continue
        if point.name in found:
            log.warning("%s: a second entry point named %r (%s) is ignored", group, point.name, point.value)
            continue
        found[point.name] = loaded
    return found


def _load(point: EntryPoint) -> Any | None:
    """What the entry point names, or None where loading fails: a broken foreign package must not break the rest."""
    try:
        return point.load()
    except Exception:  # importing foreign code can raise anything; it is logged with its traceback
        log.warning(
            "entry point %s = %s of group %s can't be loaded", point.name, point.value, point.group, exc_info=True
        )
        return None
