"""What FastAPI's generated OpenAPI lacks: the error shape everywhere, and which fields an answer always has."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from server.errors import MEDIA_TYPE

TAGS = [
    {"name": "catalogue", "description": "What can be chosen"},
    {"name": "experiments", "description": "A task, an adapter, an algorithm, and everything that happened"},
    {"name": "proposals", "description": "Skill calls that the agent suggests, with the pictures they are drawn on"},
    {"name": "feedback", "description": "Clicks"},
    {"name": "records", "description": "What an experiment leaves behind"},
    {"name": "history", "description": "What happened, read back from the database"},
    {"name": "results", "description": "Curves of one experiment, of several beside each other, and the paper's"},
    {"name": "incidents", "description": "What went wrong, as people and cameras saw it"},
    {"name": "trust", "description": "How far the critic may be trusted"},
    {"name": "practice", "description": "Proposals with known answers, corrected at once"},
    {"name": "quality", "description": "How far labels may be trusted: figures, agreement, known answers, exports"},
    {"name": "people", "description": "Coming in and going out, who is there, and who decided what"},
    {"name": "studies", "description": "Algorithms x tasks x seeds, run by `seed study`"},
    {"name": "stream", "description": "Messages of the WebSocket /api/v1/experiments/{id}/stream"},
    {"name": "probes", "description": "For whoever runs the service"},
]
REQUESTS = {
    "ExperimentCreate",
    "ExperimentUpdate",
    "FeedbackCreate",
    "ReportCreate",
    "EvaluationCreate",
    "AutoApproval",
}
"""Schemas whose defaults may be left out; an answer carries every field, null where there is nothing."""


def describe(app: FastAPI) -> None:
    """Replace the app's OpenAPI by the completed one."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = _complete(
                get_openapi(
                    title=app.title,
                    version=app.version,
                    summary=app.summary,
                    routes=app.routes,
                    webhooks=app.webhooks.routes,
                    tags=TAGS,
                    separate_input_output_schemas=False,
                )
            )
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]  # FastAPI documents this as the way


def _complete(document: dict[str, Any]) -> dict[str, Any]:
    schemas: dict[str, Any] = document["components"]["schemas"]
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    for name, schema in schemas.items():
        if "properties" in schema and name not in REQUESTS and not name.startswith("Client"):
            schema["required"] = list(schema["properties"])
    for path in document["paths"].values():
        for operation in path.values():
            for status, answer in operation["responses"].items():
                if int(status) >= 400 and "application/json" in answer.get("content", {}):
                    answer["content"] = {MEDIA_TYPE: answer["content"].get(MEDIA_TYPE) or _problem()}
    for hook in document.get("webhooks", {}).values():
        # nothing answers a message of the stream; the generated 200 and 422 would only mislead
        hook["post"]["responses"] = {"200": {"description": "Sent over the WebSocket; there is no answer to it"}}
    return document


def _problem() -> dict[str, Any]:
    return {"schema": {"$ref": "#/components/schemas/Problem"}}
