"""What every adapter must do, as tests to inherit: pytest collects them, and `check.py` runs them to give advice.

    class TestMine(AdapterContract):
        adapter_name = "mine"
        task_name = "stacking"

Every failure says in plain words what is wrong and how to put it right. Real robots run all of it but what needs a
seeded start (`simulated`), with an operator at hand.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from robot_adapters import registry
from robot_adapters.base import (
    Adapter,
    CameraFrame,
    EndReason,
    InvalidCall,
    Observation,
    SkillCall,
    SkillResult,
    SkillSpec,
    TellsTelemetry,
)
from robot_adapters.tasks.base import Task

SEED = 7
OTHER_SEED = 8
# how far, in image sizes, an overlay may lie outside its image before the calibration must be wrong
OVERSHOOT = 1.0


class AdapterContract:
    """Inherit, name adapter and task, and let pytest collect the tests. One adapter serves all tests of a class."""

    adapter_name: ClassVar[str]
    task_name: ClassVar[str]
    settings: ClassVar[Mapping[str, Any]] = {}

    adapter: ClassVar[Adapter]
    task: ClassVar[Task]

    @classmethod
    def setup_class(cls) -> None:
        """Build the adapter."""
        factory = registry.adapter(cls.adapter_name)
        cls.task = registry.task(cls.task_name)
        cls.adapter = factory(cls.task_name, factory.settings.model_validate(cls.settings))

    @classmethod
    def teardown_class(cls) -> None:
        """Close the adapter."""
        cls.adapter.close()

    def setup_method(self) -> None:
        """Start every test with the same episode."""
        self.start = self.adapter.reset(SEED)

    def test_tells_of_itself(self) -> None:
        """`info` names cameras, picture size and control rate."""
        info = self.adapter.info
        require(len(set(info.cameras)) == len(info.cameras), "info.cameras names one twice: names must be unique")
        require(min(info.image_size) > 0, f"info.image_size is {info.image_size}: give (width, height) in pixels")
        require(info.control_hz > 0, f"info.control_hz is {info.control_hz}: give set-points a second")

    def test_same_seed_gives_the_same_start(self) -> None:
        """Seeds reproduce, and differ from each other."""
        if not self.adapter.info.simulated:
            return
        other, again = self.adapter.reset(OTHER_SEED), self.adapter.reset(SEED)
        require(
            np.allclose(self.start.state, again.state, atol=1e-6),
            f"reset({SEED}) gave {self.start.state} and later {again.state}: draw everything random in reset from "
            "np.random.default_rng(seed), and leave nothing of the last episode",
        )
        require(
            not np.allclose(self.start.state, other.state, atol=1e-6),
            f"reset({SEED}) and reset({OTHER_SEED}) start alike: use task.sample_layout with the seed's generator",
        )

    def test_state_fits_the_task(self) -> None:
        """The state has the length of the task's fields and only finite numbers."""
        size = sum(field.size for field in self.task.state_fields)
        require(
            self.start.state.shape == (size,),
            f"the state has shape {self.start.state.shape}, the task's fields make ({size},): return task.state(scene)",
        )
        require(
            bool(np.isfinite(self.start.state).all()),
            f"the state {self.start.state} isn't finite: raise Unavailable where something can't be measured",
        )

    def test_observation_keeps_its_id_while_nothing_moves(self) -> None:
        """Looking, drawing and filming don't make a new observation."""
        for camera in self.adapter.info.cameras:
            self.adapter.frame(camera)
        self.adapter.overlays(self.task.true_call(self.start.state))
        again = self.adapter.observe()
        require(
            again.id == self.start.id and bool(np.array_equal(again.state, self.start.state)),
            "observe() gave another observation although nothing moved: keep it until reset or execute",
        )

    def test_observation_gets_a_new_id_after_motion(self) -> None:
        """An approval for the old observation can't pass for the new one."""
        self.run(self.task.true_call(self.start.state))
        after = self.adapter.observe()
        require(after.id != self.start.id, "observe() kept its id after a skill moved: drop it at the start of execute")
        require(
            self.adapter.reset(SEED).id not in {self.start.id, after.id},
            "reset() gave an id that was used before: make a fresh one, for instance uuid.uuid4().hex",
        )

    def test_every_camera_gives_a_picture(self) -> None:
        """An observation has one JPEG per camera; live frames come from the same cameras."""
        require(
            set(self.start.frames) == set(self.adapter.info.cameras),
            f"frames come from {sorted(self.start.frames)}, info.cameras says {sorted(self.adapter.info.cameras)}",
        )
        for camera in self.adapter.info.cameras:
            require_picture(self.start.frames[camera], camera, self.adapter.info.image_size)
            live = self.adapter.frame(camera)
            require_picture(live, camera, (live.width, live.height))

    def test_what_it_tells_of_itself_is_finite_and_fits(self) -> None:
        """Telemetry is optional; what there is of it is numbers, and joints lie within the limits told with them."""
        if not isinstance(self.adapter, TellsTelemetry):
            return
        told = self.adapter.telemetry()
        numbers = [*told.joints, *(told.gripper or ()), *(told.force or ()), told.opening or 0.0]
        require(all(math.isfinite(n) for n in numbers), f"telemetry tells {told}: leave out what isn't known")
        require(
            not told.joint_limits or len(told.joint_limits) == len(told.joints),
            f"{len(told.joints)} joints but {len(told.joint_limits)} limits: give one pair a joint, or none",
        )
        for at, (low, high) in zip(told.joints, told.joint_limits, strict=False):
            require(low - 0.1 <= at <= high + 0.1, f"a joint at {at} rad is outside its limits {low} to {high}")

    def test_overlays_are_drawn_for_every_camera_and_skill(self) -> None:
        """Any call inside the bounds can be drawn, at or near the image."""
        rng = np.random.default_rng(SEED)
        for spec in self.task.skills:
            for _ in range(20):
                call = random_call(spec, rng)
                overlays = self.adapter.overlays(call)
                require(
                    set(overlays) == set(self.adapter.info.cameras),
                    f"overlays are for {sorted(overlays)}, info.cameras says {sorted(self.adapter.info.cameras)}",
                )
                for camera, drawn in overlays.items():
                    require(
                        (drawn.dot is not None) == ({"x", "y", "z"} <= {p.name for p in spec.parameters}),
                        f"{camera}: a dot belongs to a skill with a position and to no other; wrong for {spec.name}",
                    )
                    if drawn.dot is not None:
                        self._require_near(drawn.dot, camera, call)

    def test_true_calls_are_in_view(self) -> None:
        """A trainer sees the right call on every picture."""
        call = self.task.true_call(self.start.state)
        width, height = self.adapter.info.image_size
        for camera, drawn in self.adapter.overlays(call).items():
            inside = drawn.dot is None or (0 <= drawn.dot[0] <= width and 0 <= drawn.dot[1] <= height)
            require(
                inside and drawn.in_view,
                f"{camera} draws the right call {call} at {drawn.dot}, outside its image: point it at the workspace",
            )

    def test_bad_calls_are_refused(self) -> None:
        """A call that doesn't fit the task raises InvalidCall and moves nothing."""
        for call, what in bad_calls(self.task.skills):
            for door in (self.run, self.adapter.overlays):
                refused = False
                try:
                    door(call)
                except InvalidCall:
                    refused = True
                require(refused, f"{what} was taken: call check_call(call, task.skills) first in execute and overlays")
        after = self.adapter.observe()
        require(
            after.id == self.start.id and bool(np.allclose(after.state, self.start.state, atol=1e-6)),
            "a refused call changed the observation: check before anything else happens",
        )

    def test_stops_before_it_starts(self) -> None:
        """A stop that was asked for already ends a skill with its first set-point."""
        result = self.adapter.execute(far_call(self.task), should_stop=lambda: True, on_step=_nothing)
        require(
            result.end is EndReason.STOPPED and result.low_level_steps <= 2,
            f"should_stop() was True from the start, yet: {result}. Look at it before every set-point, end `stopped`",
        )

    def test_stops_on_its_way(self) -> None:
        """A stop during motion ends it at once, and the robot can be used afterwards."""
        steps = 0

        def count() -> None:
            nonlocal steps
            steps += 1

        result = self.adapter.execute(far_call(self.task), should_stop=lambda: steps >= 1, on_step=count)
        require(
            result.end is EndReason.STOPPED,
            f"should_stop() became True after a set-point, yet the skill ended {result.end}: poll it before every one",
        )
        require(1 <= steps <= 2, f"{steps} set-points followed although a stop was asked for after the first")
        require(
            bool(np.isfinite(self.adapter.observe().state).all()), "the state isn't finite after a stop in mid-motion"
        )
        again = self.run(far_call(self.task))
        require(again.end is not EndReason.STOPPED, "the next skill ended `stopped` too: a stop ends one skill only")

    def test_counts_low_level_steps(self) -> None:
        """A finished skill says how many set-points it took, and called on_step."""
        steps = 0

        def count() -> None:
            nonlocal steps
            steps += 1

        call = self.task.true_call(self.start.state)
        result = self.adapter.execute(call, should_stop=_never, on_step=count)
        require(result.low_level_steps > 0, "low_level_steps is 0 after a skill: count the set-points")
        require(steps > 0, "on_step was never called: call it after every set-point, live video depends on it")

    def test_true_calls_solve_the_task(self) -> None:
        """No episode starts solved; the task's own calls solve it within its horizon."""
        require(not self.adapter.success(), "success() is True right after reset: start where something is left to do")
        if not self.adapter.info.simulated:
            return
        observation: Observation = self.start
        for _ in range(self.task.horizon):
            result = self.run(self.task.true_call(observation.state))
            require(
                result.success == self.adapter.success(),
                f"execute said success={result.success}, success() says {self.adapter.success()} right after it",
            )
            require(not result.violations, f"the right call broke a rule: {result.violations}")
            if result.success:
                return
            observation = self.adapter.observe()
        raise AssertionError(
            f"{self.task.horizon} true calls didn't solve the task; the last ended {result.end} at {observation.state}"
        )

    def run(self, call: SkillCall) -> SkillResult:
        """Execute to the end."""
        return self.adapter.execute(call, should_stop=_never, on_step=_nothing)

    def _require_near(self, point: tuple[float, float], camera: str, call: SkillCall) -> None:
        inside = all(
            math.isfinite(at) and -OVERSHOOT * size <= at <= (1 + OVERSHOOT) * size
            for at, size in zip(point, self.adapter.info.image_size, strict=True)
        )
        require(
            inside,
            f"{camera} draws {call} at {point}, far from its image: check the calibration (OpenCV: x right, y down, "
            "z into the scene; metres; camera_from_base maps the base frame to the camera's)",
        )


def require(condition: bool, message: str) -> None:
    """Raise AssertionError with `message` alone, also where Python or pytest treat `assert` differently."""
    if not condition:
        raise AssertionError(message)


def require_picture(frame: CameraFrame, camera: str, size: tuple[int, int]) -> None:
    """Raise AssertionError unless `frame` is a JPEG of `camera` that shows something and has the declared size."""
    from PIL import Image  # noqa: PLC0415 - only where there are pictures

    require(frame.camera == camera, f"the frame of {camera} says it is of {frame.camera}")
    require(frame.jpeg[:2] == b"\xff\xd8", f"the frame of {camera} isn't a JPEG")
    image = Image.open(io.BytesIO(frame.jpeg))
    image.load()
    require(
        image.size == (frame.width, frame.height) == tuple(size),
        f"{camera}: the JPEG has {image.size}, the frame says {(frame.width, frame.height)}, expected {tuple(size)}",
    )
    low, high = image.convert("L").getextrema()
    require(low != high, f"the picture of {camera} is blank: is there a light, and does the camera see the scene?")


def random_call(spec: SkillSpec, rng: np.random.Generator) -> SkillCall:
    """A call anywhere inside the bounds of `spec`."""
    values = spec.denormalise(rng.uniform(-1.0, 1.0, size=len(spec.parameters)))
    return SkillCall(spec.name, tuple(float(v) for v in values))


def far_call(task: Task) -> SkillCall:
    """A call that surely takes several set-points: the far end of the first skill that has a position."""
    spec = next((s for s in task.skills if s.parameters), task.skills[0])
    middle = {"z", "yaw", "direction", "delta"}
    values = [(p.low + p.high) / 2 if p.name in middle else p.low * 0.9 + p.high * 0.1 for p in spec.parameters]
    return SkillCall(spec.name, tuple(values))


def bad_calls(skills: tuple[SkillSpec, ...]) -> list[tuple[SkillCall, str]]:
    """Calls that must be refused, each with what is wrong with it."""
    found = [(SkillCall("no such skill"), "a skill that the task doesn't offer")]
    for spec in skills:
        middle = tuple(float(v) for v in (spec.low + spec.high) / 2)
        found.append((SkillCall(spec.name, (*middle, 0.0)), f"{spec.name} with a parameter too many"))
        for i, p in enumerate(spec.parameters):
            for value in (math.nan, math.inf, p.low - 0.01, p.high + 0.01):
                call = SkillCall(spec.name, (*middle[:i], value, *middle[i + 1 :]))
                found.append((call, f"{spec.name} with {p.name} = {value}"))
    return found


def _never() -> bool:
    return False


def _nothing() -> None:
    pass
