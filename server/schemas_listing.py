"""How experiments are tagged, and how a list of them is narrowed and ordered."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

Tag = Annotated[str, Field(min_length=1, max_length=40, pattern=r"^[^\x00-\x1f\x7f,]+$", examples=["ablation"])]
MOST_TAGS = 20


def _tidy(tags: list[str]) -> list[str]:
    """Without the blanks around them, each once, in the order of the alphabet."""
    return sorted({tag.strip() for tag in tags} - {""})


Tags = Annotated[
    list[Tag],
    Field(max_length=MOST_TAGS, description="words to find it by; any, without a comma, up to 40 characters each"),
    AfterValidator(_tidy),
]
Sort = Literal["created", "updated", "name", "feedback", "good_share", "successes", "violations"]
Order = Literal["asc", "desc"]


class Listing(BaseModel):
    """Which experiments, and in which order. What is left out narrows nothing.

    only: the one experiment that may be seen at all.
    text: part of the name or of a tag, whichever case. tags: every one of them. good_share: good over all feedback.
    """

    model_config = ConfigDict(frozen=True)

    only: int | None = None
    task: str | None = None
    adapter: str | None = None
    algorithm: str | None = None
    lifecycle: str | None = None
    tags: tuple[str, ...] = ()
    text: str | None = None
    sort: Sort = "created"
    order: Order = "desc"


class TagInfo(BaseModel):
    """A tag in use. experiments: how many carry it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    tag: str
    experiments: int
