"""Label quality on the wire: known answers, each trainer's figures, and how far trainers agree."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StrictFloat, StrictInt

from server.schemas_labels import Answer, TrainerName


class _Wire(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


GoldRate = Annotated[
    float,
    Field(
        ge=0,
        le=0.5,
        allow_inf_nan=False,
        description="share of proposals whose answer is known beforehand: they measure trainers, look like all others,"
        " are never executed and never learned from; 0 turns it off",
    ),
]


class PracticeRequired(_Wire):
    """What a new trainer has to show in practice before their clicks count."""

    proposals: Annotated[StrictInt, Field(ge=1, le=200, description="newest practice proposals that are looked at")] = (
        10
    )
    accuracy: Annotated[
        StrictFloat, Field(gt=0, le=1, allow_inf_nan=False, description="share of them that must be judged right")
    ] = 0.8


class GoldMark(_Wire):
    """An operator knows the answer to a closed proposal."""

    answer: Annotated[Literal[-1, 1], Field(description="-1 bad, +1 good")]
    trainer: Annotated[TrainerName, Field(description="who says so")] = "local"


class GoldAnswer(_Wire):
    """What one trainer said of a proposal whose answer was known."""

    trainer: str
    value: Answer
    right: bool


class Gold(_Wire):
    """A proposal whose answer was known before it was shown; told of only once it is closed."""

    proposal_id: int
    number: int
    skill: str
    known_answer: Annotated[int, Field(description="-1 bad, +1 good")]
    source: Annotated[Literal["rule", "operator"], Field(description="the task's rule, or an operator's mark")]
    answers: list[GoldAnswer]


class GoldPage(_Wire):
    """Closed proposals whose answer was known, newest first."""

    items: list[Gold]
    next_cursor: str | None = None


class Share(_Wire):
    """So many of so many."""

    count: int
    of: int


class Estimate(_Wire):
    """How often a trainer is right, estimated from everybody's labels and from known answers."""

    accuracy: Annotated[
        float | None, Field(description="share of labels expected to be true; null: nothing to compare them with")
    ]
    interval: Annotated[tuple[float, float] | None, Field(description="95 % interval of that share")]
    informative: Annotated[int, Field(description="good and bad labels that others, or a known answer, can be held to")]
    weight: Annotated[float, Field(description="what `weighted` counts; 2/3 for a trainer of whom nothing is known")]
    at: Annotated[datetime | None, Field(description="when it was estimated; null: not yet")]


class TrainerFigures(_Wire):
    """One trainer's work in one experiment."""

    trainer: str
    kind: Literal["person", "teacher"]
    labels: Annotated[int, Field(description="good, neutral and bad clicks that counted")]
    good: int
    neutral: int
    bad: int
    cant_tell: int
    late: int
    relabelled: Annotated[int, Field(description="clicks corrected later")]
    per_minute: Annotated[
        float | None, Field(description="clicks a minute at work; a pause of more than a minute isn't work")
    ]
    with_verdicts: Annotated[Share, Field(description="labels that agree with the verdict, where others judged too")]
    with_others: Annotated[Share, Field(description="labels that agree with another trainer's of the same proposal")]
    gold: Annotated[
        Share,
        Field(description="known answers hit; told to the trainer after each fifty clicks, so that none is given away"),
    ]
    streak: Annotated[
        int, Field(description="newest labels in a row that neither a verdict of several nor a correction contradicts")
    ]
    estimate: Annotated[Estimate | None, Field(description="null in one's own figures: it gives known answers away")]


class AgreementInfo(_Wire):
    """Krippendorff's alpha, ordinal over bad, neutral and good; late clicks count, who can't tell is missing."""

    alpha: Annotated[float | None, Field(description="1: perfect; 0: as by chance; null: see `why`")]
    proposals: Annotated[int, Field(description="judged by two trainers or more")]
    labels: int
    trainers: int
    why: Annotated[str | None, Field(description="what is missing before it can be told")]


class LabelQuality(_Wire):
    """Everybody's figures, and how far they agree."""

    experiment_id: int
    agreement: AgreementInfo
    gold: Annotated[int, Field(description="closed proposals whose answer was known")]
    trainers: list[TrainerFigures]
