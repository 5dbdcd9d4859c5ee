"""What goes into the store and comes out beside the wire models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from robot_adapters.base import SkillCall
from server.schemas import Execution, Experiment, Feedback, Proposal
from server.schemas_views import Overlay

Purpose = Literal["training", "evaluation"]
EpisodeOutcome = Literal["success", "horizon", "violation", "reset", "interrupted"]


@dataclass(frozen=True)
class NewView:
    """One camera's still image (by its hash) with the overlay that was computed on it."""

    camera: str
    width: int
    height: int
    image: str
    overlay: Overlay


@dataclass(frozen=True)
class NewProposal:
    """A proposal to open. `state` is the task's vector; parameters are metres and radians, robot base frame.

    taken_at: seconds since the epoch. electorate: the trainers whose votes majority and unanimous ask for.
    robot: index of the robot that saw the observation and would run the call. slot: which of its open proposals.
    rule_answer: what the task's rule says of the call where that is clear, +1 or -1; it is looked at only if the
    proposal is drawn to measure trainers.
    """

    experiment_id: int
    observation_id: str
    state: Sequence[float]
    taken_at: float
    call: SkillCall
    parameter_names: Sequence[str]
    predicted_feedback: float
    skill_probabilities: Mapping[str, float]
    policy_version: int
    subgoal: str | None
    views: Sequence[NewView]
    uncertainty: float | None = None
    purpose: Purpose = "training"
    electorate: Sequence[str] = ("local",)
    robot: int = 0
    slot: int = 0
    rule_answer: int | None = None


@dataclass(frozen=True)
class StoredLabel:
    """A counted feedback as the learner needs it; one per trainer of a proposal that got a verdict.

    trainer: a number for who says so: whoever corrected it last, or else who clicked.
    """

    feedback_id: int
    state: tuple[float, ...]
    skill: str
    parameters: tuple[float, ...]
    value: int
    trainer: int


@dataclass(frozen=True)
class Submission:
    """What became of a click. `closed` is the proposal if this very click closed it; `labels` train by that.

    heard: the proposal, now that this vote is counted, or this label of a proposal that was overtaken.
    """

    feedback: Feedback
    duplicate: bool
    heard: Proposal | None = None
    closed: Proposal | None = None
    labels: Sequence[StoredLabel] = ()


@dataclass(frozen=True)
class Concluded:
    """An open proposal whose votes were added up anew without a click; `labels` train if that has closed it."""

    proposal: Proposal
    labels: Sequence[StoredLabel] = ()


@dataclass(frozen=True)
class Relabelled:
    """A corrected click: what it counted as before and counts as now; `label` is what the learner has of it now."""

    feedback: Feedback
    duplicate: bool
    before: int | None
    after: int | None
    label: StoredLabel | None = None


@dataclass(frozen=True)
class Undone:
    """A click taken back: its proposal is open again, and the one opened meanwhile is withdrawn.

    Where others' votes lead to the same verdict, `reopened` is still closed. unlearned: feedback ids of the others'
    labels on it, which train no more until there is a verdict again. again: it was closed until now.
    """

    feedback: Feedback
    reopened: Proposal
    withdrawn: Proposal | None
    unlearned: Sequence[int] = ()
    again: bool = False


@dataclass(frozen=True)
class Outlook:
    """Where an experiment stands. `undoable` is the click that its trainer, or whoever, could take back now."""

    experiment: Experiment
    proposals: list[Proposal]
    executions: list[Execution]
    undoable: Feedback | None


@dataclass(frozen=True)
class Receipt:
    """Under which key, for which request, the answer to a write is kept together with what it writes."""

    key: str
    route: str
    body_digest: str
    status: int


@dataclass(frozen=True)
class StoredResponse:
    """The answer that a write was given the first time; `body` is JSON."""

    status: int
    body: Any
