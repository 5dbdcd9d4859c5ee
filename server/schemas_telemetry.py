"""What a robot tells of itself, on the wire."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field


class Telemetry(BaseModel):
    """What a robot tells of itself beside its state; what it can't tell is empty or null."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    joints: Annotated[list[float], Field(description="rad, base to wrist")] = []
    joint_limits: Annotated[list[tuple[float, float]], Field(description="lowest and highest of each joint, rad")] = []
    gripper: Annotated[tuple[float, float, float] | None, Field(description="grip site, m, robot base frame")] = None
    opening: Annotated[float | None, Field(description="m between the fingers")] = None
    force: Annotated[tuple[float, float, float] | None, Field(description="N at the hand, in its own frame")] = None
    calibration: Annotated[
        Literal["exact", "measured", "missing"] | None,
        Field(description="of the cameras: computed, calibrated, or not to be trusted"),
    ] = None
    calibration_detail: Annotated[str, Field(description="when and how well, in words")] = ""
    scene: Annotated[
        Literal["clear", "changed", "unclear"] | None,
        Field(description="whether it is as the newest picture shows it; null where nobody looks again"),
    ] = None
    scene_detail: Annotated[str, Field(description="why it isn't, in words that a trainer understands")] = ""
    mode: Annotated[
        Literal["idle", "moving", "reflex", "user_stopped", "disconnected"] | None,
        Field(description="what a real arm is doing; null for a simulated one"),
    ] = None
    words: Annotated[str, Field(description="the same in words that a trainer understands")] = ""
