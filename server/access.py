"""The one check of who may do what, for REST, the stream and pictures alike: the dependency of the whole app.

What each route asks is in `server.roles`; whose request it is, in `server.doors`.
"""

from __future__ import annotations

from starlette.requests import HTTPConnection

from server.errors import ServiceError
from server.principal import Principal, acting
from server.roles import NEEDS, too_little
from server.service import Service

OWNERS = ("proposal_id", "feedback_id", "execution_id", "incident_id", "practice_id")
"""Path parameters that name a row of an experiment."""


async def authorised(connection: HTTPConnection) -> None:
    """Find out who calls, and refuse them what their role doesn't allow; the dependency of every route.

    Raises:
        ServiceError: 401, nobody is signed in; 403, the role or the invitation doesn't reach.
    """
    service: Service = connection.app.state.service
    name = connection.scope["route"].name
    who = await service.doors.who(connection)
    connection.state.principal = who
    if who is not None:
        acting.set(who)
    need = NEEDS.get(name)
    if need is None:
        raise ServiceError(403, f"nobody may ask for {name}", remedy="declare its role in server/roles.py")
    if need.role is None:
        return
    if who is None:
        raise not_signed_in()
    if (refused := too_little(who, need.role)) is not None:
        raise refused
    if who.experiment_id is None or need.shared:
        return
    if await _experiment_of(service, connection.path_params) != who.experiment_id:
        raise ServiceError(
            403,
            f"{who.name} was invited to experiment {who.experiment_id} only",
            remedy="ask an owner for an invitation to all experiments",
            slug="not-invited",
        )


def not_signed_in() -> ServiceError:
    """Nobody is signed in, or not any more."""
    return ServiceError(
        401,
        "you are not signed in",
        remedy="open your invitation's link, or send the header Authorization: Bearer with a token",
        headers={"WWW-Authenticate": "Bearer"},
    )


def principal(connection: HTTPConnection) -> Principal:
    """Whoever calls a route that asks for a role."""
    who: Principal | None = connection.state.principal
    if who is None:
        raise not_signed_in()
    return who


async def _experiment_of(service: Service, parameters: dict[str, str]) -> int | None:
    """The experiment that a path belongs to; None where it belongs to none, or can't be told."""
    named = parameters.get("experiment_id")
    if named is not None:
        return _number(named)
    for owner in OWNERS:
        row = _number(parameters.get(owner, ""))
        if row is not None:
            return await service.store.experiment_of(owner.removesuffix("_id"), row)
    return None


def _number(text: str) -> int | None:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 19 else None
