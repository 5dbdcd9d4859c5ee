"""The simulated Franka through the whole service: Stacking, an operator or a server that is gone, a frozen worker."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import numpy as np
import pytest

from robot_adapters.registry import task
from tests.live import LiveService, wait_for
from tests.robot_adapters.franka.conftest import APART, BLOCKS, TABLE
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import PATIENCE, Session, worker_of

pytestmark = pytest.mark.simulated_arm

EPISODES = 20
both = pytest.mark.parametrize("backend", ["franka_rs", "franky"])
second_is_long = pytest.mark.parametrize("backend", ["franka_rs", pytest.param("franky", marks=pytest.mark.long)])


@pytest.fixture
def lab() -> Iterator[SimulatedFranka]:
    with SimulatedFranka(table=TABLE, blocks=BLOCKS) as simulated:
        simulated.tell(place=APART)
        yield simulated


@both
def test_stacking_from_the_first_look_to_the_last_pause(
    backend: str, service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(service, lab, backend)
    assert session.mode == "propose_only"
    service.post(f"{session.path}/start")
    first = session.proposal()
    assert (first["skill"], {v["camera"] for v in first["views"]}) == ("pick", {"left", "right"})
    session.approve(first)
    second = session.proposal()  # propose only: the next one is of the same scene

    session.patch(mode="execute_approved")
    session.approve(second)
    third = session.proposal()  # nobody is at the robot
    refused = service.get(f"/proposals/{second['id']}")["gate"]
    assert (refused["allowed"], refused["reason"]) == (False, "a real robot needs an operator present")
    assert session.executions() == []

    with session.attended():
        session.approve(third)
        assert session.ended(1)["outcome"] == "succeeded"
        session.approve(session.proposal())
        placed = session.ended(2)
        assert (placed["outcome"], placed["task_success"]) == ("succeeded", True)
        session.lifecycle("paused")  # somebody has to lay the next episode out
        (asked,) = [
            e for e in service.get(f"{session.path}/events?limit=50")["items"] if e["kind"] == "operator_needed"
        ]
        assert "success" in asked["payload"]["why"][0]
        assert service.http.post(f"/api/v1{session.path}/home?operator=anna", timeout=PATIENCE).is_success
        assert abs(lab.truth()["tip"][0] - 0.307) < 0.01
    service.post(f"{session.path}/finish")


@second_is_long
def test_an_operator_who_leaves_or_says_no_more_ends_the_motion(
    backend: str, service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(service, lab, backend)
    service.post(f"{session.path}/start")
    session.patch(mode="execute_approved")
    first = session.proposal()
    lab.tell(paced=True)  # so that no skill is over before they have left, or their lease is
    session.attend(30.0)
    session.approve(first)
    session.moving()
    session.leave()
    assert session.ended(1)["outcome"] == "stopped"
    session.idle()

    next_one = session.proposal()
    session.attend(30.0)
    session.approve(next_one)
    session.moving()
    session.attend(1.5)
    assert session.ended(2)["outcome"] == "stopped"  # the lease ran out, and nobody took it anew
    session.idle()
    service.post(f"{session.path}/finish")


@second_is_long
def test_a_driver_that_is_frozen_for_300_ms_is_stopped_by_the_robot(
    backend: str, service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(service, lab, backend)
    service.post(f"{session.path}/start")
    session.patch(mode="execute_approved")
    first = session.proposal()
    start, pid = lab.truth()["tip"], worker_of(service)
    lab.tell(paced=True)  # so that it still moves when it is frozen
    with session.attended():
        session.approve(first)
        session.moving()
        # a client doesn't answer its motion's first states, so none of those counts as lost
        wait_for(lambda: np.linalg.norm(np.subtract(lab.truth()["tip"], start)) > 0.01, "the arm to move", PATIENCE)
        lab.tell(lock_step=False)  # a real arm doesn't wait for anybody
        os.kill(pid, signal.SIGSTOP)
        frozen = lab.truth()
        try:
            wait_for(lambda: lab.truth()["clock"] > frozen["clock"] + 0.3, "300 ms of the robot's clock")
            after = lab.truth()
        finally:
            os.kill(pid, signal.SIGCONT)
            lab.tell(lock_step=True)
        assert after["mode"] == "kReflex"
        assert np.linalg.norm(np.subtract(after["tip"], frozen["tip"])) < 0.03
        broken = session.ended(1)
        assert broken["outcome"] in {"failed", "stopped"}
        wait_for(lambda: service.get(session.path)["halted"], "the stop to be latched", PATIENCE)
        assert service.http.post(f"/api/v1{session.path}/home?operator=anna").status_code == 409
        service.post(f"{session.path}/rearm")
        service.post(f"{session.path}/recover?operator=anna")
        lab.tell(place=APART, paced=False)
        service.post(f"{session.path}/resume")
        session.approve(session.proposal())
        assert session.ended(2)["outcome"] == "succeeded"
    service.post(f"{session.path}/finish")


@second_is_long
def test_a_server_that_dies_ends_the_motion_and_nothing_goes_on_by_itself(
    backend: str, own_service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(own_service, lab, backend)
    own_service.post(f"{session.path}/start")
    session.patch(mode="execute_approved")
    first = session.proposal()
    lab.tell(paced=True)  # so that it still moves when the server dies
    session.attend(30.0)
    session.approve(first)
    session.moving()
    own_service.kill()
    session.idle()
    stood = lab.truth()["tip"]
    own_service.start()
    assert own_service.get(session.path)["lifecycle"] == "paused"
    (ran,) = session.executions()
    assert ran["outcome"] == "interrupted"
    assert np.linalg.norm(np.subtract(lab.truth()["tip"], stood)) < 0.01


@pytest.mark.long
@both
def test_twenty_episodes_of_stacking_by_the_scripted_algorithm(
    backend: str, service: LiveService, lab: SimulatedFranka
) -> None:
    stacking = task("stacking")
    session = Session(service, lab, backend)
    session.patch(mode="execute_approved")
    missed, off = [], []
    with session.attended():
        for seed in range(EPISODES):
            drawn = stacking.sample_layout(np.random.default_rng(seed))
            layout = {name: drawn[name].tolist() for name in BLOCKS}
            stacked, millimetres, told = session.stacked(layout, BLOCKS)
            off.append(millimetres)
            if not stacked:
                missed.append(f"seed {seed}: {told}")
    print(f"{backend}: placed {np.median(off):.1f} mm off at the median, {max(off):.1f} mm at worst")
    assert not missed
    assert max(off) < 5.0
    service.post(f"{session.path}/finish")
