"""The worker processes of one experiment: its robots, and the learner that they share; mended after a death, ended.

A learner keeps nothing that the store doesn't have: after a start it reads the newest checkpoint and then every stored
label. Labels that arrive while it is away are kept here, so that none falls between the reading and the first request.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from robot_adapters.base import SkillCall
from server.attendance import Attendance
from server.crew_values import Idea, Saved
from server.learning import checkpoint_folder, checkpoint_name, checkpoint_path, configuration
from server.messages import RobotTold
from server.post import DEATH_WINDOW, QUICK, OnChange, Post
from server.recollection import Recollection, wire
from server.robots import OnFrame, OnTold, Robot, Stops
from server.schemas import Experiment
from server.settings import Settings
from server.store import Store
from server.store_values import StoredLabel
from server.worker import CommandFailed, Worker, WorkerDied, WorkerError

log = logging.getLogger(__name__)

DEATHS = 3
"""More deaths of one worker than this within `DEATH_WINDOW` seconds, and the experiment has failed."""


A_STEP = 1.0
"""s that an owed gradient step may last on a busy machine; a few milliseconds on one that is well."""


class TooManyDeaths(WorkerError):
    """A worker that dies again and again: restarting it is of no use."""


class Crew:
    """Robots and learner of one experiment. What asks the learner raises WorkerDied if it is or goes away."""

    def __init__(
        self,
        experiment: Experiment,
        store: Store,
        settings: Settings,
        *,
        on_frame: OnFrame | None,
        on_change: OnChange,
        on_told: OnTold,
        attendance: Attendance | None = None,
    ) -> None:
        """Have a place for each worker. attendance: of a real robot; None for simulated ones."""
        self.attendance = attendance
        self._experiment = experiment
        self._store = store
        self._settings = settings
        self._stops = Stops(newest=1 if experiment.halted else 0)
        self.robots = tuple(
            Robot(
                index,
                experiment,
                settings,
                self._stops,
                on_frame=on_frame,
                on_change=on_change,
                on_told=on_told,
                attended=None if attendance is None else lambda: attendance.present,
            )
            for index in range(experiment.num_envs)
        )
        self.learner = Post("learner", self._catch_up, on_change)
        self._posts = {post.name: post for post in (*(robot.post for robot in self.robots), self.learner)}
        self.recollection = Recollection(experiment, store, settings.learner_deadline)
        self._together: list[StoredLabel] | None = None
        self._missed: list[tuple[str, dict[str, Any]]] = []
        """What the learner is told once it is there, in the order in which it came: a newer correction comes later."""
        self._aside: set[int] = set()
        """Labels that the learner has let go of, and that may come again: an algorithm takes an id only once."""
        self._told: set[asyncio.Task[None]] = set()
        self.metrics: dict[str, float] = {}
        """What the learner's newest gradient step reported."""
        self.policy_version = 0
        """Gradient steps that the learner has reported."""
        self._owed = 0
        """Gradient steps that it owed when it last told."""

    # --- life ---------------------------------------------------------------------------------------------------

    @property
    def pids(self) -> dict[str, int]:
        """Process ids of the living workers, by name."""
        return {name: post.pid for name, post in self._posts.items() if post.pid is not None}

    async def bring_up(self, robots: Iterable[Robot]) -> None:
        """Start whichever of the learner and these robots isn't there, all at once.

        Raises:
            WorkerDied: one died while it started.
            CommandFailed: one can't do its work on this machine or with these settings.
        """
        posts = (*(robot.post for robot in robots), self.learner)
        results = await asyncio.gather(*(post.fill() for post in posts), return_exceptions=True)
        for result in results:
            if result is not None:
                raise result

    async def bury(self, death: WorkerDied) -> None:
        """Note a death, once: tell it, store it in the journal, and clear the place for the next one.

        Raises:
            TooManyDeaths: it wasn't the first one lately.
        """
        post = self._posts[death.worker]
        if not await post.bury(death):
            return
        log.warning("experiment %d: %s", self._experiment.id, death)
        payload = {"worker": post.role, "robot": post.robot, "detail": str(death)}
        await self._store.add_event(self._experiment.id, "worker_died", payload)
        if post.deaths > DEATHS:
            raise TooManyDeaths(
                f"the {post.name} worker died {post.deaths} times within {DEATH_WINDOW:g} s; last: {death}",
                remedy="see the server's log for its last words; mend the cause, then resume",
            )

    async def close(self) -> None:
        """End all workers."""
        await self.recollection.close()
        await asyncio.gather(*(post.clear() for post in self._posts.values()))

    async def distrust(self, error: Exception) -> None:
        """End a learner that has refused to go on: the next one starts from the checkpoint and the stored labels."""
        if isinstance(error, CommandFailed) and error.worker == self.learner.name:
            await self.learner.clear()

    def forgive(self) -> None:
        """Forget earlier deaths: someone has looked at the failure and resumes."""
        for post in self._posts.values():
            post.forgive()

    @property
    def told(self) -> list[RobotTold]:
        """What each robot told of itself last, of those that have."""
        telling = ((robot.index, robot.telemetry) for robot in self.robots)
        return [RobotTold(robot=index, telemetry=told) for index, told in telling if told is not None]

    @property
    def operator_present(self) -> bool:
        """Whether somebody attends a real robot."""
        return self.attendance is not None and self.attendance.present

    # --- emergency stop -----------------------------------------------------------------------------------------

    @property
    def stops(self) -> int:
        """Number of the newest stop."""
        return self._stops.newest

    @property
    def halted(self) -> bool:
        """Whether a stop is latched."""
        return self._stops.latched

    def stop(self) -> None:
        """Stop every robot at once; latched, also for a robot worker that starts only now."""
        self._stops.newest += 1
        for robot in self.robots:
            robot.post.stop(self._stops.newest)

    async def rearm(self, upto: int) -> None:
        """Lift the stops up to number `upto`."""
        self._stops.lifted = max(self._stops.lifted, upto)
        await asyncio.gather(*(robot.rearm() for robot in self.robots))

    # --- learner ------------------------------------------------------------------------------------------------

    def learn(self, labels: Sequence[StoredLabel]) -> None:
        """Hand over labels; they are with the learner before any request that is sent later."""
        if self._together is not None:
            self._together += labels
            return
        again = [label for label in labels if label.feedback_id in self._aside]
        for label in again:  # first: whatever owes gradient steps comes last, and they are taken from all of these
            self._aside.discard(label.feedback_id)
            self._tell_learner("relabel", label=wire(label))
        if new := [label for label in labels if label not in again]:
            self._tell_learner("add", labels=[wire(label) for label in new])

    @contextmanager
    def together(self) -> Iterator[None]:
        """Hand over what is learned inside at its end, at once: no gradient step falls between two of its labels."""
        self._together = []
        try:
            yield
        finally:
            labels, self._together = self._together, None
            self.learn(labels)

    def forget(self, feedback_id: int) -> None:
        """Take an undone label back."""
        self.recollection.forget(feedback_id)
        if self._together is not None:
            self._together = [label for label in self._together if label.feedback_id != feedback_id]
        self._tell_learner("forget", feedback_id=feedback_id)

    def set_aside(self, feedback_ids: Iterable[int]) -> None:
        """Take labels back that come again by `learn` if there is a verdict on their proposal again."""
        waiting = {label.feedback_id for label in self._together or ()}  # the learner hasn't heard of these
        for feedback_id in feedback_ids:
            self.forget(feedback_id)
            if feedback_id not in waiting:
                self._aside.add(feedback_id)

    def relabel(self, feedback_id: int, label: StoredLabel | None) -> None:
        """Have the learner hold this label in the place of the one it has of this feedback; None: none at all."""
        if label is None:
            self.forget(feedback_id)
            return
        if self._together is not None and any(held.feedback_id == feedback_id for held in self._together):
            self._together = [label if held.feedback_id == feedback_id else held for held in self._together]
            return
        self._tell_learner("relabel", label=wire(label))

    async def propose(self, state: tuple[float, ...], *, deterministic: bool = False) -> Idea:
        """Suggest a call for this state."""
        reply = await self._learner("propose", QUICK, state=list(state), deterministic=deterministic)
        return _idea(reply, reply["policy_version"])

    async def propose_batch(self, state: tuple[float, ...], count: int, pending: Sequence[SkillCall]) -> list[Idea]:
        """Suggest at most so many calls, each unlike the others and the pending ones."""
        waiting = [{"skill": call.skill, "parameters": list(call.parameters)} for call in pending]
        reply = await self._learner("propose_batch", QUICK, state=list(state), count=count, pending=waiting)
        return [_idea(suggestion, reply["policy_version"]) for suggestion in reply["suggestions"]]

    @property
    def knowing(self) -> Worker | None:
        """The learner as it is now, to be asked what it knows; None where nobody learns."""
        return self.learner.worker if self.learner.ready else None

    async def flush(self) -> None:
        """Wait until every owed gradient step is taken: a learner that has much to catch up with isn't hung."""
        await self._learner("flush", patience=self._owed * A_STEP)

    async def newest_policy_version(self) -> int:
        """Gradient steps taken, once those owed are taken too; of the newest checkpoint if none learns now."""
        if self.learner.ready:
            with contextlib.suppress(WorkerError):
                await self.flush()
                return self.policy_version
        newest = await self._store.latest_checkpoint(self._experiment.id)
        return newest.policy_version if newest is not None else 0

    async def save(self) -> Saved:
        """Write a checkpoint below the data directory."""
        folder = checkpoint_folder(self._settings, self._experiment.id)
        status = await self._learner("save", path=str(folder / "next.ckpt"))
        path = folder / checkpoint_name(status["policy_version"], status["last_label_id"])
        await asyncio.to_thread((folder / "next.ckpt").replace, path)
        return Saved(path, status["policy_version"], status["last_label_id"], status["sha256"])

    # --- inside -------------------------------------------------------------------------------------------------

    async def _catch_up(self, learner: Worker) -> None:
        experiment, deadline = self._experiment, self._settings.learner_deadline
        self._missed.clear()
        self._aside.clear()
        configured = await learner.call(
            "configure",
            deadline=deadline,
            **configuration(experiment, self._settings, lockstep=experiment.lockstep),
        )
        await self._load_newest(learner)
        newest_first = configured["recollects"] and not experiment.lockstep
        restored = await self.recollection.restore(learner, newest_first=newest_first)
        self.policy_version, self._owed = restored["policy_version"], restored["owed_updates"]
        # what came while this went on; the learner knows an id that it has seen
        while self._missed:
            missed, self._missed = self._missed, []
            for command, arguments in missed:
                await learner.call(command, deadline=deadline, **arguments)

    async def _load_newest(self, learner: Worker) -> None:
        """Load the newest checkpoint; without a sound one the labels alone rebuild the learner."""
        newest = await self._store.latest_checkpoint(self._experiment.id)
        if newest is None:
            return
        path = checkpoint_path(self._settings, self._experiment.id, newest)
        try:
            await learner.call("load", deadline=self._settings.learner_deadline, path=str(path))
        except CommandFailed as error:
            log.warning("experiment %d learns anew from its labels: %s", self._experiment.id, error)
            payload = {"checkpoint": newest.id, "detail": str(error)}
            await self._store.add_event(self._experiment.id, "checkpoint_unusable", payload)

    def _tell_learner(self, command: str, **arguments: Any) -> None:
        if not self.learner.ready:
            self._missed.append((command, arguments))
            return
        deadline = min(QUICK, self._settings.learner_deadline)
        reply = self.learner.worker.call(
            command, deadline=deadline, **arguments
        )  # it is sent by now, before anything else

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

    async def _learner(
        self, command: str, most: float = math.inf, *, patience: float = 0.0, **arguments: Any
    ) -> dict[str, Any]:
        deadline = min(most, self._settings.learner_deadline + patience)
        status = await self.learner.worker.call(command, deadline=deadline, **arguments)
        self.metrics, self.policy_version = status["metrics"], status["policy_version"]
        self._owed = status["owed_updates"]
        return status


def _idea(told: Mapping[str, Any], policy_version: int) -> Idea:
    return Idea(
        SkillCall(told["skill"], tuple(told["parameters"])),
        predicted_feedback=told["predicted_feedback"],
        skill_probabilities=told["skill_probabilities"],
        policy_version=policy_version,
        uncertainty=told["uncertainty"],
    )
