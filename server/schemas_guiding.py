"""A calibration of a real robot's cameras, on the wire."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Advice = Literal["taken", "enough", "unseen", "one_axis", "moving", "unseen_by", "ready", "known"]


class GuideBegin(BaseModel):
    """What to begin a calibration with."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    square_mm: Annotated[float, Field(ge=5, le=200, description="edge of a square of the printed board, mm")] = 36.0
    wanted: Annotated[int, Field(ge=8, le=60, description="poses to take of each camera")] = 15


class GuideTake(BaseModel):
    """How to look."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    take: Annotated[bool, Field(description="keep the pose if the arm stands still and the board is seen")] = False


class GuideCamera(BaseModel):
    """What one camera sees now."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    camera: Annotated[str, Field(examples=["left"])]
    found: Annotated[bool, Field(description="whether the board is in the picture")]
    taken: Annotated[int, Field(ge=0, description="poses taken so far")]
    jpeg: Annotated[str, Field(description="the picture with the corners that were found: a JPEG in Base64")]


class GuideStep(BaseModel):
    """One look of a calibration."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    cameras: list[GuideCamera]
    wanted: Annotated[int, Field(description="poses to take of each camera: what was asked for, or what is needed")]
    fewest: Annotated[int, Field(description="poses of each camera without which nothing can be calculated")]
    advice: Annotated[Advice, Field(description="what to do next")]
    camera: Annotated[str, Field(description="which camera the advice is about; empty: all")]
    said: Annotated[str, Field(description="the advice in English")]
    done: Annotated[bool, Field(description="whether there are poses enough to calculate")]


class GuideCameraResult(BaseModel):
    """What the calibration of one camera is worth."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    camera: str
    error_mm: Annotated[float, Field(description="of poses that had no part in the result, median")]
    poses: Annotated[int, Field(description="that the result is made from")]
    left_out: Annotated[int, Field(description="poses that contradict the rest")]
    good: Annotated[bool, Field(description="whether the error is 3 mm at most")]


class GuideOutcome(BaseModel):
    """What a calibration is worth, and whether it is kept."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    cameras: list[GuideCameraResult]
    apart_mm: Annotated[float | None, Field(description="between where two cameras place the board; null with one")]
    stored: bool


class GuideState(BaseModel):
    """A calibration that goes on: what its cameras see now, and what it is worth once that is calculated."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    step: Annotated[GuideStep | None, Field(description="null where none goes on")] = None
    outcome: Annotated[GuideOutcome | None, Field(description="null until it is calculated")] = None
