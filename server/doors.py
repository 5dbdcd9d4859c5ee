"""Whose request this is. Without a login, on loopback, everyone is the local owner."""

from __future__ import annotations

from starlette.requests import HTTPConnection

from server.principal import LOCAL, Principal


class Doors:
    """Finds out who stands before a request."""

    async def who(self, connection: HTTPConnection) -> Principal | None:  # noqa: ARG002 - a login will read it
        """Who it is; None: nobody that is known here."""
        return LOCAL
