"""What a page's questions take when an experiment has 10^5 proposals: the slowest of them, beside the same of 10^3.

`BENCH_PROPOSALS` is how many.
"""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path

from tests.benchmarks.result import Result
from tests.live import LiveService, wait_for
from tests.server.long_past import PAGES, lengthen

FEW = 1000
TRIES = 3


def run() -> Result:
    """Each question's best of three, in seconds; the table's until its last row."""
    count = int(os.environ.get("BENCH_PROPOSALS", "100000"))
    with tempfile.TemporaryDirectory() as folder:
        few, many = (measured(Path(folder) / str(proposals), proposals) for proposals in (FEW, count))
    lines = [f"{many[path]:7.3f} s, {few[path]:.3f} s of {FEW}: {path}" for path in many]
    slowest = max(PAGES, key=lambda path: many[path])
    return Result("long_past", many[slowest], f"s: {slowest}", baseline=few[slowest], lines=tuple(lines))


def measured(folder: Path, proposals: int) -> dict[str, float]:
    """Question -> seconds, of a service whose one experiment has so many proposals."""
    folder.mkdir()
    service = LiveService(folder / "data")
    service.start()
    experiment = service.experiment(adapter="kinematic", teacher="synthetic")
    service.post(f"/experiments/{experiment}/start")
    wait_for(lambda: service.get(f"/experiments/{experiment}")["counters"]["feedback"] >= 2, "a label")
    service.post(f"/experiments/{experiment}/finish")
    service.stop()
    lengthen(folder / "data" / "seed.db", experiment, proposals)
    service.start()
    try:
        paths = [*PAGES, "/experiments/{id}/exports/feedback?format=csv"]
        return {path: min(seconds(service, path.format(id=experiment)) for _ in range(TRIES)) for path in paths}
    finally:
        service.stop()


def seconds(service: LiveService, path: str) -> float:
    """Until the last byte of the answer."""
    began = time.perf_counter()
    service.http.get(f"/api/v1{path}", timeout=600).raise_for_status()
    return time.perf_counter() - began
