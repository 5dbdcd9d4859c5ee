"""Rules that tasks share: what of a scene only a hand can put right."""

from __future__ import annotations

import math

from robot_adapters.base import SafetyViolation, Scene
from robot_adapters.tasks import table

TILTED = math.radians(45)
REACH_MARGIN = 0.005
"""An object this little outside the bounds can still be taken off-centre."""
# an object's origin is somewhere inside it; this far below the surface, all of it has left the table
BELOW_TABLE = 0.02

Bounds = tuple[float, float]


def by_hand(detail: str) -> SafetyViolation:
    """A violation that ends the episode until somebody has put things right."""
    return SafetyViolation("manual_reset", detail)


def misplaced(
    scene: Scene, name: str, x: Bounds, y: Bounds, label: str | None = None, *, rolls: bool = False
) -> list[SafetyViolation]:
    """Whether the object fell, fell over, or lies outside x and y (m, base frame); what is held is none of these.

    What `rolls` is as good on its side.
    """
    label = label or name
    if scene.held == name:
        return []
    at = scene.objects[name]
    if at[2] < table.HEIGHT - BELOW_TABLE:
        return [by_hand(f"{label} fell off the table")]
    if not rolls and scene.tilts.get(name, 0.0) > TILTED:
        return [by_hand(f"{label} fell over")]
    if not (within(float(at[0]), x) and within(float(at[1]), y)):
        return [by_hand(f"{label} is out of reach")]
    return []


def within(value: float, bounds: Bounds, margin: float = REACH_MARGIN) -> bool:
    """Whether a coordinate lies between the bounds, or at most `margin` m outside."""
    return bounds[0] - margin <= value <= bounds[1] + margin
