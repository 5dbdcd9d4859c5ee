"""The learner worker: proposes skill calls and trains from labels, also while nobody asks it anything.

Between requests it works off the gradient steps that the labels owe, and looks for a request between any two of them:
the time a person thinks trains the network, and a request waits for one step at most. A proposal that is asked for
within a long step is made at once, where the algorithm pauses for it.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import os
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import numpy as np

from agent.affordance import near
from agent.algorithm import (
    AgentError,
    Algorithm,
    AlgorithmFactory,
    Considering,
    DeviceName,
    Estimating,
    Label,
    Pausing,
    Problem,
    Recollecting,
    Suggestion,
)
from agent.batching import propose_batch
from robot_adapters import registry
from robot_adapters.base import InvalidCall, SkillCall, check_call
from robot_adapters.tasks.base import Task, entry_names, position_fields, state_bounds
from server.workers.channel import Pipes, Refusal, answer, open_pipes

log = logging.getLogger(__name__)


class Diverged(Refusal):
    """Training isn't sound any more: nothing that this process learned is used from here on."""

    def __init__(self, cause: AgentError) -> None:
        remedy = (
            "Resume: it learns anew from the last checkpoint; if it fails again, create a new experiment"
            " with a lower learning_rate"
        )
        super().__init__(str(cause), remedy=remedy)


class NoEstimates(Refusal):
    """The algorithm has no critic that could be asked."""

    def __init__(self, message: str) -> None:
        super().__init__(message, remedy="look at an experiment whose algorithm can, such as seed")


class Learner:
    """The commands, one method each."""

    def __init__(self) -> None:
        self._algorithm: Algorithm | None = None
        self._task: Task
        self._metrics: dict[str, float] = {}
        self._fault: Diverged | None = None
        self._arriving: list[Label] = []
        """Parts of what `restore` will take."""
        self._lockstep = False
        self.meanwhile: Callable[[], None] = lambda: None
        """Called within long gradient steps."""
        self._starved = False
        """The last update had nothing to learn from: no more before something new comes."""

    @property
    def algorithm(self) -> Algorithm:
        """The configured algorithm, as long as its training is sound."""
        if self._fault is not None:
            raise self._fault
        if self._algorithm is None:
            raise Refusal("the learner isn't configured yet", remedy="send `configure` first")
        return self._algorithm

    @property
    def busy(self) -> bool:
        """Whether gradient steps are owed."""
        return self._able and self.algorithm.owed_updates > 0

    @property
    def eager(self) -> bool:
        """Whether steps may be taken now: owed ones, or, where nothing must be repeatable, spare ones."""
        return self.busy or (self._able and not self._lockstep and self.algorithm.spare_updates > 0)

    @property
    def _able(self) -> bool:
        return self._algorithm is not None and self._fault is None and not self._starved

    def configure(
        self,
        *,
        task: str,
        algorithm: str,
        settings: dict[str, Any],
        seed: int,
        lockstep: bool,
        threads: int,
        device: DeviceName,
    ) -> dict[str, Any]:
        """Build the algorithm. `settings` are complete: the preset has been merged in."""
        import torch  # noqa: PLC0415 - here, so that this module can be imported without it

        from agent.device import place  # noqa: PLC0415 - as above

        torch.set_num_threads(threads)
        factory = _factory(algorithm)
        self._task = registry.task(task)
        self._lockstep = lockstep
        built = factory(_problem(self._task), factory.settings.model_validate(settings), seed)
        place(built, device)
        self._algorithm = built
        if isinstance(self._algorithm, Pausing) and not lockstep:
            self._algorithm.pause = self.meanwhile
        return {"recollects": isinstance(built, Recollecting)} | self._status()

    def propose(self, *, state: list[float], deterministic: bool) -> dict[str, Any]:
        """Suggest a call."""
        suggestion = self.algorithm.propose(np.array(state, dtype=np.float64), deterministic=deterministic)
        return _wire(suggestion) | self._status()

    def propose_batch(self, *, state: list[float], count: int, pending: list[dict[str, Any]]) -> dict[str, Any]:
        """Suggest at most so many different calls, none of them like one that is pending (see `agent.batching`)."""
        waiting = [SkillCall(call["skill"], tuple(call["parameters"])) for call in pending]
        seen = np.array(state, dtype=np.float64)
        found = propose_batch(self.algorithm, self._task.skills, seen, count, waiting)
        return {"suggestions": [_wire(suggestion) for suggestion in found]} | self._status()

    def estimate(self, *, state: list[float], skill: str, calls: list[list[float]]) -> dict[str, Any]:
        """What the critic expects to be said of these calls, each given by its parameters."""
        algorithm = self.algorithm
        if not isinstance(algorithm, Estimating):
            raise NoEstimates("this algorithm can't be asked about calls that it doesn't propose")
        asked = [SkillCall(skill, tuple(parameters)) for parameters in calls]
        values = algorithm.estimate(np.array(state, dtype=np.float64), asked)
        return {"values": [float(value) for value in values]} | self._status()

    def consider(self, *, state: list[float]) -> dict[str, Any]:
        """What it would do with each skill, and what the critic expects to be said of that."""
        algorithm = self.algorithm
        if not isinstance(algorithm, Considering):
            raise NoEstimates("this algorithm can't be asked about calls that it doesn't propose")
        seen = np.array(state, dtype=np.float64)
        calls = algorithm.consider(seen)
        values = algorithm.estimate(seen, calls)
        told = [
            {"skill": call.skill, "parameters": list(call.parameters), "predicted_feedback": float(value)}
            for call, value in zip(calls, values, strict=True)
        ]
        return {"calls": told} | self._status()

    def add(self, *, labels: list[dict[str, Any]]) -> dict[str, Any]:
        """Take new labels; the steps they owe come later."""
        self.algorithm.add(self._labels(labels))
        return self._status()

    def restore(self, *, labels: list[dict[str, Any]], more: bool = False) -> dict[str, Any]:
        """Fill the replay after a start; labels newer than the checkpoint owe their steps.

        more: another part follows. All parts are taken at the last one; if one is refused, none is.
        """
        arrived, self._arriving = self._arriving, []
        arrived += [_label(self._task, stored) for stored in labels]
        if more:
            self._arriving = arrived
        else:
            self._starved = False
            self.algorithm.restore(arrived)
        return self._status()

    def recollect(self, *, labels: list[dict[str, Any]]) -> dict[str, Any]:
        """After `restore`, take older labels; only algorithms that said so at `configure` can."""
        algorithm = self.algorithm
        if not isinstance(algorithm, Recollecting):
            raise Refusal("this algorithm takes all labels at once", remedy="send them by `restore`")
        algorithm.recollect(self._labels(labels))
        return self._status()

    def forget(self, *, feedback_id: int) -> dict[str, Any]:
        """Take an undone label back."""
        self.algorithm.forget(feedback_id)
        return self._status()

    def relabel(self, *, label: dict[str, Any]) -> dict[str, Any]:
        """Hold a corrected label in the place of the one of the same id."""
        (corrected,) = self._labels([label])
        self.algorithm.relabel(corrected)
        return self._status()

    def flush(self) -> dict[str, Any]:
        """Answered once no gradient step is owed (`serve` holds the reply back until then)."""
        return self._status()

    def save(self, *, path: str) -> dict[str, Any]:
        """Write a checkpoint atomically."""
        target = Path(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.algorithm.save(target)
        return {"sha256": hashlib.sha256(target.read_bytes()).hexdigest()} | self._status()

    def load(self, *, path: str) -> dict[str, Any]:
        """Read a checkpoint. `restore` follows: until then there are steps owed and no labels to take them from."""
        self.algorithm.load(Path(path))
        self._starved = True
        return self._status()

    def step(self) -> None:
        """One gradient step. If training is no longer sound, it ends, and every later request is told why."""
        try:
            metrics = self.algorithm.update()
        except AgentError as error:
            self._fault = Diverged(error)
        else:
            self._starved = metrics is None
            self._metrics = {k: float(v) for k, v in (metrics or {}).items()}

    def _labels(self, labels: Sequence[Mapping[str, Any]]) -> list[Label]:
        self._starved = False
        return [_label(self._task, stored) for stored in labels]

    def _status(self) -> dict[str, Any]:
        return {
            "policy_version": self.algorithm.policy_version,
            "last_label_id": self.algorithm.last_label_id,
            "owed_updates": self.algorithm.owed_updates,
            "metrics": self._metrics,
        }


def serve(pipes: Pipes) -> None:
    """Answer requests until the server is gone; take gradient steps in between."""
    learner = Learner()
    answering = ("configure", "propose", "propose_batch", "estimate", "consider", "flush", "save", "load")
    names = (*answering, "add", "restore", "recollect", "forget", "relabel")
    handlers = {name: getattr(learner, name) for name in names}
    commands = pipes.commands
    flushes: list[Mapping[str, Any]] = []
    early: list[Mapping[str, Any] | None] = []
    """Met within a gradient step, and no proposal: it waits for the step's end, and what comes after it waits too."""

    def receive() -> Mapping[str, Any] | None:
        message = commands.receive()
        return None if message is None else json.loads(message)

    def reply(request: Mapping[str, Any]) -> None:
        commands.send(json.dumps(answer(request, handlers)).encode())

    def propose_meanwhile() -> None:
        while not early and commands.poll(0):
            request = receive()
            if request is not None and request["command"] in ("propose", "propose_batch"):
                reply(request)
            else:
                early.append(request)

    learner.meanwhile = propose_meanwhile
    with contextlib.suppress(BrokenPipeError, ConnectionResetError):
        while True:
            if learner.eager and not early and not commands.poll(0):
                learner.step()
                if not learner.busy:
                    for request in flushes:
                        reply(request)
                    flushes.clear()
                continue
            received = early.pop() if early else receive()
            if received is None:
                return
            if received["command"] == "flush" and learner.busy:
                flushes.append(received)
            else:
                reply(received)


def _wire(suggestion: Suggestion) -> dict[str, Any]:
    s = suggestion
    return {
        "skill": s.call.skill,
        "parameters": [float(p) for p in s.call.parameters],
        "predicted_feedback": float(s.predicted_feedback),
        "uncertainty": None if s.uncertainty is None else float(s.uncertainty),
        "skill_probabilities": {k: float(v) for k, v in s.skill_probabilities.items()},
    }


def _label(task: Task, stored: Mapping[str, Any]) -> Label:
    """Stored feedback, as long as it is about the task as it is today."""
    state = np.array(stored["state"], dtype=np.float64)
    call = SkillCall(stored["skill"], tuple(stored["parameters"]))
    size = sum(field.size for field in task.state_fields)
    misfit = None if state.shape == (size,) else f"its state has {state.size} numbers, the task's has {size}"
    try:
        check_call(call, task.skills)
    except InvalidCall as error:
        misfit = str(error)
    if misfit is not None:
        raise Refusal(
            f"feedback {stored['id']} doesn't fit the task {task.name!r}: {misfit}",
            remedy="the task was changed after this feedback was given: put it back as it was and resume, or create a"
            " new experiment",
        )
    return Label(stored["id"], state, call, stored["value"], near(task, state, call), stored["trainer"])


def _problem(task: Task) -> Problem:
    low, high = state_bounds(task.state_fields)
    return Problem(
        task.name,
        low,
        high,
        task.skills,
        state_names=entry_names(task.state_fields),
        keypoints=task.keypoints,
        position_fields=position_fields(task.state_fields),
    )


def _factory(name: str) -> AlgorithmFactory:
    for entry in entry_points(group="seed.algorithms"):
        if entry.name == name:
            factory: AlgorithmFactory = entry.load()
            return factory
    raise Refusal(f"unknown algorithm {name!r}", remedy="install the package that brings it")


def main() -> None:
    """Entry point of the process."""
    # the server must stay quick on a machine with few cores; learning can wait a little
    os.nice(15)
    serve(open_pipes("learner"))
    os._exit(0)


if __name__ == "__main__":
    main()
