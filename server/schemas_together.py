"""Several trainers on one experiment, on the wire: how they share its proposals, and who is at which."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StrictBool, StrictInt

from server.schemas_labels import TrainerName


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


LeaseSeconds = Annotated[
    float,
    Field(
        ge=1,
        le=3600,
        allow_inf_nan=False,
        description="how long a proposal stays with the trainer it was given to, without a sign that they look at it;"
        " then they are away, and nobody waits for them",
    ),
]
VanishSeconds = Annotated[
    float,
    Field(
        ge=0,
        le=600,
        allow_inf_nan=False,
        description="how long a trainer who is gone is waited for before the proposals that are open are decided"
        " without them",
    ),
]


FinishSeconds = Annotated[
    float,
    Field(
        ge=0,
        le=600,
        allow_inf_nan=False,
        description="how long a trainer may still judge what they had before them when another proposal was approved:"
        " it trains, and decides nothing",
    ),
]


Least = Annotated[
    StrictInt,
    Field(
        ge=1,
        le=50,
        description="how many trainers at least have to say good before a robot moves, however few are left",
    ),
]


class Together(_Wire):
    """How several trainers share the proposals of one experiment."""

    parallel: Annotated[
        StrictBool,
        Field(description="each trainer gets a proposal of their own; the first that is approved closes the others"),
    ] = False
    weighted_approves: Annotated[
        StrictBool,
        Field(
            description="whether the rule `weighted` may approve by estimated reliability alone; else more than half of"
            " the heads have to say good as well"
        ),
    ] = False
    least: Least = 1
    lease_seconds: LeaseSeconds = 60.0
    vanish_seconds: VanishSeconds = 10.0
    finish_seconds: FinishSeconds = 20.0


class TogetherUpdate(_Wire):
    """What may change of it live; a field left out stays."""

    parallel: StrictBool | None = None
    weighted_approves: StrictBool | None = None
    least: Least | None = None
    lease_seconds: LeaseSeconds | None = None
    vanish_seconds: VanishSeconds | None = None
    finish_seconds: FinishSeconds | None = None


class Judge(_Wire):
    """A trainer who is there, and what they have before them."""

    trainer: str
    proposal_id: Annotated[int | None, Field(description="the proposal that is theirs to judge")] = None
    until: Annotated[datetime | None, Field(description="when it goes back, without a sign that they look at it")] = (
        None
    )
    finishing: Annotated[
        bool,
        Field(
            description="another proposal was approved while they looked at this one: what they say of it until then"
            " trains, and decides nothing"
        ),
    ] = False
    here: Annotated[bool, Field(description="whether a page of theirs is connected")] = True
    away: Annotated[
        bool,
        Field(
            description="connected, but without a sign of life for longer than a lease: not asked, and not waited for,"
            " until the next one"
        ),
    ] = False


class NextCreate(_Wire):
    """Ask for the next proposal."""

    trainer: TrainerName = "local"


class Looked(_Wire):
    """What a trainer saw when they clicked. Where it isn't what the proposal shows, the click decides nothing."""

    observation_id: Annotated[str, Field(max_length=200)]
    policy_version: StrictInt
