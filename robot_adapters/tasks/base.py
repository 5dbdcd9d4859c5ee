"""The `Task` protocol: what a task says of its state, skills and goal. numpy only; no simulator, no learning."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall, SkillSpec


@dataclass(frozen=True)
class StateField:
    """A named part of the state vector, e.g. `block_a_position` of shape (3,) in m.

    low, high: the range that each component usually stays in, for scaling only; empty means -1 to 1.
    """

    name: str
    size: int
    unit: str
    description: str = ""
    low: tuple[float, ...] = ()
    high: tuple[float, ...] = ()


def state_bounds(fields: tuple[StateField, ...]) -> tuple[Array, Array]:
    """(n,) usual lows and (n,) usual highs of the whole state vector."""
    low = [v for f in fields for v in (f.low or (-1.0,) * f.size)]
    high = [v for f in fields for v in (f.high or (1.0,) * f.size)]
    return np.array(low, dtype=np.float64), np.array(high, dtype=np.float64)


@dataclass(frozen=True)
class ObjectSpec:
    """Something an adapter puts in the scene or draws.

    shape: `block` is a movable cube that `Scene.objects` carries; `area` is an immaterial marked sphere.
    half_size: half the cube's edge, or the sphere's radius, m. colour: RGB, each 0 to 1.
    fixed: (x, y, z) m, robot base frame, of what never moves; None where `sample_layout` places it.
    """

    name: str
    shape: Literal["block", "area"]
    half_size: float
    colour: tuple[float, float, float]
    fixed: tuple[float, float, float] | None = None


@dataclass(frozen=True)
class Subgoal:
    """A step of the task in words that a trainer understands."""

    name: str
    description: str


class Task(Protocol):
    """One task, shared by every adapter that can stage it (paper, section 'Long-horizon manipulation tasks')."""

    name: str
    title: str
    instruction: str
    state_fields: tuple[StateField, ...]
    skills: tuple[SkillSpec, ...]
    subgoals: tuple[Subgoal, ...]
    objects: tuple[ObjectSpec, ...]
    """What is in the scene; adapters also draw the areas, which trainers need to see and agents are never told."""
    table_height: float
    """z of the table's surface, m, robot base frame."""
    horizon: int
    """Executed skills after which an unsolved episode ends."""

    def state(self, scene: Scene) -> Array:
        """(n,) the state vector, fields in the order of `state_fields`."""

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """A start: object name (and `gripper`) -> (3,) m, robot base frame."""

    def success(self, scene: Scene) -> bool:
        """Whether the task is solved."""

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """Rules broken by the scene as it is now."""

    def subgoal(self, state: Array) -> int:
        """Index into `subgoals` of what comes next."""

    def judge(self, state: Array, call: SkillCall) -> int:
        """The synthetic teacher's rule: +1 if the call serves the next subgoal, otherwise -1."""

    def true_call(self, state: Array) -> SkillCall:
        """A call that solves the next subgoal (the centre of the teacher's good box)."""

    def keypoints(self, state: Array) -> Array:
        """(k, 3) positions of the task-relevant objects, m, robot base frame; (0, 3) where the state holds none."""
