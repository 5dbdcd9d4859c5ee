"""Sweeping in physics: a broom that stands by itself, a toy that slides, and a dustpan with a lip to ride up on."""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element

from robot_adapters.robosuite import mjcf
from robot_adapters.tasks.base import ObjectSpec, Part
from robot_adapters.tasks.sweeping import BROOM, GREEN, PAN, PAN_FLOOR, PAN_HALF, PAN_PARTS, TOY

# MuJoCo takes the larger friction of two geoms unless one has priority: without it the toy jams against the broom.
# Found by trying
SLIDES: dict[str, mjcf.Attribute] = {"friction": (0.3, 0.005, 0.0001), "priority": 1.0}
# less between broom and table, where a hand that presses down would hold the head back
GLIDES: dict[str, mjcf.Attribute] = {"friction": (0.1, 0.005, 0.0001), "priority": 1.0}
# condim 4: the pads resist the handle's turning about the line between them
HANDLE_GRIPS: dict[str, mjcf.Attribute] = {"friction": (2.0, 0.05, 0.0001), "condim": 4.0}
HEAD_MASS, HANDLE_MASS, TOY_MASS = 0.15, 0.03, 0.05  # kg; a low centre of gravity keeps the broom standing

STRAW = (0.78, 0.58, 0.10)
SKIN = 0.0004  # m that a drawn layer lies over what it covers
PAN_HANDLE = Part((PAN_HALF[0] + 0.045, 0.0, 0.012), (0.045, 0.014, 0.009), GREEN)

RAMP = 0.025  # m along x, over which the lip rises from below the table's surface to the pan's floor
RAMP_HALF_THICKNESS = 0.002


def build(objects: Mapping[str, ObjectSpec]) -> list[Element]:
    """Broom, toy and dustpan."""
    head, handle = objects[BROOM].parts
    toy = objects[TOY]
    return [
        mjcf.thing(
            objects[BROOM],
            [
                mjcf.part(head, mass=HEAD_MASS, **GLIDES),
                mjcf.part(handle, mass=HANDLE_MASS, **HANDLE_GRIPS),
                mjcf.untouchable(mjcf.part(_bristles(head))),
            ],
        ),
        mjcf.thing(toy, [mjcf.geom("box", (0.0, 0.0, 0.0), [toy.half_size] * 3, toy.colour, mass=TOY_MASS, **SLIDES)]),
        mjcf.fixture(objects[PAN], [*_floor(), *(mjcf.part(wall) for wall in PAN_PARTS[1:]), mjcf.part(PAN_HANDLE)]),
    ]


def _bristles(head: Part) -> Part:
    """The lower half of the head, drawn darker."""
    x, y, z = head.half
    return Part((head.centre[0], head.centre[1], head.centre[2] - z / 2), (x + SKIN, y + SKIN, z / 2), STRAW)


def _floor() -> list[Element]:
    """A ramp and the level floor behind it: an upright edge of 2 mm would stop the toy."""
    slope = math.atan2(PAN_FLOOR + 0.001, RAMP)  # from 1 mm below the surface
    centre_x = -PAN_HALF[0] + RAMP / 2
    top = (PAN_FLOOR - 0.001) / 2
    ramp = mjcf.geom(
        "box",
        (centre_x + RAMP_HALF_THICKNESS * math.sin(slope), 0.0, top - RAMP_HALF_THICKNESS * math.cos(slope)),
        (RAMP / 2, PAN_HALF[1], RAMP_HALF_THICKNESS),
        GREEN,
        euler=(0.0, -slope, 0.0),
    )
    level = mjcf.geom(
        "box",
        (RAMP / 2 - 0.001, 0.0, PAN_FLOOR / 2),
        (PAN_HALF[0] - RAMP / 2 + 0.001, PAN_HALF[1], PAN_FLOOR / 2),
        GREEN,
    )
    return [ramp, level]
