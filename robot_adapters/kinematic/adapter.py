"""The kinematic `Adapter`: plans each skill as straight segments, and takes them at once or at a settable pace."""

from __future__ import annotations

import math
import time
import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from robot_adapters.base import (
    AdapterInfo,
    CameraFrame,
    CameraOverlay,
    EndReason,
    Observation,
    SkillCall,
    SkillResult,
    SkillSpec,
    StepHook,
    StopCheck,
    Telemetry,
    Unavailable,
    check_call,
)
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.pencil import CALIBRATIONS, HEIGHT, WIDTH
from robot_adapters.kinematic.picture import Painter, Snapshot
from robot_adapters.kinematic.world import World
from robot_adapters.projection import overlay, push_vector
from robot_adapters.skills import CLOSING_DWELL, CONTACT, DIRECT, OPENING_DWELL, TRANSIT_CLEARANCE, TRANSIT_TOLERANCE
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.episode import Episode

CONTROL_HZ = 20.0
# m between two set-points: robosuite's Panda moves at 0.6 m/s under the same skills, 20 of them a second
STRIDE = 0.03
# m likewise while pushing, at 0.08 m/s
PUSH_STRIDE = 0.004
# s between two looks at `should_stop` while a set-point lasts
PATIENCE = 0.01


@dataclass(frozen=True)
class Segment:
    """Part of a skill: `move` and `push` go to `target` (`contact`: as far as it gets), the others move fingers."""

    act: Literal["move", "push", "grasp", "close", "open"]
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    contact: bool = False


class KinematicAdapter:
    """A table that exists only as positions (`Adapter`).

    `low_level_steps` is what a real arm would have needed: one set-point for every 3 cm (4 mm of a push), 5 to close
    the fingers, 3 to open them. Where skills take effect at once, `should_stop` and `on_step` are called once per
    segment instead.
    """

    def __init__(self, task: Task, settings: KinematicSettings) -> None:
        self._task = task
        self._settings = settings
        self._world = World(task.objects, task.table_height)
        self._episode = Episode(task, self._world.scene)
        self._painter = Painter(task.objects, task.table_height, settings.jpeg_quality) if settings.draw else None
        self._observation: Observation | None = None
        self.info = AdapterInfo(
            name="kinematic",
            simulated=True,
            cameras=tuple(CALIBRATIONS) if settings.draw else (),
            image_size=(WIDTH, HEIGHT),
            control_hz=1 / settings.step_seconds if settings.step_seconds else CONTROL_HZ,
        )
        self.reset(0)

    def reset(self, seed: int | None = None) -> Observation:
        """Start an episode; the same seed gives the same start. None draws a fresh one."""
        self._observation = None
        self._episode.reset()
        self._world.reset(self._task.sample_layout(np.random.default_rng(seed)))
        return self.observe()

    def observe(self) -> Observation:
        """State and images now; the same observation as long as nothing has moved. A picture is drawn when read."""
        if self._observation is None:
            now = time.time()
            state = self._task.state(self._episode.scene())
            frames = Frames(self._painter, Snapshot.of(self._world), now) if self._painter else {}
            self._observation = Observation(uuid.uuid4().hex, state, frames, now)
        return self._observation

    def execute(self, call: SkillCall, *, should_stop: StopCheck, on_step: StepHook) -> SkillResult:
        """Run one skill to its end, or until `should_stop()`.

        Raises:
            InvalidCall: the call doesn't fit the task. Nothing has moved.
        """
        spec = check_call(call, self._task.skills)
        before = self._observation.state if self._observation else self._task.state(self._episode.scene())
        self._observation = None
        end, steps = EndReason.ARRIVED, 0
        for segment in _plan(call, spec, self._world):
            ended, taken = self._take(segment, should_stop, on_step)
            steps += taken
            # an arm that grasped nothing still lifts
            if ended is EndReason.NOTHING_GRASPED:
                end = ended
            elif ended is not None:
                end = ended
                break
        scene = self._episode.scene()
        return SkillResult(end, steps, self._task.success(scene), self._episode.executed(before, call, end, scene))

    def overlays(self, call: SkillCall) -> Mapping[str, CameraOverlay]:
        """The call drawn for every camera.

        Raises:
            InvalidCall: the call doesn't fit the task.
        """
        spec = check_call(call, self._task.skills)
        skills, height = self._task.skills, self._task.table_height
        return {name: overlay(CALIBRATIONS[name], call, spec, height, skills=skills) for name in self.info.cameras}

    def frame(self, camera: str) -> CameraFrame:
        """One picture now, for live video.

        Raises:
            Unavailable: there is no such camera.
        """
        if self._painter is None or camera not in CALIBRATIONS:
            raise Unavailable(f"there is no camera {camera!r}", remedy="set draw = true and use left or right")
        return self._painter.frame(camera, Snapshot.of(self._world), time.time())

    def telemetry(self) -> Telemetry:
        """Where the gripper is. There are no joints."""
        x, y, z = self._world.gripper
        opening = self._world.opening()
        return Telemetry(gripper=(x, y, z), opening=opening, calibration="exact" if self.info.cameras else None)

    def success(self) -> bool:
        """Whether the task is solved now."""
        return self._task.success(self._episode.scene())

    def close(self) -> None:
        """Nothing to release."""

    def _take(self, segment: Segment, should_stop: StopCheck, on_step: StepHook) -> tuple[EndReason | None, int]:
        """Take one segment; why the skill ends here (None: it goes on), and its set-points."""
        world, seconds = self._world, self._settings.step_seconds
        moves = segment.act in {"move", "push"}
        if moves:
            stride = PUSH_STRIDE if segment.act == "push" else STRIDE
            count = max(1, math.ceil(math.dist(world.gripper, segment.target) / stride))
        else:
            count = OPENING_DWELL if segment.act == "open" else CLOSING_DWELL
        start = world.gripper
        for i in range(1, count + 1) if seconds else (count,):
            if self._stopped(should_stop, seconds):
                return EndReason.STOPPED, i if seconds else 1
            if moves:
                part = i / count
                at = [a + (b - a) * part for a, b in zip(start, segment.target, strict=True)]
                if segment.act == "push":
                    if world.push(at) > CONTACT:
                        return EndReason.STALLED, i
                elif world.move(at) > (CONTACT if segment.contact else STRIDE):
                    return EndReason.STALLED, i
            elif i == count:
                ended = self._fingers(segment.act)
            on_step()
        return (None if moves else ended), count

    def _fingers(self, act: str) -> EndReason | None:
        if act == "open":
            self._world.open()
        elif act == "close":
            self._world.closed = True
        elif not self._world.grasp():
            return EndReason.NOTHING_GRASPED
        return None

    def _stopped(self, should_stop: StopCheck, seconds: float) -> bool:
        """Let one set-point last `seconds`, looking at `should_stop` all the while."""
        until = time.monotonic() + seconds if seconds else 0.0
        while not should_stop():
            left = until - time.monotonic() if seconds else 0.0
            if left <= 0:
                return False
            time.sleep(min(left, PATIENCE))
        return True


class Frames(Mapping[str, CameraFrame]):
    """The pictures of one moment, drawn when they are first read."""

    def __init__(self, painter: Painter, snapshot: Snapshot, taken_at: float) -> None:
        self._painter = painter
        self._snapshot = snapshot
        self._taken_at = taken_at
        self._drawn: dict[str, CameraFrame] = {}

    def __getitem__(self, camera: str) -> CameraFrame:
        if camera not in CALIBRATIONS:
            raise KeyError(camera)
        if camera not in self._drawn:
            self._drawn[camera] = self._painter.frame(camera, self._snapshot, self._taken_at)
        return self._drawn[camera]

    def __iter__(self) -> Iterator[str]:
        return iter(CALIBRATIONS)

    def __len__(self) -> int:
        return len(CALIBRATIONS)


def _plan(call: SkillCall, spec: SkillSpec, world: World) -> list[Segment]:
    """The segments of a call, as `skills.py` would move."""
    if call.skill == "release":
        return [Segment("open")]
    values = call.named(spec)
    x, y, z = target = values["x"], values["y"], values["z"]
    transit = max(world.table_height + TRANSIT_CLEARANCE, z)
    here = world.gripper
    over: list[Segment] = []
    if here[2] < transit - TRANSIT_TOLERANCE:
        over.append(Segment("move", (here[0], here[1], transit)))
    over.append(Segment("move", (x, y, transit)))
    down, lift = Segment("move", target, contact=True), Segment("move", (x, y, transit))
    match call.skill:
        case "reach":
            return [down] if math.dist(here[:2], (x, y)) <= DIRECT else [*over, down]
        case "pick":
            return [Segment("open"), *over, down, Segment("grasp"), lift]
        case "place":
            return [*over, down, Segment("open"), lift]
        case "push":
            by = push_vector(values["direction"], values["delta"])
            end = (x + float(by[0]), y + float(by[1]), z)
            return [Segment("close"), *over, down, Segment("push", end), Segment("move", (end[0], end[1], transit))]
        case _:
            raise ValueError(f"no such primitive: {call.skill!r}")
