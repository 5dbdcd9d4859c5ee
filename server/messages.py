"""Every message of the stream: events (one tagged union), the header of a frame, and what a client may send."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field, StrictBool

from server.schemas import (
    Evaluation,
    Execution,
    Experiment,
    Feedback,
    MetricPoint,
    Proposal,
    RobotIndex,
    RowId,
    Wire,
)
from server.schemas_labels import Answer, ClickId, EstimateShown, RelabelCreate, TrainerName
from server.schemas_problems import Problem
from server.schemas_telemetry import Telemetry
from server.schemas_together import Judge, Looked

# --- stream: server to client -------------------------------------------------------------------------------------


class Event(Wire):
    """Base of what the server tells everyone who watches an experiment."""

    seq: Annotated[
        int | None,
        Field(
            description="the event's number in the experiment's stream, from 1 since the service started (`boot_id`); "
            "null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear "
            "what was missed"
        ),
    ] = None


class Snapshot(Event):
    """Everything a page needs to draw itself: the first message of a connection that doesn't go on where one ended.

    Its `seq` is that of the last event before it.
    """

    type: Literal["snapshot"] = "snapshot"
    experiment: Experiment
    proposal: Annotated[Proposal | None, Field(description="the oldest open proposal, if any")] = None
    proposals: Annotated[list[Proposal], Field(description="every open proposal, one a slot of a robot, oldest first")]
    finishing: Annotated[
        Proposal | None,
        Field(description="what this trainer may still judge although it is closed: `Judge.finishing`"),
    ] = None
    judges: Annotated[list[Judge], Field(description="who is there to judge, and at what")] = []  # noqa: RUF012
    execution: Annotated[Execution | None, Field(description="the oldest running execution, if any")] = None
    executions: Annotated[list[Execution], Field(description="every running execution, oldest first")]
    undoable: Annotated[
        Feedback | None, Field(description="this trainer's newest feedback, while it can be undone")
    ] = None
    robots: Annotated[list[RobotTold], Field(description="what each robot told of itself last")] = []  # noqa: RUF012
    operator: Annotated[str | None, Field(description="who attends the real robot; null: nobody does")] = None
    server_time: datetime
    boot_id: Annotated[str, Field(description="changes when the server restarts")]


class Resumed(Event):
    """The first message of a connection that goes on where one ended: the missed events follow, none is missing."""

    type: Literal["resumed"] = "resumed"
    missed: Annotated[int, Field(description="how many events follow that happened in between")]


class ExperimentChanged(Event):
    """Lifecycle, phase, mode, halt or counters changed."""

    type: Literal["experiment_changed"] = "experiment_changed"
    experiment: Experiment


class ProposalOpened(Event):
    """A proposal waits for feedback; it is already stored."""

    type: Literal["proposal_opened"] = "proposal_opened"
    proposal: Proposal


class ProposalClosed(Event):
    """A proposal is closed; `proposal.verdict`, `.close_reason` and `.gate` say how."""

    type: Literal["proposal_closed"] = "proposal_closed"
    proposal: Proposal


class ProposalChanged(Event):
    """Somebody has voted on an open proposal, or its electorate is another; what was said is told once it is closed."""

    type: Literal["proposal_changed"] = "proposal_changed"
    proposal: Proposal


class JudgesChanged(Event):
    """Who is there to judge, and which open proposal each has before them."""

    type: Literal["judges_changed"] = "judges_changed"
    judges: list[Judge]


class FeedbackStored(Event):
    """A click is committed, and its proposal closed by it. `undoable` says whether it can still be undone.

    While others are still asked, only who has clicked is told (`proposal_changed`), and the answer goes to them.
    """

    type: Literal["feedback_stored"] = "feedback_stored"
    feedback: Feedback
    undoable: bool


class TakenBack(Wire):
    """A click that was taken back, without what it said: others may still be asked."""

    id: int
    click_id: str
    proposal_id: int
    trainer: str
    undone_at: datetime | None


class FeedbackUndone(Event):
    """A click was taken back; its proposal is open again (a `proposal_opened` follows)."""

    type: Literal["feedback_undone"] = "feedback_undone"
    feedback: TakenBack

    @classmethod
    def of(cls, feedback: Feedback) -> FeedbackUndone:
        """What may be told of it."""
        return cls(feedback=TakenBack(**feedback.model_dump(include=set(TakenBack.model_fields))))


class FeedbackRelabelled(Event):
    """A click on a closed proposal was corrected: the learner follows, its verdict and what moved by it stay."""

    type: Literal["feedback_relabelled"] = "feedback_relabelled"
    feedback: Feedback


class ExecutionStarted(Event):
    """The robot moves; frames follow."""

    type: Literal["execution_started"] = "execution_started"
    execution: Execution


class ExecutionEnded(Event):
    """The robot stands still again."""

    type: Literal["execution_ended"] = "execution_ended"
    execution: Execution
    violations: list[str] = []  # noqa: RUF012 - pydantic copies it


class MetricsAdded(Event):
    """A new metric point."""

    type: Literal["metrics_added"] = "metrics_added"
    point: MetricPoint


class WorkerChanged(Event):
    """A worker process started, died or was restarted."""

    type: Literal["worker_changed"] = "worker_changed"
    worker: Literal["robot", "learner"]
    robot: Annotated[int | None, Field(description="which robot, from 0; null for the learner")] = None
    status: Literal["starting", "ready", "died", "restarted"]
    detail: str


class RobotTold(Event):
    """What a robot told of itself when it was looked at, or stood still again; while it moves, frames carry it."""

    type: Literal["robot_told"] = "robot_told"
    robot: RobotIndex
    telemetry: Telemetry


class IncidentKept(Event):
    """A safety violation or an emergency stop was written down with its video: see `GET incidents/{id}`."""

    type: Literal["incident_kept"] = "incident_kept"
    incident_id: int
    kind: Literal["damage", "manual_reset", "halt"]


class AttendanceChanged(Event):
    """Somebody attends the real robot from now on, or nobody does any more: then it stands still."""

    type: Literal["attendance_changed"] = "attendance_changed"
    operator: Annotated[str | None, Field(description="who attends it; null: nobody")]


class EvaluationChanged(Event):
    """An evaluation started, went on or ended."""

    type: Literal["evaluation_changed"] = "evaluation_changed"
    evaluation: Evaluation
    done: int


class Acknowledged(Event):
    """Answer to a client's message; for feedback it comes after the commit."""

    type: Literal["acknowledged"] = "acknowledged"
    request_id: Annotated[str, Field(description="the click id, or the request's own id")]
    feedback: Feedback | None = None


class Refused(Event):
    """Answer to a client's message that could not be taken; nothing changed."""

    type: Literal["refused"] = "refused"
    request_id: str | None
    problem: Problem


class Pong(Event):
    """Answer to a ping; without one: say something, nothing was heard of you for a while."""

    type: Literal["pong"] = "pong"


StreamEvent = Annotated[
    Snapshot
    | Resumed
    | ExperimentChanged
    | ProposalOpened
    | ProposalChanged
    | ProposalClosed
    | JudgesChanged
    | FeedbackStored
    | FeedbackUndone
    | FeedbackRelabelled
    | ExecutionStarted
    | ExecutionEnded
    | MetricsAdded
    | WorkerChanged
    | RobotTold
    | AttendanceChanged
    | IncidentKept
    | EvaluationChanged
    | Acknowledged
    | Refused
    | Pong,
    Field(discriminator="type"),
]


class FrameHeader(Wire):
    """JSON header of a binary frame: `[u32 big-endian header length][this][JPEG]`."""

    robot: RobotIndex = 0
    camera: str
    width: int
    height: int
    taken_at: float
    execution_id: int | None = None
    telemetry: Annotated[Telemetry | None, Field(description="in some of them; five a second")] = None


# --- stream: client to server -------------------------------------------------------------------------------------


class ClientFeedback(Wire):
    """One click over the stream."""

    type: Literal["feedback"]
    click_id: ClickId
    proposal_id: RowId
    value: Answer
    trainer: TrainerName = "local"
    estimate_shown: EstimateShown = None
    looked: Looked | None = None


class ClientLook(Wire):
    """The trainer of this connection looks at their proposal: it stays theirs."""

    type: Literal["look"]


class ClientRelabel(RelabelCreate):
    """Correct a click on a closed proposal. It never causes a motion and never changes a verdict."""

    type: Literal["relabel"]
    feedback_id: RowId


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
    regular: Annotated[
        StrictBool,
        Field(description="I say something at least every five seconds from now on, and am gone where I don't"),
    ] = False


ClientMessage = Annotated[
    ClientFeedback | ClientLook | ClientRelabel | ClientUndo | ClientHalt | ClientFrameAck | ClientPing,
    Field(discriminator="type"),
]
