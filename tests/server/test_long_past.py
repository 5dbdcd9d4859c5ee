"""However long an experiment's past is, no answer grows with it: it comes in pages, sums and thinned-out curves.

How long the answers take at 10^5 proposals is measured by `python -m tests.benchmarks long_past`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.server.long_past import PAGES, TRAINERS, lengthen
from tests.server.serving import serving

PROPOSALS = 3000
LARGEST = 600_000
"""Bytes: a hundred proposals with their overlays."""


@pytest.fixture
async def long(tmp_path: Path) -> tuple[Path, int]:
    """A data directory, and the experiment in it that has a long past."""
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(-1))
        await live.http.post(f"/api/v1/experiments/{experiment}/pause")
    lengthen(tmp_path / "seed.db", experiment, PROPOSALS)
    return tmp_path, experiment


async def test_no_answer_grows_with_the_past(long: tuple[Path, int]) -> None:
    folder, experiment = long
    async with serving(folder) as live:
        told: dict[str, Any] = {}
        for path in PAGES:
            answer = await live.http.get("/api/v1" + path.format(id=experiment))
            assert answer.status_code == 200, answer.text
            assert len(answer.content) < LARGEST, path
            told[path] = answer.json()
        assert told["/experiments/{id}"]["counters"]["feedback"] == PROPOSALS + 1
        charts = told["/experiments/{id}/curves"]["charts"]
        assert {"successes", "success_rate", "skills", "throughput", "estimate_error"} <= {c["name"] for c in charts}
        assert max(len(curve["x"]) for chart in charts for curve in chart["curves"]) <= 1001
        assert {each["trainer"] for each in told["/experiments/{id}/quality"]["trainers"]} >= set(TRAINERS)
        violated = told["/experiments/{id}/history?limit=100&violation=true"]["items"]
        assert 0 < len(violated) <= 100
        table = await live.http.get(f"/api/v1/experiments/{experiment}/exports/feedback?format=csv")
        assert table.text.count("\n") == PROPOSALS + 2
