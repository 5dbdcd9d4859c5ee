"""Roles: every route and every message of the stream has one, and whatever has none is refused."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest
from fastapi.routing import APIRoute, APIWebSocketRoute, iter_route_contexts

from server import roles
from server.app import create_app
from server.messages import ClientMessage
from server.principal import Principal, Role
from server.settings import Settings
from tests.server.serving import event, serving
from tests.server.test_errors import check_problem


def test_every_route_has_a_role_and_every_role_a_route() -> None:
    routes = list(iter_route_contexts(create_app(Settings()).routes))
    asking = {str(r.name) for r in routes if isinstance(r.original_route, APIRoute | APIWebSocketRoute)}
    assert asking == set(roles.NEEDS)
    # what doesn't ask: the description of the API, and the scripts of its page
    assert {str(r.name) for r in routes} - asking == {"openapi", "static-offline-docs"}


def test_every_message_of_the_stream_has_a_role() -> None:
    kinds = {get_args(m.model_fields["type"].annotation)[0] for m in get_args(get_args(ClientMessage)[0])}
    assert kinds == set(roles.MESSAGES)


def test_each_role_may_what_those_before_it_may() -> None:
    may = {role: {kind for kind in roles.MESSAGES if not roles.refusal(Principal("Ada", role), kind)} for role in Role}
    assert may[Role.VIEWER] == {"ping", "frame_ack"}
    assert may[Role.VIEWER] < may[Role.TRAINER] <= may[Role.OPERATOR] <= may[Role.OWNER] == set(roles.MESSAGES)


async def test_a_route_without_a_role_is_refused_to_everybody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(roles.NEEDS, "list_tasks")
    monkeypatch.delitem(roles.NEEDS, "stream")
    async with serving(tmp_path) as live:
        check_problem(await live.http.get("/api/v1/tasks"), 403)
        experiment = await live.experiment()
        with pytest.raises(Exception, match="403"):
            async with live.stream(experiment):
                pass


async def test_without_a_login_the_local_owner_may_everything_under_any_name(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        proposal = await live.proposal(experiment)
        click = live.click(-1, trainer="Ada")
        answer = await live.http.post(f"/api/v1/proposals/{proposal.id}/feedback", json=click)
        assert answer.json()["trainer"] == "Ada"
        async with live.stream(experiment) as viewer:
            await event(viewer, "snapshot")
            assert live.service.hub.presence.people(experiment) == {"local": Role.OWNER}
