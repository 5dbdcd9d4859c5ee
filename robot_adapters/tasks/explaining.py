"""Why a task's rule calls a proposal good or bad, in figures and in words, taken from the rule itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.boxes import EPSILON, Box, Boxed

Axis = Literal["x", "y", "z", "end", "place"]
"""x: away from the robot; y: to its left; z: up; end: where a push ends, along x; place: in any direction."""

_PLACES: tuple[Axis, ...] = ("x", "y", "z", "end")
_WORDS: dict[Axis, tuple[str, str]] = {
    "x": ("too near the robot", "too far from the robot"),
    "y": ("too far to the robot's right", "too far to the robot's left"),
    "z": ("too low", "too high"),
    "end": ("short of where the push has to end", "beyond where the push has to end"),
    "place": ("beside the right place", "beside the right place"),
}
"""In the negative direction of the axis, and in the positive one."""


@dataclass(frozen=True)
class Slip:
    """How far, m, a call is from the ideal along an axis, and how far it may be there and still be good."""

    axis: Axis
    off: float
    limit: float

    @property
    def text(self) -> str:
        """In words, as part of a sentence."""
        return f"{_mm(self.off)} {_WORDS[self.axis][self.off > 0]}; at most {_mm(self.limit)} counts as good"


@dataclass(frozen=True)
class Reason:
    """Why. aim: what comes next. right_skill: the skill that serves it. slips: what is wrong about the place.

    sideways: a push that goes along y where one along x is right. closest: of a good call, the coordinate that is
    furthest out.
    """

    good: bool
    skill: str
    right_skill: str
    aim: str
    slips: tuple[Slip, ...] = ()
    closest: Slip | None = None
    sideways: bool = False

    @property
    def text(self) -> str:
        """The whole reason in words."""
        if self.good and self.closest is not None:
            return (
                f"Good: it serves what comes next, to {self.aim}. It is {_mm(self.closest.off)} from the ideal place,"
                f" and up to {_mm(self.closest.limit)} counts as good."
            )
        if self.good:
            return f"Good: it serves what comes next, to {self.aim}."
        if self.skill != self.right_skill:
            return f"Bad: what comes next is to {self.aim}, which takes a {self.right_skill} and no {self.skill}."
        if self.sideways:
            return f"Bad: it pushes sideways. What comes next is to {self.aim}, which takes a push along the table."
        wrong = ", and ".join(slip.text for slip in self.slips) or "it misses what the rule calls good"
        return f"Bad: what comes next is to {self.aim}, but this is {wrong}."


def explain(task: Task, state: Array, call: SkillCall) -> Reason:
    """Why the task's rule calls this call good or bad in this state (n,)."""
    right, aim = task.true_call(state), task.subgoals[task.subgoal(state)].description
    good = task.judge(state, call) > 0
    shared = {"good": good, "skill": call.skill, "right_skill": right.skill, "aim": _lower(aim)}
    if call.skill != right.skill:
        return Reason(**shared)  # type: ignore[arg-type]  # the four of them, whatever mypy makes of a dict
    if isinstance(task, Boxed):
        at = _coordinates(call)
        if at is None:
            return Reason(**shared, sideways=True)  # type: ignore[arg-type]
        return Reason(**shared, **_boxed(task.box(state), at, good=good))  # type: ignore[arg-type]
    return Reason(**shared, **_anywhere(task, state, call, right, good=good))  # type: ignore[arg-type]


def _boxed(box: Box, at: tuple[float, ...], *, good: bool) -> dict[str, object]:
    slips = [
        Slip(axis, value - centre, below if value < centre else above)
        for axis, value, centre, below, above in zip(_PLACES, at, box.centre, box.below, box.above, strict=False)
    ]
    if good:
        return {"closest": max(slips, key=lambda slip: abs(slip.off) / max(slip.limit, EPSILON))}
    return {"slips": tuple(slip for slip in slips if abs(slip.off) > slip.limit + EPSILON)}


def _anywhere(task: Task, state: Array, call: SkillCall, right: SkillCall, *, good: bool) -> dict[str, object]:
    """For rules that aren't boxes: how far from the ideal call, and how far that may be in this direction."""
    off = math.dist(call.parameters[:3], right.parameters[:3])
    slip = Slip("place", off, off + task.margin(state, call))
    # a rule of several parts can be missed by more than the distance to the ideal place: then that says nothing
    if not math.isfinite(slip.limit) or slip.limit < 0:
        return {}
    return {"closest": slip} if good else {"slips": (slip,)}


def _coordinates(call: SkillCall) -> tuple[float, ...] | None:
    """As `Box` has them: of a push along x also where it ends; None for a push along y."""
    if call.skill != "push":
        return call.parameters
    x, y, z, direction, delta = call.parameters
    return None if direction >= 0 else (x, y, z, x + delta)


def _mm(metres: float) -> str:
    return f"{abs(metres) * 1000:.0f} mm"


def _lower(words: str) -> str:
    return (words[:1].lower() + words[1:]).rstrip(".")
