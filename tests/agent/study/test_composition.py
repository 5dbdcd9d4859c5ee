"""Composition: scenes never trained can be solved, steps point at the right places, and the right critic is asked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import torch

from agent.config import SEED, SeedSettings
from agent.study.composition import COMPOSITIONS, SOURCES, Outcome, Trained, Trial, composed, table_of
from agent.study.episodes import SkillEpisodes
from agent.study.lessons import success
from robot_adapters.base import check_call
from robot_adapters.tasks.base import Task
from tests.benchmarks.composition import kinematic

RADIUS = SeedSettings(**SEED.presets["recommended"]).grounding_radius


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


@pytest.mark.parametrize("name", COMPOSITIONS)
def test_the_teacher_solves_every_scene(name: str) -> None:
    task, rng = COMPOSITIONS[name].task(), np.random.default_rng(0)
    episodes = SkillEpisodes(task, kinematic(task), first_subgoal=False)
    assert success(episodes, task.true_call, 10) == 1.0
    assert success(episodes, lambda state: task.sample_good(state, rng), 10) == 1.0


@pytest.mark.parametrize("name", [*COMPOSITIONS, *SOURCES])
def test_each_subgoal_acts_where_its_step_says(name: str) -> None:
    """Within reach of a grounded actor, in whatever order the subgoals come."""
    made: Any = COMPOSITIONS.get(name) or SOURCES[name]
    places = made.places if name in SOURCES else [step.place for step in made.steps]
    task: Task = made.task()
    assert len(places) == len(task.subgoals)
    robot, order = SkillEpisodes(task, kinematic(task), first_subgoal=False), []
    robot.begin(3)
    for _ in task.subgoals:
        stage = task.subgoal(robot.state)
        order.append(stage)
        call = task.true_call(robot.state)
        check_call(call, task.skills)
        assert call.skill == places[stage].skill
        assert np.abs(places[stage].of(task, robot.state) - call.parameters[:3]).max() < RADIUS
        done = robot.execute(call)
    assert done.success
    assert order == list(range(len(task.subgoals)))


def test_states_are_rebound_to_what_the_source_tasks_know() -> None:
    """The call that is right in the new scene is right for the source task in the re-bound state."""
    for name in ("a third block", "Collecting's toy in Sweeping's scene"):
        composition = COMPOSITIONS[name]
        task: Task = composition.task()
        robot = SkillEpisodes(task, kinematic(task), first_subgoal=False)
        robot.begin(1)
        for _ in task.subgoals:
            source, seen = composition.rebound(task, robot.state)
            call = task.true_call(robot.state)
            assert SOURCES[source].task().judge(seen, call) == 1
            robot.execute(call)


def test_two_critics_of_stacking_build_a_higher_stack_without_feedback() -> None:
    settings, source = SeedSettings(**SEED.presets["recommended"]), SOURCES["stacking"]
    task: Task = source.task()
    trial = Trial(task, settings, seed=0)
    assert trial.run(kinematic, budget=40, rollouts=10).feedback is not None
    pieces = trial.pieces(source.places)
    assert all(piece.last_label_id for piece in pieces)
    composition = COMPOSITIONS["a third block"]
    three: Task = composition.task()
    policy = composed(composition, three, {"stacking": pieces})
    assert success(SkillEpisodes(three, kinematic(three), first_subgoal=False), policy, 10) >= 0.9


def test_the_table_says_what_was_not_reached() -> None:
    outcomes = [
        Outcome("x", 1, composed=1.0, rebound=0.5, sources=10, anew=Trained(40, 100, 0.9)),
        Outcome("x", 2, composed=0.8, rebound=0.5, sources=20, anew=Trained(None, 100, 0.0)),
    ]
    assert table_of(outcomes)[2] == "| x | 90 ± 10 % | 50 ± 0 % | 15 ± 5 | 70 ± 30 (1 of 2 not within 100) |"
