"""Behaviour cloning: it does as it was shown, and can't do two things at once unless key points tell them apart."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import torch

from agent.algorithm import AgentError, Problem
from agent.bc import Cloning, Demonstration
from agent.config import SEED, SeedSettings
from agent.study.episodes import SkillEpisodes
from agent.study.imitation import DEMONSTRATORS, PLAIN, cloned, demonstrated
from agent.study.lessons import success
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks.base import Task
from tests.agent.problems import PICK, RELEASE
from tests.benchmarks.composition import kinematic

SMALL: dict[str, Any] = {**SEED.presets["recommended"], "hidden_size": 32, "batch_size": 64, "gradient_steps": 8}


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def two_places(_state: Array, _skill: str | None) -> Array:
    return np.array([[0.4, -0.1, 0.0], [0.7, 0.1, 0.0]])


def both_ways(keypoints: Any) -> tuple[Problem, list[Demonstration]]:
    """One state in which either of two places was shown, as often; never anything between."""
    of = Problem("toy", np.zeros(3), np.full(3, 2.0), (PICK, RELEASE), keypoints=keypoints)
    at = two_places(np.ones(3), None)
    return of, [Demonstration(np.ones(3), SkillCall("pick", tuple(at[i % 2].tolist()))) for i in range(20)]


def test_it_clones_a_clean_set() -> None:
    shown = demonstrated(DEMONSTRATORS[0], kinematic, 30, seed=0)
    task: Task = DEMONSTRATORS[0].task()
    episodes = SkillEpisodes(task, kinematic(task), first_subgoal=False)
    assert success(episodes, cloned(task, shown, SeedSettings(**SMALL), 0), 20) >= 0.9


def test_what_was_shown_becomes_likely() -> None:
    of, shown = both_ways(two_places)
    clone = Cloning(of, SeedSettings(**SMALL), 0)
    losses = clone.fit(shown, 150)
    assert np.mean(losses[-10:]) < losses[0] - 0.2
    assert np.isfinite(losses).all()
    again = Cloning(of, SeedSettings(**SMALL), 0)
    assert again.fit(shown, 150) == losses


def test_without_key_points_it_goes_between_two_ways() -> None:
    of, shown = both_ways(None)
    clone = Cloning(of, SeedSettings(**{**SMALL, **PLAIN}), 0)
    clone.fit(shown, 200)
    call = clone.propose(np.ones(3))
    assert call.skill == "pick"
    np.testing.assert_allclose(call.parameters[:2], (0.55, 0.0), atol=0.03)


def test_with_key_points_it_takes_one_of_two_ways() -> None:
    of, shown = both_ways(two_places)
    clone = Cloning(of, SeedSettings(**SMALL), 0)
    clone.fit(shown, 200)
    away = np.linalg.norm(two_places(np.ones(3), None) - clone.propose(np.ones(3)).parameters, axis=1)
    assert away.min() < 0.01


def test_a_demonstration_that_does_not_fit_is_told() -> None:
    of, shown = both_ways(None)
    wrong = Demonstration(np.ones(3), SkillCall("pick", (9.0, 0.0, 0.0)))
    with pytest.raises(AgentError, match=r"pick\.x = 9\.0 is outside") as error:
        Cloning(of, SeedSettings(**SMALL), 0).fit([*shown, wrong], 10)
    assert "keep x within" in error.value.remedy
