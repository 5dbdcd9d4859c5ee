"""A camera's calibration as a file: versioned JSON beside the data, with a picture to notice a moved camera by."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Self

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from robot_adapters.base import AdapterError, Array
from robot_adapters.franka.perception.camera import Lens
from robot_adapters.franka.perception.rays import View

VERSION = 1
AGAIN = "calibrate it: seed robot calibrate --camera {}=SOURCE (docs/franka-cameras.md)"


class BadCalibration(AdapterError):
    """A calibration that is missing, damaged, or of another version."""


@dataclass(frozen=True)
class Calibration:
    """Where a camera is and how it sees. error: m, as `HandEye` has it. made_at: ISO 8601, UTC.

    reference: (h, w) grey, what it saw then. fixed_tags: number -> (2,) pixels of tags that never move.
    """

    camera: str
    source: str
    view: View
    error: float
    poses: int
    reference: NDArray[np.uint8]
    fixed_tags: dict[int, Array] = field(default_factory=dict)
    made_at: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))


class _LensFile(BaseModel):
    model_config = ConfigDict(extra="forbid")

    width: int = Field(gt=0)
    height: int = Field(gt=0)
    matrix: list[list[float]]
    distortion: list[float] = Field(min_length=5, max_length=5)


class _CalibrationFile(BaseModel):
    model_config = ConfigDict(extra="forbid")

    version: int
    camera: str
    source: str
    made_at: str
    lens: _LensFile
    camera_from_base: list[list[float]]
    error_mm: float = Field(ge=0.0)
    poses: int = Field(ge=0)
    fixed_tags: dict[int, tuple[float, float]]

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        lens, pose = np.array(self.lens.matrix), np.array(self.camera_from_base)
        if lens.shape != (3, 3) or not np.isfinite(lens).all() or lens[0, 0] <= 0 or lens[1, 1] <= 0:
            raise ValueError("lens.matrix must be 3 x 3 with positive focal lengths")
        rigid = pose.shape == (4, 4) and np.allclose(pose[3], [0, 0, 0, 1])
        if not rigid or not np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-6):
            raise ValueError("camera_from_base must be a rigid transform, 4 x 4")
        return self


def folder(setting: str = "") -> Path:
    """Where calibrations lie: as a setting says, else beside the data."""
    return Path(setting) if setting else Path(os.environ.get("SEED_DATA_DIR") or "data") / "calibration"


def save(calibration: Calibration, where: Path) -> Path:
    """Write it; what was there before is replaced as a whole or not at all."""
    where.mkdir(parents=True, exist_ok=True)
    lens = calibration.view.lens
    stored: dict[str, Any] = {
        "version": VERSION,
        "camera": calibration.camera,
        "source": calibration.source,
        "made_at": calibration.made_at,
        "lens": {
            "width": lens.width,
            "height": lens.height,
            "matrix": lens.matrix.tolist(),
            "distortion": lens.distortion.tolist(),
        },
        "camera_from_base": calibration.view.camera_from_base.tolist(),
        "error_mm": round(calibration.error * 1000, 3),
        "poses": calibration.poses,
        "fixed_tags": {str(n): [float(p) for p in at] for n, at in sorted(calibration.fixed_tags.items())},
    }
    path = where / f"{calibration.camera}.json"
    _replace(where / f"{calibration.camera}.png", cv2.imencode(".png", calibration.reference)[1].tobytes())
    _replace(path, (json.dumps(stored, indent=2) + "\n").encode())
    return path


def load(camera: str, where: Path) -> Calibration:
    """The stored calibration of a camera.

    Raises:
        BadCalibration: there is none that can be used; the remedy says what to do.
    """
    path, again = where / f"{camera}.json", AGAIN.format(camera)
    try:
        raw = json.loads(path.read_text("utf-8"))
    except FileNotFoundError as error:
        raise BadCalibration(f"camera {camera} isn't calibrated: there is no {path}", remedy=again) from error
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise BadCalibration(f"{path} can't be read: {error}", remedy=again) from error
    version = raw.get("version") if isinstance(raw, dict) else None
    if version != VERSION:
        raise BadCalibration(f"{path} has version {version!r}, not {VERSION}", remedy=again)
    try:
        read = _CalibrationFile.model_validate(raw)
    except ValidationError as error:
        first = error.errors()[0]
        at = ".".join(map(str, first["loc"])) or "the file"
        raise BadCalibration(f"{path}: {at}: {first['msg']}", remedy=again) from error
    reference = cv2.imread(str(path.with_suffix(".png")), cv2.IMREAD_GRAYSCALE)
    lens = Lens(read.lens.width, read.lens.height, np.array(read.lens.matrix), np.array(read.lens.distortion))
    if reference is None or reference.shape != (lens.height, lens.width):
        raise BadCalibration(f"the picture beside {path} is missing, or has another size", remedy=again)
    return Calibration(
        read.camera,
        read.source,
        View(lens, np.array(read.camera_from_base)),
        read.error_mm / 1000,
        read.poses,
        np.asarray(reference, dtype=np.uint8),
        {number: np.array(at) for number, at in read.fixed_tags.items()},
        read.made_at,
    )


def stored(where: Path) -> tuple[str, ...]:
    """Names of the cameras that have a file here."""
    return tuple(sorted(p.stem for p in where.glob("*.json"))) if where.is_dir() else ()


def _replace(path: Path, content: bytes) -> None:
    half = path.with_name(f".{path.name}.half")
    half.write_bytes(content)
    half.replace(path)
