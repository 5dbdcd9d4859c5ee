"""A small crowd on the real service: nothing lost or doubled, over kills of the server."""

from __future__ import annotations

from pathlib import Path

from tests.benchmarks.load import busy_service, crowd, kill_and_return


def test_a_crowd_loses_and_doubles_no_click_over_three_kills(tmp_path: Path) -> None:
    with busy_service(tmp_path, 2) as (service, streams):
        members = crowd(streams, trainers=16, viewers=4, pause=0.5)
        assert kill_and_return(service, members, kills=3, seconds=10) == []
        clicks = [click for member in members for click in member.clicks]
        assert len(clicks) > 50
        assert {click.answer for click in clicks} <= {"stored", "late"}
        assert all(member.connections > 3 for member in members)
