"""Collecting-Toy in physics: a toy, and a drawer that slides in its cabinet with a little friction."""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element

from robot_adapters.robosuite import mjcf
from robot_adapters.tasks.base import ObjectSpec
from robot_adapters.tasks.collecting_toy import (
    CABINET,
    DRAWER,
    HANDLE,
    TOY,
    TRAVEL,
    TRAY_FLOOR,
    TRAY_HALF,
    WOOD,
)

TOY_MASS, TRAY_PART_MASS = 0.05, 0.05  # kg
RUNNER_FRICTION = 0.6  # N, so that the drawer stays where it is let go; found by trying
RUNNER_DAMPING = 2.0  # N s/m: it doesn't rebound from its stop
HANDLE_MASS = 0.01  # kg, each of its two geoms
SMOOTH: dict[str, mjcf.Attribute] = {"friction": (0.2, 0.005, 0.0001), "priority": 1.0}
GAP = 0.001  # m between tray and table: it hangs in its runners


def build(objects: Mapping[str, ObjectSpec]) -> list[Element]:
    """Toy, drawer and cabinet."""
    toy, drawer, cabinet = objects[TOY], objects[DRAWER], objects[CABINET]
    thickness = (TRAY_FLOOR - GAP) / 2
    floor = mjcf.geom("box", (0.0, 0.0, -thickness), (*TRAY_HALF, thickness), WOOD, mass=TRAY_PART_MASS)
    return [
        mjcf.thing(toy, [mjcf.geom("box", (0.0, 0.0, 0.0), [toy.half_size] * 3, toy.colour, mass=TOY_MASS)]),
        mjcf.slider(
            drawer,
            [floor, *(mjcf.part(part, mass=TRAY_PART_MASS) for part in drawer.parts[1:] if part != HANDLE), *_handle()],
            TRAVEL,
            frictionloss=RUNNER_FRICTION,
            damping=RUNNER_DAMPING,
        ),
        mjcf.fixture(cabinet, [mjcf.part(part) for part in cabinet.parts]),
    ]


def _handle() -> list[Element]:
    """The task's handle with a round, smooth edge: a finger that comes down on it pushes the drawer out of its way."""
    (x, _, z), (half_x, half_y, radius) = HANDLE.centre, HANDLE.half
    tip = x - half_x + radius
    bar = mjcf.geom(
        "capsule",
        (tip, 0.0, z),
        (radius, half_y - radius),
        HANDLE.colour,
        euler=(math.pi / 2, 0.0, 0.0),
        mass=HANDLE_MASS,
        **SMOOTH,
    )
    stem_half = (x + half_x - tip) / 2
    stem = mjcf.geom(
        "box", (tip + stem_half, 0.0, z), (stem_half, half_y - radius, radius), HANDLE.colour, mass=HANDLE_MASS
    )
    return [stem, bar]
