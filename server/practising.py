"""Makes practice proposals: scenes of the task on the drawn table, calls that its rule calls good or bad, and why."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from robot_adapters import registry
from robot_adapters.base import Adapter, AdapterError, Array, SkillCall, check_call
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.explaining import Reason, Slip, explain
from server.errors import ServiceError
from server.images import Images
from server.schemas import Experiment
from server.seeds import practice

DRAWN = "kinematic"
"""The adapter that draws practice: it needs no simulator, and takes milliseconds."""
CLEAR = 0.008
"""m: nothing nearer to the border of what is good is asked. Who can't see 8 mm in a picture errs by no fault."""
NEAR_MISS = (0.012, 0.06)
"""m beyond the border: where the errors are that have to be learned to see."""
GOOD, NEAR = 0.45, 0.7
"""Share of good calls; and of near misses among the bad ones, whose others are any bad calls."""
ATTEMPTS = 200


def card(experiment: Experiment, trainer: int, number: int, data_dir: Path) -> dict[str, Any]:
    """A practice proposal as it is stored: what is shown, the answer, and why. Takes some 50 ms; call it on a thread.

    Raises:
        ServiceError: the task can't be drawn.
    """
    random = practice(experiment.seed, trainer, number)
    factory = registry.adapter(DRAWN)
    if experiment.task not in registry.staged(factory):
        raise ServiceError(
            409,
            f"the task {experiment.task!r} can't be drawn for practice",
            remedy="leave practice_required out for this task",
        )
    layout = experiment.adapter_settings.get("layout", {})
    try:
        adapter = factory(experiment.task, factory.settings.model_validate({"layout": layout}))
        return _drawn(registry.task(experiment.task), adapter, random, Images(data_dir))
    except AdapterError as error:
        raise ServiceError(409, f"practice can't be drawn: {error}", remedy=error.remedy) from error


def reason(stored: Mapping[str, Any]) -> Reason:
    """The stored reason as a value, whose words are made anew."""
    slips = tuple(Slip(**slip) for slip in stored["slips"])
    closest = None if stored["closest"] is None else Slip(**stored["closest"])
    return Reason(**{**stored, "slips": slips, "closest": closest})


def _drawn(task: Task, adapter: Adapter, random: np.random.Generator, images: Images) -> dict[str, Any]:
    seen = adapter.reset(int(random.integers(2**31)))
    for _ in range(int(random.integers(len(task.subgoals)))):  # some way into the task
        adapter.execute(task.true_call(seen.state), should_stop=lambda: False, on_step=lambda: None)
        if adapter.success():
            seen = adapter.reset(int(random.integers(2**31)))
            break
        seen = adapter.observe()
    call = _good(task, seen.state, random) if random.random() < GOOD else _bad(task, seen.state, random)
    right = task.true_call(seen.state)
    spec = check_call(call, task.skills)
    overlays, rights = adapter.overlays(call), adapter.overlays(right)
    return {
        "instruction": task.instruction,
        "skill": call.skill,
        "parameters": dict(zip([p.name for p in spec.parameters], map(float, call.parameters), strict=True)),
        "subgoal": task.subgoals[task.subgoal(seen.state)].description,
        "views": [
            {
                "camera": frame.camera,
                "width": frame.width,
                "height": frame.height,
                "image": images.put(frame.jpeg),
                "overlay": dataclasses.asdict(overlays[frame.camera]),
            }
            for frame in seen.frames.values()
        ],
        "right": {camera: dataclasses.asdict(overlay) for camera, overlay in rights.items()},
        "answer": task.judge(seen.state, call),
        "reason": dataclasses.asdict(explain(task, seen.state, call)),
    }


def _good(task: Task, state: Array, random: np.random.Generator) -> SkillCall:
    for _ in range(ATTEMPTS):
        call = task.sample_good(state, random)
        # most rules leave less than twice this room
        if task.judge(state, call) > 0 and task.margin(state, call) >= CLEAR / 4:
            return call
    return task.true_call(state)


def _bad(task: Task, state: Array, random: np.random.Generator) -> SkillCall:
    near = random.random() < NEAR
    for attempt in range(ATTEMPTS):
        call = _missed(task, state, random) if near and attempt < ATTEMPTS // 2 else _any(task, random)
        if task.judge(state, call) < 0 and task.margin(state, call) <= -CLEAR:
            return call
    return _good(task, state, random)


def _missed(task: Task, state: Array, random: np.random.Generator) -> SkillCall:
    """A good call, taken out of what is good along one direction, inside the skill's bounds."""
    ideal = task.true_call(state)
    spec = check_call(ideal, task.skills)
    places = [at for at, p in enumerate(spec.parameters) if p.name in ("x", "y", "z")]
    if not places:
        return _any(task, random)
    at, sign = places[int(random.integers(len(places)))], float(random.choice((-1.0, 1.0)))
    room = abs(task.margin(state, ideal))
    values = np.array(ideal.parameters, dtype=np.float64)
    values[at] += sign * (room + float(random.uniform(*NEAR_MISS)))
    return SkillCall(ideal.skill, tuple(np.clip(values, spec.low, spec.high).tolist()))


def _any(task: Task, random: np.random.Generator) -> SkillCall:
    spec = task.skills[int(random.integers(len(task.skills)))]
    unit = random.uniform(-1.0, 1.0, size=len(spec.parameters))
    return SkillCall(spec.name, tuple(float(v) for v in spec.denormalise(unit)))
