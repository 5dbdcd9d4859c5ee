"""How long a learner that starts anew takes to get very many stored labels through the service, while it is asked.

`BENCH_LABELS` is how many (default 20,000; a million takes 4.4 GB and about half an hour).
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.benchmarks.result import Result
from tests.live import LiveService, children, wait_for
from tests.server.long_past import lengthen

CLICKS = 10
"""While the older labels come; then nobody judges any more, and they must come all the same."""
LONGEST = 4 * 3600.0
"""s until it is given up."""


def run() -> Result:
    """Seconds from *resume* until the learner has all labels: `recommended` on Stacking, kinematic."""
    count = int(os.environ.get("BENCH_LABELS", "20000"))
    with tempfile.TemporaryDirectory() as folder:
        service = LiveService(Path(folder) / "data")
        service.start()
        fields = {"adapter": "kinematic", "algorithm": "seed", "preset": "recommended", "mode": "propose_only"}
        experiment = service.experiment(**fields)
        service.post(f"/experiments/{experiment}/start")
        _judge(service, _newest(service, experiment))
        _newest(service, experiment)
        service.post(f"/experiments/{experiment}/pause")
        wait_for(lambda: service.get(f"/experiments/{experiment}")["lifecycle"] == "paused", "the pause")
        service.stop()
        lengthen(service.data_dir / "seed.db", experiment, count)
        service.start()
        try:
            return _measured(service, experiment, count)
        finally:
            service.stop()


def _measured(service: LiveService, experiment: int, count: int) -> Result:
    before = service.rows("SELECT max(id) AS id FROM event")[0]["id"]
    began = time.monotonic()
    service.post(f"/experiments/{experiment}/resume")
    proposal = _newest(service, experiment, timeout=LONGEST)
    first, waits = time.monotonic() - began, []
    for _ in range(CLICKS):
        clicked = time.monotonic()
        _judge(service, proposal)
        proposal = _newest(service, experiment, timeout=LONGEST)
        waits.append(time.monotonic() - clicked)

    def all_taken() -> bool:
        time.sleep(0.5)
        return service.get(f"/experiments/{experiment}")["catching_up"] is None

    wait_for(all_taken, "the learner to have all labels", LONGEST)
    seconds = time.monotonic() - began
    clicked = time.monotonic()
    _judge(service, proposal)
    _newest(service, experiment)
    waits.append(time.monotonic() - clicked)
    wrong = ("worker_died", "labels_unusable", "checkpoint_unusable")
    query = f"SELECT kind FROM event WHERE id > ? AND kind IN ({', '.join('?' * len(wrong))})"
    told = [row["kind"] for row in service.rows(query, before, *wrong)]
    memory = " + ".join(f"{megabytes:.0f}" for megabytes in _megabytes(service.pid))
    lines = (
        f"first proposal after {first:.1f} s; then one {min(waits):.1f} to {max(waits):.1f} s after a click",
        f"at most {memory} MB: the service, and each of its workers",
        f"went wrong meanwhile: {', '.join(told) or 'nothing'}",
    )
    return Result("catching_up", seconds, f"s until the learner had {count} labels", ok=not told, lines=lines)


def _newest(service: LiveService, experiment: int, timeout: float = 60.0) -> dict[str, Any]:
    """The open proposal."""

    def find() -> dict[str, Any] | None:
        (newest,) = service.get(f"/experiments/{experiment}/proposals?limit=1")["items"] or [None]
        return newest if newest is not None and newest["closed_at"] is None else None

    return wait_for(find, "a proposal", timeout)


def _judge(service: LiveService, proposal: dict[str, Any]) -> None:
    service.post(f"/proposals/{proposal['id']}/feedback", {"click_id": f"bench-{proposal['id']:08}", "value": -1})


def _megabytes(pid: int) -> Iterator[float]:
    """What a process and each of its children ever had in memory."""
    for each in (pid, *children(pid)):
        status = Path(f"/proc/{each}/status").read_text("utf-8")
        yield int(status.split("VmHWM:")[1].split()[0]) / 1024
