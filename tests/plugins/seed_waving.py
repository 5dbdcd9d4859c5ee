"""A task with nothing to choose: its one skill takes no parameters, and nothing ever solves it."""

from __future__ import annotations

import numpy as np

from robot_adapters.base import Array, Scene, SkillCall, SkillSpec
from robot_adapters.tasks.base import Subgoal
from robot_adapters.tasks.reaching import Reaching


class Waving(Reaching):
    """Scene, state and starts of Reaching."""

    name = "waving"
    title = "Waving"
    instruction = "Open the gripper."
    skills = (SkillSpec("release", (), "Open the gripper."),)  # type: ignore[assignment]  # Reaching has two
    subgoals = (Subgoal("open", instruction),)

    def success(self, scene: Scene) -> bool:
        """Never."""
        return False

    def judge(self, state: Array, call: SkillCall) -> int:
        """+1, whatever it is."""
        return 1

    def margin(self, state: Array, call: SkillCall) -> float:
        """There is no edge."""
        return np.inf

    def true_call(self, state: Array) -> SkillCall:
        """The only one."""
        return SkillCall("release", ())

    def sample_good(self, state: Array, rng: np.random.Generator) -> SkillCall:
        """The only one."""
        return self.true_call(state)
