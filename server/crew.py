"""The two worker processes of one experiment: started, asked, mended after a death, ended.

A learner keeps nothing that the store doesn't have: after a start it reads the newest checkpoint and then every stored
label. Labels that arrive while it is away are kept here, so that none falls between the reading and the first request.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import time
from collections.abc import Callable
from typing import Any, Literal

from robot_adapters.base import SkillCall
from server.crew_values import Done, Idea, Picture, Saved, Seen
from server.messages import FrameHeader, WorkerChanged
from server.schemas import Experiment, Overlay
from server.settings import Settings
from server.store import Store
from server.store_values import StoredLabel
from server.worker import CommandFailed, Worker, WorkerDied, WorkerError

log = logging.getLogger(__name__)

QUICK = 10.0
"""Seconds for commands that are answered within milliseconds on a machine that is well, where no deadline is shorter.

A learner looks at them between any two gradient steps, so they wait for one at most.
"""
DEATHS, DEATH_WINDOW = 3, 60.0
"""More deaths of one worker than this within so many seconds, and the experiment has failed."""


class TooManyDeaths(WorkerError):
    """A worker that dies again and again: restarting it is of no use."""


OnFrame = Callable[[FrameHeader, bytes], None]
OnChange = Callable[[WorkerChanged], None]
Role = Literal["robot", "learner"]


class Crew:
    """Robot and learner of one experiment. Every method raises WorkerDied if its worker is or goes away."""

    def __init__(
        self, experiment: Experiment, store: Store, settings: Settings, *, on_frame: OnFrame, on_change: OnChange
    ) -> None:
        self._experiment = experiment
        self._store = store
        self._settings = settings
        self._on_frame = on_frame
        self._on_change = on_change
        self._workers: dict[Role, Worker] = {}
        self._ready: set[Role] = set()
        self._deaths: dict[Role, list[float]] = {"robot": [], "learner": []}
        self._started: set[Role] = set()
        self.stops = 1 if experiment.halted else 0
        """Number of the newest stop."""
        self._lifted = 0
        self._missed: list[StoredLabel] = []
        self._forgotten: list[int] = []
        self._told: set[asyncio.Task[None]] = set()
        self.metrics: dict[str, float] = {}
        """What the learner's newest gradient step reported."""
        self.policy_version = 0
        """Gradient steps that the learner has reported."""

    # --- life ---------------------------------------------------------------------------------------------------

    @property
    def pids(self) -> dict[str, int]:
        """Process ids of the living workers, by role."""
        return {role: worker.pid for role, worker in self._workers.items() if worker.alive}

    async def bring_up(self) -> None:
        """Start whichever worker isn't there, both at once.

        Raises:
            WorkerDied: one died while it started.
            CommandFailed: one can't do its work on this machine or with these settings.
        """
        roles: tuple[Role, Role] = ("robot", "learner")
        missing = [role for role in roles if role not in self._ready or not self._workers[role].alive]
        results = await asyncio.gather(*(self._bring_up(role) for role in missing), return_exceptions=True)
        for result in results:
            if result is not None:
                raise result

    @property
    def learner_ready(self) -> bool:
        """Whether the learner worker is up and has caught up."""
        return "learner" in self._ready and self._workers["learner"].alive

    async def bury(self, death: WorkerDied) -> None:
        """Note a death: tell it, store it in the journal, and clear the place for the next one."""
        role: Role = "robot" if death.worker == "robot" else "learner"
        self._ready.discard(role)
        now = time.monotonic()
        self._deaths[role] = [t for t in self._deaths[role] if now - t < DEATH_WINDOW] + [now]
        log.warning("experiment %d: %s", self._experiment.id, death)
        self._on_change(WorkerChanged(worker=role, status="died", detail=str(death)))
        await self._store.add_event(self._experiment.id, "worker_died", {"worker": role, "detail": str(death)})
        if worker := self._workers.pop(role, None):
            await worker.close(grace=0)
        if len(self._deaths[role]) > DEATHS:
            raise TooManyDeaths(
                f"the {role} worker died {len(self._deaths[role])} times within {DEATH_WINDOW:g} s; last: {death}",
                remedy="see the server's log for its last words; mend the cause, then resume",
            )

    async def death(self, role: Role) -> WorkerDied:
        """Wait for this worker to die."""
        return await self._workers[role].death()

    async def close(self) -> None:
        """End both workers."""
        workers, self._workers = list(self._workers.values()), {}
        self._ready.clear()
        await asyncio.gather(*(worker.close() for worker in workers))

    async def _retire(self, role: Role) -> None:
        """End a worker whose state can't be trusted any more; the next `bring_up` starts a new one."""
        self._ready.discard(role)
        if worker := self._workers.pop(role, None):
            await worker.close()

    async def distrust(self, error: Exception) -> None:
        """End a learner that has refused to go on: the next one starts from the checkpoint and the stored labels."""
        if isinstance(error, CommandFailed) and error.worker == "learner":
            await self._retire("learner")

    def forgive(self) -> None:
        """Forget earlier deaths: someone has looked at the failure and resumes."""
        self._deaths = {"robot": [], "learner": []}

    # --- robot --------------------------------------------------------------------------------------------------

    @property
    def halted(self) -> bool:
        """Whether a stop is latched."""
        return self.stops > self._lifted

    def stop(self) -> None:
        """Stop the robot at once; latched, also for a robot worker that starts only now."""
        self.stops += 1
        if robot := self._workers.get("robot"):
            robot.stop(self.stops)

    async def rearm(self, upto: int) -> None:
        """Lift the stops up to number `upto`."""
        self._lifted = max(self._lifted, upto)
        robot = self._workers.get("robot")
        if robot is not None and robot.alive:
            await robot.call("rearm", deadline=self._settings.robot_deadline, upto=upto)

    def kill_robot(self) -> None:
        """End the robot worker at once: it did not stop when it was told to."""
        if robot := self._workers.get("robot"):
            robot.kill()

    async def reset(self, seed: int) -> Seen:
        """Start an episode."""
        return _seen(await self._robot("reset", seed=seed))

    async def observe(self) -> Seen:
        """Look, without moving."""
        return _seen(await self._robot("observe", QUICK))

    async def overlay(self, call: SkillCall) -> dict[str, Overlay]:
        """The call drawn for every camera of the newest observation."""
        reply = await self._robot("overlay", QUICK, skill=call.skill, parameters=list(call.parameters))
        return {camera: Overlay(**drawn) for camera, drawn in reply["overlays"].items()}

    async def execute(self, proposal_id: int, execution_id: int, digest: str, call: SkillCall) -> Done:
        """Run an approved call. `digest` is what was approved; the robot worker compares it with the call."""
        reply = await self._robot(
            "execute",
            proposal_id=proposal_id,
            execution_id=execution_id,
            digest=digest,
            skill=call.skill,
            parameters=list(call.parameters),
        )
        violations = tuple((v["kind"], v["detail"]) for v in reply["violations"])
        fields = ("end", "arrived", "stopped", "low_level_steps", "task_success")
        times = ("first_set_point_at", "last_set_point_at")
        return Done(**{k: reply[k] for k in (*fields, *times)}, violations=violations)

    # --- learner ------------------------------------------------------------------------------------------------

    def learn(self, label: StoredLabel) -> None:
        """Hand over a label; it is with the learner before any request that is sent later."""
        self._tell_learner("add", self._missed, label, labels=[_wire(label)])

    def forget(self, feedback_id: int) -> None:
        """Take an undone label back."""
        self._tell_learner("forget", self._forgotten, feedback_id, feedback_id=feedback_id)

    async def propose(self, state: tuple[float, ...], *, deterministic: bool = False) -> Idea:
        """Suggest a call for this state."""
        reply = await self._learner("propose", QUICK, state=list(state), deterministic=deterministic)
        call = SkillCall(reply["skill"], tuple(reply["parameters"]))
        told = ("predicted_feedback", "skill_probabilities", "policy_version", "uncertainty")
        return Idea(call, **{name: reply[name] for name in told})

    async def flush(self) -> None:
        """Wait until every owed gradient step is taken."""
        await self._learner("flush")

    async def newest_policy_version(self) -> int:
        """Gradient steps taken, once those owed are taken too; of the newest checkpoint if none learns now."""
        if self.learner_ready:
            with contextlib.suppress(WorkerError):
                await self.flush()
                return self.policy_version
        newest = await self._store.latest_checkpoint(self._experiment.id)
        return newest.policy_version if newest is not None else 0

    async def save(self) -> Saved:
        """Write a checkpoint below the data directory."""
        folder = self._settings.data_dir.resolve() / "checkpoints" / str(self._experiment.id)
        status = await self._learner("save", path=str(folder / "next.ckpt"))
        path = folder / _file_name(status["policy_version"], status["last_label_id"])
        await asyncio.to_thread((folder / "next.ckpt").replace, path)
        return Saved(path, status["policy_version"], status["last_label_id"], status["sha256"])

    # --- inside -------------------------------------------------------------------------------------------------

    async def _bring_up(self, role: Role) -> None:
        again = role in self._started
        self._on_change(WorkerChanged(worker=role, status="starting", detail=f"the {role} worker is starting"))
        if left := self._workers.pop(role, None):  # one whose start failed half-way
            await left.close(grace=0)
        worker = await Worker.spawn(
            role, f"server.workers.{role}", on_frame=self._take_frame if role == "robot" else None
        )
        self._workers[role] = worker
        await (self._build(worker) if role == "robot" else self._catch_up(worker))
        self._ready.add(role)
        self._started.add(role)
        status: Literal["restarted", "ready"] = "restarted" if again else "ready"
        self._on_change(WorkerChanged(worker=role, status=status, detail=f"the {role} worker is ready"))

    async def _build(self, robot: Worker) -> None:
        if self.halted:
            robot.stop(self.stops)
        elif self._lifted:
            await robot.call("rearm", deadline=self._settings.robot_deadline, upto=self._lifted)
        experiment = self._experiment
        await robot.call(
            "build",
            deadline=self._settings.robot_deadline,
            adapter=experiment.adapter,
            task=experiment.task,
            settings=experiment.adapter_settings,
            data_dir=str(self._settings.data_dir.resolve()),
        )

    async def _catch_up(self, learner: Worker) -> None:
        experiment, deadline = self._experiment, self._settings.learner_deadline
        self._missed.clear()
        self._forgotten.clear()
        await learner.call(
            "configure",
            deadline=deadline,
            task=experiment.task,
            algorithm=experiment.algorithm,
            settings=experiment.settings,
            seed=experiment.seed,
            lockstep=experiment.lockstep,
            threads=self._settings.learner_threads,
        )
        await self._load_newest(learner)
        labels = await self._store.labels(experiment.id)
        restored = await learner.call("restore", deadline=deadline, labels=[_wire(label) for label in labels])
        self.policy_version = restored["policy_version"]
        # what came while this went on; the learner knows an id that it has seen
        while self._missed or self._forgotten:
            missed, self._missed = self._missed, []
            forgotten, self._forgotten = self._forgotten, []
            await learner.call("add", deadline=deadline, labels=[_wire(label) for label in missed])
            for feedback_id in forgotten:
                await learner.call("forget", deadline=deadline, feedback_id=feedback_id)

    async def _load_newest(self, learner: Worker) -> None:
        """Load the newest checkpoint; without a sound one the labels alone rebuild the learner."""
        newest = await self._store.latest_checkpoint(self._experiment.id)
        if newest is None:
            return
        name = _file_name(newest.policy_version, newest.last_feedback_id)
        path = self._settings.data_dir.resolve() / "checkpoints" / str(self._experiment.id) / name
        try:
            await learner.call("load", deadline=self._settings.learner_deadline, path=str(path))
        except CommandFailed as error:
            log.warning("experiment %d learns anew from its labels: %s", self._experiment.id, error)
            payload = {"checkpoint": newest.id, "detail": str(error)}
            await self._store.add_event(self._experiment.id, "checkpoint_unusable", payload)

    def _tell_learner(self, command: str, missed: list[Any], what: Any, **arguments: Any) -> None:
        learner = self._workers.get("learner")
        if "learner" not in self._ready or learner is None or not learner.alive:
            missed.append(what)
            return
        deadline = min(QUICK, self._settings.learner_deadline)
        reply = learner.call(command, deadline=deadline, **arguments)  # it is sent by now, before anything else

        async def hear() -> None:
            try:
                await reply
            except WorkerDied:
                pass  # whoever waits for the experiment's next step hears of it; the label is stored
            except CommandFailed as error:
                log.warning("experiment %d: the learner refused to %s: %s", self._experiment.id, command, error)

        told = asyncio.create_task(hear(), name=f"tell the learner of experiment {self._experiment.id}")
        self._told.add(told)
        told.add_done_callback(self._told.discard)

    async def _robot(self, command: str, most: float = math.inf, **arguments: Any) -> dict[str, Any]:
        deadline = min(most, self._settings.robot_deadline)
        return await self._worker("robot").call(command, deadline=deadline, **arguments)

    async def _learner(self, command: str, most: float = math.inf, **arguments: Any) -> dict[str, Any]:
        deadline = min(most, self._settings.learner_deadline)
        status = await self._worker("learner").call(command, deadline=deadline, **arguments)
        self.metrics, self.policy_version = status["metrics"], status["policy_version"]
        return status

    def _worker(self, role: Role) -> Worker:
        worker = self._workers.get(role)
        if worker is None:
            raise WorkerDied(role, f"the {role} worker is not there")
        return worker

    def _take_frame(self, header: bytes, jpeg: bytes) -> None:
        self._on_frame(FrameHeader.model_validate_json(header), jpeg)


def _seen(reply: dict[str, Any]) -> Seen:
    pictures = tuple(Picture(**view) for view in reply["views"])
    return Seen(reply["id"], tuple(reply["state"]), reply["taken_at"], pictures, reply["success"])


def _wire(label: StoredLabel) -> dict[str, Any]:
    return {
        "id": label.feedback_id,
        "state": list(label.state),
        "skill": label.skill,
        "parameters": list(label.parameters),
        "value": label.value,
    }


def _file_name(policy_version: int, last_feedback_id: int) -> str:
    return f"{policy_version:08d}-{last_feedback_id:08d}.ckpt"
