"""The ranges of a task's start layout: settings, each documented, that an experiment may change."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, ValidationError

from robot_adapters.base import AdapterError


class InvalidLayout(AdapterError):
    """A range that the task doesn't have, or that isn't one."""


class LayoutSettings(BaseModel):
    """Base of every task's ranges, in m, robot base frame. A task that always starts alike has none."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def _ordered(bounds: tuple[float, float]) -> tuple[float, float]:
    if not bounds[0] <= bounds[1]:
        raise ValueError("the first number must not be above the second")
    return bounds


Range = Annotated[tuple[float, float], AfterValidator(_ordered)]
"""From, to: what is drawn lies between, each place as likely."""


def draw(rng: np.random.Generator, *ranges: tuple[float, float]) -> list[float]:
    """One number from each range."""
    return [float(rng.uniform(low, high)) for low, high in ranges]


def changed(layout: LayoutSettings, by: Mapping[str, Any]) -> LayoutSettings:
    """`layout` with some of its ranges replaced.

    Raises:
        InvalidLayout: there is no such range, or its value is none; the remedy names those there are.
    """
    try:
        return type(layout).model_validate(layout.model_dump() | dict(by))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"]) or "layout"
        raise InvalidLayout(
            f"layout {where}: {first['msg']}",
            remedy="give [from, to] in m for some of: " + (", ".join(type(layout).model_fields) or "none"),
        ) from error
