"""Whose request this is. Without a login everyone is the local owner; with one, a token says who it is."""

from __future__ import annotations

import asyncio
import logging
from datetime import timedelta

from starlette.requests import HTTPConnection
from starlette.responses import Response

from server.errors import ServiceError
from server.hub import Hub
from server.origin import SAFE_METHODS, is_loopback
from server.principal import LOCAL, Principal
from server.rates import Rates
from server.schemas_people import SignedIn, SignIn
from server.settings import Settings
from server.store import Store
from server.store_errors import StoreError
from server.store_people import WrongToken

COOKIE = "seed_session"
"""Of the page. HttpOnly: no script reads it; SameSite: no other site sends it."""
UNKNOWN = "local"
"""Stands for the address of who comes by no network."""
UNCOUNTED = frozenset({"halt_experiment"})
"""Routes that somebody who is let in may ask for at any rate: an emergency stop never waits."""
LOOK_EVERY = 2.0
"""Seconds between two looks at whether those who have a stream open, or download, may still come in."""

log = logging.getLogger(__name__)


class Doors:
    """Finds out who stands before a request, and lets people in and out."""

    def __init__(self, settings: Settings, store: Store) -> None:
        self.login = settings.login
        self._people = store.people
        self._rates = Rates(settings.rate_limit)
        self._lasts = timedelta(hours=settings.session_hours)
        self._path = settings.root_path or "/"

    async def who(self, connection: HTTPConnection) -> Principal | None:
        """Who it is; None: nobody that is known here.

        Raises:
            ServiceError: 429, they ask too often; 403, a page's cookie came without the page's origin, or somebody
            comes from elsewhere although nobody is asked who they are.
        """
        if not self.login:
            address = _address(connection)
            if address != UNKNOWN and not is_loopback(address):  # a proxy of this machine has said for whom it asks
                raise ServiceError(
                    403,
                    f"{address} is another machine, and there is no login: only who sits at this one may come in",
                    remedy="set SEED_LOGIN=1: the service then asks everybody who they are (docs/people.md)",
                    slug="no-login",
                )
            return LOCAL
        scheme, _, bearer = connection.headers.get("authorization", "").partition(" ")
        token = bearer.strip() if scheme.lower() == "bearer" else ""
        if not token:
            token = connection.cookies.get(COOKIE, "")
            if token:
                _must_be_of_a_page(connection)
        # first who it is: a stranger at the same address, or a program with an old token, must not shut out the others
        who = await self._people.who(token[:200]) if token else None
        if who is None:
            address = _address(connection)
            self._rates.ask("address", address)
            if token:
                self._rates.must_be_patient(address)
                self._rates.failed(address)
        elif connection.scope["route"].name not in UNCOUNTED:
            self._rates.ask("person", str(who.person_id))
        return who

    def pace(self, who: Principal) -> None:
        """Count a message of a stream: of one session, however many streams it has open.

        Raises:
            ServiceError: 429, they send too many.
        """
        if self.login:
            self._rates.ask("session", str(who.session_id))

    async def watch(self, hub: Hub) -> None:
        """Let out those whose access runs out, or was ended by another process; until it is cancelled.

        What ends here is cut off at once by whoever ends it. This also finds a stream or a download that was just
        beginning, and a word of somebody at a robot that was on its way.
        """
        while self.login:
            await asyncio.sleep(LOOK_EVERY)
            here = [*hub.presence.served(), *hub.attending]
            ids = {who.session_id for who in here if who.session_id is not None}
            if not ids:
                continue
            try:
                known = await self._people.let_in(ids)
                # who came in meanwhile was let in a moment ago, and is looked at the next time
                await hub.let_out(lambda who: who.session_id in ids and known.get(who.session_id) != who)  # noqa: B023
            except StoreError as error:
                log.warning("whether those who are here still may be can't be told: %s. %s", error, error.remedy)

    async def sign_in(self, connection: HTTPConnection, body: SignIn, response: Response) -> SignedIn:
        """Let somebody in; the page gets its cookie, a program its token.

        Raises:
            ServiceError: 409, there is no login here; 401, the token opens nothing; 429. Conflict: the name is taken.
        """
        if not self.login:
            raise ServiceError(
                409, "nobody has to sign in here", remedy="start the service with SEED_LOGIN=1 to ask for it"
            )
        address = _address(connection)
        self._rates.must_be_patient(address)
        try:
            person, token = await self._people.sign_in(body, lasts=self._lasts)
        except WrongToken as error:
            self._rates.failed(address)
            raise ServiceError(401, str(error), remedy=error.remedy) from error
        if not body.bearer:
            response.set_cookie(
                COOKIE,
                token,
                max_age=round(self._lasts.total_seconds()),
                path=self._path,
                secure=connection.url.scheme in ("https", "wss"),
                httponly=True,
                samesite="strict",
            )
        return SignedIn(
            login=True,
            name=person.name,
            role=person.role,
            experiment_id=person.experiment_id,
            access_until=person.access_until,
            token=token if body.bearer else None,
        )

    def forget(self, response: Response) -> None:
        """Take the page's cookie away."""
        response.delete_cookie(COOKIE, path=self._path, httponly=True, samesite="strict")


def _must_be_of_a_page(connection: HTTPConnection) -> None:
    """A browser names the origin of whatever may change something; that it is ours was checked before (`origin`)."""
    unsafe = connection.scope["type"] == "websocket" or connection.scope["method"] not in SAFE_METHODS
    if unsafe and "origin" not in connection.headers:
        raise ServiceError(
            403,
            "a cookie counts for pages only, and a page names its origin",
            remedy="send Authorization: Bearer with a token instead",
            slug="foreign-origin",
        )


def _address(connection: HTTPConnection) -> str:
    return connection.client.host if connection.client is not None else UNKNOWN
