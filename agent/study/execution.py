"""A study's runs in parallel processes: spawned, one thread each, ended with their parent."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.connection import wait as wait_for_any
from multiprocessing.synchronize import Event
from pathlib import Path

from agent.algorithm import AgentError
from agent.study.algorithms import Builders
from agent.study.plan import Plan, Run
from agent.study.records import Folder, Progress
from agent.study.runs import work

POLL = 0.25
"""s between two looks at how far the runs are."""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

_stop: Event


class ProcessDied(AgentError):
    """A run's process was killed, by the system or by somebody."""


def execute(plan: Plan, path: Path, builders: Builders, jobs: int, watch: Callable[[], None]) -> dict[str, Progress]:
    """Do every run that isn't finished, at most `jobs` at a time; how each ended.

    A run whose oracle is trained by another waits for that one. `watch` is called now and then; an exception of its
    (or a KeyboardInterrupt) ends all runs in order: they go on from their last checkpoint when asked again.

    Raises:
        ProcessDied: a run's process ended on its own.
    """
    folder = Folder(path)
    ended = {run.id: folder.progress(run.id, live=False) for run in plan.runs}
    todo = [group for group in plan.groups if any(ended[run.id].state != "finished" for run in group)]
    if not todo:
        return ended
    for name in THREADS:  # read when a library is loaded, so it has to be there before a process starts
        os.environ.setdefault(name, "1")
    context = multiprocessing.get_context("spawn")
    stop = context.Event()
    pool = ProcessPoolExecutor(min(jobs, len(todo)), context, _begin, (stop,))
    going: dict[Future[Sequence[Progress]], Sequence[Run]] = {}
    try:
        while todo or going:
            busy = {run.id for group in [*going.values(), *todo] for run in group}
            ready = [group for group in todo if not any(run.oracle in busy for run in group)]
            for group in ready[: jobs - len(going)]:
                todo.remove(group)
                going[pool.submit(_work, group, plan, path, builders)] = group
            for future in wait(going, timeout=POLL, return_when=FIRST_COMPLETED).done:
                ended |= {run.id: each for run, each in zip(going.pop(future), future.result(), strict=True)}
            watch()
    except BrokenProcessPool as error:
        raise ProcessDied(
            "a run's process died, perhaps for want of memory",
            remedy="go on by --resume, with fewer --jobs",
        ) from error
    finally:
        stop.set()
        pool.shutdown(cancel_futures=True)
    return ended


def _work(group: Sequence[Run], plan: Plan, path: Path, builders: Builders) -> Sequence[Progress]:
    return work(group, plan, path, builders, _stop.is_set)


def _begin(stop: Event) -> None:
    """In each process: hear the parent's word only, and end with it."""
    global _stop  # noqa: PLW0603  a pool's processes get their surroundings so
    _stop = stop
    follow_parent()


def follow_parent() -> None:
    """In a child process: leave Ctrl-C, which reaches the whole group, to the parent, and end when it is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait_for_any([parent.sentinel])
        os._exit(1)
