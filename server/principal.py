"""Who acts: a role, a name and the session they act from. Made in one place, `server.doors`."""

from __future__ import annotations

from contextvars import ContextVar
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TypeVar

from pydantic import BaseModel

from server.names import must_be_a_persons

B = TypeVar("B", bound=BaseModel)


class Role(StrEnum):
    """What someone may do; each may also do what those before it may."""

    VIEWER = "viewer"
    TRAINER = "trainer"
    OPERATOR = "operator"
    OWNER = "owner"

    def covers(self, needed: Role) -> bool:
        """Whether this role may do what `needed` may."""
        ranks = list(Role)
        return ranks.index(self) >= ranks.index(needed)


@dataclass(frozen=True)
class Principal:
    """Someone who acts, as the service knows them."""

    name: str
    role: Role
    person_id: int | None = None
    """Row of `person`; None without a login, and for the service itself."""
    session_id: int | None = None
    """Row of `session`; None without a login, and for the service itself."""
    experiment_id: int | None = None
    """The one experiment that they may see; None: every one."""

    @property
    def local(self) -> bool:
        """Whether nobody signed in: whoever sits at this machine."""
        return self.session_id is None

    def may(self, needed: Role, experiment_id: int | None = None) -> bool:
        """Whether the role reaches, there. Without an experiment: for something that belongs to all of them."""
        return self.role.covers(needed) and self.experiment_id in (None, experiment_id)

    def called(self, name: str) -> Principal:
        """Without a login a client may say in whose name it acts; with one, nobody may."""
        return replace(self, name=name) if self.local else self

    def asking(self, name: str | None) -> str | None:
        """Who wants something of their own: without a login the name that was said, if any."""
        return name if self.local else self.name

    def speaking_for(self, name: str | None) -> str:
        """The name whose figures they may ask for: an operator anybody's, everyone else their own."""
        return name if name is not None and (self.local or self.role.covers(Role.OPERATOR)) else self.name

    def named(self, body: B) -> B:
        """A body whose `trainer` is who really sent it: with a login, whatever the body says.

        Raises:
            BadName: nobody signs in, and it is sent under a name that is the service's own.
        """
        if not self.local:
            return body.model_copy(update={"trainer": self.name})
        must_be_a_persons(getattr(body, "trainer", ""), "trainer")
        return body


LOCAL = Principal("local", Role.OWNER)
"""Whoever sits at this machine, where no login is asked for."""
SERVICE = Principal("service", Role.OWNER)
"""The service itself, in what it does of its own accord."""
acting: ContextVar[Principal] = ContextVar("acting", default=SERVICE)
"""In whose name the task at hand acts. `server.access` sets it; what the service begins by itself sets it back."""
