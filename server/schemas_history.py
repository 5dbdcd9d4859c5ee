"""What happened in an experiment, proposal by proposal and episode by episode, as it is told afterwards."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from server.schemas import Execution, Feedback, Page, Proposal, RobotIndex, Wire

Label = Literal["good", "neutral", "bad", "cant_tell"]


class HistoryEntry(Wire):
    """A closed proposal with what was said of it and what came of it."""

    proposal: Proposal
    feedback: Annotated[list[Feedback], Field(description="every click, oldest first: late and undone ones too")]
    execution: Execution | None


class HistoryPage(Page):
    """Closed proposals, newest first unless asked for otherwise."""

    items: list[HistoryEntry]


class HistoryFilter(BaseModel):
    """Which proposals. What is left out narrows nothing. label: somebody says so by now, and it counts."""

    model_config = ConfigDict(frozen=True)

    skill: str | None = None
    verdict: Literal["good", "neutral", "bad", "none"] | None = None
    label: Label | None = None
    executed: bool | None = None
    violation: bool | None = None
    episode: int | None = None
    purpose: Literal["training", "evaluation"] | None = None
    order: Literal["asc", "desc"] = "desc"


class Episode(Wire):
    """From one reset to the next. outcome is null while it goes on."""

    number: Annotated[int, Field(description="in its experiment, from 1")]
    robot: RobotIndex
    purpose: Literal["training", "evaluation"]
    outcome: Literal["success", "horizon", "violation", "reset", "interrupted"] | None
    seed: int
    started_at: datetime
    ended_at: datetime | None
    proposals: int
    executions: int
    violations: int


class Stretch(Wire):
    """What was said of closed proposals within one stretch of time, as it counts by now, and what came of it."""

    at: Annotated[datetime, Field(description="when it begins")]
    good: int
    neutral: int
    bad: int
    cant_tell: int
    executions: Annotated[int, Field(description="motions that began in it, or before the next one that is told")]
    violations: Annotated[int, Field(description="those of them with a safety violation")]
    proposal: Annotated[int, Field(description="number of the first one that was judged in it")]
    episode: Annotated[int, Field(description="number of that proposal's episode")]


class Timeline(Wire):
    """How an experiment's labels came in: stretches of the same length, oldest first, without those that have none."""

    seconds: Annotated[int, Field(ge=1, description="length of each stretch")]
    started_at: Annotated[datetime | None, Field(description="of the first label, to the second; null: there is none")]
    ended_at: Annotated[datetime | None, Field(description="of the last label, to the second")]
    stretches: list[Stretch]


class EpisodePage(Page):
    """Episodes, newest first."""

    items: list[Episode]
