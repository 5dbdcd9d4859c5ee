"""Deoxys's wire against a peer of our own, without physics: what goes over it, and when nothing comes any more."""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from robot_adapters import registry
from robot_adapters.base import EndReason, SkillCall, Unavailable
from robot_adapters.franka import FrankaSettings, connecting, deoxys_pb2
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.franka.arm import FrankaArm
from robot_adapters.franka.backend import ArmFault, FingersFault, Mode
from robot_adapters.franka.deoxys import SETTLED
from robot_adapters.skills import run_skill
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import TABLE, never, nothing
from tests.simulators.deoxys_peer import HOME, DeoxysPeer
from tests.simulators.driver import FROZEN
from tests.simulators.franka import ROOT, free_host
from tests.simulators.session import UNHURRIED
from tests.simulators.still_worker import StillEyes

PROTO = Path(str(deoxys_pb2.__file__)).with_name("deoxys.proto")
TASK = registry.task("stacking")
PATIENT = 1.0
"""s of the dead-man timer, and of silence after which arm and hand are gone."""
AWAY = SkillCall("place", (0.65, 0.10, TABLE + 0.10))
PICK = SkillCall("pick", (0.55, 0.05, TABLE + 0.02))


@pytest.fixture
def hosts() -> tuple[str, str]:
    return free_host(), free_host()


@pytest.fixture
def peer(hosts: tuple[str, str]) -> Iterator[DeoxysPeer]:
    other = DeoxysPeer(*hosts, block=0.04)
    yield other
    other.close()


@pytest.fixture
def arm(hosts: tuple[str, str], peer: DeoxysPeer) -> Iterator[FrankaArm]:
    host, pc = hosts
    settings = FrankaSettings(host=host, deoxys_bind=pc, backend="deoxys", dead_man=PATIENT)
    connected = connecting.arm(settings, TASK)
    yield connected
    connected.backend.close()


def test_a_pick_goes_over_the_wire_within_the_limits(arm: FrankaArm, peer: DeoxysPeer) -> None:
    arm.begin()
    end, steps = run_skill(arm, PICK, TASK.skills[0], should_stop=never, on_step=nothing)
    arm.end()
    assert end is EndReason.ARRIVED
    assert steps > 20
    assert peer.width == pytest.approx(0.04)
    goals = np.array(peer.goals)
    assert np.linalg.norm(np.diff(goals, axis=0), axis=1).max() <= 0.25 * 0.05 + 1e-6  # m: at most the speed's stride
    assert goals[:, 2].min() == pytest.approx(TABLE + 0.02, abs=0.003)
    assert not peer.timed_out  # not even while the fingers moved
    wait_for(lambda: peer.terminations, "the end to be told")
    arm.begin()
    assert arm.home()
    assert np.allclose(arm.look().position, HOME, atol=0.02)
    arm.backend.open()


def test_a_stop_lets_moving_fingers_stand_and_others_hold_what_they_have(arm: FrankaArm, peer: DeoxysPeer) -> None:

    def closing() -> bool:
        arm.backend.grasp()  # again: the first may come before the other side listens
        return peer.width < 0.075

    wait_for(closing, "the fingers to move")
    arm.halt()
    wait_for(lambda: peer.hand_stops == 1, "the stop to be told")
    stood = peer.width
    assert stood > 0.04
    arm.backend.grasp()
    wait_for(lambda: not arm.backend.hand().busy, "the fingers to hold the block")
    terminations = peer.terminations
    arm.halt()
    wait_for(lambda: peer.terminations > terminations, "the stop to be told")
    arm.backend.open()  # comes after whatever the stop said to the hand
    wait_for(lambda: peer.width > 0.045, "the fingers to open")
    assert peer.hand_stops == 1


def test_fingers_have_not_arrived_because_nothing_is_heard_of_them(arm: FrankaArm, peer: DeoxysPeer) -> None:
    def moving() -> bool:
        arm.backend.grasp()  # again: the first may be said before the other side has begun to listen
        return arm.backend.hand().width < 0.078

    wait_for(moving, "the fingers to move")
    peer.silent = True
    since = time.monotonic()
    while time.monotonic() - since < 2 * SETTLED:
        assert arm.backend.hand().busy
    peer.silent = False
    wait_for(lambda: not arm.backend.hand().busy, "the fingers to arrive")
    assert arm.backend.hand().width == pytest.approx(0.04)


def test_a_stop_and_silence_are_heeded(arm: FrankaArm, peer: DeoxysPeer) -> None:
    steps = 0

    def count() -> None:
        nonlocal steps
        steps += 1

    arm.begin()
    arm.should_stop = lambda: steps >= 10
    end, _ = run_skill(arm, PICK, TASK.skills[0], should_stop=arm.should_stop, on_step=count)
    assert end is EndReason.STOPPED
    wait_for(lambda: peer.terminations, "the end to be told")
    asked, arm.should_stop = len(peer.goals), never
    peer.silent = True
    with pytest.raises(ArmFault) as gone:
        run_skill(arm, PICK, TASK.skills[0], should_stop=never, on_step=nothing)
    assert gone.value.mode is Mode.DISCONNECTED
    arm.halt()
    assert len(peer.goals) - asked < 40


def test_a_hand_that_says_no_more_or_does_not_move_ends_the_skill(arm: FrankaArm, peer: DeoxysPeer) -> None:
    peer.jammed = True
    arm.begin()
    with pytest.raises(FingersFault, match="didn't close") as stuck:
        run_skill(arm, PICK, TASK.skills[0], should_stop=never, on_step=nothing)
    assert "Desk" in stuck.value.remedy
    arm.halt()
    peer.jammed = False
    steps = 0

    def fall_silent() -> None:
        nonlocal steps
        steps += 1
        peer.hand_silent = steps > 5

    arm.begin()
    with pytest.raises(ArmFault, match="hand doesn't answer") as gone:
        run_skill(arm, PICK, TASK.skills[0], should_stop=never, on_step=fall_silent)
    assert gone.value.mode is Mode.DISCONNECTED
    arm.halt()
    peer.hand_silent = False
    wait_for(lambda: arm.backend.hand().there, "the hand to be heard again")


def test_a_reflex_is_told_with_what_helps(arm: FrankaArm, peer: DeoxysPeer) -> None:
    peer.mode = deoxys_pb2.FrankaRobotStateMessage.Reflex
    wait_for(lambda: arm.look().mode is Mode.REFLEX, "the reflex to be told")
    with pytest.raises(ArmFault, match="reflex"):
        run_skill(arm, PICK, TASK.skills[0], should_stop=never, on_step=nothing)
    with pytest.raises(ArmFault) as refused:
        arm.recover()
    assert "restart" in refused.value.remedy
    assert not peer.goals


@pytest.fixture
def adapter(hosts: tuple[str, str], peer: DeoxysPeer, monkeypatch: pytest.MonkeyPatch) -> Iterator[FrankaAdapter]:
    """The whole adapter, with a double for cameras."""
    monkeypatch.setattr("robot_adapters.franka.adapter.find_eyes", lambda _: lambda *_: StillEyes())
    settings = FrankaSettings(host=hosts[0], deoxys_bind=hosts[1], backend="deoxys", dead_man=UNHURRIED)
    made = FrankaAdapter("stacking", settings)
    yield made
    made.close()


@pytest.mark.parametrize(
    ("what", "end", "kind"),
    [("Reflex", EndReason.FORCE_LIMIT, "damage"), ("UserStopped", EndReason.STOPPED, "manual_reset")],
)
def test_a_reflex_or_a_pressed_button_in_the_middle_of_a_motion_ends_it_for_good(
    what: str, end: EndReason, kind: str, adapter: FrankaAdapter, peer: DeoxysPeer
) -> None:
    adapter.reset()
    steps = 0

    def count() -> None:
        nonlocal steps
        steps += 1
        if steps == 10:
            peer.mode = getattr(deoxys_pb2.FrankaRobotStateMessage, what)

    result = adapter.execute(AWAY, should_stop=never, on_step=count)
    assert result.end is end
    assert [v.kind for v in result.violations] == [kind]
    wait_for(lambda: peer.terminations, "the end to be told")
    asked, stood = len(peer.goals), peer.position.copy()
    with pytest.raises(Unavailable):
        adapter.execute(AWAY, should_stop=never, on_step=nothing)
    peer.mode = deoxys_pb2.FrankaRobotStateMessage.Idle
    wait_for(lambda: adapter.arm.look().mode is Mode.IDLE, "the arm to be well again")
    assert len(peer.goals) == asked  # it doesn't go on by itself
    assert np.array_equal(peer.position, stood)
    adapter.reset()
    assert adapter.execute(AWAY, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


def test_a_goal_is_not_repeated_for_nobody(hosts: tuple[str, str], peer: DeoxysPeer) -> None:
    settings = FrankaSettings(host=hosts[0], deoxys_bind=hosts[1], backend="deoxys", dead_man=0.5)
    arm = connecting.arm(settings, TASK)
    try:
        for _ in range(3):  # the first may come before the other side listens
            arm.step(HOME + np.array([0.02, 0.0, 0.0]), 0.0, False)
        wait_for(lambda: peer.goals, "a goal")
        # and nobody looks at the arm any more
        wait_for(lambda: peer.terminations, "the arm to be stopped")
        assert not peer.timed_out
    finally:
        arm.backend.close()


def test_a_process_that_was_frozen_ends_its_motion(hosts: tuple[str, str], peer: DeoxysPeer, tmp_path: Path) -> None:
    said = tmp_path / "said"
    command = [sys.executable, "-m", "tests.simulators.driver", hosts[0], "deoxys", hosts[1]]
    with said.open("w") as told, subprocess.Popen(command, cwd=ROOT, stdout=told) as driver:
        try:
            wait_for(lambda: said.read_text() or driver.poll() is not None, "the arm to move", 60)
            os.kill(driver.pid, signal.SIGSTOP)
            frozen = time.monotonic()
            wait_for(lambda: time.monotonic() - frozen > FROZEN + 0.5, "more than the dead-man timer's time")
            asked, stood = len(peer.goals), peer.position.copy()
            os.kill(driver.pid, signal.SIGCONT)
            assert driver.wait(60) == 0
        finally:
            driver.kill()
    found = json.loads(said.read_text().splitlines()[-1])
    assert found["mode"] == "stopped"
    wait_for(lambda: peer.terminations, "the end to be told")
    assert len(peer.goals) - asked <= 1  # one may have been on its way when it was frozen
    assert np.linalg.norm(peer.position - stood) < 0.01


def test_states_without_forces_are_refused_with_a_remedy(hosts: tuple[str, str], peer: DeoxysPeer) -> None:
    peer.forceless = True
    settings = FrankaSettings(host=hosts[0], deoxys_bind=hosts[1], backend="deoxys")
    with pytest.raises(Unavailable, match="force at the hand") as refused:
        connecting.arm(settings, TASK)
    assert "O_F_ext_hat_K" in refused.value.remedy


def test_nobody_on_the_other_side_is_told(hosts: tuple[str, str]) -> None:
    host, pc = hosts
    with pytest.raises(Unavailable, match="tells nothing"):
        connecting.arm(FrankaSettings(host=host, deoxys_bind=pc, backend="deoxys"), TASK)


def test_the_messages_are_those_of_the_proto_file(tmp_path: Path) -> None:
    if importlib.util.find_spec("grpc_tools") is None:
        pytest.skip("no protoc")
    command = [sys.executable, "-m", "grpc_tools.protoc", f"-I{PROTO.parent}", f"--python_out={tmp_path}", PROTO.name]
    subprocess.run(command, check=True)
    written = (tmp_path / "deoxys_pb2.py").read_text("utf-8")
    mark = "AddSerializedFile("
    ours = Path(str(deoxys_pb2.__file__)).read_text("utf-8")
    assert written.split(mark)[1].splitlines()[0] == ours.split(mark)[1].splitlines()[0]
