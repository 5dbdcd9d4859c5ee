"""The table that the simulated tasks share: where it stands and which part of it skills may use."""

from __future__ import annotations

from robot_adapters.base import ParameterSpec, SkillSpec

HEIGHT = -0.112
"""z of the surface, m, robot base frame: robosuite's table at 0.8 seen from the Panda's base at 0.912."""

CENTRE = (0.56, 0.0)
"""x, y of the middle, m, robot base frame: robosuite's world origin."""

# half a metre square and 0.2 m high; the fingers reach below the grip site, so its lowest place is above the surface
X = (0.31, 0.81)
Y = (-0.25, 0.25)
Z = (HEIGHT + 0.005, HEIGHT + 0.205)


# measured: commanded at random within these, the Panda's hand, pointing down, brought no joint near its limit in 12,000
# set-points, where in all of X and Y it did 42 times
FREE_X = (0.35, 0.72)
FREE_Y = (-0.22, 0.22)
FREE_Z = (HEIGHT, HEIGHT + 0.30)
"""Where the grip site may be taken step by step: what the tasks need, and the way there."""


Bounds = tuple[float, float]


def above(low: float, high: float) -> Bounds:
    """Heights above the table, m, as z in the base frame."""
    return (HEIGHT + low, HEIGHT + high)


def position(
    what: str, *, x: Bounds = X, y: Bounds = Y, z: Bounds = Z
) -> tuple[ParameterSpec, ParameterSpec, ParameterSpec]:
    """The parameters x, y, z of a skill within these bounds (default: all of the workspace); `what` describes them."""
    return (
        ParameterSpec("x", "m", *x, f"forward from the robot's base, {what}"),
        ParameterSpec("y", "m", *y, f"left of the robot's base, {what}"),
        ParameterSpec("z", "m", *z, f"height in the robot's base frame, {what}"),
    )


def push(what: str, *, x: Bounds, y: Bounds, z: Bounds, delta: Bounds) -> tuple[ParameterSpec, ...]:
    """The parameters of a push that starts within these bounds."""
    return (
        *position(what, x=x, y=y, z=z),
        ParameterSpec("direction", "", -1.0, 1.0, "below 0: along x, otherwise along y"),
        ParameterSpec("delta", "m", *delta, "how far to push; the sign says which way"),
    )


def picking(*, x: Bounds, y: Bounds, z: Bounds, yaw: float | None = None) -> SkillSpec:
    """A pick within these bounds; `yaw` as in `SkillSpec`."""
    where = position("where the fingers close", x=x, y=y, z=z)
    return SkillSpec("pick", where, "Take what is at a position, and lift it.", yaw=yaw)


def placing(*, x: Bounds, y: Bounds, z: Bounds, yaw: float | None = None) -> SkillSpec:
    """A place within these bounds; `yaw` as in `SkillSpec`."""
    where = position("where the fingers open", x=x, y=y, z=z)
    return SkillSpec("place", where, "Bring what is held to a position; let go.", yaw=yaw)
