"""The catalogue: tasks, adapters, algorithms and teachers found by entry points, and the check of a new experiment."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Mapping
from importlib.metadata import entry_points
from typing import Any, TypeVar, cast

from pydantic import BaseModel, ValidationError

from agent.algorithm import AlgorithmFactory
from robot_adapters import registry
from robot_adapters.base import AdapterFactory
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.layout import LayoutSettings
from server import auto_approval
from server.errors import invalid
from server.scene import scene_info
from server.schemas import ExperimentCreate, Mode
from server.schemas_catalogue import AdapterInfo, AlgorithmInfo, Parameter, Skill, TaskInfo, TeacherInfo
from server.schemas_problems import FieldProblem
from server.schemas_together import Together, TogetherUpdate
from server.teacher import TeacherFactory, teachers

T = TypeVar("T")

log = logging.getLogger("seed.catalogue")


def algorithms() -> dict[str, AlgorithmFactory]:
    """Algorithms by name (entry points of the group `seed.algorithms`); a broken foreign one is skipped."""
    return cast(dict[str, AlgorithmFactory], _load("seed.algorithms"))


def task_infos() -> list[TaskInfo]:
    """Every installed task as the wire shows it; a foreign one that is broken is left out."""
    found = []
    for name, kind in sorted(registry.tasks().items()):
        try:
            found.append(task_info(name, kind))
        except Exception as error:  # noqa: BLE001  foreign code may fail in any way; the others must still work
            log.warning("the task %s is left out (%s): run seed check %s", name, error, name)
    return found


def task_info(name: str, kind: type[Task]) -> TaskInfo:
    """A task as the wire shows it."""
    task = kind()
    skills = [
        Skill(
            name=spec.name,
            description=spec.description,
            parameters=[
                Parameter(name=p.name, unit=p.unit, low=p.low, high=p.high, description=p.description)
                for p in spec.parameters
            ],
        )
        for spec in task.skills
    ]
    return TaskInfo(
        name=name,
        title=task.title,
        instruction=task.instruction,
        state=[
            {"name": f.name, "size": f.size, "unit": f.unit, "description": f.description} for f in task.state_fields
        ],
        skills=skills,
        subgoals=[s.description for s in task.subgoals],
        horizon=task.horizon,
        by_hand=getattr(task, "reset_by_hand", ""),
        scene=scene_info(task),
    )


def adapter_info(name: str, factory: AdapterFactory) -> AdapterInfo:
    """An adapter as the wire shows it."""
    return AdapterInfo(
        name=name,
        description=factory.description,
        simulated=factory.simulated,
        tasks=list(registry.staged(factory)),
        settings_schema=factory.settings.model_json_schema(),
    )


def algorithm_info(name: str, factory: AlgorithmFactory) -> AlgorithmInfo:
    """An algorithm as the wire shows it."""
    return AlgorithmInfo(
        name=name,
        description=factory.description,
        presets={preset: dict(values) for preset, values in factory.presets.items()},
        settings_schema=factory.settings.model_json_schema(),
    )


def teacher_info(name: str, factory: TeacherFactory) -> TeacherInfo:
    """A teacher as the wire shows it."""
    return TeacherInfo(name=name, description=factory.description, settings_schema=factory.settings.model_json_schema())


def check(body: ExperimentCreate) -> ExperimentCreate:
    """`body` with all settings resolved: defaults, then the preset, then what the body says.

    Raises:
        ServiceError: 422; its fields name what is wrong (e.g. `settings.batch_size`), its remedy the known names.
    """
    adapter = _known("adapter", body.adapter, registry.adapters())
    _known("task", body.task, registry.tasks())
    staged = registry.staged(adapter)
    if body.task not in staged:
        raise invalid(
            [FieldProblem(field="adapter", message=f"{body.adapter!r} can't stage the task {body.task!r}")],
            remedy=f"choose a task that {body.adapter} stages: {_list(staged)}",
        )
    if body.num_envs > 1 and not adapter.simulated:
        raise invalid(
            [FieldProblem(field="num_envs", message=f"{body.adapter!r} is a real robot, of which there is one")],
            remedy="leave num_envs at 1, or choose a simulated adapter",
        )
    algorithm = _known("algorithm", body.algorithm, algorithms())
    preset: Mapping[str, Any] = {}
    if body.preset is not None:
        preset = _known("preset", body.preset, algorithm.presets)
    _check_layout(registry.tasks()[body.task]().layout, adapter, body.adapter_settings)
    lockstep = body.teacher is not None if body.lockstep is None else body.lockstep
    check_together(body.together, teacher=body.teacher, lockstep=lockstep)
    settings = _resolve("settings", algorithm.settings, {**preset, **body.settings})
    auto_approval.check(body.auto_approval, adapter=body.adapter, simulated=adapter.simulated, settings=settings)
    return body.model_copy(
        update={
            "mode": body.mode or (Mode.EXECUTE_APPROVED if adapter.simulated else Mode.PROPOSE_ONLY),
            "settings": settings,
            "adapter_settings": _resolve("adapter_settings", adapter.settings, body.adapter_settings),
            "teacher_settings": _teacher_settings(body),
        }
    )


def check_together(together: Together | TogetherUpdate, *, teacher: str | None, lockstep: bool) -> None:
    """Refuse parallel proposals where a run is to be repeatable: which are open depends on who is there, and when.

    A teacher is alone, so with one nobody else can have to say good as well.

    Raises:
        ServiceError: 422, naming the field.
    """
    if (together.least or 1) > 1 and teacher is not None:
        raise invalid(
            [FieldProblem(field="together.least", message="is for several trainers, and a synthetic teacher is alone")],
            remedy="leave it at 1, or create the experiment without a teacher",
        )
    if together.parallel and (teacher is not None or lockstep):
        why = "a synthetic teacher judges one after another" if teacher else "every step can be repeated exactly"
        raise invalid(
            [FieldProblem(field="together.parallel", message=f"is for trainers who come and go, and here {why}")],
            remedy="leave it off, or create the experiment without a teacher and with lockstep false",
        )


def _teacher_settings(body: ExperimentCreate) -> dict[str, Any]:
    """All settings of the teacher; none where people judge."""
    if body.teacher is not None:
        factory = _known("teacher", body.teacher, teachers())
        return _resolve("teacher_settings", factory.settings, body.teacher_settings)
    if body.teacher_settings:
        raise invalid(
            [FieldProblem(field="teacher_settings", message="there is no teacher whose settings these are")],
            remedy=f"name a teacher ({_list(teachers())}), or leave them out",
        )
    return {}


def _check_layout(layout: LayoutSettings, adapter: AdapterFactory, settings: Mapping[str, Any]) -> None:
    """Refuse ranges of the start that the task doesn't have, here and not when the adapter is built."""
    changed = settings.get("layout")
    if "layout" in adapter.settings.model_fields and isinstance(changed, Mapping):
        _resolve("adapter_settings.layout", type(layout), changed, layout.model_dump())


def _known(field: str, name: str, known: Mapping[str, T]) -> T:
    found = known.get(name)
    if found is None:
        raise invalid(
            [FieldProblem(field=field, message=f"there is no {field} named {name!r}")],
            remedy=f"use one of: {_list(known)}" if known else f"there is no {field} to choose; leave it out",
        )
    return found


def _resolve(
    field: str, model: type[BaseModel], values: Mapping[str, Any], others: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """All settings of `model` as JSON values: `values`, then `others`, then the defaults."""
    unknown = sorted(set(values) - set(model.model_fields))
    if unknown:
        raise invalid(
            [FieldProblem(field=f"{field}.{name}", message="there is no such setting") for name in unknown[:50]],
            remedy=f"the settings are: {_list(model.model_fields)}"
            if model.model_fields
            else "leave it out: there are none",
        )
    for name, value in values.items():
        if not _finite(value):
            raise invalid([FieldProblem(field=f"{field}.{name}", message="is not finite")], remedy="give a number")
    try:
        return model.model_validate({**(others or {}), **values}).model_dump(mode="json")
    except ValidationError as error:
        fields = [FieldProblem(field=".".join([field, *map(str, e["loc"])]), message=e["msg"]) for e in error.errors()]
        raise invalid(fields, remedy=f"correct the named ones of: {_list(model.model_fields)}") from error


def _finite(value: Any) -> bool:
    """Whether no number in a JSON value is infinite or none at all."""
    if isinstance(value, list):
        return all(_finite(item) for item in value)
    return not isinstance(value, float) or math.isfinite(value)


def _load(group: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for entry in entry_points(group=group):
        try:
            found[entry.name] = entry.load()
        except Exception as error:  # noqa: BLE001  a foreign plug-in may fail in any way; the others must still work
            log.warning("the plug-in %s of %s can't be loaded: %s", entry.name, group, error)
    return dict(sorted(found.items()))


def _list(names: Iterable[str]) -> str:
    return ", ".join(sorted(names))
