"""The robot worker: owns the robot or simulator with its graphics, looks, draws overlays, and runs approved skills.

Everything happens on one thread, because a GL context belongs to the thread that made it. A stop has a channel of its
own, which is looked at between any two set-points: it never waits behind a skill.
"""

from __future__ import annotations

import contextlib
import dataclasses
import json
import logging
import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from robot_adapters import registry
from robot_adapters.base import (
    Adapter,
    AdapterError,
    EndReason,
    Observation,
    SafetyViolation,
    SkillCall,
    SkillResult,
    TellsTelemetry,
    Tended,
)
from robot_adapters.guiding import CalibratesCameras, Guide
from server.images import Images
from server.workers.channel import FrameSender, Pipes, Refusal, StopLatch, answer, open_pipes
from server.workers.guiding import looked, worth

log = logging.getLogger(__name__)

FRAME_INTERVAL = 0.05
"""Seconds between two live pictures while a skill runs. Cameras take turns: 10 a second each with two cameras."""

TELEMETRY_EVERY = 4
"""Pictures from one that carries the robot's telemetry to the next: five a second."""

REFRESH = 0.2
"""Seconds between two looks at a robot that nothing is asked of."""


class Latched(Refusal):
    """Nothing moves while a stop is latched."""


class Robot:
    """The commands, one method each. Replies are JSON; positions in m, robot base frame."""

    def __init__(self, latch: StopLatch, frames: FrameSender) -> None:
        self._latch = latch
        self._frames = frames
        self._adapter: Adapter | None = None
        self._images: Images
        self._index = 0
        self._executed = 0
        self._attended: float | None = None
        self._told: dict[str, Any] | None = None
        self._told_at = 0.0
        self._looked_at = 0.0
        self._guide: Guide | None = None
        self._guide_worth: dict[str, Any] | None = None

    @property
    def adapter(self) -> Adapter:
        """The built adapter."""
        if self._adapter is None:
            raise Refusal("the robot isn't built yet", remedy="send `build` first")
        return self._adapter

    def build(
        self,
        *,
        adapter: str,
        task: str,
        settings: dict[str, Any],
        data_dir: str,
        robot: int = 0,
        attended: float | None = None,
    ) -> dict[str, Any]:
        """Build the adapter; the slow part of a start, because simulators are imported here.

        robot: which one of the experiment's this is, from 0. attended: seconds without word of an operator after which
        a real robot's motion ends; None for a simulated one.
        """
        self._attended = attended
        self._index = robot
        factory = registry.adapter(adapter)
        self._images = Images(Path(data_dir))
        # adapters find what belongs to the machine there, whichever way the service was told: a rig's calibration
        os.environ["SEED_DATA_DIR"] = data_dir
        self._adapter = factory(task, factory.settings.model_validate(settings))
        info = self._adapter.info
        return {"name": info.name, "simulated": info.simulated, "cameras": list(info.cameras)}

    def reset(self, *, seed: int | None) -> dict[str, Any]:
        """Start an episode and look."""
        self._must_be_armed()
        return self._seen(self.adapter.reset(seed))

    def observe(self) -> dict[str, Any]:
        """Look, without moving."""
        return self._seen(self.adapter.observe())

    def overlay(self, *, skill: str, parameters: list[float]) -> dict[str, Any]:
        """The call drawn for every camera of the newest observation."""
        drawn = self.adapter.overlays(SkillCall(skill, tuple(parameters)))
        return {"overlays": {camera: dataclasses.asdict(overlay) for camera, overlay in drawn.items()}}

    def execute(
        self,
        *,
        proposal_id: int | None,
        execution_id: int | None,
        digest: str,
        skill: str,
        parameters: list[float],
        robot: int = 0,
        video: bool = True,
    ) -> dict[str, Any]:
        """Run an approved skill to its end, streaming pictures if there is to be a `video`.

        The last door before a motion: it opens once per proposal, only for the robot and the parameters that were
        approved, and not while a stop is latched. Times in the reply are CLOCK_MONOTONIC, which all processes of a
        machine share.
        """
        call = SkillCall(skill, tuple(float(p) for p in parameters))
        if proposal_id is None or execution_id is None:
            raise Refusal("a call without a proposal never runs", remedy="have it proposed and approved")
        if robot != self._index:
            raise Refusal(
                f"this call was approved for robot {robot + 1}, and this is robot {self._index + 1}",
                remedy="have it proposed for this robot",
            )
        if call.digest != digest:
            raise Refusal("these are not the approved parameters", remedy="have exactly these parameters approved")
        if proposal_id <= self._executed:
            raise Refusal(f"proposal {proposal_id} has had its execution", remedy="have it proposed again")
        self._executed = proposal_id  # whatever comes of it: what a stop has refused isn't run after a re-arm either
        self._must_be_armed()
        pictures = _Video(self.adapter, self._frames if video else None, execution_id)
        begun = False

        def must_stop() -> bool:
            nonlocal begun
            begun = True  # whoever asks is about to move
            return self._must_stop()

        try:
            result = self.adapter.execute(call, should_stop=must_stop, on_step=pictures.step)
            success = self.adapter.success()
        except AdapterError as error:
            if not begun:
                raise
            log.warning("proposal %d: the motion broke off: %s", proposal_id, error)
            result, success = _broken_off(error, pictures.steps), False
        except Exception as error:
            # nobody knows where the arm is now: end the process, so that the server records an interruption
            log.exception("proposal %d: the skill broke off", proposal_id)
            raise SystemExit(1) from error
        return {
            "end": str(result.end),
            "arrived": result.end is EndReason.ARRIVED,
            "stopped": result.end is EndReason.STOPPED,
            "low_level_steps": result.low_level_steps,
            "task_success": success,
            "violations": [dataclasses.asdict(v) for v in result.violations],
            "first_set_point_at": pictures.first,
            "last_set_point_at": pictures.last,
            "frames": pictures.sent,
            "telemetry": telemetry_of(self.adapter),
        }

    def home(self) -> dict[str, Any]:
        """Bring a real arm out of the way: the one motion that an operator asks for directly."""
        adapter = self._tended()
        self._must_be_armed()
        arrived = adapter.home(should_stop=self._must_stop, on_step=self._on_the_way)
        return {"arrived": arrived, "telemetry": telemetry_of(self.adapter)}

    def recover(self) -> dict[str, Any]:
        """Clear a real arm's reflex. Nothing moves."""
        self._tended().recover()
        return {"telemetry": telemetry_of(self.adapter)}

    def guide(self, *, square: float, wanted: int) -> dict[str, Any]:
        """Begin to calibrate a real robot's cameras; one that was under way is forgotten. Nothing moves."""
        if not isinstance(self.adapter, CalibratesCameras):
            raise Refusal("this robot's cameras aren't calibrated by hand", remedy="see its adapter's documentation")
        self._guide, self._guide_worth = self.adapter.guide(square=square, wanted=wanted), None
        return looked(self._guide.look(take=False))

    def guide_look(self, *, take: bool) -> dict[str, Any]:
        """See the board, and keep the pose if asked to."""
        return looked(self._guided().look(take=take))

    def guide_solve(self) -> dict[str, Any]:
        """Calculate where the cameras are."""
        self._guide_worth = worth(self._guided().solve())
        return self._guide_worth

    def guide_store(self) -> dict[str, Any]:
        """Keep that, and be done."""
        result = self._guided().store()
        self._guide = self._guide_worth = None
        return worth(result)

    def guide_state(self) -> dict[str, Any]:
        """What is under way, if anything is: the poses are kept here, not in a page."""
        if self._guide is None:
            return {}
        return {"step": looked(self._guide.look(take=False)), "outcome": self._guide_worth}

    def refresh(self) -> None:
        """Look at a real robot while nothing is asked of it, and tell how it is: at once where that has changed."""
        if not isinstance(self._adapter, Tended) or not self._is_due():
            return
        self._adapter.refresh()
        told = telemetry_of(self._adapter)
        if told is not None and told["mode"] == "moving" and self._must_stop():
            log.error("the robot is being driven although it must stand still: it is stopped")
            self._adapter.halt()
        before = self._told or {}
        changed = told is not None and any(told[what] != before.get(what) for what in ("mode", "scene"))
        if changed or time.monotonic() - self._told_at > 1.0:
            self._tell(told)

    def rearm(self, *, upto: int) -> dict[str, Any]:
        """Lift the stops up to number `upto`."""
        self._latch.rearm(upto)
        return {"stopped": self._latch.stopped()}

    def close(self) -> None:
        """Release the adapter."""
        if self._adapter is not None:
            self._adapter.close()

    def _must_stop(self) -> bool:
        """Whether a motion must end: by a stop, or because nobody attends a real robot any more."""
        return self._latch.stopped() or (self._attended is not None and self._latch.forsaken(self._attended))

    def _on_the_way(self) -> None:
        """Tell how the arm is while it goes home, by what the motion sees: another look would keep a stop waiting."""
        if self._is_due():
            self._tell(telemetry_of(self.adapter))

    def _is_due(self) -> bool:
        """Whether it is time to look, or to tell, again; if so, the time counts from now."""
        now = time.monotonic()
        due = now - self._looked_at >= REFRESH
        self._looked_at = now if due else self._looked_at
        return due

    def _tell(self, told: dict[str, Any] | None) -> None:
        self._told, self._told_at = told, time.monotonic()
        self._frames.send({"telemetry": told}, b"")

    def _guided(self) -> Guide:
        if self._guide is None:
            raise Refusal("no calibration is under way", remedy="begin one")
        return self._guide

    def _tended(self) -> Tended:
        if not isinstance(self.adapter, Tended):
            raise Refusal("this robot can't be asked for that", remedy="only a real arm has a home and recovers")
        return self.adapter

    def _must_be_armed(self) -> None:
        if self._latch.stopped():
            raise Latched("the emergency stop is latched", remedy="re-arm the experiment first")

    def _seen(self, observation: Observation) -> dict[str, Any]:
        views = [
            {"camera": f.camera, "image": self._images.put(f.jpeg), "width": f.width, "height": f.height}
            for f in observation.frames.values()
        ]
        return {
            "id": observation.id,
            "state": [float(x) for x in observation.state],
            "taken_at": observation.taken_at,
            "views": views,
            "success": self.adapter.success(),
            "telemetry": telemetry_of(self.adapter),
        }


class _Video:
    """Pictures of a running skill: at most one after any set-point, so that stop is looked at between any two.

    Without frames nobody watches, and none is rendered. A camera that gives none ends no motion: that is told, with
    what the robot says of itself, and the others are shown.
    """

    def __init__(self, adapter: Adapter, frames: FrameSender | None, execution_id: int) -> None:
        self._adapter = adapter
        self._frames = frames
        self._execution = execution_id
        self._due = 0.0
        self._turn = 0
        self._unseen: set[str] = set()
        self.sent = 0
        self.steps = 0
        self.first: float | None = None
        self.last: float | None = None

    def step(self) -> None:
        """Note the set-point's time; send the next camera's picture if one is due."""
        self.last = time.monotonic()
        self.steps += 1
        if self.first is None:
            self.first = self.last
        if self._frames is None or self.last < self._due:
            return
        self._due = self.last + FRAME_INTERVAL
        cameras = self._adapter.info.cameras
        if not cameras:
            return
        camera = cameras[self._turn % len(cameras)]
        self._turn += 1
        try:
            frame = self._adapter.frame(camera)
        except AdapterError as error:
            self._miss(camera, error)
            return
        self.sent += 1
        header = {k: getattr(frame, k) for k in ("camera", "width", "height", "taken_at")}
        if self.sent % TELEMETRY_EVERY == 1:
            header["telemetry"] = telemetry_of(self._adapter)
        self._frames.send(header | {"execution_id": self._execution}, frame.jpeg)

    def _miss(self, camera: str, error: AdapterError) -> None:
        assert self._frames is not None
        if camera not in self._unseen:
            self._unseen.add(camera)
            log.warning("camera %s gives no pictures during the motion: %s", camera, error)
            self._frames.send({"telemetry": telemetry_of(self._adapter)}, b"")


def _broken_off(error: AdapterError, steps: int) -> SkillResult:
    """What came of a motion that an error of the adapter ended in its middle: somebody has to look."""
    needs = SafetyViolation("manual_reset", f"the motion broke off: {error}. {error.remedy}")
    return SkillResult(EndReason.STALLED, steps, success=False, violations=(needs,))


def telemetry_of(adapter: Adapter) -> dict[str, Any] | None:
    """What it tells of itself, if it does."""
    return dataclasses.asdict(adapter.telemetry()) if isinstance(adapter, TellsTelemetry) else None


def serve(pipes: Pipes) -> None:
    """Answer commands until the server is gone."""
    robot = Robot(StopLatch(pipes.stop), FrameSender(pipes.frames))
    names = (
        *("build", "reset", "observe", "overlay", "execute", "home", "recover", "rearm"),
        *("guide", "guide_look", "guide_solve", "guide_store", "guide_state"),
    )
    handlers = {name: getattr(robot, name) for name in names}
    with contextlib.suppress(BrokenPipeError, ConnectionResetError):
        while (message := _next(pipes, robot)) is not None:
            request: Mapping[str, Any] = json.loads(message)
            pipes.commands.send(json.dumps(answer(request, handlers)).encode())
    robot.close()


def _next(pipes: Pipes, robot: Robot) -> bytes | None:
    """The next command; a real robot is looked at until it comes."""
    while not pipes.commands.poll(REFRESH):
        robot.refresh()
    return pipes.commands.receive()


def main() -> None:
    """Entry point of the process."""
    serve(open_pipes("robot"))
    # the interpreter's own way out frees GL contexts in an order that some drivers crash on; nothing is left to save
    os._exit(0)


if __name__ == "__main__":
    main()
