"""What happened, read back: narrowed, in either order, page by page, and never about an open proposal."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import create_engine, select, update
from sqlalchemy.orm import Session

from robot_adapters.base import SafetyViolation, SkillCall
from server import store_history, store_timeline
from server.models import ExecutionRow, FeedbackRow
from server.schemas import ExecutionOutcome
from server.schemas_history import HistoryEntry, HistoryFilter, HistoryPage
from server.schemas_labels import RelabelCreate
from server.store import NotFound, Store
from tests.server.databases import begun, click, opened, running
from tests.server.serving import serving
from tests.server.test_errors import check_problem


async def entries(store: Store, experiment: int, limit: int = 2, **wanted: Any) -> list[HistoryEntry]:
    """All pages, one after the other."""
    found: list[HistoryEntry] = []
    cursor: str | None = None

    def read(session: Session) -> HistoryPage:
        return store_history.history(session, experiment, HistoryFilter(**wanted), cursor, limit)

    while True:
        page = await store.read(read)
        found += page.items
        cursor = page.next_cursor
        if cursor is None:
            return found


async def numbers(store: Store, experiment: int, **wanted: Any) -> list[int]:
    return [entry.proposal.number for entry in await entries(store, experiment, **wanted)]


async def story(store: Store) -> int:
    """Five proposals: bad; good and executed with damage; bad, then corrected to good; good, next episode; open."""
    experiment = await running(store)
    first = await opened(store, experiment, "o1")
    await store.submit_feedback(first.id, click(-1))
    second = await opened(store, experiment, "o2", call=SkillCall("place", (0.5, 0.1, -0.1)))
    await store.submit_feedback(second.id, click(1))
    _, execution = await begun(store, second.id, "o2")
    await store.end_execution(
        execution.id,
        ExecutionOutcome.SUCCEEDED,
        end_reason="arrived",
        low_level_steps=10,
        task_success=False,
        violations=[SafetyViolation("manual_reset", "fell off")],
    )
    third = await opened(store, experiment, "o3")
    submitted = await store.submit_feedback(third.id, click(-1))
    await store.relabel(submitted.feedback.id, RelabelCreate(click_id="correction-1", value=1), anybodys=False)
    await store.begin_episode(experiment, 2)
    fourth = await opened(store, experiment, "o4")
    await store.submit_feedback(fourth.id, click(1))
    await opened(store, experiment, "o5")
    return experiment


async def test_labels_are_counted_over_time_as_they_are_by_now(store: Store, url: str) -> None:
    experiment = await story(store)
    start = datetime(2026, 1, 1, tzinfo=UTC)
    engine = create_engine(url)
    with engine.begin() as connection:  # one bad, then two of good within a moment, and the last an hour later
        rows = connection.scalars(select(FeedbackRow.id).order_by(FeedbackRow.id)).all()
        for row, seconds in zip(rows, (0.4, 600.2, 601.7, 3600), strict=True):
            at = start + timedelta(seconds=seconds)
            connection.execute(update(FeedbackRow).where(FeedbackRow.id == row).values(received_at=at))
        connection.execute(update(ExecutionRow).values(started_at=start + timedelta(seconds=900)))
    engine.dispose()
    told = await store.read(lambda session: store_timeline.timeline(session, experiment, 60))
    assert (told.seconds, told.started_at, told.ended_at) == (61, start, start + timedelta(hours=1))
    assert [((each.at - start).seconds, each.good, each.bad) for each in told.stretches] == [
        (0, 0, 1),
        (549, 2, 0),
        (3599, 1, 0),
    ]
    assert [(each.proposal, each.episode) for each in told.stretches] == [(1, 1), (2, 1), (4, 2)]
    # the motion began in a stretch without labels: it is told with the one before
    assert [(each.executions, each.violations) for each in told.stretches] == [(0, 0), (1, 1), (0, 0)]
    none = await running(store)
    assert (await store.read(lambda session: store_timeline.timeline(session, none, 60))).stretches == []
    with pytest.raises(NotFound):
        await store.read(lambda session: store_timeline.timeline(session, 99, 60))


async def test_closed_proposals_come_with_what_was_said_and_done_and_are_narrowed(store: Store) -> None:
    experiment = await story(store)
    assert await numbers(store, experiment) == [4, 3, 2, 1], "the open one isn't told"
    assert await numbers(store, experiment, order="asc") == [1, 2, 3, 4]
    assert await numbers(store, experiment, skill="place") == [2]
    assert await numbers(store, experiment, verdict="bad") == [3, 1], "a correction leaves the verdict"
    assert await numbers(store, experiment, label="good") == [4, 3, 2], "and changes the label"
    assert await numbers(store, experiment, label="bad") == [1]
    assert await numbers(store, experiment, label="cant_tell") == []
    assert await numbers(store, experiment, executed=True) == [2]
    assert await numbers(store, experiment, executed=False, verdict="good") == [4]
    assert await numbers(store, experiment, violation=True) == [2]
    assert await numbers(store, experiment, episode=1, order="asc") == [1, 2, 3]
    assert await numbers(store, experiment, purpose="evaluation") == []
    second = (await entries(store, experiment, skill="place"))[0]
    assert second.execution is not None
    assert [violation.detail for violation in second.execution.violations] == ["fell off"]
    assert [feedback.label for feedback in second.feedback] == [1]


async def test_episodes_are_counted(store: Store) -> None:
    experiment = await story(store)
    page = await store.read(lambda s: store_history.episodes(s, experiment, None, 10))
    told = [(e.number, e.proposals, e.executions, e.violations, e.outcome) for e in page.items]
    assert told[1][:4] == (1, 3, 1, 1)
    assert told[0] == (2, 2, 0, 0, None)
    one = await store.read(lambda s: store_history.episode(s, experiment, 1))
    assert one == page.items[1]
    with pytest.raises(NotFound):
        await store.read(lambda s: store_history.episode(s, experiment, 9))


async def test_the_history_over_http(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        address = f"/api/v1/experiments/{experiment}"
        assert (await live.http.get(f"{address}/history")).json()["items"] == []
        await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=live.click(-1))
        (entry,) = (await live.http.get(f"{address}/history", params={"label": "bad", "executed": "false"})).json()[
            "items"
        ]
        assert entry["proposal"]["id"] == proposal.id
        assert entry["execution"] is None
        assert (await live.http.get(entry["proposal"]["views"][0]["url"])).status_code == 200
        assert (await live.http.get(f"{address}/episodes/1")).json()["proposals"] == 1
        for wrong in ({"label": "great"}, {"executed": "perhaps"}, {"episode": 0}, {"order": "up"}, {"cursor": "x"}):
            check_problem(await live.http.get(f"{address}/history", params=wrong), 422)
        check_problem(await live.http.get(f"{address}/episodes/7"), 404)
        check_problem(await live.http.get("/api/v1/experiments/99/history"), 404)
        check_problem(await live.http.get("/api/v1/experiments/99/episodes"), 404)
