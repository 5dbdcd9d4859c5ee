"""Demonstrators show what they are said to show."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from agent.study.imitation import DEMONSTRATORS, Demonstrator, Outcome, demonstrated, table_of
from agent.study.tidying import PANS, TidyUp
from robot_adapters.base import SkillCall
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.collecting_toy import PLACE_HEIGHT
from tests.benchmarks.composition import kinematic


@pytest.mark.parametrize("who", DEMONSTRATORS, ids=lambda who: who.name)
def test_a_demonstrator_errs_as_often_as_it_is_said_to(who: Demonstrator) -> None:
    shown, task = demonstrated(who, kinematic, 300, seed=1), who.task()
    bad = [task.judge(d.state, d.call) < 0 for d in shown]
    assert len(shown) == 300
    assert np.mean(bad) == pytest.approx(who.bad, abs=0.08)
    assert len({d.call for d in shown}) == 300, "a good call is drawn anew at every step"


@pytest.mark.parametrize(("one_way", "ways"), [(True, 1), (False, 4)])
def test_ways_of_tidying_up(one_way: bool, ways: int) -> None:
    """Which toy is taken first, and into which pan it goes."""
    shown = demonstrated(Demonstrator("tidy", lambda: TidyUp(one_way=one_way)), kinematic, 200, seed=0)
    seen = set()
    for pick, place in itertools.pairwise(shown):
        toys = pick.state.reshape(2, 5)
        if pick.call.skill == "pick" and place.call.skill == "place" and not toys[:, 4].any():
            toy = int(np.argmin(np.abs(toys[:, 0] - pick.call.parameters[0])))
            seen.add((toy, place.call.parameters[1] > 0))
    assert len(seen) == ways
    if one_way:
        assert seen == {(0, True)}


def test_between_the_ways_nothing_is_good() -> None:
    task: Task = DEMONSTRATORS[-1].task()
    state = kinematic(task).reset(0).state
    near, far = task.keypoints(state, "pick")
    assert [task.judge(state, SkillCall("pick", tuple(at))) for at in (near, far, (near + far) / 2)] == [1, 1, -1]
    left, right = PANS.values()
    held = state.copy()
    held[3] = 1.0  # the near toy is in the hand
    over = [(x, y, z + PLACE_HEIGHT) for x, y, z in (left, right, np.add(left, right) / 2)]
    assert [task.judge(held, SkillCall("place", at)) for at in over] == [1, 1, -1]


def test_the_table_has_a_row_for_each_demonstrator() -> None:
    outcomes = [Outcome("a", 1, 40, 0.5, 1.0, 1.0), Outcome("a", 2, 40, 0.7, 1.0, 0.9)]
    assert table_of(outcomes)[2:] == ["| a | 60 ± 10 % | 100 ± 0 % | 95 ± 5 % |"]
