"""Tells the author of a task or an adapter what is wrong with it and how to put it right.

An empty list means that nothing was found.
"""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from robot_adapters import registry
from robot_adapters.base import AdapterError, Unavailable
from robot_adapters.check_declarations import declarations, missing, undescribed
from robot_adapters.check_rules import Finding, on_episodes, on_starts
from robot_adapters.check_watch import RuleRaised, said, watched
from robot_adapters.contract import AdapterContract
from robot_adapters.tasks.base import Task

_FACTORY_PARTS = {
    "name": "its name in the entry point group seed.adapters",
    "description": "one sentence for the catalogue",
    "simulated": "False for a real robot: it needs an operator present",
    "tasks": "the names of the tasks it can stage",
    "settings": "a pydantic model class with every field documented",
}


def check_task(name: str) -> list[str]:
    """What is wrong with the task called `name`, in plain words."""
    try:
        task = registry.task(name)
    except AdapterError as error:
        return [f"{error}: {error.remedy}"]
    except Exception as error:  # noqa: BLE001  a foreign constructor can raise anything, and that is the finding
        return [f"{name} can't be built without arguments: {said(error)}"]
    if found := missing(task, name):
        return found
    try:
        # without sound declarations, what follows would only repeat them less clearly
        return list(declarations(task, name)) or _rules(task)
    except Exception as error:  # noqa: BLE001  what a foreign task declares can be of any type
        return [f"what {name} says of itself has a wrong type, see Task in robot_adapters/tasks/base.py: {said(error)}"]


def check_adapter(name: str, task: str) -> list[str]:
    """What is wrong with the adapter called `name` when it stages `task`. Moves the robot.

    Raises:
        Unavailable: robot, simulator or graphics can't be had on this machine, so nothing could be checked.
    """
    try:
        factory = registry.adapter(name)
        registry.task(task)
    except AdapterError as error:
        return [f"{error}: {error.remedy}"]
    absent = [
        f"{name} has no {part}: add {what}" for part, what in _FACTORY_PARTS.items() if not hasattr(factory, part)
    ]
    if absent:
        return absent
    if task not in (staged := registry.staged(factory)):
        return [
            f"{name} can't stage {task}, only {', '.join(staged) or 'nothing'}: add it to the factory's tasks, or give "
            "the factory a method stages(task)"
        ]
    findings = list(_settings(factory.settings, name))

    class Contract(AdapterContract):
        adapter_name = name
        task_name = task

    try:
        Contract.setup_class()
    except Unavailable:
        raise
    except AdapterError as error:
        return [*findings, f"{name} can't be built: {error}. {error.remedy}"]
    except Exception as error:  # noqa: BLE001  a driver can raise anything, and that is the finding
        return [*findings, f"{name} can't be built, and doesn't say why with Unavailable: {said(error)}"]
    try:
        for test in sorted(part for part in dir(Contract) if part.startswith("test_")):
            findings += _ran(Contract(), test)
    finally:
        Contract.teardown_class()
    return list(dict.fromkeys(findings))


def _ran(contract: AdapterContract, test: str) -> list[str]:
    """What one test of the contract finds."""
    try:
        contract.setup_method()
        getattr(contract, test)()
    except AssertionError as error:
        return [str(error)]
    except Exception as error:  # noqa: BLE001  foreign code can raise anything, and that is the finding
        return [f"{test.removeprefix('test_').replace('_', ' ')}: raised {said(error)}"]
    return []


def _rules(task: Task) -> list[str]:
    """What is wrong with the task's rules, each with the first place where it showed."""
    observed = watched(task)
    return _told(on_starts(observed)) or _told(on_episodes(observed))


def _told(findings: Iterator[Finding]) -> list[str]:
    """Each finding once, and as the last one whatever stopped the search."""
    found: dict[str, str] = {}
    raised: list[str] = []
    try:
        for what, seen in findings:
            found.setdefault(what, seen)
    except RuleRaised as error:
        raised.append(str(error))
    except Exception as error:  # noqa: BLE001  a foreign method can also return anything
        raised.append(f"a method of the task gave what nothing can be done with: {said(error)}")
    return [*(f"{what}\n  seen {seen}" for what, seen in found.items()), *raised]


def _settings(settings: type[BaseModel], name: str) -> Iterator[str]:
    """Fields of an adapter's settings that its user could not understand or would have to fill in."""
    yield from undescribed(settings, name)
    for field, about in settings.model_fields.items():
        if about.is_required():
            yield f"the setting {field} of {name} has no default: give one, so that an experiment needs none"
