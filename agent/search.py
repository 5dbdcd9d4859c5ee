"""Looking for what no key point tells of a skill's first good call: every refusal rules out a neighbourhood.

That is a position, or for a push at its key point the direction and length.


A hypothesis is a place that good calls surround, as far as `spacing` or half of it. Hypotheses fill the skill's bounds
evenly; a call refused that near one speaks against it, and the next call goes where most of what is left can be decided
at once. So the room is covered like a floor with tiles, instead of at random.
"""

from __future__ import annotations

import torch
from torch import Tensor

from agent.grounding import Grounding

HYPOTHESES = 1024
"""Places considered: in the built-in tasks, one every 2 to 3 cm."""
SIZES = (1.0, 0.5)
"""Radii of a good area as shares of `spacing`: when no large one is left, a small one is looked for."""
AGAINST = 3.0
"""A refusal in this very situation divides what a hypothesis weighs by exp of this: nearly ruled out, for a teacher may
err and the area may be smaller than thought."""
AGAINST_ELSEWHERE = 1.5
"""The same of a refusal in another situation, in which another place may have been the right one."""
AS_GOOD = 0.97
"""Of places that decide this share of what the best one decides, any may be taken."""


class Elimination:
    """Hypotheses of one skill's good positions. Holds no labels: what they say is worked out when asked."""

    def __init__(self, grounding: Grounding, skill: int, spacing: float) -> None:
        """spacing: m, the radius that a good area is supposed to have; it lies inside the skill's bounds."""
        half = grounding.half[skill, :3]
        sobol = torch.quasirandom.SobolEngine(3)  # type: ignore[no-untyped-call]
        unit = sobol.draw(HYPOTHESES + 1)[1:]  # the first point is a corner
        inner = (half - spacing).clamp(min=0.5 * half)
        self._half, self._spacing = half, spacing
        self._metres = (2 * unit - 1) * inner
        self._covers = [(torch.cdist(self._metres, self._metres) <= r * spacing).float() for r in SIZES]

    def next(self, here: Tensor, anywhere: Tensor, generator: torch.Generator) -> Tensor:
        """(3,) in [-1, 1]: where to call next, after calls (R, 3) refused in this situation, and in any situation."""
        worth = torch.zeros(HYPOTHESES)
        for size, covers in zip(SIZES, self._covers, strict=True):
            near_here, near = (self._near(refused, size * self._spacing) for refused in (here, anywhere))
            worth += covers @ torch.exp(-(AGAINST - AGAINST_ELSEWHERE) * near_here - AGAINST_ELSEWHERE * near)
        best = torch.nonzero(worth >= AS_GOOD * worth.max())[:, 0]
        at = best[torch.randint(len(best), (1,), generator=generator)[0]]
        scaled: Tensor = self._metres[at] / self._half
        return scaled

    def _near(self, refused: Tensor, radius: float) -> Tensor:
        """(N,) how many of these (R, 3) in [-1, 1] lie within the radius, m, of each hypothesis."""
        return (torch.cdist(self._metres, refused * self._half) <= radius).float().sum(dim=1)


LENGTHS = 64
"""Lengths considered for each direction of a push: one every 6 mm of what the built-in tasks allow."""
PUSH_SIZES = (0.5, 0.25)
"""Half of what a good push's end may be off, as shares of `spacing`."""


class PushElimination:
    """Hypotheses of the direction and length of one skill's good pushes from a key point. Holds no labels.

    Refusals are compared by where the push ended, along its direction: that is what matters to what it pushes against.
    """

    def __init__(self, grounding: Grounding, skill: int, spacing: float) -> None:
        """spacing: m, as in `Elimination`."""
        delta = grounding.delta[skill]
        self._skill, self._grounding, self._spacing = skill, grounding, spacing
        lengths = torch.linspace(-1.0, 1.0, LENGTHS)
        metres = grounding.half[skill, delta] * lengths
        self._metres = (grounding.centre[skill, delta] + metres).repeat(2)
        self._axis = torch.tensor([0, 1]).repeat_interleave(LENGTHS)
        self._local = torch.stack([torch.where(self._axis == 1, 0.5, -0.5), lengths.repeat(2)], dim=1)
        same = self._axis[:, None] == self._axis
        gaps = (self._metres[:, None] - self._metres).abs()
        self._covers = [(same & (gaps <= r * spacing)).float() for r in PUSH_SIZES]

    @property
    def columns(self) -> list[int]:
        """Those of the skill's parameters that `next` gives."""
        return [int(self._grounding.direction[self._skill]), int(self._grounding.delta[self._skill])]

    def next(self, here: Tensor, anywhere: Tensor, keypoint: Tensor, generator: torch.Generator) -> Tensor:
        """(2,) in [-1, 1]: direction and length to try next from the key point (3,) m.

        here, anywhere: (R, P) scaled calls of the skill refused in this situation, and in any.
        """
        worth = torch.zeros(len(self._metres))
        ends = keypoint[self._axis] + self._metres
        for size, covers in zip(PUSH_SIZES, self._covers, strict=True):
            near_here, near = (self._near(ends, refused, size * self._spacing) for refused in (here, anywhere))
            worth += covers @ torch.exp(-(AGAINST - AGAINST_ELSEWHERE) * near_here - AGAINST_ELSEWHERE * near)
        best = torch.nonzero(worth >= AS_GOOD * worth.max())[:, 0]
        return self._local[best[torch.randint(len(best), (1,), generator=generator)[0]]]

    def _near(self, ends: Tensor, refused: Tensor, radius: float) -> Tensor:
        """(N,) how many of these calls went the same way and ended within the radius, m, of each hypothesis."""
        ground, skills = self._grounding, torch.full((len(refused),), self._skill)
        theirs = ground.centre[self._skill, :2] + ground.half[self._skill, :2] * ground.read_end(skills, refused)
        axis = (refused[:, ground.direction[self._skill]] >= 0).long()
        gaps = (ends[:, None] - theirs[torch.arange(len(axis)), axis]).abs()
        return ((gaps <= radius) & (self._axis[:, None] == axis)).float().sum(dim=1)
