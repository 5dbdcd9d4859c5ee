"""The API's page names every error type and message there is, and OpenAPI describes what the service does."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args

import pytest

import server.errors
from server.app import create_app
from server.messages import ClientMessage, StreamEvent
from server.settings import Settings

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "api.md").read_text("utf-8")


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    return create_app(Settings()).openapi()


def test_the_page_lists_every_problem_type() -> None:
    raised = {slug for _, _, slug in server.errors.STATUS_OF} | set(server.errors.SLUGS.values())
    for source in (ROOT / "server").rglob("*.py"):
        raised |= set(re.findall(r'slug="([a-z-]+)"', source.read_text("utf-8")))
    listed = set(re.findall(r"^\| `/problems/([a-z-]+)`", PAGE, re.MULTILINE))
    assert listed == raised


def test_the_page_names_everything_a_client_may_send() -> None:
    for message in get_args(get_args(ClientMessage)[0]):
        (kind,) = get_args(message.model_fields["type"].annotation)
        assert f"`{kind}`" in PAGE or f'"{kind}"' in PAGE


def test_every_event_and_message_is_declared(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]
    for message in (*get_args(get_args(StreamEvent)[0]), *get_args(get_args(ClientMessage)[0])):
        assert message.__name__ in schemas
    hooks = document["webhooks"]
    assert {"stream-event", "stream-frame", "stream-message", "stream-event/snapshot"} <= set(hooks)
    union = hooks["stream-event"]["post"]["requestBody"]["content"]["application/json"]["schema"]
    assert len(union["discriminator"]["mapping"]) == len(get_args(get_args(StreamEvent)[0]))


def test_every_operation_is_described_tagged_and_has_its_own_id(document: dict[str, Any]) -> None:
    operations = [o for path in (document["paths"] | document["webhooks"]).values() for o in path.values()]
    ids = [operation["operationId"] for operation in operations]
    assert len(ids) == len(set(ids))
    assert all(operation["description"] for operation in operations)
    known = {tag["name"] for tag in document["tags"]}
    assert all(operation["tags"] and set(operation["tags"]) <= known for operation in operations)


def test_every_body_has_an_example(document: dict[str, Any]) -> None:
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            if "requestBody" in operation:
                assert operation["requestBody"]["content"]["application/json"]["examples"], f"{method} {path}"


def test_an_answer_always_carries_all_its_fields(document: dict[str, Any]) -> None:
    for name in ("Experiment", "Proposal", "Snapshot", "Feedback", "Problem"):
        schema = document["components"]["schemas"][name]
        assert set(schema["required"]) == set(schema["properties"])
    assert "seed" not in document["components"]["schemas"]["ExperimentCreate"]["required"]


def test_the_command_line_prints_the_same_document(document: dict[str, Any]) -> None:
    program = "from server.cli import app; app()"
    printed = subprocess.run([sys.executable, "-c", program, "openapi"], capture_output=True, text=True, check=True)
    assert json.loads(printed.stdout) == json.loads(json.dumps(document))
