"""Opens proposals and clicks on them until it is killed; prints every click once it has been acknowledged."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path

from server.store import Store
from tests.server.databases import click, opened, running

ROUND = 4
"""Clicks that are under way at once."""


async def _run(url: str, data_dir: Path, name: str) -> None:
    store = await Store.open(url, data_dir)
    await store.recover()
    experiments = [await running(store) for _ in range(ROUND)]
    number = 0
    while True:
        number += 1
        await asyncio.gather(*[_one(store, e, f"{name}-{number:06}-{e}", number) for e in experiments])


async def _one(store: Store, experiment_id: int, click_id: str, number: int) -> None:
    proposal = await opened(store, experiment_id, f"o{number}")
    value = number % 3 - 1
    await store.submit_feedback(proposal.id, click(value, click_id))
    print(click_id, proposal.id, value, flush=True)


if __name__ == "__main__":
    asyncio.run(_run(sys.argv[1], Path(sys.argv[2]), sys.argv[3]))
