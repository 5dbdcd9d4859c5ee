"""Keeps real-time priority where it belongs: drivers give it to whichever thread connects, which here is Python's.

A Python thread at SCHED_FIFO 99 takes a core from everything else, and what it starts inherits that. Measured on two
cores: tests that took seconds beside others then took minutes, and so did everybody else's.
"""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Iterator
from pathlib import Path

log = logging.getLogger(__name__)


@contextlib.contextmanager
def as_before() -> Iterator[None]:
    """Whatever happens inside, this thread is scheduled afterwards as it was before."""
    policy, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        yield
    finally:
        if os.sched_getscheduler(0) != policy:
            os.sched_setscheduler(0, policy, parameters)


@contextlib.contextmanager
def inherited(*, realtime: bool) -> Iterator[None]:
    """A thread that is started inside has the highest real-time priority if `realtime`; this one only meanwhile."""
    with as_before():
        if realtime:
            try:
                os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(os.sched_get_priority_max(os.SCHED_FIFO)))
            except PermissionError:
                log.warning("no right to real-time priority: the loop at 1 kHz may come late")
        yield


def ordinary(name: str) -> None:
    """Take real-time priority from this process's threads whose names begin like this."""
    for task in Path("/proc/self/task").iterdir():
        with contextlib.suppress(OSError):  # it has ended meanwhile
            if (task / "comm").read_text().startswith(name):
                os.sched_setscheduler(int(task.name), os.SCHED_OTHER, os.sched_param(0))
