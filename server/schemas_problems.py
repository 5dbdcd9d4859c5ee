"""The one shape of an error (RFC 9457), and of the answers to a health check."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

from server.schemas import Wire


class FieldProblem(Wire):
    """One wrong field of a request."""

    field: str
    message: str


class Problem(BaseModel):
    """RFC 9457 problem details, plus `remedy` and, for a wrong body, the fields."""

    model_config = ConfigDict(extra="allow")

    type: str = "about:blank"
    title: str
    status: int
    detail: str
    remedy: str
    fields: list[FieldProblem] = []


class Health(Wire):
    """The process is up. `boot_id` changes when the server restarts."""

    status: Literal["ok"] = "ok"
    boot_id: str


class Readiness(Wire):
    """Whether work can be done; each check is `ok` or says what is wrong."""

    ready: bool
    checks: dict[str, str]
