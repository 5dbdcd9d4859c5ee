"""What goes wrong around a real arm, on both backends: it is noticed, told in words, and nothing goes on by itself."""

from __future__ import annotations

import math
import random
import re
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from robot_adapters.base import EndReason, SkillCall, SkillResult, Unavailable
from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.franka.backend import ArmFault, Goal, Mode
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import APART, TABLE, Build, never, nothing
from tests.simulators.franka import SimulatedFranka, free_host
from tests.simulators.still_arm import HOME

pytestmark = pytest.mark.simulated_arm

BACKENDS = ["franka_rs", "franky"]
AWAY = SkillCall("place", (0.65, 0.10, TABLE + 0.10))

both = pytest.mark.parametrize("backend", BACKENDS)


def moved(adapter: FrankaAdapter, call: SkillCall, what: Callable[[], object], after: int = 12) -> SkillResult:
    """Run it, and have something happen once it has sent so many set-points."""
    steps = 0

    def count() -> None:
        nonlocal steps
        steps += 1
        if steps == after:
            what()

    return adapter.execute(call, should_stop=never, on_step=count)


@both
def test_a_contact_ends_the_skill_before_the_robot_stops_itself(
    backend: str, build: Build, arm: SimulatedFranka
) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    onto = (APART["block_b"][0], APART["block_b"][1] + 0.04, TABLE + 0.01)  # one of the open fingers meets the block
    pushes = []
    result = adapter.execute(
        SkillCall("place", onto), should_stop=never, on_step=lambda: pushes.append(adapter.arm.state.newtons)
    )
    assert result.end in {EndReason.FORCE_LIMIT, EndReason.STALLED}
    assert 5.0 < max(pushes) < 45.0
    assert adapter.arm.look().mode in {Mode.IDLE, Mode.MOVING}
    assert np.linalg.norm(arm.truth()["force"]) < 30.0
    assert not result.violations
    assert adapter.execute(AWAY, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


@both
def test_a_reflex_stays_until_an_operator_recovers_the_arm(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    result = moved(adapter, AWAY, lambda: arm.tell(push=[0.0, 90.0, 0.0, 0.05]))
    assert result.end is EndReason.FORCE_LIMIT
    assert [v.kind for v in result.violations] == ["damage"]
    assert "stopped itself" in result.violations[0].detail
    assert adapter.telemetry().mode == "reflex"
    before = arm.truth()["tip"]
    with pytest.raises(Unavailable, match="reflex"):
        adapter.observe()
    with pytest.raises(Unavailable, match="reflex"):
        adapter.execute(AWAY, should_stop=never, on_step=nothing)
    assert not np.linalg.norm(np.subtract(arm.truth()["tip"], before)) > 0.005
    wait_for(lambda: np.linalg.norm(arm.truth()["force"]) < 1.0, "nobody to push any more")
    adapter.recover()
    adapter.observe()
    assert adapter.execute(AWAY, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


@both
def test_a_user_stop_is_never_recovered_by_itself(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    result = moved(adapter, AWAY, lambda: arm.tell(user_stop=True))
    assert result.end is EndReason.STOPPED
    assert [v.kind for v in result.violations] == ["manual_reset"]
    assert adapter.telemetry().mode == "user_stopped"
    for _ in range(2):
        with pytest.raises(ArmFault, match="user_stopped"):
            adapter.recover()
    with pytest.raises(Unavailable, match="user_stopped"):
        adapter.execute(AWAY, should_stop=never, on_step=nothing)
    arm.tell(user_stop=False)
    adapter.recover()
    adapter.observe()
    assert adapter.execute(AWAY, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


@both
def test_a_pulled_cable_ends_the_motion_and_is_told(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    pulled: list[dict[str, Any]] = []
    result = moved(adapter, AWAY, lambda: pulled.append(arm.tell(lock_step=False, plug=False)))
    assert result.end is EndReason.STALLED
    assert [v.kind for v in result.violations] == ["damage"]
    with pytest.raises(Unavailable, match=r"arm"):
        adapter.observe()
    assert adapter.telemetry().mode == "disconnected"
    assert adapter.telemetry().words
    assert np.linalg.norm(np.subtract(arm.truth()["tip"], pulled[0]["tip"])) < 0.05


@both
def test_a_stop_during_a_motion_or_a_grasp_is_heeded(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend)
    for until in ("the descent", "the grasp"):
        adapter.reset()
        stopped = threading.Event()

        def heed(until: str = until, stopped: threading.Event = stopped) -> bool:
            low = adapter.arm.pose()[0][2] < TABLE + 0.12
            gripping = adapter.arm.gripper_closed() and adapter.arm.backend.hand().busy
            if (until == "the descent" and low) or (until == "the grasp" and gripping):
                stopped.set()
            return stopped.is_set()

        result = adapter.execute(SkillCall("pick", tuple(APART["block_a"])), should_stop=heed, on_step=nothing)
        assert result.end is EndReason.STOPPED
        assert not result.violations
        assert arm.truth()["mode"] == "kIdle"
        arm.tell(heal=True, place=APART)


@both
def test_the_way_home_ends_where_the_arm_pushes_before_it_stops_itself(
    backend: str, build: Build, arm: SimulatedFranka
) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    assert adapter.execute(AWAY, should_stop=never, on_step=nothing).end is EndReason.ARRIVED
    began, pushes = adapter.arm.look().position, []

    def lean() -> None:
        pushes.append(adapter.arm.state.newtons)
        if max(pushes) < 1.0 and np.linalg.norm(adapter.arm.state.position - began) > 0.03:
            arm.tell(push=[0.0, 32.0, 0.0, 0.5])

    with pytest.raises(Unavailable, match=r"the hand pushes with \d+ N") as broken:
        adapter.home(should_stop=never, on_step=lean)
    assert "in its way" in broken.value.remedy
    truth = arm.truth()
    assert truth["mode"] == "kIdle"
    assert adapter.arm.look().mode is Mode.IDLE
    assert np.linalg.norm(np.subtract(truth["tip"], HOME)) > 0.1
    wait_for(lambda: np.linalg.norm(arm.truth()["force"]) < 1.0, "nobody to push any more")
    assert adapter.home(should_stop=never, on_step=nothing)


@both
def test_a_motion_that_nobody_drives_any_more_is_stopped_after_the_time_that_was_set(
    backend: str, build: Build, arm: SimulatedFranka
) -> None:
    adapter = build(backend=backend, dead_man=0.3)
    adapter.reset()

    def hang() -> None:
        wait_for(lambda: arm.truth()["mode"] == "kIdle", "the dead-man timer to stop the arm")

    assert moved(adapter, AWAY, hang).end is EndReason.STOPPED
    assert arm.truth()["mode"] == "kIdle"


@both
def test_a_halt_from_another_thread_is_no_fault_whenever_it_comes(
    backend: str, build: Build, arm: SimulatedFranka
) -> None:
    driven = build(backend=backend).arm.backend
    chance = random.Random(3)
    for _ in range(12):
        driven.begin()
        here, pause = driven.state(), chance.uniform(0.0, 0.03)
        goal = Goal(here.position, np.zeros(3), here.position, here.yaw)
        halting = threading.Timer(pause, driven.halt)
        halting.start()
        while halting.is_alive():
            driven.track(goal)
            assert driven.state().mode in {Mode.IDLE, Mode.MOVING}
        halting.join()
        assert driven.state().mode is Mode.IDLE
    assert arm.truth()["mode"] == "kIdle"


def test_with_more_patience_it_goes_on(build: Build, arm: SimulatedFranka) -> None:
    adapter = build(dead_man=5.0)
    adapter.reset()

    def dawdle() -> None:
        asked = time.monotonic()
        wait_for(lambda: time.monotonic() - asked > 0.8, "more than the impatient one's time")

    assert moved(adapter, AWAY, dawdle).end is EndReason.ARRIVED


@both
def test_the_way_down_near_the_table_is_slow(backend: str, build: Build) -> None:
    adapter = build(backend=backend)
    adapter.reset()
    seen: list[tuple[float, float]] = []
    low = SkillCall("place", (0.65, 0.10, TABLE + 0.02))
    result = adapter.execute(
        low,
        should_stop=never,
        on_step=lambda: seen.append((adapter.arm.state.time, float(adapter.arm.state.position[2]))),
    )
    assert result.end is EndReason.ARRIVED
    (times, heights), limits = np.array(seen).T, FrankaSettings()
    down = -np.diff(heights) / np.diff(times)
    near = heights[1:] < TABLE + limits.approach_height - 0.01
    assert down[~near].max() > 2 * limits.approach_speed
    assert near.sum() > 10
    assert down[near].max() < 1.5 * limits.approach_speed


def test_threads_that_hog_python_disturb_no_motion(build: Build, arm: SimulatedFranka) -> None:
    adapter = build()
    adapter.reset()
    lost, done = arm.truth()["lost"], threading.Event()

    def hog() -> None:
        while not done.is_set():
            math.factorial(300)

    hogs = [threading.Thread(target=hog) for _ in range(2)]
    for thread in hogs:
        thread.start()
    try:
        result = adapter.execute(AWAY, should_stop=never, on_step=nothing)
    finally:
        done.set()
    assert result.end is EndReason.ARRIVED
    assert arm.truth()["mode"] == "kIdle"
    assert arm.truth()["lost"] == lost


@both
def test_the_workspace_is_kept_whatever_a_task_allows(backend: str, build: Build, arm: SimulatedFranka) -> None:
    adapter = build(backend=backend, workspace_low=(0.28, -0.2, TABLE), workspace_high=(0.55, 0.2, TABLE + 0.7))
    adapter.reset()
    reached = []
    result = adapter.execute(AWAY, should_stop=never, on_step=lambda: reached.append(arm.truth()["tip"][0]))
    assert result.end is EndReason.STALLED
    assert max(reached, default=0.0) < 0.57
    assert adapter.observe()


def test_an_arm_without_a_hand_is_refused_with_a_remedy() -> None:
    with SimulatedFranka(gripper=False) as handless:
        settings = FrankaSettings(
            host=handless.host, realtime=False, eyes="onlooker", eyes_settings={"host": handless.host}
        )
        with pytest.raises(Unavailable, match="no hand") as refused:
            FrankaAdapter("stacking", settings)
        assert "Desk" in refused.value.remedy


def test_nobody_there_is_told_with_a_remedy(arm: SimulatedFranka) -> None:
    nowhere = free_host()
    settings = FrankaSettings(host=nowhere, realtime=False, eyes="onlooker", eyes_settings={"host": arm.host})
    with pytest.raises(Unavailable, match=re.escape(nowhere)) as refused:
        FrankaAdapter("stacking", settings)
    assert "FCI" in refused.value.remedy
