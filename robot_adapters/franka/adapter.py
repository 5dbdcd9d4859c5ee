"""The Franka `Adapter`: a real arm, what it sees, and the skills that simulation uses, unchanged."""

from __future__ import annotations

import contextlib
import logging
import time
import uuid
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from robot_adapters.base import (
    AdapterInfo,
    Array,
    CameraFrame,
    CameraOverlay,
    EndReason,
    Observation,
    SafetyViolation,
    Scene,
    SceneUnclear,
    SkillCall,
    SkillResult,
    SkillSpec,
    StepHook,
    StopCheck,
    Telemetry,
    Unavailable,
    check_call,
)
from robot_adapters.franka import FrankaSettings, connecting
from robot_adapters.franka.arm import CONTROL_HZ
from robot_adapters.franka.backend import WORDS, ArmFault, Mode
from robot_adapters.franka.dead_man import DeadMan
from robot_adapters.franka.eyes import (
    Calibrated,
    Hand,
    Sight,
    find_eyes,
    must_be_known,
    must_be_unmoved,
    must_stand_still,
    why_not,
)
from robot_adapters.franka.faults import ended_by, violations_of
from robot_adapters.franka.holding import gripped, holds
from robot_adapters.franka.limits import Refused, joint_limits
from robot_adapters.franka.scene_watch import SceneWatch
from robot_adapters.franka.telling import tell
from robot_adapters.guiding import Guide
from robot_adapters.projection import overlay
from robot_adapters.registry import task as task_by_name
from robot_adapters.skills import clear_yaw, run_skill
from robot_adapters.tasks.episode import Episode

log = logging.getLogger(__name__)

LIFTING = ("pick", "place", "push")
"""Skills that end by a lift; on a real robot it leads further up than in simulation, where nothing hides anything."""
OUT_OF_THE_WAY = 0.28
"""m above the table for the grip site: at the 0.17 m of a lift, the hand (204 mm wide) hides a block that it has just
put on another from cameras that look down at 48 degrees. Seen in renders."""
HOME_REMEDY = "look at what is in its way and take that away, then bring it home again"


class FrankaAdapter:
    """A real arm (`Adapter`). One thread uses it; a dead-man timer beside it may only stop."""

    def __init__(self, task: str, settings: FrankaSettings) -> None:
        """Connect to arm and cameras, and look. Nothing moves.

        Raises:
            Unavailable: one of them can't be had.
        """
        self._task = task_by_name(task)
        self._settings = settings
        self._eyes = find_eyes(settings.eyes)(task, settings.eyes_settings)
        try:
            self.arm = connecting.arm(settings, self._task)
        except BaseException:
            self._eyes.close()
            raise
        self._dead_man = DeadMan(self.arm, settings.dead_man)
        self._sight: Sight | None = None
        self._observation: Observation | None = None
        self._stood = self.arm.pose()
        """Where the arm was when that was made."""
        self._refusal: str | None = None
        """Why the cameras can't be relied on."""
        self._watch = SceneWatch()
        self._grasp: tuple[Array, float] | None = None
        """Where the fingers closed last, (3,) m robot base frame and rad; None while they are open."""
        self._episode = Episode(self._task, self._scene)
        self._shift = np.array(connecting.offset(settings, self._task))
        facts = self.arm.backend.facts()
        self._joint_limits = joint_limits(facts.fci)
        self.info = AdapterInfo(
            name="franka",
            simulated=False,
            cameras=self._eyes.cameras,
            image_size=self._eyes.image_size,
            control_hz=CONTROL_HZ,
            details={
                "backend": facts.backend,
                "fci": facts.fci,
                "firmware": facts.firmware,
                "hand": facts.hand_firmware,
                "host": settings.host,
            },
        )

    def reset(self, seed: int | None = None) -> Observation:
        """Start an episode as people have laid it out. Nothing moves: `home` does that, when an operator asks."""
        del seed
        self._observation = self._sight = None
        self._episode.reset()
        return self.observe()

    def observe(self) -> Observation:
        """State and images now; the same observation as long as nothing has moved.

        Raises:
            SceneUnclear: an object is lost, a camera has moved or is gone.
            Unavailable: the arm isn't well.
        """
        self._must_be_well()
        if self._observation is None or self._watch.trouble is not None:
            self._observation = None
            with self._watch.noting():
                self._must_see()
                self._sight, self._stood = None, self.arm.pose()
                scene = self._episode.scene()
                assert self._sight is not None
                must_be_known(self._sight)
            frames = {name: self._eyes.frame(name, still=True) for name in self.info.cameras}
            taken = min(self._sight.taken_at.values(), default=time.time())
            self._observation = Observation(uuid.uuid4().hex, self._task.state(scene), frames, taken)
        return self._observation

    def execute(self, call: SkillCall, *, should_stop: StopCheck, on_step: StepHook) -> SkillResult:
        """Run one skill to its end, or until `should_stop()`.

        Raises:
            InvalidCall: the call doesn't fit the task. Nothing has moved.
            Unavailable: the arm can't be used now, or what is seen isn't what was judged: the arm hasn't moved then. Or
                the eyes failed after the motion had begun. Whatever is raised, the arm is halted before.
        """
        spec = check_call(call, self._task.skills)
        self._must_be_well()
        before = (self._observation or self.observe()).state  # what was judged, also where a new look would differ
        with self._watch.noting():
            self._must_still_be_so()
        yaw = self._yaw(call, spec)
        self._observation = self._sight = None

        def act(stop: StopCheck, step: StepHook) -> tuple[EndReason, int]:
            end, steps = run_skill(self.arm, call, spec, should_stop=stop, on_step=step, yaw=yaw)
            lifted = call.skill in LIFTING and end in {EndReason.ARRIVED, EndReason.NOTHING_GRASPED}
            if lifted and not self.arm.rise(OUT_OF_THE_WAY):
                end = EndReason.STOPPED if stop() else EndReason.FORCE_LIMIT
            return end, steps

        end, steps, broken = self._run(should_stop, on_step, act)
        scene = self._episode.scene()
        found = self._episode.executed(before, call, end, scene)
        return SkillResult(end, steps, self._task.success(scene), (*broken, *found))

    def home(self, *, should_stop: StopCheck, on_step: StepHook) -> bool:
        """Slowly to where the arm is out of the cameras' way, because an operator asks; False if it was stopped.

        Raises:
            Unavailable: the arm can't be used now, or it broke off on the way; it stands still then.
        """
        self._must_be_well()
        self._observation = self._sight = None

        def go(_: StopCheck, step: StepHook) -> tuple[EndReason, int]:
            self.arm.while_waiting = step
            return (EndReason.ARRIVED if self.arm.home() else EndReason.STOPPED), 0

        end, _, broken = self._run(should_stop, on_step, go)
        why = self.arm.overload() or "; ".join(violation.detail for violation in broken)
        if why:
            raise Unavailable(f"the arm broke off on its way home: {why}", remedy=HOME_REMEDY)
        return end is EndReason.ARRIVED

    def recover(self) -> None:
        """Clear a reflex, because an operator says so.

        Raises:
            ArmFault: it can't be cleared; after a user stop, only by releasing the button.
        """
        state = self.arm.look()
        if state.mode in {Mode.USER_STOPPED, Mode.DISCONNECTED}:
            raise ArmFault(f"the arm is in state {state.mode}", mode=state.mode)
        if state.mode is Mode.REFLEX:
            self.arm.recover()
        self._observation = None

    def guide(self, *, square: float, wanted: int) -> Guide:
        """Begin to calibrate the cameras. Nothing moves: people guide the arm (`CalibratesCameras`).

        Raises:
            Unavailable: these eyes can't be calibrated.
        """
        if not isinstance(self._eyes, Calibrated):
            raise Unavailable("what sees here has no cameras to calibrate", remedy="use the eyes `perception`")
        self._observation = None
        return self._eyes.guide(self._hand, square=square, wanted=wanted)

    def overlays(self, call: SkillCall) -> Mapping[str, CameraOverlay]:
        """The call drawn for every camera, with the yaw that the gripper would take.

        Raises:
            InvalidCall: the call doesn't fit the task.
            SceneUnclear: the scene isn't as the observation shows it, or that can't be seen.
        """
        spec = check_call(call, self._task.skills)
        self._watch.must_be_clear()
        yaw = self._yaw(call, spec)
        shifted = np.eye(4)
        shifted[:3, 3] = self._shift  # from the task's frame to the robot's, then to the camera's
        return {
            name: overlay(
                replace(seen, camera_from_base=seen.camera_from_base @ shifted),
                call,
                spec,
                self._task.table_height,
                yaw=yaw,
                skills=self._task.skills,
            )
            for name, seen in self._eyes.calibrations().items()
        }

    def frame(self, camera: str) -> CameraFrame:
        """One picture now, for live video.

        Raises:
            Unavailable: there is no such camera, or it is gone.
        """
        try:
            return self._eyes.frame(camera, still=False)
        except Unavailable as lost:
            if camera in self.info.cameras:
                self._refusal = str(lost)
            raise

    def success(self) -> bool:
        """Whether the task is solved, as far as can be seen."""
        return self._task.success(self._episode.scene())

    def telemetry(self) -> Telemetry:
        """What the arm says of itself, as it was seen last."""
        return tell(self.arm, self._joint_limits, self._refusal, self._watch)

    def refresh(self) -> None:
        """Look at arm and scene while nothing is asked of them, so that what they tell of themselves is so."""
        try:
            self.arm.look()
        except ArmFault as fault:
            self.arm.lost(fault.mode)
        mode = self.arm.state.mode
        if mode is Mode.MOVING or not self._watch.is_due():
            return
        if mode is not Mode.IDLE:  # somebody guides it, or has to see to it: what is judged is looked at after that
            self._refusal = why_not(self._eyes)
            return
        with contextlib.suppress(Unavailable), self._watch.noting():
            self._look_again()

    def halt(self) -> None:
        """Stop at once whatever drives the arm."""
        self.arm.halt()

    def close(self) -> None:
        """Stop, and let go of arm and cameras."""
        self._dead_man.close()
        self.arm.halt()
        self.arm.backend.close()
        self._eyes.close()

    def _run(
        self,
        should_stop: StopCheck,
        on_step: StepHook,
        work: Callable[[StopCheck, StepHook], tuple[EndReason, int]],
    ) -> tuple[EndReason, int, tuple[SafetyViolation, ...]]:
        """Carry out a motion under the dead-man timer; its end, its set-points, and what the arm itself objected to."""
        steps = 0

        def count() -> None:
            nonlocal steps
            steps += 1
            self._note_grasp()
            on_step()

        stop = self._dead_man.guarding(should_stop)
        self.arm.should_stop = stop
        self.arm.while_waiting = lambda: None
        try:
            self.arm.begin()
            end, steps = work(stop, count)
        except (ArmFault, Refused) as fault:
            log.warning("the motion broke off: %s", fault)
            self.arm.halt()
            return ended_by(fault), steps, violations_of(fault)
        except BaseException:  # of the eyes, the caller's hook or a bug: nobody is going to drive this motion on
            self.arm.halt()
            raise
        finally:
            self._dead_man.rest()
        if end is EndReason.STOPPED:
            self.arm.halt()
        else:
            self.arm.end()
        return end, steps, ()

    def _hand(self) -> Array:
        """base_from_hand (4, 4) as the arm says it, also while somebody guides it."""
        state = self.arm.look()
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = state.rotation, state.position
        return pose

    def _must_be_well(self) -> None:
        try:
            state = self.arm.look()
        except ArmFault as fault:
            self.arm.lost(fault.mode)
            raise Unavailable(str(fault), remedy=fault.remedy) from fault
        if state.mode not in {Mode.IDLE, Mode.MOVING}:
            why = f" ({', '.join(state.errors)})" if state.errors else ""
            raise Unavailable(f"the arm is in state {state.mode}{why}", remedy=WORDS[state.mode])

    def _must_see(self) -> None:
        self._refusal = why_not(self._eyes)
        if self._refusal is not None:
            raise SceneUnclear(self._refusal, remedy="put that right, or pause and calibrate the cameras again")

    def _look_again(self) -> None:
        """See that what was judged is so; where somebody waits for a picture, whether there can be one."""
        if self._observation is not None:
            self._must_still_be_so()
        else:
            self._must_see()
            if self._watch.trouble is not None:
                must_be_known(self._look())

    def _must_still_be_so(self) -> None:
        """Look once more before the arm moves: people and cameras may have moved while somebody judged."""
        assert self._sight is not None
        self._must_see()
        now = self._look()
        must_be_known(now)
        must_be_unmoved(self._sight, now)
        must_stand_still(self._stood, self.arm.pose())

    def _note_grasp(self) -> None:
        if not self.arm.gripper_closed():
            self._grasp = None
        elif self._grasp is None:
            here, yaw = self.arm.pose()
            self._grasp = here + self._shift, yaw

    def _look(self) -> Sight:
        here, yaw = self.arm.pose()
        width, closed = self.arm.gripper_width(), self.arm.gripper_closed()
        return self._eyes.look(Hand(here + self._shift, yaw, width, closed, self._grasp))

    def _scene(self) -> Scene:
        """What is seen, in the task's frame, with what the fingers hold."""
        if self._sight is None:
            self._sight = self._look()
        here, _ = self.arm.pose()
        objects = {name: at - self._shift for name, at in self._sight.objects.items()}
        closed = self.arm.gripper_closed()
        held = holds(self.arm.gripper_width(), closed=closed)
        return Scene(
            objects=objects,
            gripper=here,
            gripper_closed=closed,
            held=gripped(self._task.objects, objects, self._sight.yaws, here) if held else None,
            joints=self._sight.joints,
            tilts=self._sight.tilts,
        )

    def _yaw(self, call: SkillCall, spec: SkillSpec) -> float:
        """The gripper's angle, rad, for a call that doesn't say: clear of neighbours to pick, else as it is."""
        _, present = self.arm.pose()
        if call.skill != "pick":
            return present
        values = call.named(spec)
        target = np.array([values["x"], values["y"], values["z"]])
        objects = list(self._scene().objects.values())
        if not objects:
            return present
        nearest = min(range(len(objects)), key=lambda i: float(np.linalg.norm(objects[i] - target)))
        return clear_yaw(target, objects[:nearest] + objects[nearest + 1 :])
