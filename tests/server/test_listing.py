"""Experiments narrowed, ordered and tagged: on both databases, and over HTTP."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from server.schemas import ExperimentUpdate
from server.schemas_listing import Listing
from server.store import BadCursor, Store
from tests.server.databases import click, created, opened, running
from tests.server.serving import EXPERIMENT, serving
from tests.server.test_errors import check_problem


async def ids(store: Store, limit: int = 2, **fields: Any) -> list[int]:
    """All pages of a listing, one after the other."""
    found: list[int] = []
    cursor: str | None = None
    while True:
        page = await store.experiments(cursor, limit, Listing(**fields))
        found += [each.id for each in page.items]
        cursor = page.next_cursor
        if cursor is None:
            return found


async def test_every_order_goes_through_all_experiments_once(store: Store) -> None:
    made = []
    for name, labels in (("beta", (1, -1)), ("Alpha", (1,)), ("beta", ()), ("gamma", (-1, -1, -1)), ("delta", (1, 1))):
        experiment = await running(store, name=name)
        for number, value in enumerate(labels):
            await store.submit_feedback((await opened(store, experiment, f"o{number}")).id, click(value))
        made.append(experiment)
    first, second, third, fourth, fifth = made
    assert await ids(store) == made[::-1]
    assert await ids(store, order="asc") == made
    assert await ids(store, sort="name", order="asc") == [second, first, third, fifth, fourth]
    assert await ids(store, sort="feedback") == [fourth, fifth, first, second, third]
    assert await ids(store, sort="good_share", order="asc") == [third, fourth, first, second, fifth]
    assert await ids(store, sort="updated", order="asc") == made
    page = await store.experiments(None, 2, Listing(sort="name"))
    with pytest.raises(BadCursor):
        await store.experiments(page.next_cursor, 2, Listing(sort="feedback"))


async def test_tags_are_kept_changed_and_found(store: Store) -> None:
    first = await created(store, name="100 % sure", tags=["ablation", " seed 1 ", "ablation"])
    second = await created(store, name="other", task="reaching", tags=["ablation"])
    third = await created(store, name="none")
    assert first.tags == ["ablation", "seed 1"]
    assert await ids(store, tags=("ablation",)) == [second.id, first.id]
    assert await ids(store, tags=("ablation", "seed 1")) == [first.id]
    assert await ids(store, tags=("ablation",), task="reaching") == [second.id]
    assert await ids(store, text="ABLA") == [second.id, first.id]
    assert await ids(store, text="100 %") == [first.id]
    assert await ids(store, text="%") == [first.id], "a wildcard of SQL is a character like others"
    changed = await store.update_experiment(first.id, ExperimentUpdate(tags=["paper", "seed 1"]))
    assert changed.tags == ["paper", "seed 1"]
    assert (await store.update_experiment(first.id, ExperimentUpdate(name="renamed"))).tags == ["paper", "seed 1"]
    await store.halt(third.id)
    assert await ids(store, lifecycle="halted") == [third.id]
    assert await ids(store, lifecycle="created") == [third.id, second.id, first.id]


async def test_the_list_over_http_says_which_parameter_is_wrong(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        made = [await live.experiment(name=f"run {n}", tags=["sweep", f"n{n}"]) for n in range(3)]
        address = "/api/v1/experiments"
        page = (await live.http.get(address, params={"tag": ["sweep", "n1"], "sort": "name"})).json()
        assert [item["id"] for item in page["items"]] == [made[1]]
        assert (await live.http.get("/api/v1/tags")).json()[-1] == {"tag": "sweep", "experiments": 3}
        for wrong in ({"sort": "colour"}, {"order": "up"}, {"lifecycle": "asleep"}, {"cursor": "nonsense"}):
            check_problem(await live.http.get(address, params=wrong), 422)
        for tags in ([""], ["a,b"], ["x" * 41], [f"{n}" for n in range(21)], "sweep"):
            told = check_problem(await live.http.post(address, json=EXPERIMENT | {"tags": tags}), 422)
            assert any("tags" in field.field for field in told.fields)
        check_problem(await live.http.patch(f"{address}/{made[0]}", json={"tags": ["a,b"]}), 422)
        assert (await live.http.get(f"{address}/{made[0]}")).json()["tags"] == ["n0", "sweep"]
