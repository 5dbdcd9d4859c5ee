"""Tasks, adapters, algorithms and teachers that can be chosen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from fastapi import APIRouter

from robot_adapters import registry
from server import catalogue
from server.errors import ServiceError
from server.routes.dependencies import errors
from server.schemas_catalogue import AdapterInfo, AlgorithmInfo, TaskInfo, TeacherInfo
from server.teacher import teachers

router = APIRouter(tags=["catalogue"])
T = TypeVar("T")


@router.get("/tasks", responses=errors())
def list_tasks() -> list[TaskInfo]:
    """Tasks with their skills, state and subgoals."""
    return catalogue.task_infos()


@router.get("/tasks/{name}", responses=errors(404))
def get_task(name: str) -> TaskInfo:
    """One task."""
    return _named(name, {task.name: task for task in list_tasks()}, "task")


@router.get("/adapters", responses=errors())
def list_adapters() -> list[AdapterInfo]:
    """Adapters (simulators and robots) with the tasks that they stage."""
    return [catalogue.adapter_info(name, factory) for name, factory in sorted(registry.adapters().items())]


@router.get("/adapters/{name}", responses=errors(404))
def get_adapter(name: str) -> AdapterInfo:
    """One adapter."""
    return _named(name, {adapter.name: adapter for adapter in list_adapters()}, "adapter")


@router.get("/algorithms", responses=errors())
def list_algorithms() -> list[AlgorithmInfo]:
    """Learning algorithms with their presets and the JSON Schema of their settings."""
    return [catalogue.algorithm_info(name, factory) for name, factory in catalogue.algorithms().items()]


@router.get("/algorithms/{name}", responses=errors(404))
def get_algorithm(name: str) -> AlgorithmInfo:
    """One algorithm."""
    return _named(name, {algorithm.name: algorithm for algorithm in list_algorithms()}, "algorithm")


@router.get("/teachers", responses=errors())
def list_teachers() -> list[TeacherInfo]:
    """Synthetic trainers that may judge in a person's place, with the JSON Schema of their settings."""
    return [catalogue.teacher_info(name, factory) for name, factory in teachers().items()]


@router.get("/teachers/{name}", responses=errors(404))
def get_teacher(name: str) -> TeacherInfo:
    """One synthetic trainer."""
    return _named(name, {teacher.name: teacher for teacher in list_teachers()}, "teacher")


def _named(name: str, known: Mapping[str, T], kind: str) -> T:
    if name not in known:
        raise ServiceError(404, f"there is no {kind} named {name!r}", remedy=f"use one of: {', '.join(known)}")
    return known[name]
