"""Small problems and labels that the tests of `agent` share."""

from __future__ import annotations

import numpy as np

from agent.algorithm import Label, Problem
from robot_adapters import registry
from robot_adapters.base import ParameterSpec, SkillCall, SkillSpec
from robot_adapters.tasks.base import position_fields, state_bounds

XYZ = (
    ParameterSpec("x", "m", 0.3, 0.8),
    ParameterSpec("y", "m", -0.25, 0.25),
    ParameterSpec("z", "m", -0.1, 0.1),
)
PICK = SkillSpec("pick", XYZ)
PUSH = SkillSpec("push", (*XYZ, ParameterSpec("direction", "", -1, 1), ParameterSpec("delta", "m", -0.2, 0.2)))
RELEASE = SkillSpec("release")


def problem(*skills: SkillSpec, task: str = "toy", state_size: int = 3) -> Problem:
    """A task whose state entries lie in [0, 2]."""
    names = tuple(f"block_position[{i}]" for i in range(state_size))
    return Problem(task, np.zeros(state_size), np.full(state_size, 2.0), skills or (PICK, PUSH, RELEASE), names)


def labels(count: int, *, seed: int = 0, skills: tuple[SkillSpec, ...] = (PICK, PUSH, RELEASE)) -> list[Label]:
    """Random calls in random states with random values, ids from 1."""
    rng = np.random.default_rng(seed)
    made = []
    for label_id in range(1, count + 1):
        spec = skills[rng.integers(len(skills))]
        call = SkillCall(spec.name, tuple(spec.denormalise(rng.uniform(-1, 1, len(spec.parameters))).tolist()))
        made.append(Label(label_id, rng.uniform(0, 2, 3), call, int(rng.integers(-1, 2)), bool(rng.integers(2))))
    return made


def of_task(name: str) -> Problem:
    """What the learner is told of one of the built-in tasks."""
    task = registry.task(name)
    low, high = state_bounds(task.state_fields)
    fields = position_fields(task.state_fields)
    return Problem(name, low, high, task.skills, keypoints=task.keypoints, position_fields=fields)


def judged(name: str, count: int, *, seed: int = 0) -> list[Label]:
    """Calls in start states of a built-in task as its teacher sees them, every other one a good one."""
    task, rng = registry.task(name), np.random.default_rng(seed)
    robot = registry.adapter("kinematic")(name, registry.adapter("kinematic").settings.model_validate({"draw": False}))
    made = []
    try:
        for label_id in range(1, count + 1):
            state = robot.reset(seed * 1000 + label_id).state
            spec = task.skills[rng.integers(len(task.skills))]
            call = SkillCall(spec.name, tuple(spec.denormalise(rng.uniform(-1, 1, len(spec.parameters))).tolist()))
            call = task.sample_good(state, rng) if label_id % 2 else call
            made.append(Label(label_id, state, call, task.judge(state, call)))
    finally:
        robot.close()
    return made
