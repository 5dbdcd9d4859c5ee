"""Several different proposals for one state, for trainers who judge at the same time.

What is proposed beside others matters only if those are refused: were one of them approved, the robot would move and
all the others would be void. So each is drawn as if the ones before it, and those that already wait, had been refused,
by an algorithm that heeds refusals (`Beside`). One that doesn't is asked until it says something new.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

import numpy as np

from agent.algorithm import Algorithm, Suggestion
from robot_adapters.base import Array, SkillCall, SkillSpec

ALIKE = 0.05
"""Two calls of a skill are alike if no parameter differs by more than this share of its range. For positions in the
built-in tasks that is 1 to 4 cm: who has judged one has judged the other."""
ATTEMPTS = 20
"""Draws for one more proposal. A policy that is sure of itself says the same again and again; then there is none."""


@runtime_checkable
class Beside(Protocol):
    """An algorithm that can propose a call in view of others that wait to be judged."""

    def propose_beside(self, state: Array, pending: Sequence[SkillCall]) -> Suggestion:
        """Suggest a call for state (n,), supposing that the pending ones will be refused. Draws as `propose` does."""


def propose_batch(
    algorithm: Algorithm, skills: Sequence[SkillSpec], state: Array, count: int, pending: Sequence[SkillCall] = ()
) -> list[Suggestion]:
    """At most `count` suggestions for state (n,), no two of them alike and none like a pending call.

    Fewer where the algorithm has nothing else to say; at least one where nothing is pending.
    """
    found: list[Suggestion] = []
    for _ in range(count):
        waiting = [*pending, *(suggestion.call for suggestion in found)]
        another = _another(algorithm, skills, state, waiting)
        if another is None:
            break
        found.append(another)
    return found


def alike(skills: Sequence[SkillSpec], one: SkillCall, other: SkillCall) -> bool:
    """Whether two calls are the same skill with the same parameters, give or take `ALIKE`."""
    if one.skill != other.skill:
        return False
    spec = next(spec for spec in skills if spec.name == one.skill)
    unit, another = (spec.normalise(np.asarray(call.parameters, dtype=np.float64)) for call in (one, other))
    return bool((np.abs(unit - another) <= 2 * ALIKE).all())  # the range is scaled to [-1, 1]


def _another(
    algorithm: Algorithm, skills: Sequence[SkillSpec], state: Array, waiting: Sequence[SkillCall]
) -> Suggestion | None:
    for _ in range(ATTEMPTS):
        if waiting and isinstance(algorithm, Beside):
            suggestion = algorithm.propose_beside(state, waiting)
        else:
            suggestion = algorithm.propose(state)
        if not any(alike(skills, suggestion.call, call) for call in waiting):
            return suggestion
    return None
