"""Looking for a skill's first good position without a key point."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from agent.grounding import Grounding, grounding
from agent.search import Elimination
from robot_adapters.base import Array, SkillCall
from tests.agent.problems import PICK, of_task

NOTHING = torch.zeros(0, 3)


def of_pick() -> Grounding:
    return grounding((PICK,), [0], grounded=True, relative=True, radius=0.04)


def tries(target: Array, seed: int, *, spacing: float = 0.05, radius: float = 0.05) -> int:
    """Refusals until the first call within `radius` of the target (m), and that one."""
    elimination, generator = Elimination(of_pick(), 0, spacing), torch.Generator().manual_seed(seed)
    refused = NOTHING
    for tried in range(1, 400):
        at = elimination.next(refused, refused, generator)
        if np.linalg.norm(PICK.denormalise(at.double().numpy()) - target) <= radius:
            return tried
        refused = torch.cat([refused, at[None]])
    raise AssertionError("never found")


def targets(count: int) -> Array:
    return np.random.default_rng(0).uniform(PICK.low + 0.05, PICK.high - 0.05, (count, 3))


def test_an_area_anywhere_is_found_in_about_as_many_tries_as_it_fits_in_the_room() -> None:
    """A ball of 5 cm fits 24 times into where its middle may be; half of a sweep without gaps would be 12 tries."""
    needed = [tries(target, seed) for seed, target in enumerate(targets(24))]
    assert np.mean(needed) < 30


@pytest.mark.parametrize(("spacing", "radius"), [(0.05, 0.03), (0.05, 0.1), (0.03, 0.05)])
def test_an_area_of_another_size_than_supposed_is_found_too(spacing: float, radius: float) -> None:
    assert all(tries(target, 0, spacing=spacing, radius=radius) < 400 for target in targets(3))


def test_refusals_here_count_for_more_than_those_of_other_situations() -> None:
    elimination = Elimination(of_pick(), 0, 0.05)
    left, right = torch.tensor([[0.0, -0.6, 0.0]]), torch.tensor([[0.0, 0.6, 0.0]])
    everywhere = (2 * torch.rand((4000, 3), generator=torch.Generator().manual_seed(0)) - 1) * 0.99
    but = everywhere[
        (everywhere[:, None] - torch.cat([left, right])).mul(of_pick().half[0, :3]).norm(dim=-1).amin(1) > 0.1
    ]
    doubted = torch.cat([but, left, right])
    at = elimination.next(torch.cat([but, left]), doubted, torch.Generator().manual_seed(0))
    assert float(at[1]) > 0


@pytest.mark.parametrize("elimination", [True, False])
def test_a_good_reach_ends_the_search(elimination: bool) -> None:
    chosen = {**SEED.presets["recommended"], "hidden_size": 16, "batch_size": 16, "explore_elimination": elimination}
    learner = SEED(of_task("reaching"), SeedSettings(**chosen), 0)
    state, good = np.array([0.5, 0.0, 0.1, 0.0]), (0.6, -0.1, 0.0)
    learner.add(
        [Label(1, state, SkillCall("reach", good), 1), Label(2, state, SkillCall("reach", (0.4, 0.1, 0.0)), -1)]
    )
    while learner.owed_updates:
        learner.update()
    np.testing.assert_allclose(learner.propose(state, deterministic=True).call.parameters, good, atol=1e-4)
