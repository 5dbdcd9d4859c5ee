"""What the catalogue tells of tasks, adapters, algorithms and teachers, and who judges."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from server.schemas import Page, Wire


class Parameter(Wire):
    """A skill's parameter with its bounds."""

    name: str
    unit: str
    low: float
    high: float
    description: str = ""


class Skill(Wire):
    """A primitive that a task offers."""

    name: str
    parameters: list[Parameter]
    description: str = ""


class TaskInfo(Wire):
    """A task of the catalogue."""

    name: str
    title: str
    instruction: str
    state: list[dict[str, str | int]]
    skills: list[Skill]
    subgoals: list[str]
    horizon: int


class AdapterInfo(Wire):
    """An adapter of the catalogue; `tasks` are those it can stage."""

    name: str
    description: str
    simulated: bool
    tasks: list[str]
    settings_schema: dict[str, Any]


class AlgorithmInfo(Wire):
    """An algorithm of the catalogue; `settings_schema` is JSON Schema."""

    name: str
    description: str
    presets: dict[str, dict[str, Any]]
    settings_schema: dict[str, Any]


class TeacherInfo(Wire):
    """A synthetic trainer of the catalogue; `settings_schema` is JSON Schema."""

    name: str
    description: str
    settings_schema: dict[str, Any]


class Trainer(Wire):
    """Someone who judges: a person, or a teacher."""

    id: int
    name: str
    kind: Literal["person", "teacher", "evaluation"]
    created_at: datetime


class TrainerPage(Page):
    """Trainers by id."""

    items: list[Trainer]
