"""How far the critic may be trusted, on the wire: its calibration, and the rule by which it may approve by itself."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StrictFloat, StrictInt


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class VerdictSource(StrEnum):
    """Who a verdict is by. `critic`: auto-approval in simulation; there is no feedback, and nothing learns from it."""

    TRAINERS = "trainers"
    CRITIC = "critic"
    EVALUATION = "evaluation"


Uncertainty = Annotated[
    float | None,
    Field(description="how far the critics disagree, a standard deviation of predicted feedback; null: not known"),
]
Audit = Annotated[bool, Field(description="the critic would have approved it; a trainer was asked to check the critic")]
Suspended = Annotated[str | None, Field(description="why auto-approval has suspended itself; setting it anew lifts it")]


class AutoApproval(_Wire):
    """When the critic may approve a proposal by itself. Simulated robots only; the critics must be two or more."""

    predicted_at_least: Annotated[
        StrictFloat, Field(ge=0, le=1, allow_inf_nan=False, description="least predicted feedback")
    ] = 0.9
    uncertainty_at_most: Annotated[
        StrictFloat, Field(ge=0, le=2, allow_inf_nan=False, description="most disagreement of the critics")
    ] = 0.1
    after_feedback: Annotated[
        StrictInt, Field(ge=1, le=1_000_000, description="feedback that must be stored before")
    ] = 50
    audit_every: Annotated[
        StrictInt,
        Field(ge=1, le=100, description="one of so many qualifying proposals goes to a trainer anyway; 1: all of them"),
    ] = 10
    agreement_at_least: Annotated[
        StrictFloat,
        Field(
            ge=0.5,
            le=1,
            allow_inf_nan=False,
            description="share of audited proposals that trainers must call good; suspended once the 95 % interval of "
            "the newest audits lies below it",
        ),
    ] = 0.9


class AutoApprovalRecord(_Wire):
    """What the critic approved by itself, and what trainers said of the proposals that were held back to check it."""

    experiment_id: int
    rule: Annotated[AutoApproval | None, Field(description="null: off")]
    suspended: Suspended
    approved: Annotated[int, Field(description="motions by the critic's own approval, since the experiment began")]
    audited: Annotated[int, Field(description="newest audits that trainers judged, since the rule was set")]
    agreed: Annotated[int, Field(description="those of them that trainers called good")]
    agreement: Annotated[float | None, Field(description="agreed / audited; null before the first audit")]
    interval: Annotated[tuple[float, float], Field(description="Wilson's 95 % interval of the agreement")]


class CalibrationBin(_Wire):
    """Predictions between `low` and `high`: how many, their mean, and the mean of the labels that followed."""

    low: float
    high: float
    count: int
    predicted: float
    label: float


class Calibration(_Wire):
    """Reliability curve of the critic: what it predicted when it proposed, against the first label that followed."""

    experiment_id: int
    labels: Annotated[int, Field(description="labels that the curve is made of")]
    needed: Annotated[int, Field(description="labels before which the curve says nothing")]
    error: Annotated[
        float | None,
        Field(description="expected calibration error in units of feedback; null with fewer labels than needed"),
    ]
    bins: Annotated[list[CalibrationBin], Field(description="ascending; empty ones are left out")]
