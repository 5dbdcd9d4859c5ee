"""What can go wrong in the store; each error says what the reader can do about it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


class StoreError(Exception):
    """Base of every error of the store. `remedy` says what the reader can do about it."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as it is: the arguments of a subclass differ from its message."""
        return type(self).__new__, (type(self), *self.args), self.__dict__


class NotFound(StoreError):
    """There is no row of that id."""

    def __init__(self, what: str, row_id: object, *, remedy: str | None = None) -> None:
        known = f"list what there is and use the id of a known {what}"
        super().__init__(f"there is no {what} {row_id}", remedy=remedy or known)


class Conflict(StoreError):
    """The request contradicts what is stored; nothing has changed.

    Where it is an illegal lifecycle verb, `current` is the state and `allowed` are the verbs it takes.
    """

    def __init__(self, message: str, *, remedy: str, current: str | None = None, allowed: Sequence[str] = ()) -> None:
        super().__init__(message, remedy=remedy)
        self.current = current
        self.allowed = tuple(allowed)


class BadCursor(StoreError):
    """A page cursor that no page has handed out."""

    def __init__(self) -> None:
        super().__init__(
            "the cursor is not one of a page", remedy="use `next_cursor` of the previous page, or leave it out"
        )


class BadName(StoreError):
    """A name that nobody may go by."""


class ReadOnly(StoreError):
    """The database can be read but not written."""

    def __init__(self, detail: str) -> None:
        super().__init__(
            f"the database can't be written: {detail}",
            remedy="make the database file and its directory writable for the user of the service, then try again",
        )


class Full(StoreError):
    """The disk, or the database, has no room left."""

    def __init__(self, detail: str) -> None:
        super().__init__(
            f"there is no room left to store this: {detail}",
            remedy="free space where the database lies, then try again; nothing of this request was stored",
        )


class NewerDatabase(StoreError):
    """The database was written by a newer version of the service."""

    def __init__(self, revision: str) -> None:
        super().__init__(
            f"the database has revision {revision}, which this version doesn't know",
            remedy="install the version that wrote it, or put back a copy from the directory `backups`",
        )
