"""Names that are no person's: the service writes them itself, and nobody may go by them."""

from __future__ import annotations

from server.store_errors import BadName

TEACHER = "teacher:"
"""How the name of a synthetic trainer begins."""
SOMEBODY = "somebody-"
"""How the word begins that stands for a name that isn't told."""
SERVICES = frozenset({"evaluation", "trainers", "critic"})
"""What stands in a trainer's place where none has decided."""
_TAKEN = (TEACHER, SOMEBODY, *sorted(SERVICES))
_REMEDY = "another name, one that begins with none of " + ", ".join(_TAKEN)


def is_taken(name: str) -> bool:
    """Whether it is one of the service's own, or could be mistaken for one."""
    return name.strip().casefold().startswith(_TAKEN)


def must_be_a_persons(name: str, field: str) -> None:
    """Refuse what is the service's own.

    Raises:
        BadName: it is; the error names the field.
    """
    if is_taken(name):
        raise BadName(
            f"{field}: {name[:64]!r} is no name for a person: the service itself writes what begins like that",
            remedy=f"send in {field} {_REMEDY}",
        )
