"""What is wrong with what a task says of itself, before any of its rules is tried."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator

from pydantic import BaseModel

from robot_adapters.base import PRIMITIVES, SkillSpec
from robot_adapters.check_watch import METHODS
from robot_adapters.tasks.base import ObjectSpec, StateField, Task

_PARTS = {
    "name": "its name in the entry point group seed.tasks",
    "title": "a short title for people",
    "instruction": "one sentence that tells a trainer what is to be done",
    "state_fields": "a tuple of StateField",
    "skills": "a tuple of SkillSpec",
    "subgoals": "a tuple of Subgoal, in the order they are solved",
    "objects": "a tuple of ObjectSpec: what is in the scene",
    "table_height": "the z of the table's surface in the robot base frame, m",
    "horizon": "after how many executed skills an unsolved episode ends",
    "layout": "a LayoutSettings with the ranges that starts are drawn from",
}


def missing(task: Task, name: str) -> list[str]:
    """Attributes and methods of the protocol that the task hasn't got."""
    found = [f"{name} has no {part}: add {what}" for part, what in _PARTS.items() if not hasattr(task, part)]
    return found + [
        f"{name} has no method {method}: see Task in robot_adapters/tasks/base.py"
        for method in METHODS
        if not callable(getattr(task, method, None))
    ]


def declarations(task: Task, name: str) -> Iterator[str]:
    """What is wrong with names, skills, state, objects and settings."""
    if task.name != name:
        yield f"the task's name is {task.name!r} but its entry point is {name!r}: make them the same"
    if not math.isfinite(task.table_height):
        yield f"table_height is {task.table_height}: give the z of the table's surface in the robot base frame, m"
    yield from _skills(task.skills)
    yield from _fields(task.state_fields)
    yield from _objects(task.objects)
    if not task.subgoals:
        yield "there are no subgoals: add at least one, trainers are shown what comes next"
    if task.horizon < len(task.subgoals):
        yield f"horizon {task.horizon} ends episodes before the {len(task.subgoals)} subgoals can be solved: raise it"
    yield from undescribed(type(task.layout), f"{name}'s layout")


def undescribed(settings: type[BaseModel], owner: str) -> Iterator[str]:
    """Fields of `settings` without a description."""
    for field, about in settings.model_fields.items():
        if not about.description:
            yield f"the setting {field} of {owner} has no description: add one, the page shows it"


def _skills(skills: tuple[SkillSpec, ...]) -> Iterator[str]:
    if not skills:
        yield "the task offers no skill: add at least one SkillSpec to skills"
    if _twice(spec.name for spec in skills):
        yield "two skills have the same name: offer each primitive once"
    for spec in skills:
        names = tuple(p.name for p in spec.parameters)
        wanted = PRIMITIVES.get(spec.name)
        if wanted is None:
            yield f"{spec.name!r} is no primitive: use one of {', '.join(sorted(PRIMITIVES))}"
        elif names not in ({wanted, (*wanted, "yaw")} if wanted else {wanted}):
            yield (
                f"{spec.name} has the parameters ({', '.join(names)}): arms expect ({', '.join(wanted)}) in this "
                "order, robot_adapters.tasks.table makes them"
            )
        for p in spec.parameters:
            if not (math.isfinite(p.low) and math.isfinite(p.high) and p.low < p.high):
                yield f"{spec.name}.{p.name} goes from {p.low} to {p.high}: low must be below high, both finite"


def _fields(fields: tuple[StateField, ...]) -> Iterator[str]:
    if not fields:
        yield "the state is empty: add at least one StateField"
    for name in _twice(field.name for field in fields):
        yield f"two state fields are called {name!r}: give each a name of its own, exports are keyed by it"
    for field in fields:
        if field.size < 1:
            yield f"state field {field.name} has size {field.size}: give at least 1"
        if any(len(bound) not in {0, field.size} for bound in (field.low, field.high)):
            yield f"state field {field.name} has {field.size} components: give as many low and high values, or none"
        elif any(low >= high for low, high in zip(field.low, field.high, strict=False)):
            yield f"state field {field.name} has a low that isn't below its high: learners scale by them"


def _objects(objects: tuple[ObjectSpec, ...]) -> Iterator[str]:
    for name in _twice(spec.name for spec in objects):
        yield f"two objects are called {name!r}: give each a name of its own"
    for spec in objects:
        if spec.name == "gripper":
            yield "an object is called 'gripper': that name is the gripper's own in sample_layout"
        if spec.shape in {"block", "area"} and not spec.half_size > 0:
            yield f"the {spec.shape} {spec.name} has half_size {spec.half_size}: give half its edge or its radius, m"
        if spec.shape in {"thing", "fixture", "slider"} and not (spec.parts and min(spec.half) > 0):
            yield f"the {spec.shape} {spec.name} has no parts or no outline: give parts, and their half sizes as half"
        if not spec.movable and spec.fixed is None:
            yield f"the {spec.shape} {spec.name} is nowhere: give it fixed = (x, y, z) in m, robot base frame"


def _twice(names: Iterable[str]) -> list[str]:
    """The names that come more than once."""
    return [name for name, count in Counter(names).items() if count > 1]
