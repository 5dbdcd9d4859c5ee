"""Every error has one shape (RFC 9457 with a remedy), whatever went wrong, and nothing has changed by it."""

from __future__ import annotations

import json
import re
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import text

from server.errors import MEDIA_TYPE, problem_of
from server.schemas_problems import Problem
from tests.server.serving import EXPERIMENT, Serving, serving

MEGABYTE = 1_000_000


def check_problem(answer: httpx.Response, status: int) -> Problem:
    """The answer is a problem of this status, and says what to do."""
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == MEDIA_TYPE
    told = Problem.model_validate_json(answer.content)
    assert told.status == status
    assert told.type.startswith("/problems/")
    assert told.title
    assert told.detail
    assert told.remedy
    return told


async def test_every_route_answers_errors_in_one_shape(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        document = (await live.http.get("/openapi.json")).json()
        walked = 0
        for path, operations in document["paths"].items():
            here = re.sub(r"\{(name|camera)\}", "nothing", re.sub(r"\{\w+_id\}", "987654", path))
            here = re.sub(r"\{(index|number)\}", "7", here)
            other = next(m for m in ("PUT", "TRACE") if m.lower() not in operations)
            assert check_problem(await live.http.request(other, here), 405).type == "/problems/method-not-allowed"
            for method, operation in operations.items():
                described = operation["responses"]
                for status, answer in described.items():
                    if int(status) >= 400 and path.startswith("/api"):
                        assert list(answer["content"]) == [MEDIA_TYPE], f"{method} {path} {status}"
                if "{" in path:
                    body, asked = _body_of(document, operation), _query_of(operation)
                    told = check_problem(await live.http.request(method, here, json=body, params=asked), 404)
                    assert "404" in described, f"{method} {path} doesn't document its 404"
                    assert told.type == "/problems/not-found"
                if "{experiment_id}" in path or "{proposal_id}" in path or "{feedback_id}" in path:
                    wrong = await live.http.request(method, re.sub(r"\{\w+\}", "x", path), json={})
                    assert check_problem(wrong, 422).fields[0].field.endswith("_id")
                    large = await live.http.request(method, re.sub(r"\{\w+\}", "9" * 30, path), json={})
                    assert check_problem(large, 422).fields[0].field.endswith("_id")
                if any(p["name"] == "cursor" for p in operation.get("parameters", [])):
                    known = here.replace("987654", str(await live.experiment()))
                    if "proposals/" not in path:
                        assert "cursor" in check_problem(await live.http.get(known, params={"cursor": "?"}), 422).detail
                    zero = await live.http.get(known, params={"limit": 0})
                    assert check_problem(zero, 422).fields[0].field == "limit"
                if "requestBody" in operation:
                    nothing = (b"null", b"") if operation["requestBody"].get("required") else ()
                    for rubbish in (b"{", b"\xff\xfe", b'"text"', b"[]", *nothing):
                        sent = await live.http.request(
                            method, here, content=rubbish, headers={"Content-Type": "application/json"}
                        )
                        assert sent.status_code in (400, 422)
                        check_problem(sent, sent.status_code)
                walked += 1
        assert walked > 25


def _body_of(document: dict[str, Any], operation: dict[str, Any]) -> Any:
    if "requestBody" not in operation:
        return None
    examples = operation["requestBody"]["content"]["application/json"]["examples"]
    return next(iter(examples.values()))["value"]


def _query_of(operation: dict[str, Any]) -> dict[str, str]:
    """Something for each parameter that must be asked with."""
    parameters = operation.get("parameters", [])
    asked = [p for p in parameters if p["in"] == "query" and p.get("required")]
    return {p["name"]: "1" if p["schema"].get("type") == "integer" else "somebody" for p in asked}


@pytest.fixture
async def live(tmp_path: Path) -> AsyncIterator[Serving]:
    async with serving(tmp_path) as running:
        yield running


async def test_an_unknown_route_is_a_problem_and_not_the_page(live: Serving) -> None:
    for path in ("/api", "/api/v1", "/api/v1/nothing", "/api/v2/experiments", "/api/v1/experiments/1/fly"):
        for method in ("GET", "POST", "DELETE"):
            check_problem(await live.http.request(method, path), 404)


async def _count(live: Serving) -> int:
    return len((await live.http.get("/api/v1/experiments")).json()["items"])


async def test_a_large_body_is_refused_by_its_declared_length(live: Serving) -> None:
    body = b'{"name": "' + b"x" * 10 * MEGABYTE + b'"}'
    answer = await live.http.post("/api/v1/experiments", content=body, headers={"Content-Type": "application/json"})
    assert check_problem(answer, 413).type == "/problems/too-large"
    assert await _count(live) == 0


async def test_a_large_body_of_undeclared_length_is_refused_while_it_comes(live: Serving) -> None:
    taken = 0

    async def endless() -> AsyncIterator[bytes]:
        nonlocal taken
        yield b'{"name": "'
        for _ in range(10):
            taken += 1
            yield b"x" * MEGABYTE
        yield b'"}'

    answer = await live.http.post(
        "/api/v1/experiments", content=endless(), headers={"Content-Type": "application/json"}
    )
    check_problem(answer, 413)
    assert await _count(live) == 0
    assert (await live.http.get("/health")).status_code == 200


async def test_deep_nesting_is_a_problem_and_not_a_crash(live: Serving) -> None:
    headers = {"Content-Type": "application/json"}
    for depth in (500, 2_000, 100_000):
        for opening, closing in (('{"a":', "}"), ("[", "]")):
            nested = opening * depth + "1" + closing * depth
            for body in (nested, json.dumps(EXPERIMENT)[:-1] + f', "settings": {{"hidden_size": {nested}}}}}'):
                answer = await live.http.post("/api/v1/experiments", content=body, headers=headers)
                assert answer.status_code in (400, 422)
                check_problem(answer, answer.status_code)
    assert await _count(live) == 0


async def test_a_body_of_another_kind_is_refused(live: Serving) -> None:
    form = await live.http.post("/api/v1/experiments", data={"name": "x", "task": "stacking"})
    check_problem(form, 422)
    plain = await live.http.post(
        "/api/v1/experiments", content=json.dumps(EXPERIMENT), headers={"Content-Type": "text/plain"}
    )
    check_problem(plain, 422)
    assert await _count(live) == 0


async def test_odd_text_is_refused_and_never_a_crash(live: Serving) -> None:
    headers = {"Content-Type": "application/json"}
    start = json.dumps(EXPERIMENT)[:-1]
    half = r"\ud800"  # of a surrogate pair: JSON can say it, UTF-8 can't
    for change in (
        f'"name": "{half}"',
        f'"task": "{half}"',
        f'"settings": {{"{half}": 1}}',
        f'"{half}": 1',
        r'"name": "a\u0000b"',
        r'"name": "a\nb"',
        f'"seed": {"9" * 5000}',
        f'"settings": {{"batch_size": {"9" * 400}}}',
        '"feedback_timeout": 1e400',
    ):
        answer = await live.http.post("/api/v1/experiments", content=f"{start}, {change}}}", headers=headers)
        assert answer.status_code in (400, 422), change
        check_problem(answer, answer.status_code)
    assert await _count(live) == 0


async def test_odd_addresses_lead_nowhere(live: Serving) -> None:
    for path in (
        "/api/v1/tasks/%ff",
        "/api/v1/tasks/%00",
        "/a%00b.js",
        "/..%2f..%2fserver/app.py",
        f"/{'a' * 5000}.js",
    ):
        answer = await live.http.get(path)
        # 503: the page itself isn't built where these tests run
        assert answer.status_code in (404, 503), path
        assert b"import" not in answer.content
    check_problem(await live.http.get("/api/v1/experiments", params={"cursor": "\x00"}), 422)


async def test_a_foreign_host_name_is_refused(live: Serving) -> None:
    for host in ("evil.example", "evil.example:8000", "127.0.0.1.evil.example", "", "192.168.1.2"):
        answer = await live.http.get("/api/v1/experiments", headers={"Host": host})
        assert check_problem(answer, 403).type == "/problems/foreign-host"


async def test_allowed_names_and_loopback_names_are_answered(tmp_path: Path) -> None:
    async with serving(tmp_path, allowed_hosts="Robot.Lab.example, other") as live:
        port = live.url.rpartition(":")[2]
        for host in (
            f"localhost:{port}",
            f"127.0.0.1:{port}",
            f"[::1]:{port}",
            "robot.lab.example",
            "ROBOT.lab.example:80",
        ):
            assert (await live.http.get("/health", headers={"Host": host})).status_code == 200, host


async def test_a_foreign_page_can_look_at_nothing_and_change_nothing(live: Serving) -> None:
    for origin in ("https://evil.example", "null", "http://localhost:1", "http://127.0.0.1", "file://"):
        headers = {"Origin": origin}
        answer = await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers=headers)
        assert check_problem(answer, 403).type == "/problems/foreign-origin"
        looked = await live.http.get("/api/v1/experiments", headers=headers)
        assert "access-control-allow-origin" not in looked.headers
        preflight = await live.http.options("/api/v1/experiments", headers=headers)
        assert "access-control-allow-origin" not in preflight.headers
    assert await _count(live) == 0


async def test_our_own_page_may_act(live: Serving) -> None:
    answer = await live.http.post("/api/v1/experiments", json=EXPERIMENT, headers={"Origin": live.url})
    assert answer.status_code == 201


async def test_no_page_can_frame_ours(live: Serving) -> None:
    answer = await live.http.get("/api/v1/tasks")
    assert answer.headers["x-frame-options"] == "DENY"
    assert answer.headers["x-content-type-options"] == "nosniff"


async def test_a_database_that_fails_is_told_with_a_remedy_and_the_service_goes_on(live: Serving) -> None:
    await live.experiment()
    await live.service.store.close()
    told = await live.http.get("/api/v1/experiments")
    assert told.status_code in (500, 503)
    check_problem(told, told.status_code)
    assert (await live.http.get("/ready")).status_code == 503
    assert (await live.http.get("/health")).status_code == 200
    assert (await live.http.get("/api/v1/tasks")).status_code == 200


async def _pragma(live: Serving, statement: str) -> None:
    await live.service.store._database.write(lambda session: session.execute(text(f"PRAGMA {statement}")))


async def test_a_full_disk_refuses_what_it_cant_keep_and_the_service_goes_on(live: Serving) -> None:
    proposal = await live.proposal(await live.experiment())
    await _pragma(live, "max_page_count = 1")  # SQLite takes the present size for the least
    stored = 1
    answer = await live.http.post("/api/v1/experiments", json=EXPERIMENT)
    while answer.status_code == 201:  # what is left in the last pages
        stored += 1
        answer = await live.http.post("/api/v1/experiments", json=EXPERIMENT)
    told = check_problem(answer, 503)
    assert told.type == "/problems/storage-full"
    assert "free space" in told.remedy
    assert len((await live.http.get("/api/v1/experiments", params={"limit": 200})).json()["items"]) == stored
    await _pragma(live, "max_page_count = 1000000")
    address = f"/api/v1/proposals/{proposal.id}/feedback"
    assert (await live.http.post(address, json=live.click())).status_code == 201


async def test_a_database_that_became_read_only_refuses_clicks_and_keeps_what_it_has(live: Serving) -> None:
    proposal = await live.proposal(await live.experiment())
    address = f"/api/v1/proposals/{proposal.id}/feedback"
    await _pragma(live, "query_only = ON")
    told = check_problem(await live.http.post(address, json=live.click()), 503)
    assert told.type == "/problems/read-only"
    assert "writable" in told.remedy
    assert (await live.http.get(address)).json()["items"] == []
    assert (await live.http.get(f"/api/v1/proposals/{proposal.id}")).json()["closed_at"] is None


def test_an_unforeseen_error_tells_nothing_of_the_inside() -> None:
    told = problem_of(ValueError("password=hunter2 at 0xdeadbeef"))
    assert told.status == 500
    assert "hunter2" not in told.model_dump_json()
    assert told.remedy
