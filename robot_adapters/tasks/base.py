"""The `Task` protocol: what a task says of its state, skills and goal. numpy only; no simulator, no learning."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall, SkillSpec
from robot_adapters.tasks.layout import LayoutSettings

NEAR = 0.05
"""m in the xy plane: what counts as near a task-relevant key point (the paper gives no number; two block widths)."""


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


def entry_names(fields: tuple[StateField, ...]) -> tuple[str, ...]:
    """A name for each number of the state vector: a field's own, with its index where the field has several."""
    return tuple(f.name if f.size == 1 else f"{f.name}[{i}]" for f in fields for i in range(f.size))


def position_fields(fields: tuple[StateField, ...]) -> tuple[int, ...]:
    """Where in the state vector an x stands with its y right after: fields of two or three numbers in m."""
    starts, at = [], 0
    for field in fields:
        if field.unit == "m" and field.size in {2, 3}:
            starts.append(at)
        at += field.size
    return tuple(starts)


Vector = tuple[float, float, float]
"""x, y, z in m: base frame, or from an object's origin."""


@dataclass(frozen=True)
class Part:
    """A visible part of a compound object: a box, or a disc or ring of radius `half[0]` that is 2 `half[2]` high.

    centre: from the object's origin, m. half: half sizes, m. opacity: 0 to 1.
    """

    centre: Vector
    half: Vector
    colour: tuple[float, float, float]
    shape: Literal["box", "disc", "ring"] = "box"
    opacity: float = 1.0


@dataclass(frozen=True)
class Grip:
    """Where fingers that close along y hold an object: `at` from its origin, m, and what they forgive to each side."""

    at: Vector
    below: Vector
    above: Vector


@dataclass(frozen=True)
class Seat:
    """A level place of an object where another comes to rest: `at` from its origin, m, and half sizes in x and y.

    funnel: what comes down within this far of its middle, in x and y, slides to the middle's y; 0 for a flat place.
    """

    at: Vector
    half: tuple[float, float]
    funnel: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class ObjectSpec:
    """Something an adapter puts in the scene or draws.

    shape: `block` is a movable cube that `Scene.objects` carries; `area` is an immaterial marked sphere; `thing` is
    movable too and made of `parts`; `fixture` never moves; `slider` slides along x: `Scene.joints` has how far its
    origin is from `fixed` towards the robot.
    half_size: half the cube's edge, or the sphere's radius, m. colour: RGB, each 0 to 1.
    fixed: (x, y, z) m, robot base frame, of what never moves; None where `sample_layout` places it.
    half: (3,) m, half sizes of a compound object's outline, whose middle is `middle` from the origin (right above or
    below it, as `seat` is).
    tips: whether it falls over when it is knocked, dropped, or put on an edge, like a broom that stands.
    """

    name: str
    shape: Literal["block", "area", "thing", "fixture", "slider"]
    half_size: float = 0.0
    colour: tuple[float, float, float] = (0.5, 0.5, 0.5)
    fixed: Vector | None = None
    parts: tuple[Part, ...] = ()
    half: Vector = (0.0, 0.0, 0.0)
    middle: Vector = (0.0, 0.0, 0.0)
    grip: Grip | None = None
    seat: Seat | None = None
    handle: Part | None = None
    """Of a slider: what a push meets."""
    tips: bool = False

    @property
    def movable(self) -> bool:
        """Whether `Scene.objects` carries it."""
        return self.shape in {"block", "thing"}


@dataclass(frozen=True)
class Subgoal:
    """A step of the task in words that a trainer understands."""

    name: str
    description: str


class Task(Protocol):
    """One task, shared by every adapter that can stage it (paper, section 'Long-horizon manipulation tasks').

    `docs/custom-task.md` builds one.
    """

    name: str
    title: str
    instruction: str
    state_fields: tuple[StateField, ...]
    skills: tuple[SkillSpec, ...]
    """What may be proposed, each skill with bounds of its own: the tighter, the fewer clicks are wasted."""
    subgoals: tuple[Subgoal, ...]
    objects: tuple[ObjectSpec, ...]
    """What is in the scene; adapters also draw the areas, which trainers need to see and agents are never told."""
    table_height: float
    """z of the table's surface, m, robot base frame."""
    horizon: int
    """Executed skills after which an unsolved episode ends."""

    @property
    def layout(self) -> LayoutSettings:
        """The ranges that `sample_layout` draws from. A task with any takes them as its constructor's one argument."""

    def state(self, scene: Scene) -> Array:
        """(n,) the state vector, fields in the order of `state_fields`."""

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """A start: movable object (and `gripper`) -> (3,) m, robot base frame; slider -> (1,) m from closed."""

    def success(self, scene: Scene) -> bool:
        """Whether the task is solved."""

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """Rules broken by the scene as it is now."""

    def events(self, scene: Scene) -> frozenset[str]:
        """What is so now and counts for the rest of the episode: an adapter hands it back as `Scene.latched`."""

    def subgoal(self, state: Array) -> int:
        """Index into `subgoals` of what comes next."""

    def judge(self, state: Array, call: SkillCall) -> int:
        """The synthetic teacher's rule: +1 if the call serves the next subgoal, otherwise -1."""

    def margin(self, state: Array, call: SkillCall) -> float:
        """How far, m, the call is inside what `judge` calls good; negative outside, -inf for another skill."""

    def true_call(self, state: Array) -> SkillCall:
        """A call that solves the next subgoal (the centre of the teacher's good box)."""

    def sample_good(self, state: Array, rng: np.random.Generator) -> SkillCall:
        """A call drawn uniformly from those that `judge` calls good."""

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(k, 3) where the grip site acts on task-relevant objects, m, robot base frame; (0, 3) if the state has none.

        With `skill`, only those of that skill: pick at objects, place at what carries them, push before them.
        """
