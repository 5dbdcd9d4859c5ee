"""The paper's simplified affordance: whether a call's position is near anything the task is about."""

from __future__ import annotations

import numpy as np

from agent.algorithm import Problem
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import NEAR, Task


def near(about: Problem | Task, state: Array, call: SkillCall) -> bool:
    """Whether the call's position is near a place where its skill acts on the task's objects, in state (n,).

    True for a skill without a position, and where the task names no such place: nothing to be far from.
    """
    spec = next(s for s in about.skills if s.name == call.skill)
    named = call.named(spec)
    if "x" not in named or about.keypoints is None:
        return True
    keypoints = about.keypoints(state, call.skill)
    if not len(keypoints):
        return True
    distances = np.linalg.norm(keypoints[:, :2] - np.array([named["x"], named["y"]]), axis=1)
    return bool(distances.min() <= NEAR)
