"""Attending a real robot, on the wire."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

OperatorName = Annotated[
    str,
    StringConstraints(min_length=1, max_length=64, strip_whitespace=True),
    Field(examples=["anna"], description="who attends the robot"),
]


class Attending(BaseModel):
    """An operator stands at the robot and watches it, for so long unless it is said again."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    operator: OperatorName
    seconds: Annotated[float, Field(ge=1.0, le=30.0, description="until it has to be said again")] = 5.0
