"""Draws the table, the task's objects and the gripper of the kinematic adapter as two calibrated cameras would see."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from PIL import Image

from robot_adapters.base import Array, CameraFrame
from robot_adapters.kinematic.pencil import (
    BORDER,
    EDGE,
    FINE,
    FINGER,
    HAND,
    HEIGHT,
    LINES,
    ROOM,
    TABLE,
    WIDTH,
    Colour,
    Pencil,
)
from robot_adapters.kinematic.world import FINGER_BELOW, FINGER_HALF, TABLE_HALF, World
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, Part, Vector

# m by which parts may overlap and still count as side by side
TOUCH = 0.0015

Solid = tuple[Vector, Part]
"""An object's place, m, base frame, and one of its parts."""


@dataclass(frozen=True)
class Snapshot:
    """What a picture shows: objects' places, grip site and finger opening, m, base frame; what has fallen over."""

    at: Mapping[str, Vector]
    gripper: Vector
    opening: float
    fallen: frozenset[str] = frozenset()

    @classmethod
    def of(cls, world: World) -> Snapshot:
        """The world as it is now."""
        places = {name: (x, y, z) for name, (x, y, z) in world.at.items()}
        x, y, z = world.gripper
        return cls(places, (x, y, z), world.opening(), frozenset(world.tilts))


class Painter:
    """Draws snapshots of one task's scene. What never moves and lies flat is drawn once per camera."""

    def __init__(self, objects: tuple[ObjectSpec, ...], table_height: float, quality: int) -> None:
        self._solid = tuple((spec.name, _parts(spec)) for spec in objects if spec.shape != "area")
        self._areas = tuple(spec for spec in objects if spec.shape == "area" and spec.fixed is not None)
        self._table = table_height
        self._quality = quality
        self._backgrounds: dict[str, Image.Image] = {}

    def frame(self, camera: str, snapshot: Snapshot, taken_at: float) -> CameraFrame:
        """A JPEG of `snapshot` (s since the epoch: `taken_at`)."""
        buffer = io.BytesIO()
        self.draw(camera, snapshot).save(buffer, "JPEG", quality=self._quality)
        return CameraFrame(camera, buffer.getvalue(), WIDTH, HEIGHT, taken_at)

    def draw(self, camera: str, snapshot: Snapshot) -> Image.Image:
        """A 640 x 480 RGB picture."""
        if camera not in self._backgrounds:
            self._backgrounds[camera] = self._background(camera)
        canvas = self._backgrounds[camera].copy()
        pencil = Pencil(canvas, camera)
        solids = [
            (snapshot.at[name], _lying(part) if name in snapshot.fallen else part)
            for name, parts in self._solid
            for part in parts
        ]
        solids += _hand(snapshot)
        for at, part in solids:
            pencil.shadow(np.add(at, part.centre), np.array(part.half), self._table, round_=part.shape != "box")
        for at, part in _back_to_front(solids, pencil.eye):
            pencil.part(np.add(at, part.centre), part)
        for spec in self._areas:
            pencil.sphere(np.array(spec.fixed), spec.half_size, _rgb(spec.colour), 60)
        return canvas.reduce(FINE)

    def _background(self, camera: str) -> Image.Image:
        canvas = Image.new("RGB", (WIDTH * FINE, HEIGHT * FINE), ROOM)
        pencil = Pencil(canvas, camera)
        x, y, z = *table.CENTRE, self._table
        pencil.box(np.array([x, y, z - 0.025]), np.array([TABLE_HALF, TABLE_HALF, 0.025]), TABLE, edge=EDGE)
        for i in range(-3, 4):
            pencil.line([[x + i / 10, y - TABLE_HALF, z], [x + i / 10, y + TABLE_HALF, z]], LINES, 2)
            pencil.line([[x - TABLE_HALF, y + i / 10, z], [x + TABLE_HALF, y + i / 10, z]], LINES, 2)
        # the skills' workspace
        corners = [[table.X[i], table.Y[j], z] for i, j in ((0, 0), (0, 1), (1, 1), (1, 0), (0, 0))]
        pencil.line(corners, BORDER, 3)
        for spec in self._areas:
            centre = np.array(spec.fixed)
            foot = np.array([centre[0], centre[1], z])
            pencil.disc(foot, spec.half_size, _tint(_rgb(spec.colour), 0.75))
            pencil.line([foot.tolist(), centre.tolist()], _tint(_rgb(spec.colour), 0.4), 3)
        return canvas


def _parts(spec: ObjectSpec) -> tuple[Part, ...]:
    """A cube is a compound of one part."""
    return spec.parts or (Part((0.0, 0.0, 0.0), (spec.half_size,) * 3, spec.colour),)


def _lying(part: Part) -> Part:
    """The part of an object that fell over, away from the robot."""
    (x, y, z), (a, b, c) = part.centre, part.half
    return Part((z, y, -x), (c, b, a), part.colour, part.shape, part.opacity)


def _back_to_front(solids: list[Solid], eye: Array) -> list[Solid]:
    """The parts in an order in which none is painted over by what it covers, seen from `eye` (3,)."""
    middle = np.array([np.add(at, part.centre) for at, part in solids])
    half = np.array([part.half for _, part in solids])
    low, high = middle - half + TOUCH, middle + half - TOUCH
    # i can't cover j if a plane between the two has the eye on j's side
    below = (high[:, None] <= low[None]) & (eye >= high)[:, None]
    above = (low[:, None] >= high[None]) & (eye <= low)[:, None]
    covers = ~(below | above).any(axis=2)
    far = np.linalg.norm(middle - eye, axis=1)
    left, ordered = sorted(range(len(solids)), key=lambda i: -far[i]), []
    while left:
        # one that covers nothing of what is still to come; where parts meet, the farthest
        free = (i for i in left if not any(covers[i, j] for j in left if j != i))
        chosen = next(free, left[0])
        left.remove(chosen)
        ordered.append(solids[chosen])
    return ordered


def _hand(snapshot: Snapshot) -> list[Solid]:
    """The gripper: two fingers that close along y, the hand, and its wrist."""
    reach = snapshot.opening / 2 + FINGER_HALF / 2
    parts = [
        Part((0.0, side * reach, 0.03 - FINGER_BELOW), (FINGER_HALF, FINGER_HALF / 2, 0.03), _share(FINGER))
        for side in (-1, 1)
    ]
    parts.append(Part((0.0, 0.0, 0.066), (0.022, 0.075, 0.015), _share(HAND)))
    parts.append(Part((0.0, 0.0, 0.105), (0.026, 0.026, 0.024), _share(HAND)))
    return [(snapshot.gripper, part) for part in parts]


def _share(colour: Colour) -> tuple[float, float, float]:
    return (colour[0] / 255, colour[1] / 255, colour[2] / 255)


def _rgb(colour: tuple[float, float, float]) -> Colour:
    return (round(colour[0] * 255), round(colour[1] * 255), round(colour[2] * 255))


def _tint(colour: Colour, by: float) -> Colour:
    """`colour` mixed with that much of the table's."""
    r, g, b = (round(c + (t - c) * by) for c, t in zip(colour, TABLE, strict=True))
    return (r, g, b)
