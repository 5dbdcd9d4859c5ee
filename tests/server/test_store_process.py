"""The process that writes for `seed serve`: what it refuses comes back whole, and nobody outlives the other."""

from __future__ import annotations

import inspect
import os
import pickle
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from server.store import Store
from server.store_errors import BadCursor, Conflict, Full, NotFound, StoreError
from server.store_people import PeopleStore, WrongToken
from server.store_quality import QualityStore
from tests.live import LiveService, gone, wait_for


@pytest.fixture
def service(tmp_path: Path) -> Iterator[LiveService]:
    """One that isn't started yet."""
    made = LiveService(tmp_path / "data")
    yield made
    made.sweep()
    made.http.close()


def _click(service: LiveService, experiment: int, click_id: str) -> int:
    """Say bad to what is open; the proposal's id."""

    def opened() -> int:
        proposals = service.get(f"/experiments/{experiment}/proposals?limit=1")["items"]
        return int(proposals[0]["id"]) if proposals and proposals[0]["closed_at"] is None else 0

    proposal = wait_for(opened, "a proposal")
    service.post(f"/proposals/{proposal}/feedback", {"click_id": click_id, "value": -1, "trainer": "ann"})
    return proposal


def test_a_service_whose_writer_is_killed_ends_and_its_next_start_goes_on(service: LiveService) -> None:
    service.start()
    experiment = service.experiment(adapter="kinematic", mode="propose_only")
    service.post(f"/experiments/{experiment}/start")
    judged = _click(service, experiment, "click-before")
    os.kill(service.writer, signal.SIGKILL)
    assert service._process is not None
    assert service._process.wait(30) != 0
    assert "the process that writes to the database has ended; the service ends" in service.log()

    service.start()
    assert service.get(f"/experiments/{experiment}")["lifecycle"] == "paused"
    assert [row["proposal_id"] for row in service.rows("SELECT proposal_id FROM feedback")] == [judged]
    service.post(f"/experiments/{experiment}/resume")
    assert _click(service, experiment, "click-after") != judged


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_the_writer_ends_with_its_service_and_not_before(service: LiveService, how: signal.Signals) -> None:
    service.start()
    writer = service.writer
    os.kill(writer, signal.SIGTERM)  # as everything of a service gets it from a supervisor or a terminal
    os.kill(writer, signal.SIGINT)
    service.experiment(adapter="kinematic")
    os.kill(service.pid, how)
    assert service._process is not None
    service._process.wait(30)
    wait_for(lambda: gone(writer), "the writer to end")


def test_every_method_that_writes_is_marked_for_the_writer() -> None:
    for part in (Store, PeopleStore, QualityStore):
        for name, method in inspect.getmembers(part, inspect.iscoroutinefunction):
            where = inspect.unwrap(method)
            if "_database.write(" in inspect.getsource(where):
                assert where is not method, f"{part.__name__}.{name}"


@pytest.mark.parametrize(
    "error",
    [
        StoreError("it failed", remedy="try again"),
        NotFound("proposal", 7),
        Conflict("no", remedy="wait", current="paused", allowed=["resume"]),
        BadCursor(),
        Full("disk"),
        WrongToken(),
    ],
)
def test_an_error_of_the_store_is_the_same_on_the_other_side(error: StoreError) -> None:
    other = pickle.loads(pickle.dumps(error))
    assert (type(other), str(other), other.__dict__) == (type(error), str(error), error.__dict__)
