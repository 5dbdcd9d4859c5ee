"""What an operator asks of the arm itself is a motion like any other: it can be stopped, whatever else goes on.

The robot is a double that says it is a real one and takes long to come home; service, worker and processes are real.
"""

from __future__ import annotations

import asyncio
import os
import signal
import threading
from pathlib import Path
from unittest import mock

import httpx
import pytest

from server.cli_serve import Server, config
from server.robots import Robot, Stops
from server.settings import Settings
from server.store import Store
from tests.live import LiveService, wait_for
from tests.plugins.seed_benchtop import HOMING
from tests.server.databases import created
from tests.server.serving import serving
from tests.server.test_errors import check_problem
from tests.simulators.session import worker_of

PATIENCE = 90.0
LONG = {"adapter": "benchtop", "adapter_settings": {"home_seconds": 600.0}}
HERE = {"operator": "anna", "seconds": 30}


def test_a_double_whose_worker_hangs_on_its_way_home_is_killed_by_a_stop(own_service: LiveService) -> None:
    path = f"/api/v1/experiments/{own_service.experiment(**LONG)}"
    assert own_service.http.put(f"{path}/attendance", json=HERE).is_success
    answers: list[httpx.Response] = []
    asked = threading.Thread(
        target=lambda: answers.append(
            httpx.post(f"{own_service.url}{path}/home?operator=anna", json={}, timeout=PATIENCE)
        )
    )
    asked.start()
    wait_for((own_service.data_dir / HOMING).exists, "the way home to begin", PATIENCE)
    pid = worker_of(own_service)
    os.kill(pid, signal.SIGSTOP)
    try:
        assert own_service.http.post(f"{path}/halt").json()["halted"] is True
        wait_for(lambda: not Path(f"/proc/{pid}").exists(), "the robot worker to be killed", PATIENCE)
    finally:
        own_service.sweep()
        asked.join()
    (answer,) = answers
    assert check_problem(answer, 503).type == "/problems/worker-died"


@pytest.mark.usefixtures("plugins")
async def test_a_double_on_its_way_home_is_stopped_when_the_service_ends(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        path = f"/api/v1/experiments/{await live.experiment(**LONG)}"
        assert (await live.http.put(f"{path}/attendance", json=HERE)).is_success
        asked = asyncio.create_task(live.http.post(f"{path}/home?operator=anna", json={}, timeout=PATIENCE))
        await asyncio.to_thread(wait_for, (tmp_path / HOMING).exists, "the way home to begin", PATIENCE)
        async with asyncio.timeout(PATIENCE):
            await live.service.hub.close()  # which would wait ten minutes for it
            assert (await asked).is_success
        events = (await live.http.get(f"{path}/events", params={"limit": 5})).json()["items"]
        (homed,) = [event for event in events if event["kind"] == "robot_homed"]
        assert homed["payload"]["arrived"] is False


def test_a_signal_is_heeded_before_requests_get_their_grace() -> None:
    server, happened = Server(config(None, Settings())), []
    server.on_end = lambda: happened.append(server.should_exit)
    server.handle_exit(signal.SIGTERM, None)
    assert happened == [False]
    assert server.should_exit


async def test_a_worker_double_hears_whether_it_is_attended_before_the_command(
    sqlite_store: Store, tmp_path: Path
) -> None:
    experiment = await created(sqlite_store)

    def yes() -> bool:
        return True

    def no() -> bool:
        return False

    for attended, told in ((yes, "keep_alive"), (no, "forsake")):
        robot = Robot(
            0,
            experiment,
            Settings(data_dir=tmp_path),
            Stops(),
            on_frame=None,
            on_change=mock.Mock(),
            on_told=mock.Mock(),
            attended=attended,
        )
        robot.post = mock.Mock()
        robot.post.worker.call = mock.AsyncMock(return_value={"arrived": True})
        await robot.home()
        assert [call[0] for call in robot.post.mock_calls][:2] == [told, "worker.call"]
