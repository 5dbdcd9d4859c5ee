"""The hand of the simulated arm: fingers that don't obey end a skill, and what they hold outlives a restart."""

from __future__ import annotations

import pytest

from robot_adapters.base import EndReason, SkillCall
from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.adapter import FrankaAdapter
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import APART, TABLE, Build, errors, never, nothing
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import UNHURRIED

pytestmark = pytest.mark.simulated_arm

PICK = SkillCall("pick", tuple(APART["block_a"]))
ON_TOP = (APART["block_b"][0], APART["block_b"][1], APART["block_b"][2] + 0.047)
both = pytest.mark.parametrize("backend", ["franka_rs", pytest.param("franky", marks=pytest.mark.long)])


@both
def test_fingers_that_do_not_obey_end_the_skill_where_it_is(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    arm.tell(jammed=True)
    picked = adapter.execute(PICK, should_stop=never, on_step=nothing)
    assert picked.end is EndReason.STALLED
    assert [v.kind for v in picked.violations] == ["manual_reset"]
    assert "didn't close: they are 80 mm apart" in picked.violations[0].detail
    assert "Desk" in picked.violations[0].detail
    wait_for(lambda: arm.truth()["mode"] == "kIdle", "the arm to be let go of")
    assert arm.truth()["tip"][2] < TABLE + 0.05  # it didn't rise as after a grasp

    arm.tell(jammed=False)
    arm.tell(heal=True, place=APART)
    adapter.reset()
    assert adapter.execute(PICK, should_stop=never, on_step=nothing).end is EndReason.ARRIVED
    arm.tell(jammed=True)
    placed = adapter.execute(SkillCall("place", ON_TOP), should_stop=never, on_step=nothing)
    assert placed.end is EndReason.STALLED
    assert "didn't open" in placed.violations[0].detail
    assert errors(arm, "block_a", ON_TOP) < 0.01  # nor was the block lifted again
    assert arm.truth()["blocks"]["block_a"][2] < ON_TOP[2] + 0.02
    wait_for(lambda: arm.truth()["mode"] == "kIdle", "the arm to be let go of")


@both
def test_what_is_held_is_held_still_after_a_restart(backend: str, arm: SimulatedFranka) -> None:
    arm.tell(heal=True, place=APART)
    settings = {
        "host": arm.host,
        "backend": backend,
        "realtime": False,
        "dead_man": UNHURRIED,
        "eyes": "onlooker",
        "eyes_settings": {"host": arm.host},
    }
    before = FrankaAdapter("stacking", FrankaSettings.model_validate(settings))
    try:
        before.reset()
        assert before.execute(PICK, should_stop=never, on_step=nothing).end is EndReason.ARRIVED
    finally:
        before.close()
    after = FrankaAdapter("stacking", FrankaSettings.model_validate(settings))
    try:
        after.observe()
        assert after._scene().gripper_closed
        assert after._scene().held == "block_a"
        low: list[float] = []

        def look() -> None:
            truth = arm.truth()
            if truth["tip"][2] < TABLE + 0.12:
                low.append(truth["width"])

        # the next pick lets go of it above, and doesn't come down with it in its fingers
        picked = after.execute(SkillCall("pick", tuple(APART["block_b"])), should_stop=never, on_step=look)
        assert picked.end is EndReason.ARRIVED
        assert low[0] > 0.075
        assert arm.truth()["width"] > 0.045  # the larger block
    finally:
        after.close()
