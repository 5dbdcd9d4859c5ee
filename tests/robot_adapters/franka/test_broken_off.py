"""What breaks a motion off that isn't the arm's fault: nothing drives the arm on, and nobody is told of a refusal."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from robot_adapters.base import EndReason, SkillCall, Unavailable
from robot_adapters.franka.backend import Mode
from server.workers.robot import Robot
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import APART, TABLE, Build, never
from tests.simulators.franka import SimulatedFranka
from tests.simulators.still_arm import StillArm
from tests.simulators.still_worker import StillEyes, StillWorker, still_worker

AWAY = SkillCall("place", (0.65, 0.10, TABLE + 0.10))
LONG = 600.0
"""s that nothing in these tests waits for."""


@pytest.fixture
def arm_double() -> StillArm:
    return StillArm()


@pytest.fixture
def eyes_double() -> StillEyes:
    return StillEyes(("left", "right"))


@pytest.fixture
def worker(arm_double: StillArm, eyes_double: StillEyes) -> Iterator[StillWorker]:
    with still_worker(arm_double, eyes_double, attended=LONG, dead_man=10.0) as built:
        built.attend()
        yield built


def execute(robot: Robot, call: SkillCall, proposal: int = 1, *, video: bool = True) -> dict[str, Any]:
    return robot.execute(
        proposal_id=proposal,
        execution_id=proposal,
        digest=call.digest,
        skill=call.skill,
        parameters=list(call.parameters),
        video=video,
    )


def after(steps: int, happens: Callable[[], None]) -> Callable[[], None]:
    """A hook that does something after so many set-points."""
    count = 0

    def step() -> None:
        nonlocal count
        count += 1
        if count == steps:
            happens()

    return step


@pytest.mark.simulated_arm
@pytest.mark.parametrize("backend", ["franka_rs", pytest.param("franky", marks=pytest.mark.long)])
def test_an_error_in_the_middle_of_a_motion_leaves_no_arm_under_control(
    backend: str, build: Build, arm: SimulatedFranka
) -> None:
    adapter = build(backend=backend)
    adapter.reset()

    def lose() -> None:
        assert arm.truth()["mode"] == "kMove"
        raise Unavailable("camera left is gone", remedy="check its cable")

    with pytest.raises(Unavailable, match="camera left"):
        adapter.execute(AWAY, should_stop=never, on_step=after(12, lose))
    wait_for(lambda: arm.truth()["mode"] == "kIdle", "the arm to be let go of")
    assert adapter.arm.look().mode is Mode.IDLE
    arm.tell(heal=True, place=APART)
    adapter.reset()
    assert adapter.execute(AWAY, should_stop=never, on_step=lambda: None).end is EndReason.ARRIVED


def test_a_camera_that_is_lost_ends_no_motion_of_a_double_and_is_told(
    worker: StillWorker, arm_double: StillArm, eyes_double: StillEyes, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker.robot.reset(seed=None)

    def lose(happened: list[int] = []) -> bool:  # noqa: B006  counts over all calls
        happened.append(1)
        eyes_double.gone = len(happened) > 20
        return False

    monkeypatch.setattr(worker.robot, "_must_stop", lose)
    monkeypatch.setattr("server.workers.robot.FRAME_INTERVAL", 0.0)
    done = execute(worker.robot, AWAY)
    assert eyes_double.gone
    assert (done["end"], done["violations"]) == ("arrived", [])
    assert arm_double.state().mode is Mode.IDLE
    told = [header["telemetry"] for header, jpeg in sent(worker) if not jpeg]
    assert "camera" in told[0]["calibration_detail"]
    with pytest.raises(Unavailable, match="is gone"):
        worker.robot.observe()


def test_eyes_that_break_during_a_motion_of_a_double_make_no_refusal_of_it(
    worker: StillWorker, arm_double: StillArm, eyes_double: StillEyes, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker.robot.reset(seed=None)

    def lose() -> bool:
        eyes_double.broken = bool(arm_double.orders)
        return False

    monkeypatch.setattr(worker.robot, "_must_stop", lose)
    done = execute(worker.robot, AWAY)
    assert done["low_level_steps"] > 5
    assert not done["arrived"]
    (violation,) = done["violations"]
    assert violation["kind"] == "manual_reset"
    assert "calibration can't be read" in violation["detail"]
    assert arm_double.state().mode is Mode.IDLE
    eyes_double.broken = False
    monkeypatch.undo()
    eyes_double.lost = True
    orders = len(arm_double.orders)
    with pytest.raises(Unavailable, match="hidden"):  # before it has begun, it is one
        execute(worker.robot, AWAY, 2)
    assert len(arm_double.orders) == orders


def test_an_arm_double_that_is_driven_while_a_stop_is_latched_is_stopped(
    worker: StillWorker, arm_double: StillArm
) -> None:
    arm_double.begin()
    worker.robot.refresh()
    assert arm_double.state().mode is Mode.MOVING
    worker.stop()

    def idle() -> bool:
        worker.robot.refresh()
        return arm_double.state().mode is Mode.IDLE

    wait_for(idle, "the worker to look at the arm again")


def test_eyes_that_break_at_rest_refuse_at_a_double_and_end_no_worker(
    worker: StillWorker, arm_double: StillArm, eyes_double: StillEyes
) -> None:
    eyes_double.broken = True
    worker.robot.refresh()
    told = worker.robot.adapter.telemetry()  # type: ignore[attr-defined]
    assert "calibration can't be read" in told.calibration_detail
    with pytest.raises(Unavailable, match="calibration can't be read"):
        worker.robot.observe()
    assert not arm_double.orders


def sent(worker: StillWorker) -> Iterator[tuple[dict[str, dict[str, str]], bytes]]:
    """What the worker has sent for the page, header and picture."""
    worker.frames.setblocking(False)
    data = worker.frames.recv(1 << 22)
    while data:
        (size,), data = struct.unpack(">I", data[:4]), data[4:]
        (head,) = struct.unpack(">I", data[:4])
        yield json.loads(data[4 : 4 + head]), data[4 + head : size]
        data = data[size:]
