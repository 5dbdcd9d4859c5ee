"""Tells the author of a task or an adapter what is wrong with it and how to put it right.

An empty list means that nothing was found.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from pydantic import BaseModel

from robot_adapters import registry
from robot_adapters.base import AdapterError, InvalidCall, Scene, check_call
from robot_adapters.contract import AdapterContract, random_call
from robot_adapters.tasks.base import Task, state_bounds

PRIMITIVES = {"reach", "pick", "place", "push", "release"}
STARTS = 20
RANDOM_CALLS = 200
GOOD_CALLS = 20

_TASK_PARTS = {
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
_TASK_METHODS = (
    "state",
    "sample_layout",
    "success",
    "violations",
    "events",
    "subgoal",
    "judge",
    "margin",
    "true_call",
    "sample_good",
    "keypoints",
)
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
        return [f"{name} can't be built without arguments: {_said(error)}"]
    missing = [f"{name} has no {part}: add {what}" for part, what in _TASK_PARTS.items() if not hasattr(task, part)]
    missing += [
        f"{name} has no method {method}: see Task in robot_adapters/tasks/base.py"
        for method in _TASK_METHODS
        if not callable(getattr(task, method, None))
    ]
    if missing:
        return missing
    findings = [*_declarations(task, name), *_undescribed(type(task.layout), f"{name}'s layout")]
    # without sound declarations, what follows would only repeat them less clearly
    return findings or _unique(_guarded(lambda: _rules(task)))


def check_adapter(name: str, task: str) -> list[str]:
    """What is wrong with the adapter called `name` when it stages `task`. Moves the robot."""
    try:
        factory = registry.adapter(name)
        registry.task(task)
    except AdapterError as error:
        return [f"{error}: {error.remedy}"]
    missing = [
        f"{name} has no {part}: add {what}" for part, what in _FACTORY_PARTS.items() if not hasattr(factory, part)
    ]
    if missing:
        return missing
    if task not in factory.tasks:
        return [f"{name} can't stage {task}: add it to the factory's tasks, now {', '.join(factory.tasks) or 'none'}"]
    findings = list(_settings(factory.settings, name))

    class Contract(AdapterContract):
        adapter_name = name
        task_name = task

    try:
        Contract.setup_class()
    except AdapterError as error:
        return [*findings, f"{name} can't be built: {error}. {error.remedy}"]
    except Exception as error:  # noqa: BLE001  a driver can raise anything, and that is the finding
        return [*findings, f"{name} can't be built, and doesn't say why with Unavailable: {_said(error)}"]
    try:
        for test in sorted(part for part in dir(Contract) if part.startswith("test_")):
            findings += _ran(Contract(), test)
    finally:
        Contract.teardown_class()
    return _unique(findings)


def _ran(contract: AdapterContract, test: str) -> list[str]:
    """What one test of the contract finds."""
    try:
        contract.setup_method()
        getattr(contract, test)()
    except AssertionError as error:
        return [str(error)]
    except Exception as error:  # noqa: BLE001  foreign code can raise anything, and that is the finding
        return [f"{test.removeprefix('test_').replace('_', ' ')}: raised {_said(error)}"]
    return []


def _declarations(task: Task, name: str) -> Iterator[str]:
    """What is wrong with what the task says of itself."""
    if task.name != name:
        yield f"the task's name is {task.name!r} but its entry point is {name!r}: make them the same"
    if not task.skills:
        yield "the task offers no skill: add at least one SkillSpec to skills"
    for spec in task.skills:
        if spec.name not in PRIMITIVES:
            yield f"{spec.name!r} is no primitive: use one of {', '.join(sorted(PRIMITIVES))}"
        for p in spec.parameters:
            if not p.low < p.high:
                yield f"{spec.name}.{p.name} goes from {p.low} to {p.high}: low must be below high"
    if len({spec.name for spec in task.skills}) < len(task.skills):
        yield "two skills have the same name: offer each primitive once"
    for field in task.state_fields:
        if any(len(bound) not in {0, field.size} for bound in (field.low, field.high)):
            yield f"state field {field.name} has {field.size} components: give as many low and high values, or none"
    if not task.state_fields:
        yield "the state is empty: add at least one StateField"
    if not task.subgoals:
        yield "there are no subgoals: add at least one, trainers are shown what comes next"
    if task.horizon < len(task.subgoals):
        yield f"horizon {task.horizon} ends episodes before the {len(task.subgoals)} subgoals can be solved: raise it"


def _rules(task: Task) -> Iterator[str]:
    """What is wrong with the task's rules, tried on several starts."""
    low, high = state_bounds(task.state_fields)
    outside = 0
    for seed in range(STARTS):
        layout, again = (task.sample_layout(np.random.default_rng(seed)) for _ in range(2))
        if layout.keys() != again.keys() or any(not np.array_equal(layout[k], again[k]) for k in layout):
            yield "sample_layout gives two starts for one seed: draw only from the generator it is handed"
        moved = {spec.name for spec in task.objects if spec.movable}
        slides = {spec.name for spec in task.objects if spec.shape == "slider"}
        wanted = moved | slides | {"gripper"}
        if layout.keys() != wanted:
            yield f"sample_layout places {sorted(layout)}: place exactly what moves and `gripper`, {sorted(wanted)}"
            return
        joints = {name: float(layout[name][0]) for name in slides}
        scene = Scene({name: layout[name] for name in moved}, layout["gripper"], gripper_closed=False, joints=joints)
        state = task.state(scene)
        if state.shape != low.shape or not np.isfinite(state).all():
            yield f"state() gives shape {state.shape}: it must be finite and as long as its fields, {low.shape}"
            return
        outside += bool(((state < low) | (state > high)).any())
        if task.success(scene):
            yield "a start is already solved: keep starts away from the goal in sample_layout"
        for violation in task.violations(scene):
            yield f"a start already breaks a rule ({violation.detail}): keep starts inside the workspace"
        yield from _teacher(task, state, np.random.default_rng(seed))
    if outside > STARTS // 2:
        yield "most starts lie outside the state fields' low and high: widen them, learners scale by them"


def _teacher(
    task: Task, state: np.ndarray[tuple[int, ...], np.dtype[np.float64]], rng: np.random.Generator
) -> Iterator[str]:
    """What is wrong with the teacher's rule, the true call and the keypoints in one state."""
    for skill in (None, *(spec.name for spec in task.skills)):
        points = task.keypoints(state, skill)
        if points.ndim != 2 or points.shape[1] != 3:
            yield f"keypoints() gives shape {points.shape}: give (k, 3), or np.zeros((0, 3)) where the state holds none"
    if not 0 <= task.subgoal(state) < len(task.subgoals):
        yield f"subgoal() gives {task.subgoal(state)}: give an index into the {len(task.subgoals)} subgoals"
    call = task.true_call(state)
    try:
        check_call(call, task.skills)
    except InvalidCall as error:
        yield f"true_call() gives a call that doesn't fit the skills: {error}; {error.remedy}"
        return
    if task.judge(state, call) != 1:
        yield "judge() finds the true call bad: the teacher's rule must contain the centre of its own box"
    if task.margin(state, call) < 0:
        yield "margin() is below 0 for the true call: give how far a call is inside what judge() calls good, in m"
    if any(task.judge(state, task.sample_good(state, rng)) != 1 for _ in range(GOOD_CALLS)):
        yield "judge() finds calls of sample_good() bad: draw only what the teacher's rule calls good"
    calls = [random_call(spec, rng) for spec in task.skills for _ in range(RANDOM_CALLS // len(task.skills))]
    verdicts = [task.judge(state, call) for call in calls]
    if set(verdicts) - {-1, 1}:
        yield f"judge() gives {sorted(set(verdicts) - {-1, 1})}: give +1 or -1"
    if sum(v == 1 for v in verdicts) > len(verdicts) / 2:
        yield "judge() finds most random calls good, so there is nothing to learn: tighten the teacher's rule"


def _settings(settings: type[BaseModel], name: str) -> Iterator[str]:
    """Fields of an adapter's settings that its user could not understand or would have to fill in."""
    yield from _undescribed(settings, name)
    for field, about in settings.model_fields.items():
        if about.is_required():
            yield f"the setting {field} of {name} has no default: give one, so that an experiment needs none"


def _undescribed(settings: type[BaseModel], owner: str) -> Iterator[str]:
    """Fields of `settings` without a description."""
    for field, about in settings.model_fields.items():
        if not about.description:
            yield f"the setting {field} of {owner} has no description: add one, the page shows it"


def _guarded(rules: Callable[[], Iterator[str]]) -> list[str]:
    """The findings of `rules`, and as the last one whatever stopped them."""
    found: list[str] = []
    try:
        for finding in rules():
            found.append(finding)  # noqa: PERF402  what was found before an error counts
    except Exception as error:  # noqa: BLE001  foreign code can raise anything, and that is the finding
        found.append(f"a rule of the task raised {_said(error)}")
    return found


def _said(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"


def _unique(findings: list[str]) -> list[str]:
    """Each finding once, in order."""
    return list(dict.fromkeys(findings))
