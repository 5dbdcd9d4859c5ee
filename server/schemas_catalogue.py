"""What the catalogue tells of tasks, adapters, algorithms and teachers, and who judges."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import Field

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


Vector = tuple[float, float, float]


class Solid(Wire):
    """A visible part of an object: a box, or a disc or ring about z. `centre` from the object's origin, m."""

    shape: Literal["box", "disc", "ring", "sphere"]
    centre: Vector
    half: Vector
    colour: Vector
    opacity: float = 1.0


class SceneObject(Wire):
    """Something on the table, and where the state vector tells its place. All lengths in m, robot base frame."""

    name: str
    parts: list[Solid]
    fixed: Annotated[Vector | None, Field(description="where it stands, or stands when slid shut")] = None
    state_at: Annotated[
        int | None, Field(description="index of its x in the state, y and maybe z after it; null: not told")
    ] = None
    state_size: Annotated[int, Field(description="2: the state has no z, it lies on the table")] = 3
    slides_at: Annotated[
        int | None, Field(description="index in the state of how far it is from `fixed` towards the robot")
    ] = None
    rests: Annotated[float, Field(description="height of its origin above the table when it lies there")] = 0.0


class SceneInfo(Wire):
    """A task's scene, enough to draw it from the state alone. Lengths in m, robot base frame."""

    table_height: float
    table_centre: tuple[float, float]
    workspace: Annotated[tuple[Vector, Vector] | None, Field(description="corners of where skills may act")] = None
    objects: list[SceneObject]
    gripper_at: Annotated[int | None, Field(description="index in the state of the grip site's x; null: not told")] = (
        None
    )


class TaskInfo(Wire):
    """A task of the catalogue."""

    name: str
    title: str
    instruction: str
    state: list[dict[str, str | int]]
    skills: list[Skill]
    subgoals: list[str]
    horizon: int
    by_hand: Annotated[str, Field(description="what to do by hand where only that helps; empty: the task doesn't say")]
    scene: SceneInfo


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
