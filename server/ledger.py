"""Counters, metric points and checkpoints: written beside the loop, so that no proposal waits for their commits."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections import defaultdict
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any

from server.crew import Crew
from server.messages import MetricsAdded, StreamEvent
from server.schemas import Experiment, Proposal
from server.store import Store, StoreError
from server.worker import WorkerError

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class _Vote:
    feedback_id: int
    predicted_feedback: float
    label: int | None


@dataclass(frozen=True)
class _Note:
    number: int
    good: int
    predicted_feedback: float
    label: int


class Ledger:
    """Takes a note of every counted click, and writes them down in their order when nobody waits."""

    def __init__(
        self,
        experiment: Experiment,
        store: Store,
        crew: Crew,
        *,
        checkpoint_every: int,
        publish: Callable[[StreamEvent], None],
        changed: Callable[[Experiment], None],
    ) -> None:
        self._id = experiment.id
        self._store = store
        self._crew = crew
        self._every = checkpoint_every
        self._publish = publish
        self._changed = changed
        # counted here too: when a click is written down, the next one may be stored already
        self._feedback = experiment.counters.feedback
        self._good = experiment.counters.good
        self._notes: list[_Note] = []
        self._votes: defaultdict[int, list[_Vote]] = defaultdict(list)
        """On proposals that are still open: what was said of them isn't told."""
        self._unsaved = 0
        self._task: asyncio.Task[None] | None = None

    def note(self, proposal: Proposal, feedback_id: int, label: int | None) -> None:
        """Remember a counted click until its proposal is closed."""
        self._votes[proposal.id].append(_Vote(feedback_id, proposal.predicted_feedback, label))

    def note_closed(self, proposal: Proposal, feedback_id: int, label: int | None) -> None:
        """Write down a label of a proposal that is closed already, soon."""
        self.note(proposal, feedback_id, label)
        self.release(proposal.id)
        self.write()

    def release(self, proposal_id: int) -> None:
        """It is closed: what was said of it may be written down. A click that says nothing is no feedback."""
        for vote in self._votes.pop(proposal_id, ()):
            if vote.label is None:
                self.refresh()
                continue
            self._feedback += 1
            self._good += vote.label == 1
            self._notes.append(_Note(self._feedback, self._good, vote.predicted_feedback, vote.label))
            self._unsaved += 1

    def undo(self, proposal_id: int, feedback_id: int, label: int | None) -> None:
        """A click was taken back, before its proposal was closed or after."""
        votes = self._votes.get(proposal_id, [])
        held = [vote for vote in votes if vote.feedback_id != feedback_id]
        if len(held) < len(votes):
            self._votes[proposal_id] = held
            self.refresh()
        else:
            self.recount(label, None)

    def write(self) -> None:
        """Write down what has been noted, soon."""
        if self._notes:
            notes, self._notes = self._notes, []
            self._soon(self._write(notes, self._crew.metrics))

    def recount(self, before: int | None, after: int | None) -> None:
        """A click that was counted counts as something else now, or, without an `after`, for nothing."""
        self._feedback += (after is not None) - (before is not None)
        self._good += (after == 1) - (before == 1)
        self.refresh()

    def refresh(self) -> None:
        """Read the counters anew and tell everyone, soon."""
        self._soon(self._refresh())

    async def settled(self) -> None:
        """Wait until everything is written."""
        while self._task is not None and not self._task.done():
            await asyncio.wait({self._task})

    async def leave(self) -> None:
        """Write what is left, and a checkpoint, when the loop ends."""
        self.write()
        self.refresh()
        await self.settled()
        if self._unsaved:
            await self._checkpoint()

    def _soon(self, work: Coroutine[Any, Any, None]) -> None:
        previous = self._task

        async def follow() -> None:
            if previous is not None:
                await asyncio.wait({previous})
            try:
                await work
            except StoreError:
                # the clicks themselves are stored; a figure that is missing is not worth stopping for
                log.exception("experiment %d: metrics could not be stored", self._id)

        self._task = asyncio.create_task(follow(), name=f"ledger {self._id}")

    async def _write(self, notes: list[_Note], learner: dict[str, float]) -> None:
        points = [(note.number, _values(note) | learner) for note in notes]
        written, experiment = await self._store.add_metrics(self._id, points)
        for point in written:
            self._publish(MetricsAdded(point=point))
        self._changed(experiment)
        if self._unsaved >= self._every:
            await self._checkpoint()

    async def _refresh(self) -> None:
        self._changed(await self._store.experiment(self._id))

    async def _checkpoint(self) -> None:
        """Save the learner. What can't be saved is only slower to rebuild: the labels are all stored."""
        unsaved, self._unsaved = self._unsaved, 0
        try:
            saved = await self._crew.save()
            await self._store.add_checkpoint(
                self._id,
                policy_version=saved.policy_version,
                last_feedback_id=saved.last_feedback_id,
                sha256=saved.sha256,
            )
        except (WorkerError, StoreError, OSError) as error:
            self._unsaved += unsaved
            log.warning("experiment %d: no checkpoint: %s", self._id, error)
            with contextlib.suppress(StoreError):
                await self._store.add_event(self._id, "checkpoint_failed", {"detail": str(error)})


def _values(note: _Note) -> dict[str, float]:
    """What a metric point holds beside the learner's own values and the counters.

    good_share: of all feedback counted so far, 0 to 1.
    """
    return {
        "predicted_feedback": note.predicted_feedback,
        "label": float(note.label),
        "good_share": note.good / note.number,
    }
