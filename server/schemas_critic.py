"""What the critic expects all over the table, and what was said nearby."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schemas import Wire
from server.schemas_catalogue import Vector
from server.schemas_views import Overlay


class NearbyLabel(Wire):
    """A label of the same skill. alike: it was given in a situation like this one, no entry 2 cm away."""

    proposal_id: int
    number: int
    x: float
    y: float
    value: Literal[-1, 0, 1]
    predicted_feedback: float
    alike: bool


class Considered(Wire):
    """What the agent would do with one skill. Overlays are there while the proposal is open and its robot looks on."""

    skill: str
    probability: Annotated[float, Field(description="of the skill, when the proposal was made")]
    parameters: Annotated[dict[str, float], Field(description="m and rad, robot base frame")]
    predicted_feedback: float
    proposed: Annotated[bool, Field(description="it is the proposal itself")]
    overlays: Annotated[dict[str, Overlay], Field(description="by camera, in pixels of the proposal's pictures")]


class ConsideredList(Wire):
    """What the agent would do with each skill in one proposal's situation, the likeliest skill first."""

    proposal_id: int
    policy_version: Annotated[int, Field(description="gradient steps that the agent had taken when it was asked")]
    items: list[Considered]


class CriticMap(Wire):
    """The predicted feedback of one skill over the table, in one proposal's situation. Lengths in m, base frame."""

    experiment_id: int
    proposal_id: int
    skill: str
    x: Annotated[list[float], Field(description="of the columns, ascending")]
    y: Annotated[list[float], Field(description="of the rows, ascending")]
    values: Annotated[list[list[float]], Field(description="a row for each y, a value for each x")]
    others: Annotated[dict[str, float], Field(description="the skill's other parameters, the same everywhere")]
    labels: list[NearbyLabel]
    keypoints: Annotated[list[Vector], Field(description="where the skill acts on objects, as the task tells")]
    policy_version: Annotated[int, Field(description="gradient steps that this critic had taken")]
    source: Annotated[
        Literal["learner", "checkpoint"], Field(description="asked as it learns, or read from its newest checkpoint")
    ]
