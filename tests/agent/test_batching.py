"""Several different proposals for one state: none alike, drawn as if the others had been refused."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from agent.algorithm import Algorithm, Label, Problem, Suggestion
from agent.batching import ATTEMPTS, alike, propose_batch
from agent.config import SEED
from robot_adapters import registry
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import state_bounds


def stacking(preset: str, seed: int = 0) -> tuple[Any, Algorithm, Array]:
    task = registry.task("stacking")
    low, high = state_bounds(task.state_fields)
    problem = Problem(task.name, low, high, task.skills, keypoints=task.keypoints)
    settings = SEED.settings.model_validate(dict(SEED.presets[preset]) | {"hidden_size": 32})
    state = task.sample_state(np.random.default_rng(seed)) if hasattr(task, "sample_state") else (low + high) / 2
    return task, SEED(problem, settings, seed), np.asarray(state, dtype=np.float64)


@pytest.mark.parametrize("preset", ["recommended", "paper_sim"])
def test_eight_at_once_are_all_different(preset: str) -> None:
    task, algorithm, state = stacking(preset)
    waiting = [algorithm.propose(state).call]
    found = propose_batch(algorithm, task.skills, state, 8, waiting)
    assert len(found) == 8
    calls = [*waiting, *(suggestion.call for suggestion in found)]
    assert not [pair for pair in itertools.combinations(calls, 2) if alike(task.skills, *pair)]


def test_what_waits_is_avoided_as_what_was_refused_is() -> None:
    """Searching goes on beside a waiting call as it would after its refusal, not where it would have gone anyway."""
    task, algorithm, state = stacking("recommended")
    first = algorithm.propose(state).call
    beside = propose_batch(algorithm, task.skills, state, 12, [first])
    _, other, _ = stacking("recommended")
    assert other.propose(state).call == first
    other.add([Label(1, state, first, -1)])
    after = []
    for number in range(12):
        after.append(other.propose(state))
        other.add([Label(number + 2, state, after[-1].call, -1)])
    reach = 0.05  # m

    def near(found: Sequence[Suggestion]) -> int:
        same = [s.call for s in found if s.call.skill == first.skill]
        return sum(bool(np.linalg.norm(np.subtract(c.parameters[:3], first.parameters[:3])) < reach) for c in same)

    assert near(beside) <= near(after) + 2


class Sure:
    """Says the same every time."""

    policy_version = 0

    def __init__(self, call: SkillCall) -> None:
        self._call = call
        self.asked = 0

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        self.asked += 1
        return Suggestion(self._call, 0.0, {self._call.skill: 1.0}, 0)


def test_who_has_nothing_else_to_say_says_less() -> None:
    task, _, state = stacking("paper_sim")
    call = task.true_call(state)
    sure: Any = Sure(call)
    assert [s.call for s in propose_batch(sure, task.skills, state, 3)] == [call]
    assert sure.asked == 1 + ATTEMPTS
    assert propose_batch(sure, task.skills, state, 3, [call]) == []


def test_alike_is_of_one_skill_within_a_twentieth_of_each_range() -> None:
    task, _, _ = stacking("paper_sim")
    spec = task.skills[0]
    unit = np.zeros(len(spec.parameters))

    def call(offset: float) -> SkillCall:
        moved = unit.copy()
        moved[0] = offset
        return SkillCall(spec.name, tuple(float(v) for v in spec.denormalise(moved)))

    assert alike(task.skills, call(0.0), call(0.09))
    assert not alike(task.skills, call(0.0), call(0.11))
    other = task.skills[1]
    assert not alike(task.skills, call(0.0), SkillCall(other.name, tuple(call(0.0).parameters)))
