"""Practice on the wire: proposals with known answers, corrected at once, before a trainer's clicks count."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field

from server.schemas import RowId, Wire
from server.schemas_labels import Answer, ClickId, TrainerName
from server.schemas_quality import PracticeRequired, Share
from server.schemas_views import Overlay, View


class PracticeCreate(Wire):
    """Ask for the next practice proposal."""

    trainer: TrainerName = "local"


class PracticeProgress(Wire):
    """How a trainer does in an experiment's practice."""

    required: Annotated[PracticeRequired | None, Field(description="null: clicks count without any practice")]
    answered: int
    right: int
    newest: Annotated[Share, Field(description="right among the newest that are looked at")]
    passed: bool
    counts: Annotated[bool, Field(description="whether this trainer's clicks count in the experiment now")]


class PracticeCard(Wire):
    """A practice proposal that waits for its answer."""

    id: RowId
    experiment_id: int
    number: Annotated[int, Field(description="number among this trainer's, from 1")]
    task: str
    instruction: str
    skill: str
    parameters: dict[str, float]
    subgoal: Annotated[str, Field(description="what comes next, in words")]
    views: list[View]
    opened_at: datetime
    progress: PracticeProgress


class PracticeAnswer(Wire):
    """What the trainer says of it."""

    click_id: ClickId
    value: Answer
    trainer: TrainerName = "local"


class PracticeSlip(Wire):
    """How far the call is from the ideal along an axis of the robot's base frame, and how far counts as good."""

    axis: Annotated[
        Literal["x", "y", "z", "end", "place"],
        Field(description="x: away from the robot; y: to its left; z: up; end: of a push; place: in any direction"),
    ]
    off_mm: float
    limit_mm: float


class PracticeReason(Wire):
    """Why the answer is what it is, from the task's own rule."""

    good: bool
    skill: str
    right_skill: str
    aim: str
    sideways: bool
    slips: Annotated[list[PracticeSlip], Field(description="what is wrong about the place; of a good call nothing")]
    closest: Annotated[PracticeSlip | None, Field(description="of a good call: the coordinate that is furthest out")]
    text: Annotated[str, Field(description="all of it in words")]


class PracticeResult(Wire):
    """The instant correction."""

    id: int
    value: Answer
    right_answer: Literal[-1, 1]
    right: bool
    reason: PracticeReason
    right_overlays: Annotated[dict[str, Overlay], Field(description="a call that would be good, drawn for each camera")]
    progress: PracticeProgress
