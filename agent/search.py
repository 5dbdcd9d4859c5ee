"""Looking for a skill's first good position where no key point leads to it: every refusal rules out a neighbourhood.

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
