"""The tables. What must never be doubled or dangling is a constraint here too, not only a rule of the store."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING, Any, TypeVar

from sqlalchemy import (
    JSON,
    CheckConstraint,
    ColumnElement,
    ForeignKey,
    Index,
    ScalarSelect,
    String,
    Text,
    UniqueConstraint,
    case,
    exists,
    select,
    text,
)
from sqlalchemy.ext.hybrid import hybrid_property
from sqlalchemy.orm import InstrumentedAttribute, Mapped, mapped_column, relationship

from server.models_base import Base, one_of

if TYPE_CHECKING:
    from server.models_incidents import ReportRow, ViolationRow
    from server.models_tags import TagRow


COUNTING = ("stored", "overtaken")
"""Status of clicks that are feedback: counted, and learned from. Only those that are `stored` decide anything."""
_COUNTS = text("status IN ('stored', 'overtaken') AND undone_at IS NULL")

T = TypeVar("T")


def _one_a_robot(name: str, where: str, *within: str) -> Index:
    """Of the rows that satisfy `where`, a robot has one at most; `within`: one for each value of these columns."""
    columns = ("experiment_id", "robot", *within)
    return Index(name, *columns, unique=True, sqlite_where=text(where), postgresql_where=text(where))


class ExperimentRow(Base):
    """An experiment with its counters, which change in the transactions that they count."""

    __tablename__ = "experiment"
    __table_args__ = (
        one_of("lifecycle", "created", "running", "paused", "finished", "failed", "archived"),
        one_of("mode", "propose_only", "execute_approved"),
        one_of("aggregation", "first", "majority", "unanimous", "weighted"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    task: Mapped[str]
    adapter: Mapped[str]
    algorithm: Mapped[str]
    preset: Mapped[str | None]
    settings: Mapped[dict[str, Any]]
    adapter_settings: Mapped[dict[str, Any]]
    teacher_settings: Mapped[dict[str, Any]] = mapped_column(server_default=text("'{}'"))
    seed: Mapped[int]
    mode: Mapped[str]
    aggregation: Mapped[str]
    feedback_timeout: Mapped[float | None]
    teacher: Mapped[str | None]
    lockstep: Mapped[bool]
    num_envs: Mapped[int] = mapped_column(default=1, server_default=text("1"))
    lifecycle: Mapped[str]
    halted: Mapped[bool] = mapped_column(default=False)
    failure: Mapped[str | None] = mapped_column(Text)
    feedback: Mapped[int] = mapped_column(default=0)
    good: Mapped[int] = mapped_column(default=0)
    neutral: Mapped[int] = mapped_column(default=0)
    bad: Mapped[int] = mapped_column(default=0)
    cant_tell: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    late: Mapped[int] = mapped_column(default=0)
    relabelled: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    proposals: Mapped[int] = mapped_column(default=0)
    executions: Mapped[int] = mapped_column(default=0)
    low_level_steps: Mapped[int] = mapped_column(default=0)
    successes: Mapped[int] = mapped_column(default=0)
    episodes: Mapped[int] = mapped_column(default=0)
    violations: Mapped[int] = mapped_column(default=0)
    auto_approved: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    auto_approval: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    auto_approval_since: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    auto_approval_suspended: Mapped[str | None] = mapped_column(Text)
    gold_rate: Mapped[float] = mapped_column(default=0.0, server_default=text("0"))
    practice_required: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    together: Mapped[dict[str, Any]] = mapped_column(server_default=text("'{}'"))
    created_at: Mapped[datetime]
    updated_at: Mapped[datetime]

    tags: Mapped[list[TagRow]] = relationship(order_by="TagRow.tag", cascade="all, delete-orphan")


class EpisodeRow(Base):
    """From one reset to the next."""

    __tablename__ = "episode"
    __table_args__ = (
        UniqueConstraint("experiment_id", "number"),
        one_of("outcome", "success", "horizon", "violation", "reset", "interrupted"),
        one_of("purpose", "training", "evaluation"),
        CheckConstraint("(outcome IS NULL) = (ended_at IS NULL)", name="ended"),
        _one_a_robot("uq_episode_open", "ended_at IS NULL"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    robot: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    number: Mapped[int]
    purpose: Mapped[str]
    seed: Mapped[int]
    outcome: Mapped[str | None]
    started_at: Mapped[datetime]
    ended_at: Mapped[datetime | None]


class ObservationRow(Base):
    """A state as the robot saw it. `uid` is the adapter's id: the same uid means that nothing moved."""

    __tablename__ = "observation"
    __table_args__ = (UniqueConstraint("experiment_id", "uid"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    uid: Mapped[str]
    state: Mapped[list[Any]]
    taken_at: Mapped[float]


class ProposalRow(Base):
    """A skill call with the pictures it was drawn on: `views` holds image hash and overlay together."""

    __tablename__ = "proposal"
    __table_args__ = (
        UniqueConstraint("experiment_id", "number"),
        one_of("purpose", "training", "evaluation"),
        one_of("verdict", "good", "neutral", "bad"),
        one_of("close_reason", "judged", "cant_tell", "superseded", "timed_out", "withdrawn", "interrupted"),
        CheckConstraint("(close_reason IS NULL) = (closed_at IS NULL)", name="closed"),
        CheckConstraint(
            "(verdict IS NULL AND (close_reason IS NULL OR close_reason <> 'judged'))"
            " OR (verdict IS NOT NULL AND close_reason IS NOT NULL AND close_reason = 'judged')",
            name="judged",
        ),
        CheckConstraint("(gate_allowed IS NULL) = (gate_reason IS NULL)", name="gate"),
        one_of("verdict_source", "trainers", "critic", "evaluation"),
        _one_a_robot("uq_proposal_open", "closed_at IS NULL", "slot"),
        Index("ix_proposal_experiment_id_id", "experiment_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    episode_id: Mapped[int] = mapped_column(ForeignKey("episode.id"), index=True)
    observation_id: Mapped[int] = mapped_column(ForeignKey("observation.id"), index=True)
    robot: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    slot: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    number: Mapped[int]
    purpose: Mapped[str]
    skill: Mapped[str]
    parameters: Mapped[list[Any]]
    parameter_names: Mapped[list[Any]]
    digest: Mapped[str] = mapped_column(String(64))
    predicted_feedback: Mapped[float]
    uncertainty: Mapped[float | None]
    skill_probabilities: Mapped[dict[str, Any]]
    policy_version: Mapped[int]
    subgoal: Mapped[str | None]
    views: Mapped[list[Any]]
    electorate: Mapped[list[Any]]
    opened_at: Mapped[datetime]
    closed_at: Mapped[datetime | None]
    close_reason: Mapped[str | None]
    verdict: Mapped[str | None]
    verdict_source: Mapped[str | None]
    rule: Mapped[str | None]
    superseded_by: Mapped[int | None] = mapped_column(ForeignKey("proposal.id"))
    audit: Mapped[bool] = mapped_column(default=False, server_default=text("false"))
    gate_allowed: Mapped[bool | None]
    gate_reason: Mapped[str | None]
    known_answer: Mapped[int | None]
    gold_of: Mapped[int | None] = mapped_column(ForeignKey("proposal.id"))

    episode: Mapped[EpisodeRow] = relationship(lazy="joined", innerjoin=True)
    observation: Mapped[ObservationRow] = relationship(lazy="joined", innerjoin=True)
    heard: Mapped[list[TrainerRow]] = relationship(
        secondary="feedback",
        primaryjoin="and_(FeedbackRow.proposal_id == ProposalRow.id, FeedbackRow.status == 'stored',"
        " FeedbackRow.undone_at.is_(None))",
        secondaryjoin="FeedbackRow.trainer_id == TrainerRow.id",
        order_by="FeedbackRow.id",
        viewonly=True,
    )
    """Whose votes count, in the order they came. Read when first asked for: whoever reads many rows loads it."""


class TrainerRow(Base):
    """Someone who judges."""

    __tablename__ = "trainer"
    __table_args__ = (UniqueConstraint("name", "kind"), one_of("kind", "person", "teacher", "evaluation"))

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    kind: Mapped[str]
    created_at: Mapped[datetime]


class FeedbackRow(Base):
    """A click; no value: can't tell. Rows are never deleted nor overwritten; an undone one keeps its place."""

    __tablename__ = "feedback"
    __table_args__ = (
        UniqueConstraint("click_id"),
        CheckConstraint("value IN (-1, 0, 1)", name="value"),
        one_of("status", "stored", "overtaken", "late", "practice"),
        Index(
            "uq_feedback_one_vote",
            "proposal_id",
            "trainer_id",
            unique=True,
            sqlite_where=_COUNTS,
            postgresql_where=_COUNTS,
        ),
        Index("ix_feedback_experiment_id_id", "experiment_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    click_id: Mapped[str] = mapped_column(String(64))
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    proposal_id: Mapped[int] = mapped_column(ForeignKey("proposal.id"), index=True)
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"))
    value: Mapped[int | None]
    status: Mapped[str]
    received_at: Mapped[datetime]
    undone_at: Mapped[datetime | None]
    estimate_shown: Mapped[bool | None]

    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)
    relabels: Mapped[list[RelabelRow]] = relationship(order_by="RelabelRow.id")

    @hybrid_property
    def label(self) -> int | None:
        """What it says by now, in Python and in a query; None, null: can't tell."""
        return self.relabels[-1].value if self.relabels else self.value

    @label.inplace.expression
    @classmethod
    def _label_in_query(cls) -> ColumnElement[int | None]:
        newest = RelabelRow.newest(RelabelRow.value, cls)
        corrected = exists().where(RelabelRow.feedback_id == cls.id).correlate(cls)
        return case((corrected, newest), else_=cls.value)


class RelabelRow(Base):
    """A correction of a click: the newest one of it is what it says now, to the counters and to the learner."""

    __tablename__ = "relabel"
    __table_args__ = (
        UniqueConstraint("click_id"),
        CheckConstraint("value IN (-1, 0, 1)", name="value"),
        Index("ix_relabel_feedback_id_id", "feedback_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    click_id: Mapped[str] = mapped_column(String(64))
    feedback_id: Mapped[int] = mapped_column(ForeignKey("feedback.id"))
    trainer_id: Mapped[int] = mapped_column(ForeignKey("trainer.id"))
    value: Mapped[int | None]
    at: Mapped[datetime]

    trainer: Mapped[TrainerRow] = relationship(lazy="joined", innerjoin=True)

    @classmethod
    def newest(cls, column: InstrumentedAttribute[T], click: type[FeedbackRow]) -> ScalarSelect[T]:
        """In a query: a column of the newest correction of each click; null where there is none."""
        query = select(column).where(cls.feedback_id == click.id).order_by(cls.id.desc()).limit(1)
        return query.correlate(click).scalar_subquery()


class ExecutionRow(Base):
    """One run of an approved call: at most one a proposal, ever."""

    __tablename__ = "execution"
    __table_args__ = (
        UniqueConstraint("proposal_id"),
        one_of("outcome", "succeeded", "failed", "stopped", "interrupted"),
        CheckConstraint("(outcome IS NULL) = (ended_at IS NULL)", name="ended"),
        _one_a_robot("uq_execution_running", "ended_at IS NULL"),
        Index("ix_execution_experiment_id_id", "experiment_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    proposal_id: Mapped[int] = mapped_column(ForeignKey("proposal.id"))
    robot: Mapped[int] = mapped_column(default=0, server_default=text("0"))
    started_at: Mapped[datetime]
    ended_at: Mapped[datetime | None]
    outcome: Mapped[str | None]
    end_reason: Mapped[str | None]
    low_level_steps: Mapped[int] = mapped_column(default=0)
    task_success: Mapped[bool] = mapped_column(default=False)

    proposal: Mapped[ProposalRow] = relationship(lazy="joined", innerjoin=True)
    violations: Mapped[list[ViolationRow]] = relationship(lazy="selectin", order_by="ViolationRow.id", viewonly=True)
    reports: Mapped[list[ReportRow]] = relationship(lazy="selectin", order_by="ReportRow.id", viewonly=True)


class MetricRow(Base):
    """Values at one amount of feedback."""

    __tablename__ = "metric"
    __table_args__ = (Index("ix_metric_experiment_id_id", "experiment_id", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    feedback: Mapped[int]
    at: Mapped[datetime]
    data: Mapped[dict[str, Any]]


class EvaluationRow(Base):
    """Rollouts of the deterministic policy; `done` of `rollouts` are over."""

    __tablename__ = "evaluation"
    __table_args__ = (
        CheckConstraint("successes >= 0 AND successes <= done AND done <= rollouts", name="counts"),
        Index("ix_evaluation_experiment_id_id", "experiment_id", "id"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    feedback: Mapped[int]
    policy_version: Mapped[int]
    rollouts: Mapped[int]
    done: Mapped[int] = mapped_column(default=0)
    successes: Mapped[int] = mapped_column(default=0)
    low_level_steps: Mapped[int] = mapped_column(default=0)
    seed: Mapped[int]
    started_at: Mapped[datetime]
    ended_at: Mapped[datetime | None]


class CheckpointRow(Base):
    """A saved learner; the file is named by the store's caller."""

    __tablename__ = "checkpoint"
    __table_args__ = (Index("ix_checkpoint_experiment_id_id", "experiment_id", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    policy_version: Mapped[int]
    last_feedback_id: Mapped[int]
    sha256: Mapped[str] = mapped_column(String(64))
    created_at: Mapped[datetime]


class EventRow(Base):
    """One line of the journal, written in the transaction that causes it."""

    __tablename__ = "event"
    __table_args__ = (Index("ix_event_experiment_id_id", "experiment_id", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    experiment_id: Mapped[int] = mapped_column(ForeignKey("experiment.id"))
    kind: Mapped[str]
    payload: Mapped[dict[str, Any]]
    at: Mapped[datetime]


class IdempotencyRow(Base):
    """The answer that a retried write gets again."""

    __tablename__ = "idempotency"

    key: Mapped[str] = mapped_column(primary_key=True)
    route: Mapped[str] = mapped_column(primary_key=True)
    body_digest: Mapped[str] = mapped_column(String(64))
    status: Mapped[int]
    body: Mapped[str] = mapped_column(Text)
    created_at: Mapped[datetime] = mapped_column(index=True)
