"""Eyes for the Franka: cameras, their calibration, tags, and the scene. Importing this opens nothing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from robot_adapters.base import Unavailable

if TYPE_CHECKING:
    from robot_adapters.franka.eyes import Eyes


class PerceptionSettings(BaseModel):
    """Settings of the eyes (`eyes_settings` of the Franka adapter)."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    calibration: str = Field("", description="Folder of the calibrations; empty: `calibration` beside the data.")
    cameras: dict[str, str] = Field(
        default_factory=dict, description="Camera -> where its pictures come from; empty: all that are calibrated."
    )
    tags: str = Field("", description="Tag file of the task; empty: the one that comes with SEED.")
    table_height: float | None = Field(None, ge=-1.0, le=1.0, description="As in the adapter's settings.")
    lost_after: float = Field(3.0, gt=0.0, le=60.0, description="s unseen until an object counts as lost.")
    silence: float = Field(2.0, gt=0.0, le=30.0, description="s without a new picture until a camera counts as gone.")
    jpeg_quality: int = Field(90, ge=30, le=100, description="JPEG quality of the pictures that trainers judge.")


def perceive(task: str, settings: Mapping[str, object]) -> Eyes:
    """Open the cameras (`EyesFactory` of the entry point `perception`).

    Raises:
        Unavailable: a setting is wrong, or a camera or its calibration can't be had.
        BadTags: the tag file doesn't fit the task.
    """
    from robot_adapters.franka.perception.seeing import Perception  # noqa: PLC0415  importing this must stay light

    try:
        read = PerceptionSettings.model_validate(dict(settings))
    except ValidationError as error:
        first = error.errors()[0]
        at = ".".join(map(str, first["loc"])) or "eyes_settings"
        raise Unavailable(f"eyes_settings: {at}: {first['msg']}", remedy="see docs/franka-cameras.md") from error
    return Perception(task, read)
