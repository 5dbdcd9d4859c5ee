"""Looking for a skill's first good position without a key point."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from agent.grounding import Grounding, grounding
from agent.search import Elimination, PushElimination
from robot_adapters.base import Array, SkillCall
from tests.agent.problems import PICK, PUSH, of_task

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


KEYPOINT = torch.tensor([0.55, 0.0, 0.0])


def of_push() -> Grounding:
    return grounding((PUSH,), [1], grounded=True, relative=True, radius=0.04)


def pushed(end: float, *, along_y: bool, seed: int) -> int:
    """Refusals until the first push from the key point that ends within 20 mm of `end` (m), and that one."""
    ground, generator = of_push(), torch.Generator().manual_seed(seed)
    elimination = PushElimination(ground, 0, 0.05)
    refused = torch.zeros(0, 5)
    for tried in range(1, 200):
        direction, delta = elimination.next(refused, refused, KEYPOINT, generator).tolist()
        length = PUSH.denormalise(np.array([0.0, 0.0, 0.0, direction, delta]))[4]
        if (direction >= 0) == along_y and abs(float(KEYPOINT[int(along_y)]) + length - end) <= 0.02:
            return tried
        local = torch.tensor([[[0.0, 0.0, 0.0, direction, delta]]])
        refused = torch.cat([refused, ground.decode(local, KEYPOINT.view(1, 1, 1, 3))[0]])
    raise AssertionError("never found")


@pytest.mark.parametrize("along_y", [True, False])
def test_a_pushs_direction_and_length_are_found_in_a_sweep(along_y: bool) -> None:
    """Forty millimetres fit ten times into the lengths of each direction."""
    middle = float(KEYPOINT[int(along_y)])
    needed = [pushed(middle + length, along_y=along_y, seed=i) for i, length in enumerate(np.linspace(-0.17, 0.17, 12))]
    assert np.mean(needed) < 20


def test_a_push_is_remembered_by_where_it_ended_too() -> None:
    """Sweeping's toy lies elsewhere now, the dustpan doesn't: the same end takes another length."""
    problem, ground = (
        of_task("sweeping"),
        grounding(of_task("sweeping").skills, [1, 1], grounded=True, relative=True, radius=0.04),
    )
    before, after = (
        torch.tensor([[[0.45, 0.17, 0.0], [x, y, 0.0]]]).view(2, 1, 3) for x, y in ((0.45, 0.0), (0.49, 0.02))
    )
    start = problem.skills[1].normalise(np.array([0.45, 0.0, -0.03, -0.5, 0.235]))
    call = torch.from_numpy(start.astype(np.float32))[None]
    skills = torch.tensor([1])
    options, local = ground.encode(skills, call, before[None])
    again = ground.ending_alike(skills, call, options, local, after)
    every = ground.decode(again.expand(ground.options, 1, -1), after[None])
    x, y, _, direction, delta = problem.skills[1].denormalise(every[options[0], 0].double().numpy()).tolist()
    assert (x, y) == pytest.approx((0.49, 0.02), abs=1e-5)
    assert x + delta == pytest.approx(0.685, abs=1e-5)
    assert direction < 0
