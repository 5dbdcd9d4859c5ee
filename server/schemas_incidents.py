"""What people and cameras saw go wrong, on the wire: reports on executions, and incidents with their video."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from server.schemas_labels import ClickId, TrainerName

Reported = Annotated[
    Literal["success", "failed", "damage", "needs_reset"],
    Field(description="what a person saw; needs_reset: the task can't go on without a hand"),
]


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ReportCreate(_Wire):
    """What somebody saw an execution do, where the robot can't tell by itself."""

    report_id: ClickId
    outcome: Reported
    note: Annotated[str, Field(max_length=1000)] = ""
    trainer: TrainerName = "local"


class Report(_Wire):
    """One report. The execution's own outcome stays as the robot told it."""

    report_id: str
    outcome: Reported
    note: str
    trainer: str
    at: datetime


class Violation(_Wire):
    """A safety violation that the robot noticed."""

    kind: Literal["damage", "manual_reset"]
    detail: str


class IncidentFrame(_Wire):
    """One picture of an incident's video."""

    camera: str
    robot: int
    width: int
    height: int
    taken_at: Annotated[float, Field(description="seconds since the epoch")]
    image: Annotated[str, Field(description="SHA-256 of the JPEG")]
    url: Annotated[str, Field(description="path of the JPEG below the server's root")]


class Incident(_Wire):
    """A safety violation or an emergency stop, with what the cameras saw in the seconds before."""

    id: int
    experiment_id: int
    execution_id: int | None
    kind: Literal["damage", "manual_reset", "halt"]
    detail: str
    at: datetime
    frames: Annotated[list[IncidentFrame], Field(description="oldest first; none where nothing had moved")]


class IncidentPage(_Wire):
    """Incidents, newest first."""

    next_cursor: str | None = None
    items: list[Incident]
