"""What REST bodies look like; the stream's messages are in `messages.py`.

Times are ISO 8601 UTC. Parameters are in metres and radians, robot base frame; overlays in pixels of the image.
"""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, StrictInt

from server.schemas_incidents import Report, Violation
from server.schemas_labels import Answer, CatchingUp, ClickId, EstimateShown, Relabel, TrainerName, label_of
from server.schemas_listing import Tags
from server.schemas_quality import GoldRate, PracticeRequired
from server.schemas_together import Judge, Looked, Together, TogetherUpdate
from server.schemas_trust import Audit, AutoApproval, Suspended, Uncertainty, VerdictSource
from server.schemas_views import View


class Wire(BaseModel):
    """Base of every message: unknown fields are an error, values are immutable."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class NoFields(Wire):
    """The body of a verb that takes none: a field that is meant to do something is refused, not ignored."""


class Lifecycle(StrEnum):
    """Where an experiment is (DESIGN.md section 6). `halted` is a separate, latched flag."""

    CREATED = "created"
    RUNNING = "running"
    PAUSED = "paused"
    FINISHED = "finished"
    FAILED = "failed"
    ARCHIVED = "archived"


class Phase(StrEnum):
    """What a running experiment is doing right now."""

    IDLE = "idle"
    STARTING = "starting"
    OBSERVING = "observing"
    PROPOSING = "proposing"
    AWAITING_FEEDBACK = "awaiting_feedback"
    DECIDING = "deciding"
    EXECUTING = "executing"
    LEARNING = "learning"
    EVALUATING = "evaluating"


class Mode(StrEnum):
    """Whether an approved skill reaches the robot."""

    PROPOSE_ONLY = "propose_only"
    EXECUTE_APPROVED = "execute_approved"


class Aggregation(StrEnum):
    """How several trainers' feedback on one proposal adds up to a verdict."""

    FIRST = "first"
    MAJORITY = "majority"
    UNANIMOUS = "unanimous"
    WEIGHTED = "weighted"


RowId = Annotated[StrictInt, Field(ge=1, lt=2**63)]
RobotIndex = Annotated[int, Field(description="which robot of the experiment, from 0")]
Seed = Annotated[StrictInt, Field(ge=0, lt=2**31)]
Name = Annotated[str, Field(min_length=1, max_length=120, pattern=r"^[^\x00-\x1f\x7f]+$")]


class Counters(Wire):
    """What happened so far in an experiment."""

    feedback: int = 0
    good: int = 0
    neutral: int = 0
    bad: int = 0
    cant_tell: Annotated[int, Field(description="answers that nothing can be told from the view; no feedback")] = 0
    late: int = 0
    relabelled: Annotated[int, Field(description="corrections of closed proposals' clicks")] = 0
    proposals: int = 0
    executions: int = 0
    low_level_steps: int = 0
    successes: int = 0
    episodes: int = 0
    violations: int = 0
    auto_approved: int = 0


class ExperimentCreate(Wire):
    """The body that creates an experiment."""

    name: Name
    task: Annotated[str, Field(examples=["stacking"], description="a name from GET /api/v1/tasks")]
    adapter: Annotated[str, Field(examples=["robosuite"], description="a name from GET /api/v1/adapters")] = "robosuite"
    algorithm: Annotated[str, Field(examples=["seed"], description="a name from GET /api/v1/algorithms")] = "seed"
    preset: Annotated[str | None, Field(examples=["paper_sim"], description="a preset of the algorithm")] = None
    settings: Annotated[dict[str, Any], Field(description="the algorithm's settings that differ from the preset")] = {}
    adapter_settings: Annotated[dict[str, Any], Field(description="the adapter's settings")] = {}
    num_envs: Annotated[
        StrictInt, Field(ge=1, le=16, description="simulated robots at once, each in a process; they share the learner")
    ] = 1
    seed: Seed = 0
    mode: Annotated[
        Mode | None, Field(description="null: simulated robots execute what is approved, real ones propose only")
    ] = None
    aggregation: Aggregation = Aggregation.FIRST
    feedback_timeout: Annotated[
        float | None,
        Field(gt=0, le=86400, description="seconds until an unjudged proposal closes without a verdict; null: never"),
    ] = None
    teacher: Annotated[
        str | None, Field(examples=["synthetic"], description="a synthetic trainer that judges; null: people do")
    ] = None
    teacher_settings: Annotated[
        dict[str, Any], Field(description="the teacher's settings; see GET /api/v1/teachers")
    ] = {}
    lockstep: Annotated[
        bool | None,
        Field(
            description="true: owed gradient steps are worked off before the next proposal, so a run can be repeated "
            "exactly; false: they run while the human thinks; null: true with a teacher, else false"
        ),
    ] = None
    auto_approval: AutoApproval | None = None
    gold_rate: GoldRate = 0.0
    practice_required: PracticeRequired | None = None
    together: Together = Together()
    tags: Tags = []


class ExperimentUpdate(Wire):
    """What may change live."""

    name: Name | None = None
    mode: Mode | None = None
    aggregation: Aggregation | None = None
    feedback_timeout: Annotated[float | None, Field(gt=0, le=86400)] = None
    auto_approval: AutoApproval | None = None
    gold_rate: GoldRate | None = None
    practice_required: PracticeRequired | None = None
    together: TogetherUpdate | None = None
    tags: Annotated[Tags | None, Field(description="all of them: one that is left out is taken off")] = None


class Experiment(Wire):
    """An experiment as it is now."""

    id: int
    name: str
    task: str
    adapter: str
    algorithm: str
    preset: str | None
    settings: dict[str, Any]
    adapter_settings: dict[str, Any]
    num_envs: int
    seed: int
    mode: Mode
    aggregation: Aggregation
    feedback_timeout: float | None
    teacher: str | None
    teacher_settings: dict[str, Any]
    lockstep: bool
    lifecycle: Lifecycle
    phase: Phase
    halted: bool
    failure: Annotated[str | None, Field(description="why it failed, with the remedy")] = None
    catching_up: Annotated[
        CatchingUp | None, Field(description="while a learner that has started anew takes the stored labels")
    ] = None
    auto_approval: AutoApproval | None = None
    auto_approval_suspended: Suspended = None
    gold_rate: float = 0.0
    practice_required: PracticeRequired | None = None
    together: Together = Together()
    tags: list[str] = []
    counters: Counters
    created_at: datetime
    updated_at: datetime


class Page(Wire):
    """Base of a cursor page; `next_cursor` is null on the last one."""

    next_cursor: str | None = None


class ExperimentPage(Page):
    """Experiments, newest first."""

    items: list[Experiment]


class Verdict(StrEnum):
    """What the trainers' feedback on a proposal adds up to."""

    GOOD = "good"
    NEUTRAL = "neutral"
    BAD = "bad"


class CloseReason(StrEnum):
    """Why a proposal is no longer open. `cant_tell`: nobody could tell from the views, so there is no verdict.

    `superseded`: another one for the same state was approved, and the robot moves by that; votes on it still train.
    """

    JUDGED = "judged"
    CANT_TELL = "cant_tell"
    SUPERSEDED = "superseded"
    TIMED_OUT = "timed_out"
    WITHDRAWN = "withdrawn"
    INTERRUPTED = "interrupted"


class GateDecision(Wire):
    """Whether the approved call may run; `reason` is `open`, or what kept it shut, in words."""

    allowed: bool
    reason: str


class Proposal(Wire):
    """A skill call that the agent suggests for an observation."""

    id: int
    experiment_id: int
    robot: RobotIndex
    slot: Annotated[int, Field(description="which of the robot's open proposals at once, from 0")] = 0
    episode: Annotated[int, Field(description="number of the episode in its experiment, from 1")]
    number: Annotated[int, Field(description="number of the proposal in its experiment, from 1")]
    observation_id: str
    state: list[float]
    skill: str
    parameters: dict[str, float]
    digest: Annotated[str, Field(description="SHA-256 over skill and parameters; an approval is bound to it")]
    predicted_feedback: float
    uncertainty: Uncertainty = None
    skill_probabilities: dict[str, float]
    policy_version: int
    subgoal: Annotated[str | None, Field(description="what comes next, in words")] = None
    views: list[View]
    opened_at: datetime
    closed_at: datetime | None = None
    close_reason: CloseReason | None = None
    verdict: Verdict | None = None
    verdict_source: VerdictSource | None = None
    rule: Annotated[Aggregation | None, Field(description="by which the trainers' verdict was reached")] = None
    superseded_by: Annotated[int | None, Field(description="the proposal that was approved first")] = None
    electorate: Annotated[list[str], Field(description="whose votes are asked for")] = []
    heard: Annotated[list[str], Field(description="who has voted, in order; what, is told once it is closed")] = []
    audit: Audit = False
    gate: GateDecision | None = None
    purpose: Literal["training", "evaluation"] = "training"


class ProposalPage(Page):
    """Proposals, newest first."""

    items: list[Proposal]


class Next(Wire):
    """What a trainer is to judge, of all robots and slots; theirs until `judge.until`."""

    proposal: Annotated[Proposal | None, Field(description="null: nothing waits for them now; ask again")]
    judge: Judge


class FeedbackCreate(Wire):
    """One click."""

    click_id: ClickId
    value: Answer
    trainer: TrainerName = "local"
    estimate_shown: EstimateShown = None
    looked: Looked | None = None

    @property
    def label(self) -> int | None:
        """What it says of the proposal; None: nothing."""
        return label_of(self.value)


class FeedbackStatus(StrEnum):
    """What became of a click: it counted, it came after the proposal had closed, or its trainer has to practise first.

    `overtaken`: another proposal was approved while its trainer looked at this one. It is counted and trains as any
    other, and decides nothing. Late ones and those of practice are kept, and decide and teach nothing.
    """

    STORED = "stored"
    OVERTAKEN = "overtaken"
    LATE = "late"
    PRACTICE = "practice"


class Feedback(Wire):
    """One trainer's label for one proposal. A correction changes `label`, and neither `value` nor the verdict."""

    id: int
    click_id: str
    proposal_id: int
    experiment_id: int
    trainer: str
    value: Annotated[Answer, Field(description="as it was clicked, and as it counted for the verdict")]
    label: Annotated[Answer, Field(description="what it counts as now: in the counters, and for the learner")]
    relabels: Annotated[list[Relabel], Field(description="every correction, oldest first")]
    status: FeedbackStatus
    received_at: datetime
    undone_at: datetime | None = None
    estimate_shown: EstimateShown = None
    late_because: Annotated[str | None, Field(description="why it decides nothing; told to its sender")] = None


class FeedbackPage(Page):
    """Feedback, newest first."""

    items: list[Feedback]


class ExecutionOutcome(StrEnum):
    """How one run of a skill call on a robot ended."""

    SUCCEEDED = "succeeded"
    FAILED = "failed"
    STOPPED = "stopped"
    INTERRUPTED = "interrupted"


class Execution(Wire):
    """One run of a skill call. `outcome` is null while it moves."""

    id: int
    experiment_id: int
    proposal_id: int
    robot: RobotIndex
    skill: str
    parameters: dict[str, float]
    started_at: datetime
    ended_at: datetime | None = None
    outcome: ExecutionOutcome | None = None
    end_reason: Annotated[str | None, Field(description="arrived, timeout, stalled, force_limit, stopped, ...")] = None
    low_level_steps: int = 0
    task_success: bool = False
    violations: list[Violation] = []
    reports: Annotated[list[Report], Field(description="what people saw, oldest first; the newest counts")] = []


class ExecutionPage(Page):
    """Executions, newest first."""

    items: list[Execution]


class MetricPoint(Wire):
    """Values at one amount of feedback: successes, predicted feedback, losses, temperatures, ..."""

    feedback: int
    at: datetime
    values: dict[str, float]


class EvaluationCreate(Wire):
    """Ask for rollouts of the deterministic policy (simulated adapters only)."""

    rollouts: Annotated[StrictInt, Field(ge=1, le=1000)] = 10
    seed: Seed = 10_000


class Evaluation(Wire):
    """Rollouts of the deterministic policy (paper, section 'Evaluation metrics': 10 a time)."""

    id: int
    experiment_id: int
    feedback: Annotated[int, Field(description="feedback stored when it started")]
    policy_version: int
    rollouts: int
    successes: int
    success_rate: float
    low_level_steps: int
    seed: int
    started_at: datetime
    ended_at: datetime | None = None
