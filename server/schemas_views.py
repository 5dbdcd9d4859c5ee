"""A proposal drawn on a camera's picture, on the wire."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


Point = tuple[float, float]


class Overlay(_Wire):
    """A proposal drawn for one camera, in pixels of the full-size image (see `robot_adapters.base.CameraOverlay`)."""

    dot: Point | None = None
    line: tuple[Point, Point] | None = None
    arrow: bool = False
    bar: tuple[Point, Point] | None = None
    ring: Point | None = None
    in_view: bool = True
    ghost: Annotated[
        list[list[Point]], Field(description="outlines of fingers and hand at the target; empty where not known")
    ] = []
    yaw: Annotated[float | None, Field(description="the gripper's angle, rad, that bar and ghost are drawn for")] = None
    workspace: Annotated[
        list[Point], Field(description="corners of where skills may act, the lower four first; empty where not known")
    ] = []


class View(_Wire):
    """One camera's still image of the observation, with the overlay that was computed on it."""

    camera: str
    width: int
    height: int
    image: Annotated[str, Field(description="SHA-256 of the JPEG; the same hash is the same picture")]
    url: Annotated[str, Field(description="path of the JPEG below the server's root")]
    overlay: Overlay
