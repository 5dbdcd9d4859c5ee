"""What crosses the boundary between a robot and everything else: frozen values and the `Adapter` protocol.

Every position is in metres in the robot base frame (x forward, y left, z up), every angle in radians, unless a
docstring says otherwise.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

Array = NDArray[np.float64]
"""A float64 array; the docstring of whatever carries it gives shape, unit and frame."""


class AdapterError(Exception):
    """Base of every error of this package. `remedy` says what the reader can do about it."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


class InvalidCall(AdapterError):
    """A skill call that names no skill of the task, or whose parameters are missing, not finite or out of bounds."""


class Unavailable(AdapterError):
    """The robot, the simulator or its graphics can't be had on this machine."""


class SceneUnclear(Unavailable):
    """What is to be acted on can't be seen well enough. Nothing moves until somebody has put that right."""


class SceneChanged(SceneUnclear):
    """The scene isn't any more as the picture shows it that was judged."""


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter of a skill with its bounds (inclusive), e.g. `x` from 0.31 to 0.81 m."""

    name: str
    unit: str
    low: float
    high: float
    description: str = ""


PRIMITIVES: Mapping[str, tuple[str, ...]] = {
    "reach": ("x", "y", "z"),
    "pick": ("x", "y", "z"),
    "place": ("x", "y", "z"),
    "push": ("x", "y", "z", "direction", "delta"),
    "release": (),
}
"""What an arm can do, and the parameters that each takes; all that have any may take `yaw` as the last."""


@dataclass(frozen=True)
class SkillSpec:
    """A primitive as one task offers it: its name and the bounds of its parameters (DESIGN.md section 1).

    `name` is one of reach, pick, place, push, release. Position parameters are called x, y, z; push adds `direction`
    (below 0: along x, otherwise along y) and `delta` (signed metres); `yaw` turns the gripper about z.

    The attribute `yaw` (rad) fixes that angle where it is no parameter; None leaves it to the adapter.
    """

    name: str
    parameters: tuple[ParameterSpec, ...] = ()
    description: str = ""
    yaw: float | None = None

    @property
    def low(self) -> Array:
        """(n,) lower bounds in the parameters' units."""
        return np.array([p.low for p in self.parameters], dtype=np.float64)

    @property
    def high(self) -> Array:
        """(n,) upper bounds in the parameters' units."""
        return np.array([p.high for p in self.parameters], dtype=np.float64)

    def denormalise(self, unit: Array) -> Array:
        """(n,) in [-1, 1] -> (n,) in the parameters' units."""
        return self.low + (np.clip(unit, -1.0, 1.0) + 1.0) * 0.5 * (self.high - self.low)

    def normalise(self, values: Array) -> Array:
        """(n,) in the parameters' units -> (n,) in [-1, 1]; a parameter of zero width maps to 0."""
        span = self.high - self.low
        safe = np.where(span > 0, span, 1.0)
        return np.where(span > 0, 2.0 * (values - self.low) / safe - 1.0, 0.0)


def workspace(skills: tuple[SkillSpec, ...]) -> tuple[Array, Array] | None:
    """Opposite corners, (3,) m each, of the box that holds every place any of `skills` may be asked for."""
    limits = {
        axis: [limit for spec in skills for p in spec.parameters if p.name == axis for limit in (p.low, p.high)]
        for axis in "xyz"
    }
    if not all(limits.values()):
        return None
    low, high = (np.array([end(limits[axis]) for axis in "xyz"]) for end in (min, max))
    return low, high


@dataclass(frozen=True)
class SkillCall:
    """A skill with its parameters in the order of its `SkillSpec`."""

    skill: str
    parameters: tuple[float, ...] = ()

    @property
    def digest(self) -> str:
        """SHA-256 over the canonical JSON of skill and parameters: what an approval is bound to."""
        canonical = json.dumps([self.skill, [float(p) for p in self.parameters]], separators=(",", ":"))
        return hashlib.sha256(canonical.encode()).hexdigest()

    def named(self, spec: SkillSpec) -> dict[str, float]:
        """The parameters by name."""
        return {p.name: v for p, v in zip(spec.parameters, self.parameters, strict=True)}


def check_call(call: SkillCall, skills: tuple[SkillSpec, ...]) -> SkillSpec:
    """The spec that `call` satisfies.

    Raises:
        InvalidCall: unknown skill, wrong number of parameters, a value that is not finite or outside its bounds.
    """
    by_name = {spec.name: spec for spec in skills}
    spec = by_name.get(call.skill)
    if spec is None:
        raise InvalidCall(f"the task has no skill {call.skill!r}", remedy=f"use one of: {', '.join(sorted(by_name))}")
    if len(call.parameters) != len(spec.parameters):
        raise InvalidCall(
            f"{call.skill} takes {len(spec.parameters)} parameters, got {len(call.parameters)}",
            remedy="give exactly: " + (", ".join(p.name for p in spec.parameters) or "none"),
        )
    for p, value in zip(spec.parameters, call.parameters, strict=True):
        # 1e-9: a bound that went through JSON or float32 is still that bound
        if not math.isfinite(value) or not p.low - 1e-9 <= value <= p.high + 1e-9:
            raise InvalidCall(
                f"{call.skill}.{p.name} = {value} is outside the workspace",
                remedy=f"keep {p.name} within [{p.low}, {p.high}] {p.unit}",
            )
    return spec


@dataclass(frozen=True)
class CameraCalibration:
    """A pinhole camera (OpenCV convention: x right, y down, z into the scene).

    intrinsics: (3, 3) in pixels. camera_from_base: (4, 4) rigid transform from the robot base frame.
    """

    width: int
    height: int
    intrinsics: Array
    camera_from_base: Array


@dataclass(frozen=True)
class CameraFrame:
    """One encoded picture. `taken_at` is seconds since the epoch."""

    camera: str
    jpeg: bytes
    width: int
    height: int
    taken_at: float


@dataclass(frozen=True)
class Scene:
    """Everything a task may look at, as one snapshot: what simulators know and real robots estimate.

    objects: name -> (3,) centre, m, robot base frame. gripper: (3,) grip site, m, robot base frame.
    gripper_closed: whether the fingers are commanded closed. held: the object between the fingers, if any.
    joints: name -> position of what slides, m from closed. tilts: name -> angle between an object's upright axis and
    the vertical, rad; one that isn't named stands upright. latched: what `Task.events` has named in this episode.
    """

    objects: Mapping[str, Array]
    gripper: Array
    gripper_closed: bool
    held: str | None = None
    joints: Mapping[str, float] = field(default_factory=dict)
    tilts: Mapping[str, float] = field(default_factory=dict)
    latched: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Observation:
    """The state s (n,) with the images taken with it. `taken_at` is seconds since the epoch.

    Two observations with the same `id` are the same observation: nothing moved in between.
    """

    id: str
    state: Array
    frames: Mapping[str, CameraFrame]
    taken_at: float


class EndReason(StrEnum):
    """Why a skill ended."""

    ARRIVED = "arrived"
    TIMEOUT = "timeout"
    STALLED = "stalled"
    FORCE_LIMIT = "force_limit"
    STOPPED = "stopped"
    NOTHING_GRASPED = "nothing_grasped"


@dataclass(frozen=True)
class SafetyViolation:
    """`kind` is `damage` (would need the emergency stop) or `manual_reset` (the task can't go on without a hand)."""

    kind: str
    detail: str


@dataclass(frozen=True)
class SkillResult:
    """What one execution did. `low_level_steps` counts controller set-points (one low-level action each)."""

    end: EndReason
    low_level_steps: int
    success: bool
    violations: tuple[SafetyViolation, ...] = ()


Pixel = tuple[float, float]
"""u to the right, v down, from the top left corner of a full-size image."""


@dataclass(frozen=True)
class CameraOverlay:
    """A skill call drawn for one camera, in pixels of its full-size image; a point may lie outside the image.

    dot: the parameter's position. line: height above the table, or push direction and length. bar: the gripper's
    closing direction. ring: where the drop line meets the table. ghost: outlines of the fingers and the hand as they
    are at the end of the way to the target. yaw: the gripper's angle about z, rad, that bar and ghost are drawn for.
    workspace: the eight corners of where the task's skills may act, the lower four first, each four in turn.
    A skill without a position has only its name and the workspace.
    """

    dot: Pixel | None = None
    line: tuple[Pixel, Pixel] | None = None
    arrow: bool = False
    bar: tuple[Pixel, Pixel] | None = None
    ring: Pixel | None = None
    in_view: bool = True
    ghost: tuple[tuple[Pixel, ...], ...] = ()
    yaw: float | None = None
    workspace: tuple[Pixel, ...] = ()


@dataclass(frozen=True)
class Telemetry:
    """What a robot tells of itself beside its state, for whoever keeps it safe; what it can't tell is left out.

    joints: (n,) rad, base to wrist. joint_limits: lowest and highest of each, rad. gripper: (3,) m, grip site, base
    frame. opening: m between the fingers. force: (3,) N, at the hand, in its own frame. calibration: `exact` where the
    cameras are computed, `measured` where they were calibrated, `missing` where overlays can't be trusted.
    calibration_detail: when and how well, in words. scene: whether it is as the newest observation shows it, None where
    nobody looks again; unclear where that can't be told. scene_detail: why not, in words for the trainer. mode: what a
    real arm is doing. words: the same for a trainer.
    """

    joints: tuple[float, ...] = ()
    joint_limits: tuple[tuple[float, float], ...] = ()
    gripper: tuple[float, float, float] | None = None
    opening: float | None = None
    force: tuple[float, float, float] | None = None
    calibration: Literal["exact", "measured", "missing"] | None = None
    calibration_detail: str = ""
    scene: Literal["clear", "changed", "unclear"] | None = None
    scene_detail: str = ""
    mode: Literal["idle", "moving", "reflex", "user_stopped", "disconnected"] | None = None
    words: str = ""


@runtime_checkable
class TellsTelemetry(Protocol):
    """What an adapter has beside `Adapter` if it can tell more of itself."""

    def telemetry(self) -> Telemetry:
        """As it is now. Asked between two set-points too, so it must take well under a millisecond."""


@runtime_checkable
class Tended(Protocol):
    """What a real robot's adapter has beside `Adapter`: what only an operator asks for, and a look at any time."""

    def home(self, *, should_stop: StopCheck, on_step: StepHook) -> bool:
        """Bring the robot slowly out of the way; False if it was stopped. It pushes against nothing.

        Raises:
            Unavailable: it can't be used now, or it broke off on the way, and why.
        """

    def recover(self) -> None:
        """Clear what keeps the robot from moving after it stopped itself.

        Raises:
            AdapterError: it can't be cleared, and what helps.
        """

    def refresh(self) -> None:
        """Look at the robot, so that its telemetry is of now. Never raises for a robot that isn't well."""

    def halt(self) -> None:
        """Stop at once whatever drives the robot. Never raises."""


@dataclass(frozen=True)
class AdapterInfo:
    """What an adapter tells of itself before anything moves."""

    name: str
    simulated: bool
    cameras: tuple[str, ...]
    image_size: tuple[int, int]
    control_hz: float
    details: Mapping[str, Any] = field(default_factory=dict)


StopCheck = Callable[[], bool]
"""Returns True as soon as the motion must end; polled between any two set-points."""

StepHook = Callable[[], None]
"""Called after every set-point; an adapter's caller uses it to stream frames."""


class Adapter(Protocol):
    """A robot with its task. Used from one thread only: the one that created it (GL contexts are bound to it)."""

    info: AdapterInfo

    def reset(self, seed: int | None = None) -> Observation:
        """Start an episode. The same seed gives the same start on a simulator."""

    def observe(self) -> Observation:
        """State and images now, without moving."""

    def execute(self, call: SkillCall, *, should_stop: StopCheck, on_step: StepHook) -> SkillResult:
        """Run one skill to its end, or until `should_stop()`; then `end` is `stopped`.

        Raises:
            InvalidCall: the call doesn't fit the task. Nothing has moved.
            AdapterError: it can't run now; or, once `should_stop` was asked, it broke off, and nothing drives the robot
                any more.
        """

    def overlays(self, call: SkillCall) -> Mapping[str, CameraOverlay]:
        """The call drawn for every camera of the newest observation."""

    def frame(self, camera: str) -> CameraFrame:
        """One picture now, for live video: may be of a lower quality than an observation's."""

    def success(self) -> bool:
        """Whether the task is solved now."""

    def close(self) -> None:
        """Release simulator, robot and graphics."""


class AdapterFactory(Protocol):
    """What an entry point of the group `seed.adapters` names. Importing it must not import a simulator or driver."""

    name: str
    description: str
    simulated: bool
    """False for a real robot: evaluations are refused and motion needs an operator present."""
    tasks: tuple[str, ...]
    """The tasks it was made for. An adapter that can stage others has a method `stages`: see `registry.Stages`."""
    settings: type[BaseModel]
    """Pydantic model of the adapter's settings, each field documented."""

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build the adapter. Only here may the simulator be imported.

        Raises:
            Unavailable: graphics, simulator or robot can't be had; the remedy says what to install or set.
        """
