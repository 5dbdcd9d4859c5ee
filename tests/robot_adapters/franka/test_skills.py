"""The skills that stacking doesn't need, on the simulated arm with both drivers: reach, push and release."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from robot_adapters.base import EndReason, SkillCall, SkillResult
from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.adapter import FrankaAdapter
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import TABLE, never, nothing
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import UNHURRIED

pytestmark = pytest.mark.simulated_arm

TOY = [0.48, 0.03, TABLE + 0.02]
both = pytest.mark.parametrize("backend", ["franka_rs", "franky"])


@pytest.fixture(scope="module")
def lab() -> Iterator[SimulatedFranka]:
    with SimulatedFranka(table=TABLE, blocks={"toy": 0.02}) as simulated:
        yield simulated


def adapter_for(task: str, backend: str, lab: SimulatedFranka) -> FrankaAdapter:
    lab.tell(heal=True, place={"toy": TOY})
    given = {
        "host": lab.host,
        "backend": backend,
        "realtime": False,
        "dead_man": UNHURRIED,
        "eyes": "onlooker",
        "eyes_settings": {"host": lab.host, "joints": {"drawer": 0.16}},
    }
    return FrankaAdapter(task, FrankaSettings.model_validate(given))


def run(adapter: FrankaAdapter, call: SkillCall) -> SkillResult:
    return adapter.execute(call, should_stop=never, on_step=nothing)


@both
def test_it_reaches_a_place_and_opens_the_hand(backend: str, lab: SimulatedFranka) -> None:
    adapter = adapter_for("reaching", backend, lab)
    try:
        adapter.reset()
        lab.tell(fingers=0.0)
        wait_for(lambda: adapter.arm.gripper_width() < 0.005, "somebody to close the fingers by hand")
        place = (0.56, 0.12, 0.02)
        reached = run(adapter, SkillCall("reach", place))
        assert (reached.end, reached.success) == (EndReason.ARRIVED, True)
        assert np.linalg.norm(np.subtract(lab.truth()["tip"], place)) < 0.005
        assert run(adapter, SkillCall("release")).end is EndReason.ARRIVED
        assert lab.truth()["width"] > 0.07
        assert np.linalg.norm(np.subtract(lab.truth()["tip"], place)) < 0.005
    finally:
        adapter.close()


@both
def test_it_pushes_a_real_block_as_far_as_was_asked(backend: str, lab: SimulatedFranka) -> None:
    adapter = adapter_for("collecting_toy", backend, lab)
    try:
        adapter.reset()
        behind = (TOY[0] - 0.06, TOY[1], TABLE + 0.03)
        pushed = run(adapter, SkillCall("push", (*behind, -0.5, 0.12)))
        assert pushed.end is EndReason.ARRIVED
        there = lab.truth()["blocks"]["toy"]
        assert there[0] == pytest.approx(behind[0] + 0.12 + 0.01 + 0.02, abs=0.012)  # half the fingers, half the block
        assert there[1] == pytest.approx(TOY[1], abs=0.01)
        assert lab.truth()["width"] < 0.005
    finally:
        adapter.close()
