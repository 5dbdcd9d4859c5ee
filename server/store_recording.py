"""The store's writes of what a run leaves behind: metrics, evaluations, checkpoints, journal, answers to retries."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

from sqlalchemy.orm import Session

from server import schemas, schemas_records, store_experiments, store_records
from server import store_wire as wire
from server.database import writes
from server.store_reads import Reads
from server.store_values import Receipt

M = TypeVar("M", schemas.Experiment, schemas.Evaluation)


class Recording(Reads):
    """Reads, and the writes that decide nothing; `server.store.Store` adds those that do."""

    @writes
    async def add_metrics(
        self, experiment_id: int, points: Sequence[tuple[int, Mapping[str, float]]]
    ) -> tuple[list[schemas.MetricPoint], schemas.Experiment]:
        """Points of the charts, each at an amount of feedback, and the experiment then. See `store_records`."""

        def add(session: Session) -> tuple[list[schemas.MetricPoint], schemas.Experiment]:
            written, row = store_records.add_metrics(session, experiment_id, points)
            return written, wire.experiment(row)

        return await self._database.write(add)

    @writes
    async def create_evaluation(
        self,
        experiment_id: int,
        *,
        rollouts: int,
        seed: int,
        policy_version: int = 0,
        receipt: Receipt | None = None,
    ) -> schemas.Evaluation:
        """An evaluation that has begun, and the answer that a retry gets. Its proposals bring the policy version."""

        def create(session: Session) -> schemas.Evaluation:
            row = store_records.create_evaluation(session, experiment_id, rollouts, seed, policy_version)
            return receipted(session, wire.evaluation(row), receipt)

        return await self._database.write(create)

    @writes
    async def update_evaluation(
        self, evaluation_id: int, *, done: int, successes: int, low_level_steps: int, ended: bool = False
    ) -> schemas.Evaluation:
        """Running totals over the `done` rollouts; `ended` writes the end."""
        return await self._database.write(
            lambda s: wire.evaluation(
                store_records.update_evaluation(
                    s, evaluation_id, done=done, successes=successes, low_level_steps=low_level_steps, ended=ended
                )
            )
        )

    @writes
    async def add_checkpoint(
        self, experiment_id: int, *, policy_version: int, last_feedback_id: int, sha256: str
    ) -> schemas_records.Checkpoint:
        """A learner that has been saved."""
        return await self._database.write(
            lambda s: wire.checkpoint(
                store_records.add_checkpoint(s, experiment_id, policy_version, last_feedback_id, sha256)
            )
        )

    @writes
    async def add_event(self, experiment_id: int, kind: str, payload: Mapping[str, Any]) -> schemas_records.StoredEvent:
        """A line of the journal that no other write causes, e.g. a worker's death."""

        def add(session: Session) -> schemas_records.StoredEvent:
            store_experiments.load(session, experiment_id)
            row = store_experiments.journal(session, experiment_id, kind, **dict(payload))
            session.flush()
            return wire.event(row)

        return await self._database.write(add)

    # --- retries ----------------------------------------------------------------------------------------------------

    @writes
    async def remember(self, key: str, route: str, body_digest: str, status: int, body: Any) -> None:
        """Keep an answer (JSON) for a day."""
        await self._database.write(
            lambda s: store_records.remember(s, key, route, body_digest, status=status, body=body)
        )


def receipted(session: Session, made: M, receipt: Receipt | None) -> M:
    """What was made, kept as the answer that a retry gets."""
    if receipt is not None:
        body = made.model_dump(mode="json")
        store_records.remember(
            session, receipt.key, receipt.route, receipt.body_digest, status=receipt.status, body=body
        )
    return made
