"""Why a call is good or bad: the words and figures say what the rule says, on every task."""

from __future__ import annotations

import numpy as np
import pytest

from robot_adapters import registry
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.boxes import Boxed
from robot_adapters.tasks.explaining import explain

TASKS = ("collecting_toy", "cooking_hotdog", "reaching", "stacking", "sweeping")


def staged(name: str, seed: int) -> tuple[Task, Array]:
    """A task, and a state on the way to its end."""
    task = registry.task(name)
    factory = registry.adapter("kinematic")
    adapter = factory(name, factory.settings.model_validate({"draw": False}))
    state = adapter.reset(seed).state
    for _ in range(seed % len(task.subgoals)):
        adapter.execute(task.true_call(state), should_stop=lambda: False, on_step=lambda: None)
        state = adapter.observe().state
    return task, state


@pytest.mark.parametrize("name", TASKS)
def test_the_reason_is_the_rules_own(name: str) -> None:
    random = np.random.default_rng(4)
    for seed in range(12):
        task, state = staged(name, seed)
        calls = [task.true_call(state), task.sample_good(state, random)]
        for spec in task.skills:
            calls += [
                SkillCall(spec.name, tuple(spec.denormalise(random.uniform(-1, 1, len(spec.parameters))).tolist()))
                for _ in range(4)
            ]
        for call in calls:
            reason = explain(task, state, call)
            assert reason.good == (task.judge(state, call) > 0)
            assert reason.text.startswith("Good" if reason.good else "Bad")
            assert reason.text.endswith(".")
            if reason.good or call.skill != reason.right_skill or reason.sideways:
                assert reason.slips == ()
            else:
                beyond = max(abs(slip.off) - slip.limit for slip in reason.slips)
                assert beyond == pytest.approx(-task.margin(state, call), abs=1e-9)
            if reason.good and isinstance(task, Boxed):
                assert reason.closest is not None
                assert abs(reason.closest.off) <= reason.closest.limit + 1e-9


def test_it_is_told_in_millimetres_and_directions() -> None:
    task = registry.task("stacking")
    state = np.array([0.5, 0.0, -0.092, 0.6, 0.1, -0.087])
    aside = explain(task, state, SkillCall("pick", (0.5, 0.042, -0.092))).text
    assert aside == (
        "Bad: what comes next is to pick up the red block, but this is 42 mm too far to the robot's left; at most 15 mm"
        " counts as good."
    )
    both = explain(task, state, SkillCall("pick", (0.48, 0.0, -0.05))).text
    assert "20 mm too near the robot; at most 15 mm counts as good, and 42 mm too high; at most 12 mm" in both
    other = explain(task, state, SkillCall("place", (0.6, 0.1, -0.04))).text
    assert other == "Bad: what comes next is to pick up the red block, which takes a pick and no place."
    good = explain(task, state, SkillCall("pick", (0.504, 0.0, -0.092))).text
    assert good.endswith("It is 4 mm from the ideal place, and up to 15 mm counts as good.")
