"""The table that the simulated tasks share: where it stands and which part of it skills may use."""

from __future__ import annotations

from robot_adapters.base import ParameterSpec

HEIGHT = -0.112
"""z of the surface, m, robot base frame: robosuite's table at 0.8 seen from the Panda's base at 0.912."""

CENTRE = (0.56, 0.0)
"""x, y of the middle, m, robot base frame: robosuite's world origin."""

# half a metre square and 0.2 m high; the fingers reach below the grip site, so its lowest place is above the surface
X = (0.31, 0.81)
Y = (-0.25, 0.25)
Z = (HEIGHT + 0.005, HEIGHT + 0.205)


def position(what: str) -> tuple[ParameterSpec, ParameterSpec, ParameterSpec]:
    """The parameters x, y, z of a skill that may use the whole workspace; `what` completes their description."""
    return (
        ParameterSpec("x", "m", *X, f"forward from the robot's base, {what}"),
        ParameterSpec("y", "m", *Y, f"left of the robot's base, {what}"),
        ParameterSpec("z", "m", *Z, f"height in the robot's base frame, {what}"),
    )
