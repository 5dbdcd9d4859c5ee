"""Draws the table, blocks, areas and gripper of the kinematic adapter as two calibrated cameras would see them."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from robot_adapters.base import Array, CameraCalibration, CameraFrame
from robot_adapters.kinematic.world import FINGER_BELOW, FINGER_HALF, TABLE_HALF, World
from robot_adapters.projection import look_at, project
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec

WIDTH, HEIGHT = 640, 480
# drawn at twice the size and reduced: Pillow's polygons have jagged edges
FINE = 2

# the same two places as the robosuite adapter's cameras: left and right of the robot, opposite it
EYES = {"left": (1.36, 0.58, 0.588), "right": (1.36, -0.58, 0.588)}
CALIBRATIONS: Mapping[str, CameraCalibration] = {
    name: look_at(
        np.array(eye),
        np.array([0.54, 0.0, -0.082]),
        vertical_field_of_view=np.pi / 4,
        width=WIDTH,
        height=HEIGHT,
    )
    for name, eye in EYES.items()
}

Colour = tuple[int, int, int]
ROOM: Colour = (214, 220, 226)
TABLE: Colour = (250, 250, 248)
EDGE: Colour = (186, 190, 196)
LINES: Colour = (229, 231, 232)
BORDER: Colour = (196, 202, 208)
SHADOW: Colour = (218, 220, 222)
HAND: Colour = (88, 94, 102)
FINGER: Colour = (58, 62, 70)
# light from above and the cameras' side
BRIGHTNESS = {(0, 0, 1): 1.0, (1, 0, 0): 0.82, (-1, 0, 0): 0.6, (0, 1, 0): 0.7, (0, -1, 0): 0.7, (0, 0, -1): 0.4}


@dataclass(frozen=True)
class Snapshot:
    """What a picture shows: block centres, grip site and finger opening, m, robot base frame."""

    blocks: Mapping[str, tuple[float, ...]]
    gripper: tuple[float, ...]
    opening: float

    @classmethod
    def of(cls, world: World) -> Snapshot:
        """The world as it is now."""
        return cls({name: tuple(at) for name, at in world.blocks.items()}, tuple(world.gripper), world.opening())


class Painter:
    """Draws snapshots of one task's scene. What never moves is drawn once per camera."""

    def __init__(self, objects: tuple[ObjectSpec, ...], table_height: float, quality: int) -> None:
        self._blocks = {spec.name: spec for spec in objects if spec.shape == "block"}
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
        pencil = _Pencil(canvas, camera)
        boxes = [
            (np.array(at), np.full(3, self._blocks[name].half_size), _rgb(self._blocks[name].colour))
            for name, at in snapshot.blocks.items()
        ]
        boxes += _hand(snapshot)
        for centre, half, _ in boxes:
            pencil.shadow(centre, half, self._table)
        # the farthest first; what is nearer covers it
        for centre, half, colour in sorted(boxes, key=lambda box: -pencil.distance(box[0])):
            pencil.box(centre, half, colour)
        for spec in self._areas:
            pencil.sphere(np.array(spec.fixed), spec.half_size, _rgb(spec.colour), 60)
        return canvas.reduce(FINE)

    def _background(self, camera: str) -> Image.Image:
        canvas = Image.new("RGB", (WIDTH * FINE, HEIGHT * FINE), ROOM)
        pencil = _Pencil(canvas, camera)
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


class _Pencil:
    """Draws shapes in the base frame on one camera's canvas."""

    def __init__(self, canvas: Image.Image, camera: str) -> None:
        self._canvas = canvas
        self._draw = ImageDraw.Draw(canvas)
        self._calibration = CALIBRATIONS[camera]
        self._eye = np.array(EYES[camera])

    def distance(self, point: Array) -> float:
        """How far `point` (3,) is from the camera, m."""
        return float(np.linalg.norm(point - self._eye))

    def line(self, points: list[list[float]], colour: Colour, width: int) -> None:
        """A line through `points`."""
        self._draw.line(self._pixels(np.array(points)), colour, width)

    def disc(self, centre: Array, radius: float, colour: Colour) -> None:
        """A horizontal disc."""
        self._draw.polygon(self._pixels(centre + radius * _circle()), colour)

    def shadow(self, centre: Array, half: Array, floor: float) -> None:
        """The shadow on the plane `floor` of a box right above it."""
        corners = [[centre[0] + i * half[0], centre[1] + j * half[1], floor] for i, j in _SQUARE]
        if abs(centre[0] - table.CENTRE[0]) < TABLE_HALF and centre[2] > floor:
            self._draw.polygon(self._pixels(np.array(corners)), SHADOW)

    def box(self, centre: Array, half: Array, colour: Colour, *, edge: Colour | None = None) -> None:
        """An upright box with the given half sizes (3,): the faces that the camera sees."""
        corners = self._pixels(centre + _CORNERS * half)
        outline = edge or _shade(colour, 0.5)
        for normal, face in _FACES:
            middle = centre + np.array(normal) * half
            if float(np.dot(self._eye - middle, normal)) > 0:
                points = [corners[i] for i in face]
                self._draw.polygon(points, _shade(colour, BRIGHTNESS[normal]))
                self._draw.line([*points, points[0]], outline, 2)

    def sphere(self, centre: Array, radius: float, colour: Colour, opacity: int) -> None:
        """A see-through ball, `opacity` of 255."""
        # its outline is a disc across the line of sight
        away = (centre - self._eye) / np.linalg.norm(centre - self._eye)
        side = np.cross(away, [0.0, 0.0, 1.0])
        side /= np.linalg.norm(side)
        circle = _circle()
        rim = centre + radius * (circle[:, :1] * side + circle[:, 1:2] * np.cross(side, away))
        points = self._pixels(rim)
        us, vs = [u for u, _ in points], [v for _, v in points]
        corner = (int(min(us)) - 2, int(min(vs)) - 2)
        patch = Image.new("L", (int(max(us)) + 4 - corner[0], int(max(vs)) + 4 - corner[1]))
        local = [(u - corner[0], v - corner[1]) for u, v in points]
        mask = ImageDraw.Draw(patch)
        mask.polygon(local, opacity)
        mask.line([*local, local[0]], 255, 4)
        self._canvas.paste(colour, corner, patch)

    def _pixels(self, points: Array) -> list[tuple[float, float]]:
        pixels, _ = project(self._calibration, points)
        # projection puts a pixel's centre at +0.5, Pillow at 0
        return [(u, v) for u, v in (pixels * FINE - 0.5).tolist()]


_SQUARE = ((-1, -1), (-1, 1), (1, 1), (1, -1))
_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))


def _faces() -> list[tuple[tuple[int, int, int], tuple[int, ...]]]:
    """Each side's normal with the indices of its corners, in order around it."""
    faces = []
    for axis, sign in product(range(3), (-1, 1)):
        normal = tuple(sign if i == axis else 0 for i in range(3))
        a, b = (i for i in range(3) if i != axis)
        around = []
        for i, j in _SQUARE:
            corner = [0, 0, 0]
            corner[axis], corner[a], corner[b] = sign, i, j
            around.append(sum((c > 0) << (2 - k) for k, c in enumerate(corner)))
        faces.append(((normal[0], normal[1], normal[2]), tuple(around)))
    return faces


_FACES = _faces()


def _hand(snapshot: Snapshot) -> list[tuple[Array, Array, Colour]]:
    """The gripper as boxes (centre, half sizes, colour): two fingers that close along y, the hand, and its wrist."""
    x, y, z = snapshot.gripper
    parts: list[tuple[Any, Any, Colour]] = []
    for side in (-1, 1):
        across = y + side * (snapshot.opening / 2 + FINGER_HALF / 2)
        parts.append(([x, across, z - FINGER_BELOW + 0.03], [FINGER_HALF, FINGER_HALF / 2, 0.03], FINGER))
    parts.append(([x, y, z + 0.066], [0.022, 0.075, 0.015], HAND))
    parts.append(([x, y, z + 0.105], [0.026, 0.026, 0.024], HAND))
    return [(np.array(centre), np.array(half), colour) for centre, half, colour in parts]


@cache
def _circle() -> Array:
    """(48, 3) unit circle in the horizontal plane."""
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)


def _rgb(colour: tuple[float, float, float]) -> Colour:
    return (round(colour[0] * 255), round(colour[1] * 255), round(colour[2] * 255))


def _shade(colour: Colour, by: float) -> Colour:
    return (round(colour[0] * by), round(colour[1] * by), round(colour[2] * by))


def _tint(colour: Colour, by: float) -> Colour:
    """`colour` mixed with that much of the table's."""
    r, g, b = (round(c + (t - c) * by) for c, t in zip(colour, TABLE, strict=True))
    return (r, g, b)
