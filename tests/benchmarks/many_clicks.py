"""What everybody's figures take of very many clicks by five trainers, beside reading the same clicks as row objects.

`BENCH_LABELS` is how many (default 100,000: time and memory grow in proportion).
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import resource
import sqlite3
import tempfile
import time
from collections.abc import Awaitable, Callable
from pathlib import Path

from sqlalchemy import select
from sqlalchemy.orm import Session

from server.models import FeedbackRow, ProposalRow, TrainerRow
from server.store import Store
from tests.benchmarks.result import Result
from tests.server.databases import click, opened, running
from tests.server.long_past import TRAINERS, lengthen

CROWD = (*TRAINERS, "Dan", "Eve")
_MORE = """
INSERT INTO feedback (click_id, experiment_id, proposal_id, trainer_id, value, status, received_at)
SELECT 'more-' || f.id || '-' || t.id, f.experiment_id, f.proposal_id, t.id,
       CASE WHEN (7 * f.id + 3 * t.id) % 5 = 0 THEN -f.value ELSE f.value END, 'overtaken', f.received_at
FROM feedback f JOIN trainer t ON t.id <> f.trainer_id
WHERE f.click_id LIKE 'past-%' AND t.kind = 'person' AND t.name IN ('Ann', 'Bo', 'Cleo', 'Dan', 'Eve')
"""


def run() -> Result:
    """Seconds until the figures are there."""
    count = int(os.environ.get("BENCH_LABELS", "100000"))
    with tempfile.TemporaryDirectory() as folder:
        return asyncio.run(_measured(Path(folder), count))


async def _measured(folder: Path, count: int) -> Result:
    experiment_id = await _filled(folder, count)
    store = await Store.open(None, folder)
    try:
        estimate, for_estimate = await _costs(lambda: store.quality.measure(experiment_id))
        figures, for_figures = await _costs(lambda: store.quality.quality(experiment_id))
        rows, for_rows = await _costs(lambda: store.read(lambda session: _as_rows(session, experiment_id)))
    finally:
        await store.close()
    lines = (
        f"an estimate of the trainers: {estimate:.2f} s, {for_estimate:.0f} MB",
        f"everybody's figures, after it: {for_figures:.0f} MB more",
        f"row objects, after both: {for_rows:.0f} MB more",
    )
    return Result("many_clicks", figures, f"s for the figures of {count} clicks", baseline=rows, lines=lines)


async def _filled(folder: Path, count: int) -> int:
    """An experiment of five trainers, each of whom judged every proposal."""
    store = await Store.open(None, folder)
    experiment_id = await running(store)
    await store.submit_feedback((await opened(store, experiment_id)).id, click(-1))
    await store.close()
    lengthen(folder / "seed.db", experiment_id, count // len(CROWD))
    with contextlib.closing(sqlite3.connect(folder / "seed.db")) as database, database:
        for name in CROWD:
            row = (name, "person", "2026-01-01 00:00:00.000000")
            database.execute("INSERT OR IGNORE INTO trainer (name, kind, created_at) VALUES (?, ?, ?)", row)
        database.execute(_MORE)
    return experiment_id


def _as_rows(session: Session, experiment_id: int) -> None:
    """All clicks at once, as objects, without any figure being made of them."""
    columns = (FeedbackRow.proposal_id, FeedbackRow.trainer_id, TrainerRow.name, FeedbackRow.value, FeedbackRow.status)
    query = select(*columns, FeedbackRow.label, FeedbackRow.received_at, ProposalRow.verdict)
    query = query.join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
    query = query.join(TrainerRow, TrainerRow.id == FeedbackRow.trainer_id)
    session.execute(query.where(FeedbackRow.experiment_id == experiment_id).order_by(FeedbackRow.id)).all()


async def _costs(act: Callable[[], Awaitable[object]]) -> tuple[float, float]:
    """Seconds, and by how many megabytes the most that this process ever had has grown."""
    before, began = _megabytes(), time.perf_counter()
    await act()
    return time.perf_counter() - began, _megabytes() - before


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
