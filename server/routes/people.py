"""Signing in and out, invitations, people, who is on-line, and the audit."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request, Response
from fastapi.responses import StreamingResponse

from server import export, store_audit
from server.errors import ServiceError
from server.principal import Principal, Role
from server.routes.dependencies import LARGEST_ID, Cursor, Id, Limit, Running, Who, errors
from server.routes.tables import table
from server.schemas_people import (
    AuditPage,
    InvitationCreate,
    InvitationMade,
    InvitationPage,
    Me,
    Person,
    PersonPage,
    PersonUpdate,
    Present,
    PresentList,
    SignedIn,
    SignIn,
    TokenCreate,
    TokenMade,
)

router = APIRouter(tags=["people"])

ENTER: dict[str, Any] = {"by invitation": {"value": {"token": "the-token-of-the-invitation", "name": "Ann"}}}
INVITE: dict[str, Any] = {"five trainers": {"value": {"role": "trainer", "uses": 5, "hours": 6, "access_hours": 6}}}
FOR_A_PROGRAM: dict[str, Any] = {"a notebook": {"value": {"note": "my notebook"}}}
OTHER_ROLE: dict[str, Any] = {"operator": {"value": {"role": "operator"}}}
TABLE: dict[int | str, dict[str, Any]] = {200: {"content": {"text/csv": {}}, "description": "The table"}}

OfExperiment = Annotated[int | None, Query(ge=1, le=LARGEST_ID, description="only of this experiment")]


@router.get("/me", responses=errors())
async def get_me(service: Running, request: Request) -> Me:
    """Who asks, and whether anybody has to sign in here; without a name: not signed in."""
    who: Principal | None = request.state.principal
    if who is None:
        return Me(login=True)
    return Me(login=service.doors.login, name=who.name, role=who.role, experiment_id=who.experiment_id)


@router.post("/sign-in", responses=errors(400, 409, 413, 422))
async def sign_in(
    service: Running, request: Request, response: Response, body: Annotated[SignIn, Body(openapi_examples=ENTER)]
) -> SignedIn:
    """Come in by an invitation's token, or by one's own. A page gets a cookie, a program asks for a bearer token."""
    return await service.doors.sign_in(request, body, response)


@router.post("/sign-out", status_code=204, responses=errors())
async def sign_out(service: Running, who: Who) -> Response:
    """End this session; what it has open is closed."""
    response = Response(status_code=204)
    if who.session_id is not None:
        await service.store.people.sign_out(who.session_id)
        await service.hub.let_out(lambda other: other.session_id == who.session_id)
        service.doors.forget(response)
    return response


@router.post("/me/tokens", status_code=201, responses=errors(400, 409, 413, 422))
async def make_token(
    service: Running, who: Who, body: Annotated[TokenCreate, Body(openapi_examples=FOR_A_PROGRAM)]
) -> TokenMade:
    """A token for a program that acts in one's own name: `Authorization: Bearer`. It is told this once."""
    if who.person_id is None:
        raise ServiceError(409, "nobody has to sign in here, so a program needs no token", remedy="send none")
    return TokenMade(token=await service.store.people.make_token(who.person_id, body.note))


@router.get("/invitations", responses=errors(422))
async def list_invitations(service: Running, cursor: Cursor = None, limit: Limit = 50) -> InvitationPage:
    """Every invitation, newest first; the tokens themselves are not kept."""
    return await service.store.people.invitations(cursor, limit)


@router.post("/invitations", status_code=201, responses=errors(400, 404, 409, 413, 422))
async def invite(
    service: Running, who: Who, body: Annotated[InvitationCreate, Body(openapi_examples=INVITE)]
) -> InvitationMade:
    """Make a link that lets people in. Nobody gives away more than they may themselves."""
    if not service.doors.login:
        raise ServiceError(
            409, "whoever reaches this service may do everything", remedy="start it with SEED_LOGIN=1, then invite"
        )
    _must_reach(who, body.role)
    made, token = await service.store.people.invite(body, who)
    return InvitationMade(**made.model_dump(), token=token, path=f"{service.settings.root_path}/join#{token}")


@router.delete("/invitations/{invitation_id}", status_code=204, responses=errors(404, 422))
async def revoke_invitation(service: Running, who: Who, invitation_id: Id) -> Response:
    """Let nobody in by it any more."""
    _must_reach(who, (await service.store.people.invitation(invitation_id)).role)
    await service.store.people.revoke_invitation(invitation_id)
    return Response(status_code=204)


@router.get("/people", responses=errors(422))
async def list_people(service: Running, cursor: Cursor = None, limit: Limit = 50) -> PersonPage:
    """Everybody who was let in, newest first, and where they are on-line."""
    page = await service.store.people.people(cursor, limit)
    where: dict[int, list[int]] = {}
    for visit in service.hub.presence.streams():
        if visit.who.person_id is not None and visit.experiment_id not in where.get(visit.who.person_id, []):
            where.setdefault(visit.who.person_id, []).append(visit.experiment_id)
    items = [each.model_copy(update={"online": tuple(sorted(where.get(each.id, [])))}) for each in page.items]
    return page.model_copy(update={"items": items})


@router.patch("/people/{person_id}", responses=errors(400, 404, 409, 413, 422))
async def update_person(
    service: Running, person_id: Id, body: Annotated[PersonUpdate, Body(openapi_examples=OTHER_ROLE)]
) -> Person:
    """Give somebody another role; their open pages begin anew with it, and what they attend is attended no longer."""
    changed = await service.store.people.change_role(person_id, body.role)
    await service.hub.let_out(lambda who: who.person_id == person_id)
    return changed


@router.delete("/people/{person_id}", responses=errors(404, 409, 422))
async def revoke_person(service: Running, who: Who, person_id: Id) -> Person:
    """Let somebody out: every session and token of theirs ends, and what they have open is closed at once."""
    _must_reach(who, (await service.store.people.person(person_id)).role)
    gone = await service.store.people.revoke(person_id)
    await service.hub.let_out(lambda other: other.person_id == person_id)
    return gone


@router.get("/experiments/{experiment_id}/people", responses=errors(404, 422))
async def list_present(service: Running, experiment_id: Id) -> PresentList:
    """Who is on-line in an experiment now."""
    await service.store.experiment(experiment_id)
    there = service.hub.presence.present(experiment_id)
    items = [Present(name=e.who.name, role=e.who.role, since=e.since, streams=e.streams) for e in there]
    return PresentList(items=items)


@router.get("/audit", responses=errors(422))
async def list_audit(
    service: Running, experiment: OfExperiment = None, cursor: Cursor = None, limit: Limit = 50
) -> AuditPage:
    """Every decision: who, what, when, from which session; newest first. Nothing in it is ever changed or deleted."""
    return await service.store.read(lambda s: store_audit.page(s, experiment, cursor, limit))


@router.get("/exports/audit", response_class=StreamingResponse, responses={**errors(422), **TABLE})
async def export_audit(service: Running, who: Who, experiment: OfExperiment = None) -> StreamingResponse:
    """The same as CSV, oldest first."""
    return table(export.audit(service.store, experiment), "csv", "audit", to=who, among=service.hub.presence)


def _must_reach(who: Principal, role: Role) -> None:
    if not who.role.covers(role):
        raise ServiceError(
            403, f"as {who.role.value} you have no say over the role {role.value}", remedy="ask an owner to do it"
        )
