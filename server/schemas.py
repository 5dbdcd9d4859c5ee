"""Every message on the wire: REST bodies, stream events (one tagged union) and what a client may send.

Times are ISO 8601 UTC. Parameters are in metres and radians, robot base frame; overlays in pixels of the image.
"""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, StrictInt


class Wire(BaseModel):
    """Base of every message: unknown fields are an error, values are immutable."""

    model_config = ConfigDict(extra="forbid", frozen=True)


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


Value = Annotated[StrictInt, Field(ge=-1, le=1, description="-1 bad, 0 neutral, +1 good")]
ClickId = Annotated[
    str,
    Field(
        min_length=8,
        max_length=64,
        pattern=r"^[A-Za-z0-9_.:-]+$",
        description="made by the client, unique per click; the same id again is acknowledged again and stored once",
    ),
]
RowId = Annotated[StrictInt, Field(ge=1, lt=2**63)]
Seed = Annotated[StrictInt, Field(ge=0, lt=2**31)]
Name = Annotated[str, Field(min_length=1, max_length=120, pattern=r"^[^\x00-\x1f\x7f]+$")]
TrainerName = Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[^\x00-\x1f\x7f]+$")]


class Counters(Wire):
    """What happened so far in an experiment."""

    feedback: int = 0
    good: int = 0
    neutral: int = 0
    bad: int = 0
    late: int = 0
    proposals: int = 0
    executions: int = 0
    low_level_steps: int = 0
    successes: int = 0
    episodes: int = 0
    violations: int = 0


class ExperimentCreate(Wire):
    """The body that creates an experiment."""

    name: Name
    task: Annotated[str, Field(examples=["stacking"], description="a name from GET /api/v1/tasks")]
    adapter: Annotated[str, Field(examples=["robosuite"], description="a name from GET /api/v1/adapters")] = "robosuite"
    algorithm: Annotated[str, Field(examples=["seed"], description="a name from GET /api/v1/algorithms")] = "seed"
    preset: Annotated[str | None, Field(examples=["paper_sim"], description="a preset of the algorithm")] = None
    settings: Annotated[dict[str, Any], Field(description="the algorithm's settings that differ from the preset")] = {}
    adapter_settings: Annotated[dict[str, Any], Field(description="the adapter's settings")] = {}
    seed: Seed = 0
    mode: Mode = Mode.EXECUTE_APPROVED
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


class ExperimentUpdate(Wire):
    """What may change live."""

    name: Name | None = None
    mode: Mode | None = None
    feedback_timeout: Annotated[float | None, Field(gt=0, le=86400)] = None


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
    counters: Counters
    created_at: datetime
    updated_at: datetime


class Page(Wire):
    """Base of a cursor page; `next_cursor` is null on the last one."""

    next_cursor: str | None = None


class ExperimentPage(Page):
    """Experiments, newest first."""

    items: list[Experiment]


Point = tuple[float, float]


class Overlay(Wire):
    """A proposal drawn for one camera, in pixels of the full-size image (see `robot_adapters.base.CameraOverlay`)."""

    dot: Point | None = None
    line: tuple[Point, Point] | None = None
    arrow: bool = False
    bar: tuple[Point, Point] | None = None
    ring: Point | None = None
    in_view: bool = True


class View(Wire):
    """One camera's still image of the observation, with the overlay that was computed on it."""

    camera: str
    width: int
    height: int
    image: Annotated[str, Field(description="SHA-256 of the JPEG; the same hash is the same picture")]
    url: Annotated[str, Field(description="path of the JPEG below the server's root")]
    overlay: Overlay


class Verdict(StrEnum):
    """What the trainers' feedback on a proposal adds up to."""

    GOOD = "good"
    NEUTRAL = "neutral"
    BAD = "bad"


class CloseReason(StrEnum):
    """Why a proposal is no longer open."""

    JUDGED = "judged"
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
    episode: Annotated[int, Field(description="number of the episode in its experiment, from 1")]
    number: Annotated[int, Field(description="number of the proposal in its experiment, from 1")]
    observation_id: str
    state: list[float]
    skill: str
    parameters: dict[str, float]
    digest: Annotated[str, Field(description="SHA-256 over skill and parameters; an approval is bound to it")]
    predicted_feedback: float
    skill_probabilities: dict[str, float]
    policy_version: int
    subgoal: Annotated[str | None, Field(description="what comes next, in words")] = None
    views: list[View]
    opened_at: datetime
    closed_at: datetime | None = None
    close_reason: CloseReason | None = None
    verdict: Verdict | None = None
    gate: GateDecision | None = None
    purpose: Literal["training", "evaluation"] = "training"


class ProposalPage(Page):
    """Proposals, newest first."""

    items: list[Proposal]


class FeedbackCreate(Wire):
    """One click."""

    click_id: ClickId
    value: Value
    trainer: TrainerName = "local"


class FeedbackStatus(StrEnum):
    """What became of a click: it counted, or it came after the proposal had closed and decides nothing."""

    STORED = "stored"
    LATE = "late"


class Feedback(Wire):
    """One trainer's label for one proposal."""

    id: int
    click_id: str
    proposal_id: int
    experiment_id: int
    trainer: str
    value: int
    status: FeedbackStatus
    received_at: datetime
    undone_at: datetime | None = None


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
    skill: str
    parameters: dict[str, float]
    started_at: datetime
    ended_at: datetime | None = None
    outcome: ExecutionOutcome | None = None
    end_reason: Annotated[str | None, Field(description="arrived, timeout, stalled, force_limit, stopped, ...")] = None
    low_level_steps: int = 0
    task_success: bool = False


class ExecutionPage(Page):
    """Executions, newest first."""

    items: list[Execution]


class MetricPoint(Wire):
    """Values at one amount of feedback: successes, predicted feedback, losses, temperatures, ..."""

    feedback: int
    at: datetime
    values: dict[str, float]


class MetricPage(Page):
    """Metric points, oldest first."""

    items: list[MetricPoint]


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


class EvaluationPage(Page):
    """Evaluations, newest first."""

    items: list[Evaluation]


class Checkpoint(Wire):
    """A saved learner."""

    id: int
    experiment_id: int
    policy_version: int
    last_feedback_id: int
    sha256: str
    created_at: datetime


class CheckpointPage(Page):
    """Checkpoints, newest first."""

    items: list[Checkpoint]


class Trainer(Wire):
    """Someone who judges: a person, or a teacher."""

    id: int
    name: str
    kind: Literal["person", "teacher", "evaluation"]
    created_at: datetime


class TrainerPage(Page):
    """Trainers by id."""

    items: list[Trainer]


class Parameter(Wire):
    """A skill's parameter with its bounds."""

    name: str
    unit: str
    low: float
    high: float
    description: str = ""


class Skill(Wire):
    """A primitive that a task offers."""

    name: str
    parameters: list[Parameter]
    description: str = ""


class TaskInfo(Wire):
    """A task of the catalogue."""

    name: str
    title: str
    instruction: str
    state: list[dict[str, str | int]]
    skills: list[Skill]
    subgoals: list[str]
    horizon: int


class AdapterInfo(Wire):
    """An adapter of the catalogue; `tasks` are those it can stage."""

    name: str
    description: str
    simulated: bool
    tasks: list[str]
    settings_schema: dict[str, Any]


class AlgorithmInfo(Wire):
    """An algorithm of the catalogue; `settings_schema` is JSON Schema."""

    name: str
    description: str
    presets: dict[str, dict[str, Any]]
    settings_schema: dict[str, Any]


class TeacherInfo(Wire):
    """A synthetic trainer of the catalogue; `settings_schema` is JSON Schema."""

    name: str
    description: str
    settings_schema: dict[str, Any]


class StoredEvent(Wire):
    """One line of the experiment's journal."""

    id: int
    kind: str
    payload: dict[str, Any]
    at: datetime


class EventPage(Page):
    """Journal lines, oldest first."""

    items: list[StoredEvent]


class FieldProblem(Wire):
    """One wrong field of a request."""

    field: str
    message: str


class Problem(BaseModel):
    """RFC 9457 problem details, plus `remedy` and, for a wrong body, the fields."""

    model_config = ConfigDict(extra="allow")

    type: str = "about:blank"
    title: str
    status: int
    detail: str
    remedy: str
    fields: list[FieldProblem] = []


class Health(Wire):
    """The process is up. `boot_id` changes when the server restarts."""

    status: Literal["ok"] = "ok"
    boot_id: str


class Readiness(Wire):
    """Whether work can be done; each check is `ok` or says what is wrong."""

    ready: bool
    checks: dict[str, str]


# --- stream: server to client -------------------------------------------------------------------------------------


class Snapshot(Wire):
    """Everything a page needs to draw itself; sent first on every connection, and again after a resync."""

    type: Literal["snapshot"] = "snapshot"
    experiment: Experiment
    proposal: Annotated[Proposal | None, Field(description="the open proposal, if any")] = None
    execution: Annotated[Execution | None, Field(description="the running execution, if any")] = None
    undoable: Annotated[Feedback | None, Field(description="the newest feedback, while it can be undone")] = None
    server_time: datetime
    boot_id: Annotated[str, Field(description="changes when the server restarts")]


class ExperimentChanged(Wire):
    """Lifecycle, phase, mode, halt or counters changed."""

    type: Literal["experiment_changed"] = "experiment_changed"
    experiment: Experiment


class ProposalOpened(Wire):
    """A proposal waits for feedback; it is already stored."""

    type: Literal["proposal_opened"] = "proposal_opened"
    proposal: Proposal


class ProposalClosed(Wire):
    """A proposal is closed; `proposal.verdict`, `.close_reason` and `.gate` say how."""

    type: Literal["proposal_closed"] = "proposal_closed"
    proposal: Proposal


class FeedbackStored(Wire):
    """A click is committed. `undoable` says whether it can still be undone."""

    type: Literal["feedback_stored"] = "feedback_stored"
    feedback: Feedback
    undoable: bool


class FeedbackUndone(Wire):
    """A click was taken back; its proposal is open again (a `proposal_opened` follows)."""

    type: Literal["feedback_undone"] = "feedback_undone"
    feedback: Feedback


class ExecutionStarted(Wire):
    """The robot moves; frames follow."""

    type: Literal["execution_started"] = "execution_started"
    execution: Execution


class ExecutionEnded(Wire):
    """The robot stands still again."""

    type: Literal["execution_ended"] = "execution_ended"
    execution: Execution
    violations: list[str] = []


class MetricsAdded(Wire):
    """A new metric point."""

    type: Literal["metrics_added"] = "metrics_added"
    point: MetricPoint


class WorkerChanged(Wire):
    """A worker process started, died or was restarted."""

    type: Literal["worker_changed"] = "worker_changed"
    worker: Literal["robot", "learner"]
    status: Literal["starting", "ready", "died", "restarted"]
    detail: str


class EvaluationChanged(Wire):
    """An evaluation started, went on or ended."""

    type: Literal["evaluation_changed"] = "evaluation_changed"
    evaluation: Evaluation
    done: int


class Acknowledged(Wire):
    """Answer to a client's message; for feedback it comes after the commit."""

    type: Literal["acknowledged"] = "acknowledged"
    request_id: Annotated[str, Field(description="the click id, or the request's own id")]
    feedback: Feedback | None = None


class Refused(Wire):
    """Answer to a client's message that could not be taken; nothing changed."""

    type: Literal["refused"] = "refused"
    request_id: str | None
    problem: Problem


class Pong(Wire):
    """Answer to a ping."""

    type: Literal["pong"] = "pong"


StreamEvent = Annotated[
    Snapshot
    | ExperimentChanged
    | ProposalOpened
    | ProposalClosed
    | FeedbackStored
    | FeedbackUndone
    | ExecutionStarted
    | ExecutionEnded
    | MetricsAdded
    | WorkerChanged
    | EvaluationChanged
    | Acknowledged
    | Refused
    | Pong,
    Field(discriminator="type"),
]


class FrameHeader(Wire):
    """JSON header of a binary frame: `[u32 big-endian header length][this][JPEG]`."""

    camera: str
    width: int
    height: int
    taken_at: float
    execution_id: int | None = None


# --- stream: client to server -------------------------------------------------------------------------------------


class ClientFeedback(Wire):
    """One click over the stream."""

    type: Literal["feedback"]
    click_id: ClickId
    proposal_id: RowId
    value: Value
    trainer: TrainerName = "local"


class ClientUndo(Wire):
    """Take back a feedback, while nothing has moved."""

    type: Literal["undo"]
    request_id: ClickId
    feedback_id: RowId


class ClientHalt(Wire):
    """Emergency stop."""

    type: Literal["halt"]
    request_id: ClickId


class ClientFrameAck(Wire):
    """The last frame is drawn: the next one may come."""

    type: Literal["frame_ack"]


class ClientPing(Wire):
    """Are you there?"""

    type: Literal["ping"]


ClientMessage = Annotated[
    ClientFeedback | ClientUndo | ClientHalt | ClientFrameAck | ClientPing, Field(discriminator="type")
]
