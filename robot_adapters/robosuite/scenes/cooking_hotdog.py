"""Cooking-Hotdog in physics: a light skillet, a sausage that stays, a stove, and a bun that guides what falls."""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element

from robot_adapters.robosuite import mjcf
from robot_adapters.tasks.base import ObjectSpec
from robot_adapters.tasks.cooking_hotdog import (
    BREAD,
    BUN,
    BUN_FLOOR,
    BUN_HALF,
    CRUST,
    GREY,
    IRON,
    MEAT,
    PAN_FLOOR,
    PAN_HALF_HEIGHT,
    PAN_RADIUS,
    SAUSAGE,
    SAUSAGE_HALF,
    SKILLET,
    STOVE,
)

# condim 4: the pads resist turning about the line between them, the skillet's weight hanging from its handle's end
GRIPS: dict[str, mjcf.Attribute] = {"friction": (2.0, 0.05, 0.0001), "condim": 4.0}
SLIPPERY: dict[str, mjcf.Attribute] = {"friction": (0.2, 0.005, 0.0001), "priority": 1.0}
PAN_MASS, RIM_MASS, HANDLE_MASS = 0.08, 0.002, 0.02  # kg, 0.13 in all: found by trying
SAUSAGE_MASS = 0.02  # kg, each of its two geoms

# The rim leans outwards, so that open fingers find room beside a sausage
RIM_PARTS, FLARE = 16, math.radians(45)
RIM_HALF_LENGTH, RIM_HALF_THICKNESS = 0.009, 0.002
SHADE = (0.12, 0.13, 0.15)

# The bun's cut: a level middle as wide as the sausage, and slopes on which it slides there. They are low enough for
# the fingers to open between them
MIDDLE = 0.011
SLOPE = math.radians(22)
SLOPE_LENGTH, SLOPE_HALF_THICKNESS = 0.013, 0.003
CRUST_RADIUS, CRUST_Y, CRUST_Z = 0.012, 0.044, 0.010


def build(objects: Mapping[str, ObjectSpec]) -> list[Element]:
    """Skillet, sausage, stove and bun."""
    stove = objects[STOVE]
    block, ring = stove.parts
    ring_radius, _, ring_half = ring.half
    inner = mjcf.geom("cylinder", ring.centre, (ring_radius - 0.014, ring_half + 0.0003), GREY)
    return [
        mjcf.thing(objects[SKILLET], _skillet(objects[SKILLET])),
        mjcf.thing(objects[SAUSAGE], _sausage()),
        mjcf.fixture(stove, [mjcf.part(block), mjcf.untouchable(mjcf.part(ring)), mjcf.untouchable(inner)]),
        mjcf.fixture(objects[BUN], _bun()),
    ]


def _skillet(skillet: ObjectSpec) -> list[Element]:
    floor_half = PAN_FLOOR / 2
    floor = mjcf.geom(
        "cylinder", (0.0, 0.0, floor_half - PAN_HALF_HEIGHT), (PAN_RADIUS, floor_half), SHADE, mass=PAN_MASS
    )
    along, up = RIM_HALF_LENGTH * math.sin(FLARE), RIM_HALF_LENGTH * math.cos(FLARE)
    radius, height = PAN_RADIUS - RIM_HALF_THICKNESS + along, floor_half + up - PAN_HALF_HEIGHT
    half_side = (radius + along) * math.tan(math.pi / RIM_PARTS)
    rim = [
        mjcf.geom(
            "box",
            (radius * math.cos(angle), radius * math.sin(angle), height),
            (RIM_HALF_THICKNESS, half_side, RIM_HALF_LENGTH),
            IRON,
            quat=_turned(angle, FLARE),
            mass=RIM_MASS,
        )
        for angle in (2 * math.pi * i / RIM_PARTS for i in range(RIM_PARTS))
    ]
    return [floor, *rim, mjcf.part(skillet.parts[1], mass=HANDLE_MASS, **GRIPS)]


def _turned(about_z: float, then_about_own_y: float) -> tuple[float, float, float, float]:
    """Quaternion w, x, y, z of two turns, rad."""
    z, y = about_z / 2, then_about_own_y / 2
    return (
        math.cos(z) * math.cos(y),
        -math.sin(z) * math.sin(y),
        math.cos(z) * math.sin(y),
        math.sin(z) * math.cos(y),
    )


def _sausage() -> list[Element]:
    """A capsule for the fingers and the eye; a box under it keeps it from rolling."""
    length, width, height = SAUSAGE_HALF
    lying: dict[str, mjcf.Attribute] = {"euler": (0.0, math.pi / 2, 0.0)}
    capsule = mjcf.geom("capsule", (0.0, 0.0, 0.0), (width, length - width), MEAT, mass=SAUSAGE_MASS, **GRIPS, **lying)
    box = mjcf.geom("box", (0.0, 0.0, -height / 2), (length - width, 0.75 * width, height / 2), MEAT, mass=SAUSAGE_MASS)
    return [capsule, mjcf.unseen(box)]


def _bun() -> list[Element]:
    length = BUN_HALF[0]
    floor = mjcf.geom("box", (0.0, 0.0, BUN_FLOOR / 2), (length, CRUST_Y, BUN_FLOOR / 2), BREAD, **SLIPPERY)
    found = [floor]
    along, up = SLOPE_LENGTH / 2 * math.cos(SLOPE), SLOPE_LENGTH / 2 * math.sin(SLOPE)
    for side in (-1, 1):
        out, down = SLOPE_HALF_THICKNESS * math.sin(SLOPE), SLOPE_HALF_THICKNESS * math.cos(SLOPE)
        found.append(
            mjcf.geom(
                "box",
                (0.0, side * (MIDDLE + along + out), BUN_FLOOR + up - down),
                (length, SLOPE_LENGTH / 2, SLOPE_HALF_THICKNESS),
                BREAD,
                euler=(side * SLOPE, 0.0, 0.0),
                **SLIPPERY,
            )
        )
        found.append(
            mjcf.geom(
                "capsule",
                (0.0, side * CRUST_Y, CRUST_Z),
                (CRUST_RADIUS, length - CRUST_RADIUS / 2),
                CRUST,
                euler=(0.0, math.pi / 2, 0.0),
                **SLIPPERY,
            )
        )
    return found
