"""Real-time priority: for the loop at 1 kHz where it is wanted, and for no thread of Python's."""

from __future__ import annotations

import contextlib
import os
import threading
from pathlib import Path

import pytest

from robot_adapters.base import EndReason, SkillCall
from robot_adapters.franka.scheduling import inherited
from tests.robot_adapters.franka.conftest import TABLE, Build, never


def policies() -> set[int]:
    """Of all threads of this process, some of which another test may have left, and which may end meanwhile."""
    found = set()
    for task in Path("/proc/self/task").iterdir():
        with contextlib.suppress(ProcessLookupError):
            found.add(os.sched_getscheduler(int(task.name)))
    return found


@pytest.mark.parametrize("realtime", [False, True])
def test_a_thread_that_is_started_inside_has_it_and_the_one_that_starts_it_keeps_its_own(realtime: bool) -> None:
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    except PermissionError:
        pytest.skip("no right to real-time priority here")
    told: list[int] = []
    thread = threading.Thread(target=lambda: told.append(os.sched_getscheduler(0)))
    with inherited(realtime=realtime):
        thread.start()
    thread.join()
    assert told == [os.SCHED_FIFO if realtime else os.SCHED_OTHER]
    assert os.sched_getscheduler(0) == os.SCHED_OTHER


@pytest.mark.simulated_arm
@pytest.mark.parametrize("backend", ["franka_rs", "franky"])
def test_a_driver_that_need_not_be_in_time_takes_no_core_from_anybody(backend: str, build: Build) -> None:
    adapter = build(backend=backend)
    seen, steps = policies(), 0

    def look() -> None:
        nonlocal steps
        steps += 1
        seen.update(policies())

    away = SkillCall("place", (0.65, 0.10, TABLE + 0.10))
    result = adapter.execute(away, should_stop=lambda: steps >= 10, on_step=look)
    assert result.end is EndReason.STOPPED
    assert adapter.home(should_stop=never, on_step=look)
    assert not seen & {os.SCHED_FIFO, os.SCHED_RR}
