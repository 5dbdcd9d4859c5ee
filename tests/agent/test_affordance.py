"""What counts as near a task-relevant object."""

from __future__ import annotations

import numpy as np

from agent.affordance import near
from robot_adapters import registry
from robot_adapters.base import SkillCall
from robot_adapters.tasks.base import NEAR
from tests.agent.problems import of_task, problem

STATE = np.array([0.5, 0.0, -0.09, 0.7, 0.1, -0.087])


def test_near_is_within_five_centimetres_whatever_the_height() -> None:
    task = registry.task("stacking")
    assert near(task, STATE, SkillCall("pick", (0.53, 0.03, 0.05)))
    assert not near(task, STATE, SkillCall("pick", (0.6, 0.0, -0.09)))
    assert NEAR == 0.05
    assert near(task, STATE, SkillCall("pick", (0.54, 0.03 - 1e-9, 0.2)))
    assert not near(task, STATE, SkillCall("pick", (0.541, 0.03, -0.09)))


def test_each_skill_has_places_of_its_own() -> None:
    task = registry.task("stacking")
    assert not near(task, STATE, SkillCall("pick", (0.7, 0.1, -0.04))), "over the large block"
    assert near(task, STATE, SkillCall("place", (0.7, 0.1, -0.04)))
    assert not near(task, STATE, SkillCall("place", (0.5, 0.0, -0.04))), "over the small block"


def test_near_any_one_of_several_is_near() -> None:
    hotdog = registry.task("cooking_hotdog")
    seen = np.zeros(sum(f.size for f in hotdog.state_fields))
    places = hotdog.keypoints(seen, "place")
    assert len(places) > 1
    for at in places:
        assert near(hotdog, seen, SkillCall("place", tuple(float(v) for v in at)))


def test_where_there_is_nothing_to_be_far_from_everything_is_near() -> None:
    state = np.array([0.5, 0.0, 0.0, 0.0])
    for about in (registry.task("reaching"), of_task("reaching")):
        assert near(about, state, SkillCall("release"))
        assert near(about, state, SkillCall("reach", (0.8, 0.2, 0.0)))
    assert near(problem(), np.zeros(3), SkillCall("pick", (0.3, 0.0, 0.0)))


def test_a_problem_and_its_task_agree() -> None:
    task, told = registry.task("stacking"), of_task("stacking")
    calls = [SkillCall("pick", (x, 0.0, -0.09)) for x in np.linspace(0.43, 0.69, 14).tolist()]
    assert [near(told, STATE, call) for call in calls] == [near(task, STATE, call) for call in calls]
