"""How a learner that starts anew gets the stored labels back: the newest first, and then the rest while it proposes.

A proposal is looked for with the newest labels, so it need not wait for the oldest of a million. Where a run must be
repeatable the learner has them all before it is asked anything.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable, Mapping
from typing import Any

from server.schemas import Experiment
from server.schemas_labels import CatchingUp
from server.store import Store
from server.store_errors import StoreError
from server.store_values import StoredLabel
from server.worker import CommandFailed, Worker, WorkerDied

log = logging.getLogger(__name__)

LABELS_AT_ONCE = 2_000
"""Labels of one message to the learner, about 1 MB: a longer one would hold up everything else in this process."""
FIRST = 2 * LABELS_AT_ONCE
"""Labels that a learner has before it is asked: many times what it looks at when it proposes."""
MEANWHILE = 250
"""Labels of one message to a learner that is being asked: a request waits for one such message at most."""
A_LABEL = 0.001
"""s that taking a stored label may last on a busy machine; measured: 0.064 ms of the processor."""


class Recollection:
    """The labels of one experiment on their way to its learner."""

    def __init__(self, experiment: Experiment, store: Store, deadline: float) -> None:
        """deadline: s for one command."""
        self._experiment, self._store, self._deadline = experiment, store, deadline
        self.on_progress: Callable[[], None] = lambda: None
        """Called whenever `progress` has changed."""
        self._forgotten: set[int] = set()
        self._feeding: asyncio.Task[None] | None = None
        self.progress: CatchingUp | None = None
        """None: the learner has all that there are, or they are few."""

    async def restore(self, learner: Worker, *, newest_first: bool) -> Mapping[str, Any]:
        """Send labels until the learner may be asked; what it answered to the last. The rest follows by itself.

        Raises:
            WorkerDied: it died. CommandFailed: it can't take them.
        """
        await self.close()
        self._forgotten.clear()
        counters = (await self._store.experiment(self._experiment.id)).counters
        of = counters.good + counters.neutral + counters.bad
        newest: list[StoredLabel] = []
        if newest_first and of > FIRST:
            newest = await self._store.labels_before(self._experiment.id, None, FIRST)
        if newest:
            half = len(newest) // 2
            await self._send(learner, "restore", newest[:half], more=True)
            told = await self._send(learner, "restore", newest[half:], patience=len(newest) * A_LABEL, more=False)
            self._tell(len(newest), of)
            rest = self._feed(learner, newest[0].feedback_id, len(newest), of)
            self._feeding = asyncio.create_task(rest, name=f"old labels of experiment {self._experiment.id}")
            return told
        told, after, sent, more = {}, 0, 0, True
        while more:
            part = await self._store.labels(self._experiment.id, after, LABELS_AT_ONCE)
            after, sent, more = part[-1].feedback_id if part else after, sent + len(part), bool(part)
            patience = 0.0 if more else sent * A_LABEL  # it takes them at the last part
            told = await self._send(learner, "restore", part, patience=patience, more=more)
            if of > FIRST:
                self._tell(sent, of)
        self._done()
        return told

    def forget(self, feedback_id: int) -> None:
        """Don't send this label any more: it was taken back, and the learner was told so."""
        self._forgotten.add(feedback_id)

    async def close(self) -> None:
        """Send nothing more."""
        if self._feeding is not None:
            self._feeding.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._feeding
            self._feeding = None
        self._done()

    async def _feed(self, learner: Worker, before: int, taken: int, of: int) -> None:
        """Send what is older, from the newest on."""
        try:
            while part := await self._store.labels_before(self._experiment.id, before, LABELS_AT_ONCE):
                before = part[0].feedback_id
                for end in range(len(part), 0, -MEANWHILE):
                    few = [
                        each for each in part[max(0, end - MEANWHILE) : end] if each.feedback_id not in self._forgotten
                    ]
                    await self._send(learner, "recollect", few)
                taken += len(part)
                self._tell(taken, max(taken, of))
        except WorkerDied:
            pass  # whoever waits for the experiment's next step hears of it
        except (CommandFailed, StoreError) as error:
            log.warning("experiment %d learns on without its older labels: %s", self._experiment.id, error)
            with contextlib.suppress(StoreError):
                payload = {"older_than": before, "detail": str(error)}
                await self._store.add_event(self._experiment.id, "labels_unusable", payload)
        self._done()

    async def _send(
        self, learner: Worker, command: str, labels: list[StoredLabel], *, patience: float = 0.0, **more: bool
    ) -> dict[str, Any]:
        deadline = self._deadline + patience
        return await learner.call(command, deadline=deadline, labels=[wire(label) for label in labels], **more)

    def _tell(self, taken: int, of: int) -> None:
        self.progress = CatchingUp(taken=taken, of=of)
        self.on_progress()

    def _done(self) -> None:
        if self.progress is not None:
            self.progress = None
            self.on_progress()


def wire(label: StoredLabel) -> dict[str, Any]:
    """A label as the learner's worker takes it."""
    return {
        "id": label.feedback_id,
        "state": list(label.state),
        "skill": label.skill,
        "parameters": list(label.parameters),
        "value": label.value,
        "trainer": label.trainer,
    }
