"""What a calibration of the cameras tells, step by step, as the robot worker replies it: JSON, lengths in mm."""

from __future__ import annotations

import base64
import dataclasses
from typing import Any

from robot_adapters.guiding import GuideLook, GuideResult


def looked(look: GuideLook) -> dict[str, Any]:
    """One look of the cameras at the board, with what each sees."""
    cameras = [
        dataclasses.asdict(seen) | {"jpeg": base64.b64encode(seen.jpeg).decode("ascii")} for seen in look.cameras
    ]
    return dataclasses.asdict(look) | {"cameras": cameras}


def worth(result: GuideResult) -> dict[str, Any]:
    """How exact the cameras' places are."""
    cameras = [
        {
            "camera": found.camera,
            "error_mm": round(1000 * found.error, 2),
            "poses": found.poses,
            "left_out": found.left_out,
            "good": found.good,
        }
        for found in result.cameras
    ]
    apart = None if result.apart is None else round(1000 * result.apart, 2)
    return {"cameras": cameras, "apart_mm": apart, "stored": result.stored}
