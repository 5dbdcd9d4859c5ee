"""Draws boxes, discs and balls of the base frame as one of two calibrated cameras sees them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import product

import numpy as np
from PIL import Image, ImageDraw

from robot_adapters.base import Array, CameraCalibration
from robot_adapters.kinematic.world import TABLE_HALF
from robot_adapters.projection import look_at, project
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Part

WIDTH, HEIGHT = 640, 480
# drawn at twice the size and reduced: Pillow's polygons have jagged edges
FINE = 2

# the same two places as the robosuite adapter's cameras: left and right of the robot, opposite it
EYES = {"left": (1.36, 0.58, 0.588), "right": (1.36, -0.58, 0.588)}
CALIBRATIONS: Mapping[str, CameraCalibration] = {
    name: look_at(
        np.array(eye),
        np.array([0.56, 0.0, -0.042]),
        vertical_field_of_view=np.radians(34.0),
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


class Pencil:
    """Draws shapes in the base frame on one camera's canvas."""

    def __init__(self, canvas: Image.Image, camera: str) -> None:
        self._canvas = canvas
        self._draw = ImageDraw.Draw(canvas)
        self._calibration = CALIBRATIONS[camera]
        self.eye: Array = np.array(EYES[camera])

    def line(self, points: list[list[float]], colour: Colour, width: int) -> None:
        """A line through `points`."""
        self._draw.line(self._pixels(np.array(points)), colour, width)

    def disc(self, centre: Array, radius: float, colour: Colour) -> None:
        """A horizontal disc."""
        self._draw.polygon(self._pixels(centre + radius * _circle()), colour)

    def shadow(self, centre: Array, half: Array, floor: float, *, round_: bool = False) -> None:
        """The shadow on the plane `floor` of a box, or a disc, right above it."""
        if abs(centre[0] - table.CENTRE[0]) >= TABLE_HALF or centre[2] <= floor:
            return
        foot = np.array([centre[0], centre[1], floor])
        rim = half[0] * _circle() if round_ else half * np.array([[i, j, 0.0] for i, j in _SQUARE])
        self._draw.polygon(self._pixels(foot + rim), SHADOW)

    def part(self, centre: Array, part: Part) -> None:
        """A part of an object, its middle at `centre`."""
        r, g, b = (round(c * 255) for c in part.colour)
        half = np.array(part.half)
        if part.shape == "box" and part.opacity < 1:
            self._see_through(centre, half, (r, g, b), part.opacity)
        elif part.shape == "box":
            self.box(centre, half, (r, g, b))
        elif part.shape == "disc":
            self._drum(centre, part.half[0], part.half[2], (r, g, b))
        else:
            rim = self._pixels(centre + part.half[0] * 0.85 * _circle())
            self._draw.line([*rim, rim[0]], (r, g, b), 10)

    def _drum(self, centre: Array, radius: float, half: float, colour: Colour) -> None:
        """An open round pan: its outside, its rim, and the floor inside."""
        up = np.array([0.0, 0.0, half])
        low, rim = centre - up + radius * _circle(), centre + up + radius * _circle()
        bottom, top = self._pixels(low), self._pixels(rim)
        n = len(top)
        for i in range(n):
            outward = low[i] - centre
            if float(np.dot(self.eye - low[i], [outward[0], outward[1], 0.0])) > 0:
                j = (i + 1) % n
                self._draw.polygon([bottom[i], bottom[j], top[j], top[i]], shade(colour, 0.8))
        self._draw.polygon(top, shade(colour, 1.5))
        floor = self._pixels(centre - 0.5 * up + 0.9 * radius * _circle())
        self._draw.polygon(floor, shade(colour, 1.15))
        self._draw.line([*top, top[0]], shade(colour, 2.2), 3)

    def _see_through(self, centre: Array, half: Array, colour: Colour, opacity: float) -> None:
        """The top of a box, through which one sees."""
        top = np.array([[i, j, 1.0] for i, j in _SQUARE]) * half
        points = self._pixels(centre + top)
        mask = Image.new("L", self._canvas.size)
        ImageDraw.Draw(mask).polygon(points, round(opacity * 255))
        self._canvas.paste(colour, (0, 0), mask)
        self._draw.line([*points, points[0]], shade(colour, 0.7), 3)

    def box(self, centre: Array, half: Array, colour: Colour, *, edge: Colour | None = None) -> None:
        """An upright box with the given half sizes (3,): the faces that the camera sees."""
        corners = self._pixels(centre + _CORNERS * half)
        outline = edge or shade(colour, 0.5)
        for normal, face in _FACES:
            middle = centre + np.array(normal) * half
            if float(np.dot(self.eye - middle, normal)) > 0:
                points = [corners[i] for i in face]
                self._draw.polygon(points, shade(colour, BRIGHTNESS[normal]))
                self._draw.line([*points, points[0]], outline, 2)

    def sphere(self, centre: Array, radius: float, colour: Colour, opacity: int) -> None:
        """A see-through ball, `opacity` of 255."""
        # its outline is a disc across the line of sight
        away = (centre - self.eye) / np.linalg.norm(centre - self.eye)
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


@cache
def _circle() -> Array:
    """(48, 3) unit circle in the horizontal plane."""
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)


def shade(colour: Colour, by: float) -> Colour:
    """`colour`, darker (below 1) or lighter."""
    r, g, b = (min(255, round(c * by)) for c in colour)
    return (r, g, b)
