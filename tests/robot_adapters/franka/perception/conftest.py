"""One rendered scene for every test of a worker: the tagged objects of all tasks, a board, and two cameras."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

from robot_adapters.franka.perception import calibration
from robot_adapters.franka.perception.board import COLUMNS, MODULE, ROWS, SQUARE, modules
from robot_adapters.franka.perception.calibration import Calibration
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.tagging import FACES, load
from robot_adapters.registry import task as task_by_name
from robot_adapters.tasks.base import ObjectSpec, Part
from tests.robot_adapters.franka.perception.filming import Film
from tests.robot_adapters.franka.perception.rendering import EYES, Patch, Solid, Stage, cube, tag_patch, view

TASKS = ("stacking", "sweeping", "collecting_toy", "cooking_hotdog")
PLAIN = (0.78, 0.70, 0.55)


def tagged(task: str) -> dict[str, Solid]:
    """The task's objects as they are, called `task/object`, with the tags of its tag file."""
    staged = task_by_name(task)
    specs = {spec.name: spec for spec in staged.objects}
    solids = {}
    for name, what in load(staged).objects.items():
        patches = tuple(tag_patch(on.number, on.size, on.at, FACES[on.faces]) for on in what.tags)
        solids[f"{task}/{name}"] = Solid(_parts(specs[name]), patches)
    return solids


def _parts(spec: ObjectSpec) -> tuple[Part, ...]:
    half = spec.half_size
    return tuple(_hollow(part, spec) for part in spec.parts) or (Part((0.0, 0.0, 0.0), (half, half, half), PLAIN),)


def _hollow(part: Part, spec: ObjectSpec) -> Part:
    """A dish as its floor: what lies in it is seen over its rim."""
    if part.shape != "disc" or spec.seat is None:
        return part
    bottom, floor = part.centre[2] - part.half[2], spec.seat.at[2]
    return Part((*part.centre[:2], (bottom + floor) / 2), (*part.half[:2], (floor - bottom) / 2), part.colour, "disc")


def board_solid() -> Solid:
    """The calibration board; its body's origin is its middle, x right, y up as it is read."""
    grid = np.kron(modules(), np.ones((10, 10), dtype=bool))
    pixels = np.pad(np.where(grid, 0, 255).astype(np.uint8), 40, constant_values=255)
    return Solid((), (Patch(pixels, (COLUMNS * SQUARE + 8 * MODULE, ROWS * SQUARE + 8 * MODULE)),))


@pytest.fixture(scope="session")
def views() -> dict[str, View]:
    """Where the two cameras are."""
    return {name: view(eye) for name, eye in EYES.items()}


@pytest.fixture(scope="session")
def whole_stage(views: dict[str, View]) -> Iterator[Stage]:
    """Everything, drawn by one graphics context."""
    solids = {name: solid for task in TASKS for name, solid in tagged(task).items()}
    solids |= {"board": board_solid(), "toy": cube(0.02, (0.95, 0.38, 0.66))}
    made = Stage(solids, views)
    yield made
    made.close()


@pytest.fixture
def stage(whole_stage: Stage, views: dict[str, View]) -> Stage:
    """The same, with nothing on the table, the cameras in place, and noise that is the same in every run."""
    whole_stage.clear()
    whole_stage.rng = np.random.default_rng(0)
    for name, seen in views.items():
        whole_stage.stand(name, seen)
    return whole_stage


@pytest.fixture
def film(stage: Stage, tmp_path: Path) -> Film:
    """Takes pictures of the stage."""
    return Film(stage, tmp_path)


Calibrate = Callable[..., Path]


@pytest.fixture
def calibrated(tmp_path: Path, stage: Stage, views: dict[str, View]) -> Calibrate:
    """Stores exact calibrations of both cameras, with what they see of the table now; the folder."""

    def make(**sources: str) -> Path:
        where = tmp_path / "calibration"
        for name, seen in views.items():
            grey = cv2.cvtColor(stage.draw(name), cv2.COLOR_RGB2GRAY)
            source = sources.get(name, "opencv:99")
            calibration.save(Calibration(name, source, seen, 0.001, 15, np.asarray(grey, dtype=np.uint8)), where)
        return where

    return make
