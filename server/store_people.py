"""Who may come in: people, invitations and sessions. Tokens are told once; the database keeps their digests only."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Collection
from datetime import UTC, datetime, timedelta
from typing import TypeVar

from sqlalchemy import Select, or_, select
from sqlalchemy.orm import Session

from server import schemas_people as wire
from server import store_pages
from server.database import Database, writes
from server.models import ExperimentRow
from server.models_people import InvitationRow, PersonRow, SessionRow
from server.names import must_be_a_persons
from server.principal import Principal, Role
from server.store_audit import record
from server.store_errors import Conflict, NotFound

R = TypeVar("R", ExperimentRow, InvitationRow, PersonRow)

OWNER = "owner"
"""Name of whoever holds the token that the first start prints."""


FIRST_USE = timedelta(days=7)
"""How long the owner may take to sign in by a token that was printed."""


class WrongToken(Conflict):
    """The token opens nothing: mistyped, used up, expired or revoked. Which of them isn't told to a stranger."""

    def __init__(self) -> None:
        super().__init__(
            "this token opens nothing, or nothing any more", remedy="ask whoever invited you for a new link"
        )


def digest(token: str) -> str:
    """As it is stored."""
    return hashlib.sha256(token.encode()).hexdigest()


def new_token() -> str:
    """256 random bits."""
    return secrets.token_urlsafe(32)


class PeopleStore:
    """Reads and writes of access."""

    def __init__(self, database: Database) -> None:
        self._database = database

    # --- signing in ---------------------------------------------------------------------------------------------

    async def who(self, token: str) -> Principal | None:
        """Whose token this is; None: nobody's who may still come in."""
        key = digest(token)

        def find(session: Session) -> Principal | None:
            row = _active_session(session, key)
            return None if row is None or row.once else _principal(row)

        return await self._database.read(find)

    async def let_in(self, sessions: Collection[int]) -> dict[int, Principal]:
        """Those of these sessions that still let somebody in, and who that is by now."""

        def find(session: Session) -> dict[int, Principal]:
            return {row.id: _principal(row) for row in session.scalars(_active().where(SessionRow.id.in_(sessions)))}

        return await self._database.read(find)

    @writes
    async def sign_in(self, body: wire.SignIn, *, lasts: timedelta) -> tuple[wire.Person, str]:
        """Let somebody in by an invitation or by a token of their own; the person, and the token of the new session.

        Raises:
            WrongToken: it opens nothing. Conflict: the name is missing or taken. BadName: it is the service's own.
        """
        must_be_a_persons(body.name or "", "name")
        made = new_token()

        def enter(session: Session) -> wire.Person:
            invitation = _open_invitation(session, digest(body.token))
            if invitation is not None:
                person = _admit(session, invitation, body.name)
            else:
                own = _active_session(session, digest(body.token))
                if own is None or own.kind != "token":
                    raise WrongToken
                if own.once:
                    own.revoked_at = _now()
                person = own.person
            row = SessionRow(
                person=person,
                digest=digest(made),
                kind="token" if body.bearer else "page",
                note="",
                created_at=_now(),
                expires_at=_earliest(None if body.bearer else _now() + lasts, person.access_until),
            )
            session.add(row)
            session.flush()
            session.info["who"] = _principal(row)
            record(session, "signed_in", person.experiment_id, program=body.bearer)
            return _person(person)

        return await self._database.write(enter), made

    @writes
    async def sign_out(self, session_id: int) -> None:
        """End one session."""

        def leave(session: Session) -> None:
            session.get_one(SessionRow, session_id).revoked_at = _now()
            record(session, "signed_out")

        await self._database.write(leave)

    @writes
    async def make_token(self, person_id: int, note: str) -> str:
        """A token for a program of this person."""
        made = new_token()

        def make(session: Session) -> None:
            person = session.get_one(PersonRow, person_id)
            expires = person.access_until
            session.add(
                SessionRow(
                    person=person, digest=digest(made), kind="token", note=note, created_at=_now(), expires_at=expires
                )
            )
            record(session, "token_made", note=note)

        await self._database.write(make)
        return made

    async def has_owner(self) -> bool:
        """Whether somebody can let others in."""
        query = select(PersonRow.id).where(PersonRow.role == Role.OWNER.value, PersonRow.revoked_at.is_(None)).limit(1)
        return await self._database.read(lambda session: session.scalar(query)) is not None

    async def own_by(self, token: str) -> None:
        """Have this be the owner's token, as it is already or from now on; then those of before end."""
        who = await self.who(token)
        if who is None or who.name != OWNER or who.role is not Role.OWNER:
            await self.owner_token(token)

    async def old_way_in(self) -> bool:
        """Whether a token that an earlier version has printed, and that never ends, still lets the owner in."""

        def find(session: Session) -> bool:
            owners = _active().where(PersonRow.name == OWNER).order_by(SessionRow.id)
            # what made it has ended those of before; the sessions that came of it stand behind it
            oldest = session.scalars(owners).first()
            return oldest is not None and oldest.kind == "token" and not any(row.once for row in oldest.person.sessions)

        return await self._database.read(find)

    @writes
    async def owner_token(self, given: str | None = None) -> str:
        """A new token of the owner. Those of before, and every session of the owner, end.

        given: one that is kept somewhere and stays; else one is made, by which the owner signs in a single time.
        """
        made = given or new_token()

        def make(session: Session) -> None:
            person = session.scalars(select(PersonRow).where(PersonRow.name == OWNER)).one_or_none()
            if person is None:
                person = PersonRow(name=OWNER, role=Role.OWNER.value, created_at=_now())
                session.add(person)
            person.revoked_at, person.role = None, Role.OWNER.value
            for each in person.sessions:
                each.revoked_at = each.revoked_at or _now()
            row = session.scalars(select(SessionRow).where(SessionRow.digest == digest(made))).one_or_none()
            if row is None:
                row = SessionRow(digest=digest(made), note="", created_at=_now())
                session.add(row)
            row.person, row.kind, row.revoked_at = person, "token", None
            row.once, row.expires_at = given is None, None if given else _now() + FIRST_USE
            record(session, "owner_token_made")

        await self._database.write(make)
        return made

    # --- invitations --------------------------------------------------------------------------------------------

    @writes
    async def invite(self, body: wire.InvitationCreate, by: Principal) -> tuple[wire.Invitation, str]:
        """A new invitation and its token.

        Raises:
            NotFound: no such experiment.
        """
        made = new_token()

        def make(session: Session) -> wire.Invitation:
            if body.experiment_id is not None:
                _load(session, ExperimentRow, body.experiment_id)
            at = _now()
            row = InvitationRow(
                digest=digest(made),
                role=body.role.value,
                experiment_id=body.experiment_id,
                note=body.note,
                uses=body.uses,
                used=0,
                expires_at=at + timedelta(hours=body.hours),
                access_until=None if body.access_hours is None else at + timedelta(hours=body.access_hours),
                invited_by=by.name,
                created_at=at,
            )
            session.add(row)
            session.flush()
            record(session, "invited", body.experiment_id, invitation=row.id, role=row.role, uses=row.uses)
            return _invitation(row)

        return await self._database.write(make), made

    async def invitations(self, cursor: str | None, limit: int) -> wire.InvitationPage:
        """Newest first."""
        items, following = await self._database.read(
            lambda s: store_pages.page(
                s, select(InvitationRow), InvitationRow.id, _invitation, cursor=cursor, limit=limit
            )
        )
        return wire.InvitationPage(items=items, next_cursor=following)

    async def invitation(self, invitation_id: int) -> wire.Invitation:
        """One of them.

        Raises:
            NotFound: there is none.
        """
        return await self._database.read(lambda s: _invitation(_load(s, InvitationRow, invitation_id)))

    @writes
    async def revoke_invitation(self, invitation_id: int) -> None:
        """Let nobody in by it any more; those who are in stay."""

        def revoke(session: Session) -> None:
            row = _load(session, InvitationRow, invitation_id)
            if row.revoked_at is None:
                row.revoked_at = _now()
                record(session, "invitation_revoked", row.experiment_id, invitation=row.id)

        await self._database.write(revoke)

    # --- people -------------------------------------------------------------------------------------------------

    async def people(self, cursor: str | None, limit: int) -> wire.PersonPage:
        """Newest first, also those who were let out."""
        items, following = await self._database.read(
            lambda s: store_pages.page(s, select(PersonRow), PersonRow.id, _person, cursor=cursor, limit=limit)
        )
        return wire.PersonPage(items=items, next_cursor=following)

    async def person(self, person_id: int) -> wire.Person:
        """One of them.

        Raises:
            NotFound: there is none.
        """
        return await self._database.read(lambda s: _person(_load(s, PersonRow, person_id)))

    @writes
    async def change_role(self, person_id: int, role: Role) -> wire.Person:
        """Give somebody another role.

        Raises:
            NotFound: there is nobody. Conflict: it is the last owner.
        """

        def change(session: Session) -> wire.Person:
            row = _load(session, PersonRow, person_id)
            if role is not Role.OWNER:
                _must_not_be_last(session, row)
            if row.role != role.value:
                record(session, "role_changed", row.experiment_id, person=row.id, before=row.role, after=role.value)
                row.role = role.value
            return _person(row)

        return await self._database.write(change)

    @writes
    async def revoke(self, person_id: int) -> wire.Person:
        """Let somebody out, with every session and token of theirs.

        Raises:
            NotFound: there is nobody. Conflict: it is the last owner.
        """

        def revoke(session: Session) -> wire.Person:
            row = _load(session, PersonRow, person_id)
            _must_not_be_last(session, row)
            if row.revoked_at is None:
                row.revoked_at = _now()
                record(session, "revoked", row.experiment_id, person=row.id, name_of=row.name)
            return _person(row)

        return await self._database.write(revoke)


def _active() -> Select[SessionRow]:
    """Sessions that let somebody in now."""
    at = _now()
    return (
        select(SessionRow)
        .join(PersonRow)
        .where(SessionRow.revoked_at.is_(None), PersonRow.revoked_at.is_(None))
        .where(or_(SessionRow.expires_at.is_(None), SessionRow.expires_at > at))
        .where(or_(PersonRow.access_until.is_(None), PersonRow.access_until > at))
    )


def _active_session(session: Session, key: str) -> SessionRow | None:
    return session.scalars(_active().where(SessionRow.digest == key)).one_or_none()


def _open_invitation(session: Session, key: str) -> InvitationRow | None:
    row = InvitationRow
    query = select(row).where(row.digest == key, row.revoked_at.is_(None), row.expires_at > _now(), row.used < row.uses)
    return session.scalars(query).one_or_none()


def _admit(session: Session, invitation: InvitationRow, name: str | None) -> PersonRow:
    wanted = (name or "").strip()
    if not wanted:
        raise Conflict("name: an invitation asks for a name", remedy="send a name, by which the others will know you")
    if session.scalar(select(PersonRow.id).where(PersonRow.name == wanted)) is not None or wanted in RESERVED:
        raise Conflict(f"name: {wanted} is taken", remedy="take another name, e.g. with an initial")
    invitation.used += 1
    person = PersonRow(
        name=wanted,
        role=invitation.role,
        experiment_id=invitation.experiment_id,
        invitation_id=invitation.id,
        access_until=invitation.access_until,
        created_at=_now(),
    )
    session.add(person)
    session.flush()
    return person


RESERVED = frozenset({OWNER, "local", "service"})
"""Names that would be taken for somebody else in an audit."""


def _load(session: Session, kind: type[R], row_id: int) -> R:
    row = session.get(kind, row_id)
    if row is None:
        raise NotFound(kind.__tablename__, row_id)
    return row


def _must_not_be_last(session: Session, row: PersonRow) -> None:
    others = select(PersonRow.id).where(
        PersonRow.role == Role.OWNER.value, PersonRow.revoked_at.is_(None), PersonRow.id != row.id
    )
    if row.role == Role.OWNER.value and session.scalar(others.limit(1)) is None:
        raise Conflict("this is the last owner", remedy="make somebody else an owner first")


def _principal(row: SessionRow) -> Principal:
    person = row.person
    return Principal(
        name=person.name,
        role=Role(person.role),
        person_id=person.id,
        session_id=row.id,
        experiment_id=person.experiment_id,
    )


def _person(row: PersonRow) -> wire.Person:
    fields = ("id", "name", "role", "experiment_id", "access_until", "created_at", "revoked_at")
    return wire.Person(**{field: getattr(row, field) for field in fields})


def _invitation(row: InvitationRow) -> wire.Invitation:
    return wire.Invitation(**{field: getattr(row, field) for field in wire.Invitation.model_fields})


def _earliest(*times: datetime | None) -> datetime | None:
    return min((each for each in times if each is not None), default=None)


def _now() -> datetime:
    return datetime.now(UTC)
