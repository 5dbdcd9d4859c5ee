"""Tag files: which tags are on which object of a task, where on it, and at which heights it may rest (TOML)."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from robot_adapters.base import AdapterError, Array
from robot_adapters.franka.perception.moved import FIXED_FROM
from robot_adapters.tasks.base import Task

VERSION = 1
FACES: Mapping[str, Array] = {
    # columns: the tag's x (right as it is read), its y (up), and z, towards the reader, in the object's frame
    "up": np.eye(3),
    "+x": np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
    "-x": np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
    "+y": np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
    "-y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
}
"""How a tag lies on an object: flat on top with its right towards the object's x, or upright on one of its sides."""


class BadTags(AdapterError):
    """A tag file that is missing, damaged, or doesn't fit its task."""


class TagOn(BaseModel):
    """A tag on an object: the edge of its black square in m, its middle from the object's origin in m."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    number: int = Field(ge=0, le=586)
    size: float = Field(gt=0.005, lt=0.3)
    at: tuple[float, float, float]
    faces: Literal["up", "+x", "-x", "+y", "-y"] = "up"


class Tagged(BaseModel):
    """How an object is found: by tags, or without any by its colour (RGB, 0 to 1) and depth.

    rests: heights of its origin above the table, m, at which it may lie; with one camera, they are what is known.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    rests: tuple[float, ...] = Field(min_length=1)
    tags: tuple[TagOn, ...] = ()
    colour: tuple[float, float, float] | None = None
    half_height: float = Field(0.0, ge=0.0, le=0.5)
    """m from the origin to the top, of what is found by its colour."""

    @model_validator(mode="after")
    def _findable(self) -> Self:
        if not self.tags and self.colour is None:
            raise ValueError("give tags, or a colour to find it by")
        return self


class _File(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)

    version: Literal[1]
    objects: dict[str, Tagged] = Field(min_length=1)

    @model_validator(mode="after")
    def _distinct(self) -> Self:
        numbers = [tag.number for found in self.objects.values() for tag in found.tags]
        twice = sorted({n for n in numbers if numbers.count(n) > 1})
        if twice:
            raise ValueError(f"tag {twice[0]} is given twice")
        if any(n >= FIXED_FROM for n in numbers):
            raise ValueError(f"tags from {FIXED_FROM} on are for what never moves")
        return self


@dataclass(frozen=True)
class Tagging:
    """How the objects of a task are found. sliding: those of them that slide along x, with x where they are closed."""

    objects: Mapping[str, Tagged]
    sliding: Mapping[str, float]


def load(task: Task, path: str = "") -> Tagging:
    """The tag file at `path`, or the one that comes with this package for the task.

    Raises:
        BadTags: there is none, it can't be read, or it doesn't say how to find every object of the task.
    """
    sliding = {spec.name: spec.fixed[0] for spec in task.objects if spec.shape == "slider" and spec.fixed is not None}
    wanted = {spec.name for spec in task.objects if spec.movable} | sliding.keys()
    if not wanted and not path:
        return Tagging({}, {})
    name = path or f"the tag file of {task.name}"
    try:
        text = (
            Path(path).read_text("utf-8")
            if path
            else (files(__package__) / "tag_files" / f"{task.name}.toml").read_text()
        )
        read = _File.model_validate(tomllib.loads(text))
    except FileNotFoundError as error:
        raise BadTags(
            f"there is no tag file for {task.name}" if not path else f"there is no {path}",
            remedy="write one as docs/franka-cameras.md describes, and name it in eyes_settings.tags",
        ) from error
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise BadTags(f"{name} can't be read: {error}", remedy="it must be TOML; see docs/franka-cameras.md") from error
    except ValidationError as error:
        first = error.errors()[0]
        at = ".".join(map(str, first["loc"])) or "the file"
        raise BadTags(f"{name}: {at}: {first['msg']}", remedy="see docs/franka-cameras.md") from error
    if read.objects.keys() != wanted:
        raise BadTags(
            f"{name} has {', '.join(sorted(read.objects))}, the task {', '.join(sorted(wanted)) or 'nothing to find'}",
            remedy="name exactly the task's objects that move",
        )
    return Tagging(read.objects, sliding)
