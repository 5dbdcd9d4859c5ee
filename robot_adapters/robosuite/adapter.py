"""The robosuite adapter: a task staged in simulation, seen by two cameras, moved by `skills.py`."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from robot_adapters.base import (
    AdapterInfo,
    CameraFrame,
    CameraOverlay,
    EndReason,
    Observation,
    SafetyViolation,
    SkillCall,
    SkillResult,
    SkillSpec,
    StepHook,
    StopCheck,
    Telemetry,
    Unavailable,
    check_call,
)
from robot_adapters.projection import overlay
from robot_adapters.robosuite import RobosuiteSettings
from robot_adapters.robosuite.graphics import choose_backend, load_robosuite
from robot_adapters.skills import clear_yaw, run_skill
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.episode import Episode

if TYPE_CHECKING:
    from robot_adapters.robosuite.cameras import Cameras


class RobosuiteAdapter:
    """A Panda in simulation (`Adapter`). Use it on the thread that made it: its OpenGL context belongs to that one."""

    def __init__(self, task: Task, settings: RobosuiteSettings) -> None:
        """Load the simulator, draw a first picture if there are cameras, and start an episode with seed 0.

        Raises:
            Unavailable: simulator or graphics can't be had.
        """
        backend, chosen_by = choose_backend() if settings.draw else ("none", "draw = false")
        load_robosuite()
        # only now: MuJoCo binds to its OpenGL at import
        from robot_adapters.robosuite.cameras import HEIGHT, WIDTH, Cameras  # noqa: PLC0415
        from robot_adapters.robosuite.scene import CAMERAS, CONTROL_HZ  # noqa: PLC0415
        from robot_adapters.robosuite.scenes import find  # noqa: PLC0415
        from robot_adapters.robosuite.simulator import Simulator  # noqa: PLC0415

        self._task = task
        self._settings = settings
        self.simulator = Simulator(task.objects, settings.stepping, find(task.name))
        self._cameras: Cameras | None = None
        if settings.draw:
            smooth = settings.stills == "smooth"
            self._cameras = Cameras(self.simulator.model, self.simulator.data, smooth_stills=smooth)
        names = tuple(CAMERAS) if settings.draw else ()
        self._calibrations = {name: self.cameras.calibration(name) for name in names}
        self._observation: Observation | None = None
        self._episode = Episode(task, self.simulator.scene)
        self.info = AdapterInfo(
            name="robosuite",
            simulated=True,
            cameras=names,
            image_size=(WIDTH, HEIGHT),
            control_hz=float(CONTROL_HZ),
            details={
                "graphics": backend,
                "graphics_chosen_by": chosen_by,
                "stills": settings.stills,
                "robot": "Panda",
                "controller": "OSC_POSE",
                "stepping": settings.stepping,
            },
        )
        self.reset(0)

    @property
    def cameras(self) -> Cameras:
        """What draws.

        Raises:
            Unavailable: nothing does.
        """
        if self._cameras is None:
            raise Unavailable("there are no cameras", remedy="set draw to true")
        return self._cameras

    def reset(self, seed: int | None = None) -> Observation:
        """Start an episode; the same seed gives the same start. None draws a fresh one."""
        rng = np.random.default_rng(seed)
        self._observation = None
        self._episode.reset()
        self.simulator.reset(self._task.sample_layout(rng), rng)
        return self.observe()

    def observe(self) -> Observation:
        """State and images now. As long as nothing has moved it is the same observation, rendered once."""
        if self._observation is None:
            quality = self._settings.jpeg_quality
            frames = {name: self.cameras.frame(name, quality, still=True) for name in self.info.cameras}
            state = self._task.state(self._episode.scene())
            self._observation = Observation(uuid.uuid4().hex, state, frames, time.time())
        return self._observation

    def execute(self, call: SkillCall, *, should_stop: StopCheck, on_step: StepHook) -> SkillResult:
        """Run one skill to its end, or until `should_stop()`.

        Raises:
            InvalidCall: the call doesn't fit the task. Nothing has moved.
        """
        spec = check_call(call, self._task.skills)
        before = self._observation.state if self._observation else self._task.state(self._episode.scene())
        self._observation = None
        if self._settings.speed > 0:
            on_step = paced(on_step, 1.0 / (self.info.control_hz * self._settings.speed))
        self.simulator.damage = None
        end, steps = run_skill(
            self.simulator, call, spec, should_stop=should_stop, on_step=on_step, yaw=self._yaw(call, spec)
        )
        scene = self._episode.scene()
        violations = self._episode.executed(before, call, end, scene)
        if end is EndReason.FORCE_LIMIT and self.simulator.damage is not None:
            violations = (SafetyViolation("damage", self.simulator.damage), *violations)
        return SkillResult(end, steps, self._task.success(scene), violations)

    def overlays(self, call: SkillCall) -> Mapping[str, CameraOverlay]:
        """The call drawn for every camera, with the yaw that the gripper would take.

        Raises:
            InvalidCall: the call doesn't fit the task.
        """
        spec = check_call(call, self._task.skills)
        yaw = self._yaw(call, spec)
        return {
            name: overlay(calibration, call, spec, self._task.table_height, yaw=yaw, skills=self._task.skills)
            for name, calibration in self._calibrations.items()
        }

    def frame(self, camera: str) -> CameraFrame:
        """One picture now, for live video.

        Raises:
            Unavailable: there is no such camera.
        """
        if camera not in self.info.cameras:
            raise Unavailable(f"there is no camera {camera!r}", remedy="set draw to true and use left or right")
        return self.cameras.frame(camera, self._settings.live_jpeg_quality)

    def telemetry(self) -> Telemetry:
        """Joints, gripper and the force at the hand, as the simulator has them; its cameras are computed."""
        told = self.simulator.telemetry()
        return replace(told, calibration="exact" if self.info.cameras else None)

    def success(self) -> bool:
        """Whether the task is solved now."""
        return self._task.success(self._episode.scene())

    def close(self) -> None:
        """Release simulator and graphics."""
        if self._cameras is not None:
            self._cameras.close()
        self.simulator.close()

    def _yaw(self, call: SkillCall, spec: SkillSpec) -> float:
        """The gripper's angle, rad, for a call that doesn't say: clear of neighbours to pick, else as it is."""
        if call.skill != "pick":
            return self.simulator.yaw
        values = call.named(spec)
        target = np.array([values["x"], values["y"], values["z"]])
        objects = list(self.simulator.scene().objects.values())
        if not objects:
            return self.simulator.yaw
        # what lies nearest the target is what is picked, the others are in the way
        nearest = min(range(len(objects)), key=lambda i: float(np.linalg.norm(objects[i] - target)))
        return clear_yaw(target, objects[:nearest] + objects[nearest + 1 :])


def paced(
    on_step: StepHook,
    period: float,
    *,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> StepHook:
    """`on_step`, then a wait until `period` seconds after the last call was due; lost time isn't caught up."""
    due = clock() + period

    def wait() -> None:
        nonlocal due
        on_step()
        now = clock()
        if now < due:
            sleep(due - now)
        due = max(due, now) + period

    return wait
