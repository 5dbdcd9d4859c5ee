"""Finds tasks and adapters by their entry points: those of this project exactly as foreign ones."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Protocol, cast, runtime_checkable

from robot_adapters.base import AdapterError, AdapterFactory
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.layout import changed

TASKS = "seed.tasks"
ADAPTERS = "seed.adapters"

log = logging.getLogger(__name__)


class UnknownName(AdapterError):
    """No installed package offers a task or adapter of this name, or what it offers can't be loaded."""


@runtime_checkable
class Stages(Protocol):
    """What an adapter's factory has beside `AdapterFactory` if it can stage tasks that it doesn't name."""

    def stages(self, task: Task) -> bool:
        """Whether it has what this task's objects and skills need. Builds nothing, imports no simulator or driver."""


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


def staged(factory: AdapterFactory) -> tuple[str, ...]:
    """The tasks that an adapter can stage: those that it names, then every other installed one that it accepts."""
    if not isinstance(factory, Stages):
        return factory.tasks
    others = sorted(tasks().keys() - set(factory.tasks))
    return (*factory.tasks, *(name for name in others if _accepts(factory, name)))


def broken(group: str) -> Mapping[str, str]:
    """Name -> why, of every entry point of the group that can't be loaded."""
    _load_all(group)
    return dict(_broken.get(group, {}))


def _accepts(factory: Stages, name: str) -> bool:
    """Whether it stages this task; a task that can't even be built it doesn't."""
    try:
        return factory.stages(task(name))
    except Exception as error:  # noqa: BLE001  foreign code can raise anything; `seed check` tells its author
        log.warning("the task %s can't be staged (%s): run seed check %s", name, error, name)
        return False


def _find(group: str, kind: str, name: str) -> object:
    known = _load_all(group)
    if name in _broken.get(group, {}):
        raise UnknownName(
            f"the {kind} {name!r} can't be loaded: {_broken[group][name]}",
            remedy=f"mend the import of what its entry point in {group} names",
        )
    if name not in known:
        names = ", ".join(sorted(known)) or "none is installed"
        raise UnknownName(
            f"there is no {kind} called {name!r}",
            remedy=f"use one of: {names}. One of your own is found by an entry point of the group {group}",
        )
    return known[name]


_broken: dict[str, dict[str, str]] = {}
"""Group -> name -> why it can't be loaded."""


@cache
def _load_all(group: str) -> dict[str, object]:
    """Name -> loaded object. Read once: packages don't come and go while a process runs."""
    found: dict[str, object] = {}
    _broken[group] = {}
    for point in entry_points(group=group):
        loaded = _load(point)
        if loaded is None:
            continue
        if point.name in found:
            log.warning("%s: a second entry point named %r (%s) is ignored", group, point.name, point.value)
            continue
        found[point.name] = loaded
    for name in found.keys() & _broken[group].keys():
        del _broken[group][name]
    return found


def _load(point: EntryPoint) -> Any | None:
    """What the entry point names, or None where loading fails: a broken foreign package must not break the rest."""
    try:
        return point.load()
    except Exception as error:  # importing foreign code can raise anything; it is logged with its traceback
        _broken[point.group][point.name] = f"{type(error).__name__}: {error}"
        log.warning(
            "entry point %s = %s of group %s can't be loaded", point.name, point.value, point.group, exc_info=True
        )
        return None
