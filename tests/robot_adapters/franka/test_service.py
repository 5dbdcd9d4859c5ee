"""The simulated Franka through the whole service: Stacking, an operator who leaves, and a worker that freezes."""

from __future__ import annotations

import contextlib
import itertools
import os
import signal
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.live import LiveService, wait_for
from tests.robot_adapters.franka.conftest import APART, BLOCKS, TABLE
from tests.simulators.franka import SimulatedFranka

pytestmark = pytest.mark.simulated_arm

PATIENCE = 120.0
clicks = itertools.count(1)


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveService]:
    live = LiveService(tmp_path_factory.mktemp("service") / "data")
    live.start()
    yield live
    live.stop()


@pytest.fixture
def lab() -> Iterator[SimulatedFranka]:
    with SimulatedFranka(table=TABLE, blocks=BLOCKS) as simulated:
        simulated.tell(place=APART)
        yield simulated


class Session:
    """One experiment on the arm, with an operator at it."""

    def __init__(self, service: LiveService, lab: SimulatedFranka, backend: str) -> None:
        self.service = service
        settings = {
            "host": lab.host,
            "backend": backend,
            "realtime": False,
            "eyes": "onlooker",
            "eyes_settings": {"host": lab.host},
        }
        made = service.post(
            "/experiments",
            {
                "name": "Real",
                "task": "stacking",
                "adapter": "franka",
                "algorithm": "scripted",
                "adapter_settings": settings,
            },
        )
        self.mode, self.path = made["mode"], f"/experiments/{made['id']}"
        self._gone = threading.Event()

    def patch(self, **fields: Any) -> None:
        assert self.service.http.patch(f"/api/v1{self.path}", json=fields).is_success

    def attend(self, seconds: float = 5.0) -> None:
        body = {"operator": "anna", "seconds": seconds}
        assert self.service.http.put(f"/api/v1{self.path}/attendance", json=body).is_success

    @contextlib.contextmanager
    def attended(self) -> Iterator[None]:
        """Somebody says every half second that they are there."""
        gone = threading.Event()

        def stay() -> None:
            while not gone.wait(0.5):
                self.attend(3.0)

        self.attend(3.0)
        thread = threading.Thread(target=stay)
        thread.start()
        try:
            yield
        finally:
            gone.set()
            thread.join()

    def proposal(self, after: int = 0) -> dict[str, Any]:
        """The open one, newer than `after`."""

        def newest() -> dict[str, Any] | None:
            state = self.service.get(self.path)
            assert state["lifecycle"] != "failed", state["failure"]
            items = self.service.get(f"{self.path}/proposals?limit=5")["items"]
            return next((p for p in items if p["closed_at"] is None and p["id"] > after), None)

        return wait_for(newest, "a proposal", PATIENCE)

    def approve(self, proposal: dict[str, Any]) -> None:
        body = {"click_id": f"franka-{next(clicks)}", "value": 1}
        self.service.post(f"/proposals/{proposal['id']}/feedback", body)

    def executions(self) -> list[dict[str, Any]]:
        return list(reversed(self.service.get(f"{self.path}/executions")["items"]))

    def ended(self, count: int) -> dict[str, Any]:
        """The execution of this number, once it has ended."""

        def last() -> dict[str, Any] | None:
            found = self.executions()
            return found[count - 1] if len(found) >= count and found[count - 1]["ended_at"] else None

        return wait_for(last, f"execution {count} to end", PATIENCE)

    def lifecycle(self, wanted: str) -> None:
        wait_for(lambda: self.service.get(self.path)["lifecycle"] == wanted, f"the experiment to be {wanted}", PATIENCE)


@pytest.mark.parametrize("backend", ["franka_rs", "franky"])
def test_stacking_from_the_first_look_to_the_last_pause(
    backend: str, service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(service, lab, backend)
    assert session.mode == "propose_only"
    service.post(f"{session.path}/start")
    first = session.proposal()
    assert (first["skill"], {v["camera"] for v in first["views"]}) == ("pick", {"left", "right"})
    session.approve(first)
    second = session.proposal(first["id"])  # propose only: the next one is of the same scene

    session.patch(mode="execute_approved")
    session.approve(second)
    third = session.proposal(second["id"])  # nobody is at the robot
    refused = service.get(f"/proposals/{second['id']}")["gate"]
    assert (refused["allowed"], refused["reason"]) == (False, "a real robot needs an operator present")
    assert session.executions() == []

    with session.attended():
        session.approve(third)
        assert session.ended(1)["outcome"] == "succeeded"
        session.approve(session.proposal(third["id"]))
        placed = session.ended(2)
        assert (placed["outcome"], placed["task_success"]) == ("succeeded", True)
        session.lifecycle("paused")  # somebody has to lay the next episode out
        (asked,) = [
            e for e in service.get(f"{session.path}/events?limit=50")["items"] if e["kind"] == "operator_needed"
        ]
        assert "success" in asked["payload"]["why"][0]
        assert service.http.post(f"/api/v1{session.path}/home", timeout=PATIENCE).is_success
        assert abs(lab.truth()["tip"][0] - 0.307) < 0.01
    service.post(f"{session.path}/finish")


def test_an_operator_who_leaves_ends_the_motion_and_a_frozen_worker_is_stopped_by_the_robot(
    service: LiveService, lab: SimulatedFranka
) -> None:
    session = Session(service, lab, "franka_rs")
    service.post(f"{session.path}/start")
    session.patch(mode="execute_approved")
    first = session.proposal()
    session.attend()
    session.approve(first)
    wait_for(lambda: lab.truth()["mode"] == "kMove", "the arm to move")
    assert service.http.delete(f"/api/v1{session.path}/attendance", params={"operator": "anna"}).is_success
    assert session.ended(1)["outcome"] == "stopped"

    with session.attended():
        session.approve(session.proposal(first["id"]))
        wait_for(lambda: lab.truth()["mode"] == "kMove", "the arm to move")
        pid = worker_of(service)
        lab.tell(lock_step=False)  # a real arm doesn't wait for anybody
        os.kill(pid, signal.SIGSTOP)
        try:
            wait_for(lambda: lab.truth()["mode"] == "kReflex", "the robot to stop itself")
        finally:
            os.kill(pid, signal.SIGCONT)
            lab.tell(lock_step=True)
        broken = session.ended(2)
        assert broken["outcome"] in {"failed", "stopped"}
        wait_for(lambda: service.get(session.path)["halted"], "the stop to be latched", PATIENCE)
        assert service.http.post(f"/api/v1{session.path}/home").status_code == 409
        service.post(f"{session.path}/rearm")
        service.post(f"{session.path}/recover")
        lab.tell(place=APART)
        service.post(f"{session.path}/resume")
        session.approve(session.proposal(broken["proposal_id"]))
        assert session.ended(3)["outcome"] == "succeeded"
    service.post(f"{session.path}/finish")


def worker_of(service: LiveService) -> int:
    """The process of this service that drives the arm."""
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            with contextlib.suppress(OSError):
                theirs = os.getsid(int(folder.name)) == service.pid
                if theirs and b"server.workers.robot" in (folder / "cmdline").read_bytes():
                    return int(folder.name)
    raise AssertionError("no robot worker")
