"""What a trainer can answer, and correcting it later, on the wire."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

CANT_TELL: Literal["cant_tell"] = "cant_tell"


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


def _plain(value: object) -> object:
    """Neither true nor 1.0 is meant as a judgement; Python takes both for 1."""
    return None if isinstance(value, bool | float) else value


class CatchingUp(_Wire):
    """How far a learner that has started anew is with the stored labels. It may propose before it has them all."""

    taken: int
    of: int


Answer = Annotated[
    Literal[-1, 0, 1, "cant_tell"],
    BeforeValidator(_plain),
    Field(
        description="-1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention:"
        " stored, never learned from, and neither for nor against"
    ),
]
ClickId = Annotated[
    str,
    Field(
        min_length=8,
        max_length=64,
        pattern=r"^[A-Za-z0-9_.:-]+$",
        description="made by the client, unique per click; the same id again is acknowledged again and stored once",
    ),
]
TrainerName = Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[^\x00-\x1f\x7f]+$")]


EstimateShown = Annotated[
    bool | None,
    Field(description="whether the page showed the predicted feedback when it was clicked; null: it wasn't told"),
]


def label_of(answer: Answer) -> int | None:
    """As it is stored and added up: -1, 0 or +1; None for `cant_tell`."""
    return None if answer == CANT_TELL else int(answer)


def answer_of(label: int | None) -> Answer:
    """The inverse of `label_of`."""
    if label is None:
        return CANT_TELL
    return 1 if label > 0 else -1 if label < 0 else 0


class RelabelCreate(_Wire):
    """Correct a click on a proposal that is closed."""

    click_id: ClickId
    value: Answer
    trainer: TrainerName = "local"


class Relabel(_Wire):
    """One correction. The click itself stays as it was given."""

    id: int
    click_id: str
    trainer: Annotated[str, Field(description="who corrected it")]
    value: Answer
    at: datetime
