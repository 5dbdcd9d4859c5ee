"""The arm in the simulator does what simulation's arm does: the same five skills, to the millimetre."""

from __future__ import annotations

import numpy as np
import pytest

from robot_adapters.base import EndReason, InvalidCall, SkillCall, SkillResult, Unavailable
from robot_adapters.franka.adapter import FrankaAdapter
from tests.robot_adapters.franka.conftest import APART, Build, errors, never, nothing
from tests.simulators.franka import SimulatedFranka

pytestmark = pytest.mark.simulated_arm

BACKENDS = ["franka_rs", "franky"]


def run(adapter: FrankaAdapter, call: SkillCall) -> SkillResult:
    return adapter.execute(call, should_stop=never, on_step=nothing)


@pytest.mark.parametrize("backend", BACKENDS)
def test_it_stacks_a_real_block_on_another(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    start = adapter.reset()
    picked = run(adapter, SkillCall("pick", tuple(APART["block_a"])))
    assert picked.end is EndReason.ARRIVED
    assert 0.03 < arm.truth()["width"] < 0.045
    held = adapter.observe()
    assert held.id != start.id
    assert held.state[2] > start.state[2] + 0.1
    on_top = (APART["block_b"][0], APART["block_b"][1], APART["block_b"][2] + 0.047)
    placed = run(adapter, SkillCall("place", on_top))
    assert placed.end is EndReason.ARRIVED
    assert placed.success
    assert not placed.violations
    assert errors(arm, "block_a", on_top) < 0.005


def test_a_grasp_of_nothing_is_told_by_the_width(build: Build) -> None:
    adapter = build()
    adapter.reset()
    away = (0.55, 0.0, APART["block_a"][2])
    assert run(adapter, SkillCall("pick", away)).end is EndReason.NOTHING_GRASPED


@pytest.mark.long
def test_a_block_that_slips_out_of_the_fingers_was_not_grasped(build: Build, arm: SimulatedFranka) -> None:
    adapter = build()
    arm.tell(slippery=True)
    adapter.reset()
    assert run(adapter, SkillCall("pick", tuple(APART["block_a"]))).end is EndReason.NOTHING_GRASPED


def test_bad_calls_move_nothing(build: Build, arm: SimulatedFranka) -> None:
    adapter = build()
    seen, before = adapter.reset(), arm.truth()["tip"]
    for bad in (SkillCall("pick", (0.5, 0.0, float("nan"))), SkillCall("pick", (0.9, 0.0, -0.1)), SkillCall("fly")):
        with pytest.raises(InvalidCall):
            run(adapter, bad)
    assert np.allclose(arm.truth()["tip"], before, atol=1e-4)
    assert adapter.observe().id == seen.id


@pytest.mark.parametrize(
    ("turned", "told"),
    [
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.15], "turned by 9 degrees"),
        ([0.08, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], "the arm was moved by 2. mm"),
    ],
)
def test_an_arm_that_was_guided_elsewhere_while_a_proposal_waited_moves_nowhere(
    turned: list[float], told: str, build: Build, arm: SimulatedFranka
) -> None:
    adapter = build()
    seen = adapter.reset()
    assert adapter.observe() is seen
    arm.tell(guide=turned)
    before = arm.truth()["tip"]
    call = SkillCall("place", (0.65, 0.10, APART["block_a"][2] + 0.1))
    with pytest.raises(Unavailable, match=told):
        run(adapter, call)
    assert np.allclose(arm.truth()["tip"], before, atol=1e-3)
    again = adapter.observe()
    assert again.id != seen.id
    assert run(adapter, call).end is EndReason.ARRIVED
