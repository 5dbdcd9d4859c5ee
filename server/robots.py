"""The robots of one experiment, as their worker processes run them, and the emergency stops that all of them heed."""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from robot_adapters.base import SkillCall
from server.crew_values import Done, Picture, Seen
from server.messages import FrameHeader, RobotTold
from server.post import QUICK, OnChange, Post
from server.schemas import Experiment, Proposal
from server.schemas_telemetry import Telemetry
from server.schemas_views import Overlay
from server.settings import Settings
from server.worker import Worker, WorkerDied

UNCLEAR = {"SceneUnclear", "SceneChanged"}
"""What the worker calls it where it can't see what it has to: people put that right, and nothing has failed."""
KEEP_ALIVE = 0.1
"""Seconds between two words to a real robot's worker that an operator attends it."""

OnTold = Callable[[RobotTold], None]
OnFrame = Callable[[FrameHeader, bytes], None]


@dataclass
class Stops:
    """The emergency stops of one experiment, numbered from 1: which was the newest, and up to which they are lifted."""

    newest: int = 0
    lifted: int = 0

    @property
    def latched(self) -> bool:
        """Whether nothing may move."""
        return self.newest > self.lifted


class Robot:
    """One robot. Its commands raise WorkerDied if its worker is or goes away."""

    def __init__(
        self,
        index: int,
        experiment: Experiment,
        settings: Settings,
        stops: Stops,
        *,
        on_frame: OnFrame | None,
        on_change: OnChange,
        on_told: OnTold,
        attended: Callable[[], bool] | None = None,
    ) -> None:
        """Have a place for its worker. attended: whether an operator is at a real robot; None for a simulated one."""
        self.index = index
        self._experiment = experiment
        self._settings = settings
        self._stops = stops
        self._show = on_frame
        self._told = on_told
        self._attended = attended
        self.telemetry: Telemetry | None = None
        """What it told of itself last."""
        self.post = Post(
            "robot",
            self._build,
            on_change,
            name="robot" if experiment.num_envs == 1 else f"robot {index + 1}",
            robot=index,
            on_frame=self._take_frame,
        )

    @property
    def unclear(self) -> str:
        """Why it can't see that the scene is as its newest picture shows it; empty where it can, or doesn't look."""
        told = self.telemetry
        return "" if told is None or told.scene in {None, "clear"} else told.scene_detail

    @property
    def outdated(self) -> bool:
        """Whether something is elsewhere by now than on its newest picture."""
        return self.telemetry is not None and self.telemetry.scene == "changed"

    async def reset(self, seed: int) -> Seen:
        """Start an episode."""
        return self._seen(await self._ask("reset", seed=seed))

    async def observe(self) -> Seen:
        """Look, without moving."""
        return self._seen(await self._ask("observe", QUICK))

    async def overlay(self, call: SkillCall) -> dict[str, Overlay]:
        """The call drawn for every camera of the newest observation."""
        reply = await self._ask("overlay", QUICK, skill=call.skill, parameters=list(call.parameters))
        return {camera: Overlay(**drawn) for camera, drawn in reply["overlays"].items()}

    async def execute(self, proposal: Proposal, execution_id: int, call: SkillCall) -> Done:
        """Run an approved call. The worker compares it with the robot and the digest that were approved."""
        reply = await self._ask(
            "execute",
            robot=proposal.robot,
            proposal_id=proposal.id,
            execution_id=execution_id,
            digest=proposal.digest,
            skill=call.skill,
            parameters=list(call.parameters),
            video=self._show is not None,
        )
        self._hear(reply)
        violations = tuple((v["kind"], v["detail"]) for v in reply["violations"])
        fields = ("end", "arrived", "stopped", "low_level_steps", "task_success")
        times = ("first_set_point_at", "last_set_point_at")
        return Done(**{k: reply[k] for k in (*fields, *times)}, violations=violations)

    async def rearm(self) -> None:
        """Lift the stops that are lifted here too; a worker that is still being built is told at the end of that."""
        if self.post.ready:
            with contextlib.suppress(WorkerDied):
                await self._ask("rearm", upto=self._stops.lifted)

    async def home(self) -> bool:
        """Bring a real arm out of the way; whether it arrived."""
        reply = await self._ask("home")
        self._hear(reply)
        return bool(reply["arrived"])

    async def recover(self) -> None:
        """Clear a real arm's reflex."""
        self._hear(await self._ask("recover", QUICK))

    async def guide(self, step: str, **arguments: Any) -> dict[str, Any]:
        """One step of a calibration of its cameras, as the worker names them."""
        return await self._ask(step, **arguments)

    async def _build(self, worker: Worker) -> None:
        deadline, experiment = self._settings.robot_deadline, self._experiment
        if self._stops.latched:
            worker.stop(self._stops.newest)
        await worker.call(
            "build",
            deadline=deadline,
            robot=self.index,
            adapter=experiment.adapter,
            task=experiment.task,
            settings=experiment.adapter_settings,
            data_dir=str(self._settings.data_dir.resolve()),
            attended=None if self._attended is None else self._settings.operator_silence,
        )
        told = 0
        while told < self._stops.lifted:  # also by a re-arm that came meanwhile, and didn't wait for this
            told = self._stops.lifted
            await worker.call("rearm", deadline=deadline, upto=told)

    async def _ask(self, command: str, most: float = math.inf, **arguments: Any) -> dict[str, Any]:
        deadline = min(most, self._settings.robot_deadline)
        self._tell_whether_attended()  # before the command: what it said last may no longer be so
        keeping = asyncio.create_task(self._keep_alive(), name=f"attend {self.post.name}") if self._attended else None
        try:
            return await self.post.worker.call(command, deadline=deadline, **arguments)
        finally:
            if keeping is not None:
                keeping.cancel()

    async def _keep_alive(self) -> None:
        """Say whether the robot is attended, again and again: silence means that it isn't, but takes its time."""
        while self._attended is not None:
            self._tell_whether_attended()
            await asyncio.sleep(KEEP_ALIVE)

    def _tell_whether_attended(self) -> None:
        if self._attended is not None:
            (self.post.keep_alive if self._attended() else self.post.forsake)()

    def _take_frame(self, header: bytes, jpeg: bytes) -> None:
        if not jpeg:
            self._hear(json.loads(header))
        elif self._show is not None:
            # which channel it came by says whose it is
            told = FrameHeader.model_validate_json(header)
            self.telemetry = told.telemetry or self.telemetry
            self._show(told.model_copy(update={"robot": self.index}), jpeg)

    def _seen(self, reply: dict[str, Any]) -> Seen:
        self._hear(reply)
        pictures = tuple(Picture(**view) for view in reply["views"])
        return Seen(reply["id"], tuple(reply["state"]), reply["taken_at"], pictures, reply["success"])

    def _hear(self, reply: dict[str, Any]) -> None:
        if reply.get("telemetry") is not None:
            self.telemetry = Telemetry.model_validate(reply["telemetry"])
            self._told(RobotTold(robot=self.index, telemetry=self.telemetry))
