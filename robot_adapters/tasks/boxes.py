"""The teacher's box: which parameters of one skill are good, and how far a call is from the border."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array, Scene, SkillCall, SkillSpec

# the box includes its faces, whatever rounding did to them
EPSILON = 1e-9


@dataclass(frozen=True)
class Box:
    """Good calls of one skill: x, y, z of the grip site, m, base frame, each with what is forgiven below and above.

    A push (along x) has a fourth coordinate, the x where it ends: what matters is how far the object is taken.
    """

    skill: str
    centre: tuple[float, ...]
    below: tuple[float, ...]
    above: tuple[float, ...]

    def margin(self, call: SkillCall) -> float:
        """Metres from the call to the box's nearest face: positive inside, negative outside.

        Minus infinity for another skill, and for a push along y.
        """
        if call.skill != self.skill:
            return -math.inf
        at: tuple[float, ...] = call.parameters
        if call.skill == "push":
            x, y, z, direction, delta = at
            if direction >= 0:
                return -math.inf
            at = (x, y, z, x + delta)
        sides = zip(at, self.centre, self.below, self.above, strict=True)
        return min(min(v - c + below, c + above - v) for v, c, below, above in sides)

    def call(self, spec: SkillSpec, at: tuple[float, ...] | None = None) -> SkillCall:
        """The call at these coordinates (default: the centre), kept inside the skill's bounds."""
        at = at or self.centre
        values = [min(max(v, p.low), p.high) for v, p in zip(at[:3], spec.parameters, strict=False)]
        if self.skill == "push":
            along, delta = spec.parameters[3:5]
            # half of what means x: far from where it would mean y
            values += [along.low / 2, min(max(at[3] - values[0], delta.low), delta.high)]
        return SkillCall(self.skill, tuple(float(v) for v in values))


class Boxed(ABC):
    """What a task says of good calls, where those of each subgoal fill a box."""

    skills: tuple[SkillSpec, ...]

    @abstractmethod
    def box(self, state: Array) -> Box:
        """The good calls in this state (n,)."""

    def judge(self, state: Array, call: SkillCall) -> int:
        """+1 for a call inside the box of the next subgoal, otherwise -1."""
        return 1 if self.box(state).margin(call) >= -EPSILON else -1

    def margin(self, state: Array, call: SkillCall) -> float:
        """Metres from the call to the box's nearest face, negative outside; -inf for another skill."""
        return self.box(state).margin(call)

    def true_call(self, state: Array) -> SkillCall:
        """The box's centre, kept inside the skill's bounds."""
        box = self.box(state)
        return box.call(self._spec(box.skill))

    def sample_good(self, state: Array, rng: np.random.Generator) -> SkillCall:
        """A call drawn uniformly from the box, kept inside the skill's bounds."""
        box = self.box(state)
        at = rng.uniform(np.subtract(box.centre, box.below), np.add(box.centre, box.above))
        return box.call(self._spec(box.skill), tuple(at.tolist()))

    def events(self, scene: Scene) -> frozenset[str]:  # noqa: ARG002 - for tasks in which nothing is to be remembered
        """Nothing."""
        return frozenset()

    def _spec(self, name: str) -> SkillSpec:
        return next(spec for spec in self.skills if spec.name == name)
