"""People, invitations, signing in and the audit, on the wire."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any

from pydantic import Field

from server.principal import Role
from server.schemas import RowId, Wire
from server.schemas_labels import TrainerName

Token = Annotated[
    str,
    Field(min_length=20, max_length=200, pattern=r"^[A-Za-z0-9_-]+$", description="of an invitation, or one's own"),
]
Note = Annotated[str, Field(max_length=120, description="for whom or what, in your own words")]


class SignIn(Wire):
    """What lets somebody in. An invitation asks for a name; one's own token doesn't."""

    token: Token
    name: Annotated[TrainerName | None, Field(description="under which you judge; with an invitation only")] = None
    bearer: Annotated[
        bool, Field(description="true: for a program, the answer has a token for `Authorization: Bearer`; no cookie")
    ] = False


class Me(Wire):
    """Who asks."""

    login: Annotated[bool, Field(description="whether anybody has to sign in here")]
    name: str | None = None
    role: Role | None = None
    experiment_id: Annotated[int | None, Field(description="the one experiment you were invited to")] = None
    access_until: datetime | None = None


class SignedIn(Me):
    """Who is signed in now."""

    token: Annotated[str | None, Field(description="shown this once; only where it was asked for")] = None


class InvitationCreate(Wire):
    """A link to hand out."""

    role: Role = Role.TRAINER
    experiment_id: Annotated[RowId | None, Field(description="the only experiment they may see; null: all")] = None
    uses: Annotated[int, Field(ge=1, le=1000, description="how many people may use the link")] = 1
    hours: Annotated[float, Field(gt=0, le=24 * 365, description="until the link ends")] = 24.0
    access_hours: Annotated[
        float | None, Field(gt=0, le=24 * 365, description="until those who used it are let out; null: never")
    ] = None
    note: Note = ""


class Invitation(Wire):
    """An invitation as it stands; its token was told once."""

    id: int
    role: Role
    experiment_id: int | None
    note: str
    uses: int
    used: int
    expires_at: datetime
    access_until: datetime | None
    invited_by: str
    created_at: datetime
    revoked_at: datetime | None


class InvitationMade(Invitation):
    """A new invitation, with what only its maker is told."""

    token: str
    path: Annotated[str, Field(description="of the link, to be put behind the address of the service")]


class InvitationPage(Wire):
    """Invitations, newest first."""

    items: list[Invitation]
    next_cursor: str | None


class Person(Wire):
    """Somebody who was let in."""

    id: int
    name: str
    role: Role
    experiment_id: int | None
    access_until: datetime | None
    created_at: datetime
    revoked_at: datetime | None
    online: Annotated[tuple[int, ...], Field(description="ids of the experiments that they look at now")] = ()


class PersonPage(Wire):
    """People, newest first."""

    items: list[Person]
    next_cursor: str | None


class PersonUpdate(Wire):
    """What may change about somebody."""

    role: Role


class TokenCreate(Wire):
    """A token for a program of one's own."""

    note: Note = ""


class TokenMade(Wire):
    """A new token; it is told this once."""

    token: str


class Present(Wire):
    """Somebody who is on-line in an experiment."""

    name: str
    role: Role
    since: datetime
    streams: Annotated[int, Field(description="open pages; two of one person are one person")]


class PresentList(Wire):
    """Everyone who is on-line in an experiment, who came first first."""

    items: list[Present]


class AuditEntry(Wire):
    """One decision. `session_id` null: nobody has to sign in, or the service did it by itself."""

    id: int
    at: datetime
    name: str
    role: str
    person_id: int | None
    session_id: int | None
    experiment_id: int | None
    action: str
    subject: dict[str, Any]


class AuditPage(Wire):
    """Decisions, newest first."""

    items: list[AuditEntry]
    next_cursor: str | None
