"""One error shape for everything: RFC 9457 problem details with a remedy (`application/problem+json`)."""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from pydantic import ValidationError
from pydantic_core import ErrorDetails
from starlette.exceptions import HTTPException

from agent.algorithm import AgentError
from robot_adapters.base import AdapterError, Unavailable
from server.schemas import Feedback
from server.schemas_problems import FieldProblem, Problem
from server.store_errors import BadCursor, BadName, Conflict, Full, NewerDatabase, NotFound, ReadOnly, StoreError
from server.worker import CommandFailed, WorkerDied, WorkerError, WorkerTimeout

MEDIA_TYPE = "application/problem+json"
SLUGS = {
    400: "bad-request",
    401: "not-signed-in",
    403: "forbidden",
    404: "not-found",
    405: "method-not-allowed",
    409: "conflict",
    413: "too-large",
    422: "invalid",
    429: "too-often",
    500: "internal",
    503: "unavailable",
}
STATUS_OF: tuple[tuple[type[Exception], int, str], ...] = (
    (NotFound, 404, "not-found"),
    (BadCursor, 422, "invalid"),
    (BadName, 422, "invalid"),
    (Conflict, 409, "conflict"),
    (ReadOnly, 503, "read-only"),
    (Full, 503, "storage-full"),
    (NewerDatabase, 503, "newer-database"),
    (StoreError, 503, "storage"),
    (WorkerTimeout, 503, "worker-timeout"),
    (WorkerDied, 503, "worker-died"),
    (CommandFailed, 503, "worker-refused"),
    (WorkerError, 503, "worker"),
    (Unavailable, 503, "unavailable"),
    (AdapterError, 422, "invalid"),
    (AgentError, 422, "invalid"),
)
"""First match wins: the more special class stands before its base."""

REMEDIES = {
    400: "send a body of valid JSON with Content-Type: application/json",
    403: "open the service under its own address",
    404: "see /docs for the routes there are",
    405: "use one of the methods in the Allow header; see /docs",
    413: "send a smaller body",
}
INTERNAL_REMEDY = "try again; if it happens again, report it with the server's log"

log = logging.getLogger("seed.errors")


class ServiceError(Exception):
    """An error that a route raises itself, ready for the wire."""

    def __init__(
        self,
        status: int,
        detail: str,
        *,
        remedy: str,
        slug: str | None = None,
        fields: list[FieldProblem] | None = None,
        extra: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(detail)
        self.remedy = remedy
        self.headers = headers
        self.problem = problem(status, detail, remedy=remedy, slug=slug, fields=fields, extra=extra)


def problem(
    status: int,
    detail: str,
    *,
    remedy: str,
    slug: str | None = None,
    fields: list[FieldProblem] | None = None,
    extra: Mapping[str, Any] | None = None,
) -> Problem:
    """Problem details; `type` is a stable relative reference, explained in docs/api.md."""
    return Problem(
        type=f"/problems/{slug or SLUGS.get(status, 'bad-request')}",
        title=HTTPStatus(status).phrase,
        status=status,
        detail=detail,
        remedy=remedy,
        fields=fields or [],
        **dict(extra or {}),
    )


def invalid(fields: list[FieldProblem], remedy: str) -> ServiceError:
    """A request whose fields are wrong; `detail` names the first."""
    first = fields[0]
    more = f" (and {len(fields) - 1} more)" if len(fields) > 1 else ""
    return ServiceError(422, f"{first.field}: {first.message}{more}", remedy=remedy, fields=fields)


def late_feedback(feedback: Feedback) -> ServiceError:
    """A click that came after its proposal had closed: it is kept, and decides nothing."""
    why = feedback.late_because or "it came too late"
    return ServiceError(
        409,
        f"this click on proposal {feedback.proposal_id} is kept and decides nothing: {why}",
        remedy="judge the proposal that is open now",
        slug="late-feedback",
        extra={"feedback": feedback.model_dump(mode="json")},
    )


def problem_of(error: Exception) -> Problem:
    """The problem details of any exception; one that nobody foresaw is logged and told without its inside."""
    if isinstance(error, ServiceError):
        return error.problem
    if isinstance(error, RequestValidationError | ValidationError):
        return validation_problem(list(error.errors()))
    if isinstance(error, RecursionError):
        return problem(400, "the body is nested too deeply", remedy="send the body flat, as /docs shows it")
    if isinstance(error, HTTPException):
        return _http_problem(error)
    for kind, status, slug in STATUS_OF:
        if isinstance(error, kind):
            extra: dict[str, Any] = {}
            if isinstance(error, Conflict):
                extra = {"current": error.current, "allowed": list(error.allowed)} if error.current else {}
            return problem(status, str(error), remedy=getattr(error, "remedy", INTERNAL_REMEDY), slug=slug, extra=extra)
    log.error("unexpected error", exc_info=error)
    return problem(500, "the service met an error of its own", remedy=INTERNAL_REMEDY)


def validation_problem(errors: list[ErrorDetails] | list[Any]) -> Problem:
    """Pydantic's findings as fields; the values that were sent are not echoed."""
    if errors and errors[0]["type"] == "json_invalid":
        return problem(400, "the body is not valid JSON", remedy=REMEDIES[400])
    fields = [FieldProblem(field=_path(e["loc"]), message=e["msg"]) for e in errors[:50]]
    return invalid(fields, remedy="correct the named fields; /docs shows the schema").problem


def response(details: Problem, headers: Mapping[str, str] | None = None) -> Response:
    """The problem as an HTTP response. It may quote half a surrogate pair, which UTF-8 can't carry: then `?`."""
    body = json.dumps(details.model_dump(mode="json"), ensure_ascii=False).encode("utf-8", "replace")
    return Response(body, details.status, media_type=MEDIA_TYPE, headers=dict(headers or {}))


def install(app: FastAPI) -> None:
    """Give every error of the app this one shape."""

    async def handle(_: Request, error: Exception) -> Response:
        headers = error.headers if isinstance(error, HTTPException | ServiceError) else None
        return response(problem_of(error), headers)

    foreseen = (StoreError, WorkerError, AdapterError, AgentError, ServiceError)
    for kind in (*foreseen, HTTPException, RequestValidationError, RecursionError, Exception):
        app.add_exception_handler(kind, handle)


def _http_problem(error: HTTPException) -> Problem:
    remedy = REMEDIES.get(error.status_code, INTERNAL_REMEDY)
    detail = error.detail
    if error.status_code == 400:
        # FastAPI says this of any body it can't parse: wrong encoding, or nested too deeply for the JSON parser
        detail = "the body can't be read: it is not UTF-8 JSON, or nested too deeply"
    elif error.status_code == 404:
        detail = "there is nothing at this address"
    elif error.status_code == 405:
        detail = "this address doesn't take this method"
    return problem(error.status_code, detail, remedy=remedy)


def _path(location: tuple[int | str, ...]) -> str:
    """('body', 'settings', 'x') -> settings.x; a header or query keeps its kind."""
    parts = [str(part) for part in location]
    if len(parts) > 1 and parts[0] in ("body", "query", "path", "header"):
        parts = parts[1:]
    return ".".join(parts)
