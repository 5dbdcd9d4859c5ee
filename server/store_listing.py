"""Lists of experiments, narrowed and in any order, a page at a time.

A cursor names the last row that was handed out by its id and by the value it was ordered by, so that a page neither
repeats nor skips a row while others are added; a row whose own value changes meanwhile may come twice or not at all.
"""

from __future__ import annotations

import base64
import binascii
import json
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import ColumnElement, Float, and_, cast, func, or_, select
from sqlalchemy.orm import Session, selectinload

from server import schemas
from server import store_wire as wire
from server.models import ExperimentRow
from server.models_tags import TagRow
from server.schemas_listing import Listing, TagInfo
from server.store_errors import BadCursor
from server.store_pages import LARGEST

Value = str | int | float | datetime


def experiments(session: Session, listing: Listing, cursor: str | None, limit: int) -> schemas.ExperimentPage:
    """One page.

    Raises:
        BadCursor: no page of this order handed it out.
    """
    by = _ordered_by(listing.sort)
    down = listing.order == "desc"
    query = select(ExperimentRow, by.label("by")).options(selectinload(ExperimentRow.tags)).where(*_narrowed(listing))
    if cursor is not None:
        value, last = _decode(cursor, listing)
        beyond = and_(by == value, ExperimentRow.id < last if down else ExperimentRow.id > last)
        query = query.where(or_(by < value if down else by > value, beyond))
    ends = (by.desc(), ExperimentRow.id.desc()) if down else (by, ExperimentRow.id)
    limit = max(1, min(limit, LARGEST))
    rows = session.execute(query.order_by(*ends).limit(limit + 1)).all()
    page = rows[:limit]
    after = _encode(page[-1].by, page[-1].ExperimentRow.id, listing) if len(rows) > limit else None
    return schemas.ExperimentPage(items=[wire.experiment(row.ExperimentRow) for row in page], next_cursor=after)


def tags(session: Session, only: int | None) -> list[TagInfo]:
    """Every tag in use, by the alphabet; `only` of one experiment."""
    count = func.count(TagRow.experiment_id)
    query = select(TagRow.tag, count).group_by(TagRow.tag).order_by(TagRow.tag)
    if only is not None:
        query = query.where(TagRow.experiment_id == only)
    return [TagInfo(tag=tag, experiments=number) for tag, number in session.execute(query)]


def _ordered_by(sort: str) -> ColumnElement[Any]:
    """What the rows are ordered by; never null, or no row could be compared with it. No label yet counts as below 0."""
    row = ExperimentRow
    share = func.coalesce(cast(row.good, Float) / func.nullif(cast(row.feedback, Float), 0.0), -1.0)
    columns: dict[str, Any] = {
        "created": row.id,
        "updated": row.updated_at,
        "name": func.lower(row.name),
        "feedback": row.feedback,
        "good_share": share,
        "successes": row.successes,
        "violations": row.violations,
    }
    found: ColumnElement[Any] = columns[sort]
    return found


def _narrowed(listing: Listing) -> list[ColumnElement[bool]]:
    row = ExperimentRow
    exact = ((row.task, listing.task), (row.adapter, listing.adapter), (row.algorithm, listing.algorithm))
    wanted: list[ColumnElement[bool]] = [column == value for column, value in exact if value is not None]
    if listing.only is not None:
        wanted.append(row.id == listing.only)
    if listing.lifecycle == "halted":
        wanted.append(row.halted.is_(True))
    elif listing.lifecycle is not None:
        wanted.append(row.lifecycle == listing.lifecycle)
    wanted += [_tagged(TagRow.tag == tag) for tag in listing.tags]
    if listing.text:
        name = row.name.icontains(listing.text, autoescape=True)
        wanted.append(or_(name, _tagged(TagRow.tag.icontains(listing.text, autoescape=True))))
    return wanted


def _tagged(condition: ColumnElement[bool]) -> ColumnElement[bool]:
    return select(TagRow.tag).where(TagRow.experiment_id == ExperimentRow.id, condition).exists()


def _encode(value: Value, row_id: int, listing: Listing) -> str:
    told = value.isoformat() if isinstance(value, datetime) else value
    text = json.dumps([listing.sort, listing.order, told, row_id])
    return base64.urlsafe_b64encode(text.encode()).decode().rstrip("=")


def _decode(cursor: str, listing: Listing) -> tuple[Value, int]:
    try:
        text = base64.b64decode(cursor + "=" * (-len(cursor) % 4), altchars=b"-_", validate=True).decode()
        value: Any
        sort, order, value, row_id = json.loads(text)
        if listing.sort == "updated":
            value = datetime.fromisoformat(value).astimezone(UTC)
    except (binascii.Error, ValueError, TypeError, OverflowError) as error:
        raise BadCursor from error
    kinds: tuple[type, ...] = {"name": (str,), "updated": (datetime,), "good_share": (float, int)}.get(
        listing.sort, (int,)
    )
    ids = isinstance(row_id, int) and not isinstance(row_id, bool) and 0 < row_id < 2**63
    huge = isinstance(value, int) and abs(value) >= 2**63
    if (sort, order) != (listing.sort, listing.order) or not ids or huge or type(value) not in kinds:
        raise BadCursor
    return value, row_id
