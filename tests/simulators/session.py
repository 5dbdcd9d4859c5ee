"""One experiment at a simulated arm through the whole service, with an operator who attends, approves and lays out."""

from __future__ import annotations

import contextlib
import itertools
import os
import threading
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from robot_adapters.registry import task
from tests.live import LiveService, wait_for
from tests.simulators.franka import SimulatedFranka

PATIENCE = 120.0
UNHURRIED = 5.0
"""s of the dead-man timer where a busy machine is no fault of the arm's."""
clicks = itertools.count(1)


class Session:
    """One experiment on the arm, with an operator at it."""

    def __init__(self, service: LiveService, lab: SimulatedFranka, backend: str, **settings: Any) -> None:
        """Create it. settings: more of the adapter's."""
        self.service, self.lab = service, lab
        given = {
            "host": lab.host,
            "backend": backend,
            "realtime": False,
            "dead_man": UNHURRIED,
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
                "adapter_settings": given | settings,
            },
        )
        self.mode, self.path = made["mode"], f"/experiments/{made['id']}"
        self._judged = 0

    def patch(self, **fields: Any) -> None:
        """Change the experiment."""
        assert self.service.http.patch(f"/api/v1{self.path}", json=fields).is_success

    def attend(self, seconds: float = 5.0) -> None:
        """Say once that somebody is there, for so long."""
        body = {"operator": "anna", "seconds": seconds}
        assert self.service.http.put(f"/api/v1{self.path}/attendance", json=body).is_success

    def leave(self) -> None:
        """Say that nobody is there any more."""
        gone = self.service.http.delete(f"/api/v1{self.path}/attendance", params={"operator": "anna"})
        assert gone.is_success

    @contextlib.contextmanager
    def attended(self) -> Iterator[None]:
        """Somebody says every half second that they are there."""
        gone = threading.Event()

        def stay() -> None:
            while not gone.wait(0.5):
                self.attend()

        self.attend()
        thread = threading.Thread(target=stay)
        thread.start()
        try:
            yield
        finally:
            gone.set()
            thread.join()

    def proposal(self, after: int | None = None) -> dict[str, Any]:
        """The open one, newer than `after`, or than what was approved last."""
        newer = self._judged if after is None else after

        def newest() -> dict[str, Any] | None:
            state = self.service.get(self.path)
            assert state["lifecycle"] != "failed", state["failure"]
            items = self.service.get(f"{self.path}/proposals?limit=5")["items"]
            return next((p for p in items if p["closed_at"] is None and p["id"] > newer), None)

        return wait_for(newest, "a proposal", PATIENCE)

    def approve(self, proposal: dict[str, Any]) -> None:
        """Judge it good."""
        self._judged = proposal["id"]
        body = {"click_id": f"franka-{next(clicks)}", "value": 1}
        self.service.post(f"/proposals/{proposal['id']}/feedback", body)

    def executions(self) -> list[dict[str, Any]]:
        """The newest of them, in their order."""
        return list(reversed(self.service.get(f"{self.path}/executions?limit=100")["items"]))

    def ended(self, count: int) -> dict[str, Any]:
        """The execution of this number, once it has ended."""

        def last() -> dict[str, Any] | None:
            found = self.executions()
            return found[count - 1] if len(found) >= count and found[count - 1]["ended_at"] else None

        return wait_for(last, f"execution {count} to end", PATIENCE)

    def lifecycle(self, wanted: str) -> None:
        """Wait until it is there."""
        wait_for(lambda: self.service.get(self.path)["lifecycle"] == wanted, f"the experiment to be {wanted}", PATIENCE)

    def moving(self) -> None:
        """Wait until the arm is driven."""
        wait_for(lambda: self.lab.truth()["mode"] == "kMove", "the arm to move", PATIENCE)

    def idle(self) -> None:
        """Wait until nothing drives it any more."""
        wait_for(lambda: self.lab.truth()["mode"] == "kIdle", "the arm to be let go of", PATIENCE)

    def stacked(self, layout: Mapping[str, list[float]], blocks: Mapping[str, float]) -> tuple[bool, float, str]:
        """Lay out and approve to the end of the episode.

        Whether a is on b in truth, how many mm from its place it was put, and what happened in words.
        """
        done = len(self.executions())
        self.lab.tell(place=dict(layout))
        self.service.post(f"{self.path}/resume" if done else f"{self.path}/start")
        told, off = [], 0.0
        for _ in range(task("stacking").horizon):
            proposal = self.proposal()
            self.approve(proposal)
            done += 1
            ran = self.ended(done)
            told.append(f"{proposal['skill']} {ran['outcome']}")
            if proposal["skill"] == "place":
                there = np.array(self.lab.truth()["blocks"]["block_a"][:2])
                wanted = [proposal["parameters"][axis] for axis in "xy"]
                off = 1e3 * float(np.linalg.norm(there - wanted))
            if ran["task_success"]:
                break
        self.lifecycle("paused")
        at = self.lab.truth()["blocks"]
        height = at["block_a"][2] - at["block_b"][2]
        return bool(ran["task_success"]) and abs(height - sum(blocks.values())) < 0.005, off, ", ".join(told)


def worker_of(service: LiveService) -> int:
    """The newest process of this service that drives an arm: the one before may still be on its way out."""
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            with contextlib.suppress(OSError):
                theirs = os.getsid(int(folder.name)) == service.pid
                if theirs and b"server.workers.robot" in (folder / "cmdline").read_bytes():
                    found.append(int(folder.name))
    assert found, "no robot worker"
    return max(found)
