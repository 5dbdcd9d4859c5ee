"""Pages with an opaque cursor. A cursor stays valid while rows are added: it names the last row that was handed out."""

from __future__ import annotations

import base64
import binascii
from collections.abc import Callable
from typing import Any, TypeVar

from sqlalchemy import Select
from sqlalchemy.orm import Session

from server.store_errors import BadCursor

T = TypeVar("T")

LARGEST = 500
"""Rows on a page at most."""


def page(
    session: Session,
    query: Select[Any],
    key: Any,
    wire: Callable[[Any], T],
    *,
    cursor: str | None,
    limit: int,
    newest_first: bool = True,
) -> tuple[list[T], str | None]:
    """One page of `query` ordered by the integer column `key`, and the cursor of the next page, None on the last.

    Raises:
        BadCursor: no page handed it out.
    """
    if cursor is not None:
        last = _decode(cursor)
        query = query.where(key < last if newest_first else key > last)
    limit = max(1, min(limit, LARGEST))
    ordered = query.order_by(key.desc() if newest_first else key).limit(limit + 1)
    rows = list(session.scalars(ordered))
    more = len(rows) > limit
    rows = rows[:limit]
    return [wire(row) for row in rows], _encode(rows[-1].id) if more else None


def _encode(row_id: int) -> str:
    return base64.urlsafe_b64encode(f"id:{row_id}".encode()).decode().rstrip("=")


def _decode(cursor: str) -> int:
    try:
        text = base64.b64decode(cursor + "=" * (-len(cursor) % 4), altchars=b"-_", validate=True).decode("ascii")
    except (binascii.Error, ValueError) as error:
        raise BadCursor from error
    prefix, _, digits = text.partition(":")
    if prefix != "id" or not digits.isascii() or not digits.isdigit() or len(digits) > 18:
        raise BadCursor
    return int(digits)
