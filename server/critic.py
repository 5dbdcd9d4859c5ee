"""Asks a critic what it expects all over the table: the learner as it is, or one that is read from its checkpoint.

A learner is asked between two of its gradient steps and isn't changed by it. Where none lives (after a restart, or of a
finished experiment) a process of its own loads the newest checkpoint, answers, and ends once nobody has asked for a
while. It never trains and never proposes.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from robot_adapters import registry
from robot_adapters.base import SkillCall, SkillSpec
from robot_adapters.tasks.base import Task
from server import store_critic
from server.errors import invalid
from server.hub import Hub
from server.learning import checkpoint_path, configuration
from server.schemas import Experiment, Proposal
from server.schemas_critic import Considered, ConsideredList, CriticMap
from server.schemas_problems import FieldProblem
from server.schemas_views import Overlay
from server.settings import Settings
from server.store import Conflict, Store
from server.worker import CommandFailed, Worker, WorkerDied, WorkerError

LINGER = 60.0
"""Seconds that a process which nobody asks stays: loading torch and a checkpoint takes some."""
MOST = 2
"""Such processes at once: each holds a copy of torch."""


class Critics:
    """Those of all experiments. Used from one event loop."""

    def __init__(self, store: Store, settings: Settings, hub: Hub) -> None:
        self._store = store
        self._settings = settings
        self._hub = hub
        self._readers: dict[int, tuple[int, Worker]] = {}
        self._ends: dict[int, asyncio.TimerHandle] = {}
        self._turns: defaultdict[int, asyncio.Lock] = defaultdict(asyncio.Lock)
        self._closing: set[asyncio.Task[None]] = set()

    async def look(self, proposal_id: int, skill: str | None, points: int, others: Mapping[str, float]) -> CriticMap:
        """The map of a skill, or of the proposal's own, in the situation of this proposal.

        points: along the longer side. others: parameters beside x and y; those left out are the proposal's where it is
        of this skill, else those of the newest good call of it, else in the middle of their bounds.

        Raises:
            NotFound: no such proposal. ServiceError: 422, the skill or a parameter isn't one of the task's.
            Conflict: nothing was learned yet, or the algorithm has no critic to ask.
        """
        proposal = await self._store.proposal(proposal_id)
        experiment = await self._store.experiment(proposal.experiment_id)
        task = registry.task(experiment.task)
        spec = _spec(task, skill or proposal.skill)
        held = await self._held(proposal, spec, others)
        x, y = _axes(spec, points)
        names = [p.name for p in spec.parameters]
        calls = [[{**held, "x": at, "y": up}[name] for name in names] for up in y for at in x]
        told, source = await self._ask(experiment, "estimate", state=proposal.state, skill=spec.name, calls=calls)
        labels = await self._store.read(lambda s: store_critic.nearby(s, proposal_id, spec.name))
        keypoints = np.asarray(task.keypoints(np.array(proposal.state), spec.name), dtype=float).reshape(-1, 3)
        return CriticMap(
            experiment_id=experiment.id,
            proposal_id=proposal_id,
            skill=spec.name,
            x=x,
            y=y,
            values=np.round(np.array(told["values"]).reshape(len(y), len(x)), 4).tolist(),
            others=held,
            labels=labels,
            keypoints=[(float(a), float(b), float(c)) for a, b, c in keypoints],
            policy_version=told["policy_version"],
            source="learner" if source else "checkpoint",
        )

    async def consider(self, proposal_id: int) -> ConsideredList:
        """What the agent would do with each skill in the situation of this proposal; the proposal itself as it is.

        Raises:
            NotFound: no such proposal. Conflict: nothing was learned yet, or the algorithm can't be asked.
        """
        proposal = await self._store.proposal(proposal_id)
        experiment = await self._store.experiment(proposal.experiment_id)
        told, _ = await self._ask(experiment, "consider", state=proposal.state)
        names = {spec.name: [p.name for p in spec.parameters] for spec in registry.task(experiment.task).skills}
        items = []
        for each in told["calls"]:
            skill, parameters = each["skill"], each["parameters"]
            own = skill == proposal.skill
            drawn: Mapping[str, Overlay] = {view.camera: view.overlay for view in proposal.views} if own else {}
            if not own:
                drawn = await self._drawn(proposal, SkillCall(skill, tuple(parameters)))
            items.append(
                Considered(
                    skill=skill,
                    probability=proposal.skill_probabilities.get(skill, 0.0),
                    parameters=proposal.parameters if own else dict(zip(names[skill], parameters, strict=True)),
                    predicted_feedback=proposal.predicted_feedback if own else each["predicted_feedback"],
                    proposed=own,
                    overlays=dict(drawn),
                )
            )
        items.sort(key=lambda each: -each.probability)
        return ConsideredList(proposal_id=proposal_id, policy_version=told["policy_version"], items=items)

    async def close(self) -> None:
        """End every process."""
        for handle in self._ends.values():
            handle.cancel()
        for experiment_id in list(self._readers):
            self._end(experiment_id)
        if self._closing:
            await asyncio.wait(self._closing)

    async def _drawn(self, proposal: Proposal, call: SkillCall) -> dict[str, Overlay]:
        """Another call on the pictures of an open proposal; nothing where its robot moves or is away."""
        runner = self._hub.at_work(proposal.experiment_id)
        robot = None if runner is None else runner.stations[proposal.robot].resting
        if robot is None or proposal.closed_at is not None:
            return {}
        try:
            drawn = await robot.overlay(call)
        except WorkerError:  # its runner tells of it
            return {}
        # closed meanwhile: something else may stand before the cameras by now
        return drawn if (await self._store.proposal(proposal.id)).closed_at is None else {}

    async def _held(self, proposal: Proposal, spec: SkillSpec, others: Mapping[str, float]) -> dict[str, float]:
        names = {p.name: p for p in spec.parameters if p.name not in ("x", "y")}
        wrong = [
            FieldProblem(field="other", message=f"{spec.name} has no parameter {name!r} to hold")
            for name in others
            if name not in names
        ] + [
            FieldProblem(field="other", message=f"{name} must lie in [{p.low:g}, {p.high:g}]")
            for name, p in names.items()
            if name in others and not p.low <= others[name] <= p.high
        ]
        if wrong:
            raise invalid(wrong, remedy=f"give one of: {', '.join(names)}" if names else "leave it out")
        usual: Mapping[str, float] = proposal.parameters
        if proposal.skill != spec.name:
            usual = await self._store.read(lambda s: store_critic.newest_good(s, proposal.experiment_id, spec.name))
        middle = {name: (p.low + p.high) / 2 for name, p in names.items()}
        return {name: float(others.get(name, usual.get(name, middle[name]))) for name in names}

    async def _ask(self, experiment: Experiment, what: str, **arguments: Any) -> tuple[dict[str, Any], bool]:
        """The reply, and whether it is the living learner's."""
        try:
            runner = self._hub.at_work(experiment.id)
            if runner is not None and (learner := runner.crew.knowing) is not None:
                with contextlib.suppress(WorkerDied):  # then its last checkpoint is the best there is
                    return await learner.call(what, deadline=self._settings.learner_deadline, **arguments), True
            async with self._turns[experiment.id]:
                reader = await self._reader(experiment)
                return await reader.call(what, deadline=self._settings.learner_deadline, **arguments), False
        except CommandFailed as error:
            if error.kind == "NoEstimates":
                raise Conflict(f"{experiment.algorithm}: {error}", remedy=error.remedy) from error
            raise

    async def _reader(self, experiment: Experiment) -> Worker:
        newest = await self._store.latest_checkpoint(experiment.id)
        if newest is None:
            raise Conflict(
                "there is no critic to ask: nothing of this experiment was learned and saved yet",
                remedy="start it, judge a few proposals, and look again",
            )
        known = self._readers.get(experiment.id)
        if known is not None and known[0] == newest.id and known[1].alive:
            self._linger(experiment.id)
            return known[1]
        self._end(experiment.id)
        while len(self._readers) >= MOST:
            self._end(next(iter(self._readers)))
        worker = await Worker.spawn(f"critic of experiment {experiment.id}", "server.workers.learner")
        try:
            deadline = self._settings.learner_deadline
            # in lockstep it takes no spare steps; without labels it takes none at all
            await worker.call(
                "configure", deadline=deadline, **configuration(experiment, self._settings, lockstep=True)
            )
            await worker.call(
                "load", deadline=deadline, path=str(checkpoint_path(self._settings, experiment.id, newest))
            )
        except BaseException:
            await worker.close(grace=0)
            raise
        self._readers[experiment.id] = (newest.id, worker)
        self._linger(experiment.id)
        return worker

    def _linger(self, experiment_id: int) -> None:
        if experiment_id in self._ends:
            self._ends[experiment_id].cancel()
        self._ends[experiment_id] = asyncio.get_running_loop().call_later(LINGER, self._end, experiment_id)

    def _end(self, experiment_id: int) -> None:
        if (handle := self._ends.pop(experiment_id, None)) is not None:
            handle.cancel()
        if (known := self._readers.pop(experiment_id, None)) is not None:
            task = asyncio.create_task(known[1].close(), name=f"end the critic of experiment {experiment_id}")
            self._closing.add(task)
            task.add_done_callback(self._closing.discard)


def _spec(task: Task, skill: str) -> SkillSpec:
    found = next((spec for spec in task.skills if spec.name == skill), None)
    placed = [spec.name for spec in task.skills if {"x", "y"} <= {p.name for p in spec.parameters}]
    if found is None or skill not in placed:
        why = "there is no such skill" if found is None else "it has no place on the table"
        raise invalid([FieldProblem(field="skill", message=why)], remedy=f"use one of: {', '.join(placed)}")
    return found


def _axes(spec: SkillSpec, points: int) -> tuple[list[float], list[float]]:
    """X and y over the skill's bounds, of about square cells."""
    bounds = {p.name: (p.low, p.high) for p in spec.parameters}
    (x0, x1), (y0, y1) = bounds["x"], bounds["y"]
    cell = max(x1 - x0, y1 - y0) / (points - 1) or 1.0
    counts = [max(2, round((high - low) / cell) + 1) for low, high in (bounds["x"], bounds["y"])]
    return _line(x0, x1, counts[0]), _line(y0, y1, counts[1])


def _line(low: float, high: float, count: int) -> list[float]:
    steps: Sequence[float] = np.linspace(low, high, count).tolist()
    return list(steps)
