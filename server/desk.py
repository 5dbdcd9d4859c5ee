"""The proposal of one robot that lies before the trainers: presented, judged, timed out, taken back, withdrawn.

At most one is open. A verdict of good stays here as `judged` until the gate has been asked, so that taking the click
back and starting the motion exclude each other.
"""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections.abc import Callable
from datetime import UTC, datetime

from server.acting import Publish
from server.auto_approval import Decision
from server.crew import Crew
from server.ledger import Ledger
from server.messages import FeedbackRelabelled, FeedbackStored, FeedbackUndone, ProposalClosed, ProposalOpened
from server.robots import Robot
from server.schemas import CloseReason, Experiment, Feedback, FeedbackCreate, FeedbackStatus, Mode, Proposal, Verdict
from server.schemas_labels import RelabelCreate, label_of
from server.store import Store, StoreError
from server.store_values import NewProposal, Relabelled, Submission
from server.worker import WorkerDied


class Desk:
    """The open proposal of one robot, and the clicks on it."""

    def __init__(
        self,
        store: Store,
        crew: Crew,
        robot: Robot,
        ledger: Ledger,
        publish: Publish,
        *,
        experiment: Callable[[], Experiment],
    ) -> None:
        self._store = store
        self._crew = crew
        self._robot = robot
        self._ledger = ledger
        self._publish = publish
        self._experiment = experiment
        self.open: Proposal | None = None
        """Waits for a click."""
        self.judged: Proposal | None = None
        """A click has closed it, and nothing has come of it yet."""
        self.turn = asyncio.Lock()
        """Presenting, starting an execution, taking a click back and pausing exclude each other."""
        self._news = asyncio.Event()
        self._since = 0.0
        self._ahead: asyncio.Task[NewProposal] | None = None

    async def present(self, drawn: NewProposal) -> None:
        """Open a proposal, unless an undo has just opened one. It is stored before it is shown.

        Raises:
            Conflict: the experiment doesn't run any more.
        """
        async with self.turn:
            if self.open is None:
                self._show(await self._store.open_proposal(drawn))

    async def consider(self, *, simulated: bool) -> None:
        """Let the critic approve the open proposal, if the experiment has a rule for that and it meets it.

        What it approves is judged as by a click, and waits for the gate; nothing is learned from it.
        """
        experiment = self._experiment()
        if self.open is None or experiment.auto_approval is None or experiment.auto_approval_suspended is not None:
            return
        async with self.turn:
            if self.open is None:
                return
            considered = await self._store.consider(self.open.id, simulated=simulated)
            if considered.decision is Decision.APPROVE:
                self.open, self.judged = None, considered.proposal
        # without clicks nothing else tells of the motions so far; nor that auto-approval has just suspended itself
        self._ledger.refresh()

    async def verdict(self, leave: asyncio.Event) -> Proposal | None:
        """Wait until the open proposal is closed; the judged one, or None where it closed without a verdict.

        Raises:
            WorkerDied: a worker went away while this waited.
        """
        waiting = self.open
        while self._waits(waiting, leave):
            self._news.clear()
            if not await self._news_or_death(self._left()):
                # to its end, also where this robot's wait is broken off because another one has died
                await asyncio.shield(asyncio.create_task(self.withdraw(CloseReason.TIMED_OUT)))
        judged = self.judged
        if judged is not None and judged.verdict is not Verdict.GOOD:
            self.judged = None
        return judged

    async def wait(self, seconds: float, leave: asyncio.Event) -> bool:
        """Let a teacher think; False if the proposal closes, its time is over, or the loop is to end before that.

        Raises:
            WorkerDied: a worker went away meanwhile.
        """
        waiting, until = self.open, time.monotonic() + seconds
        while self._waits(waiting, leave):
            thinking, left = max(0.0, until - time.monotonic()), self._left()
            self._news.clear()
            if not await self._news_or_death(thinking if left is None else min(thinking, left)):
                return left is None or thinking < left
        return False

    async def feedback(self, proposal_id: int, body: FeedbackCreate, kind: str) -> Submission:
        """Store a click, then act on it: it is committed before anybody hears of it, and before this returns.

        What will be proposed after a bad click is often known by then (`draw_ahead`); it is committed with the click.
        """
        ahead = self._take_ahead() if body.label != 1 and self._is_open(proposal_id) else None
        if ahead is None:
            submission, opened = await self._store.submit_feedback(proposal_id, body, kind=kind), None
        else:
            async with self.turn:
                submission, opened = await asyncio.gather(
                    self._store.submit_feedback(proposal_id, body, kind=kind), self._try_open(ahead, after=proposal_id)
                )
        if not submission.duplicate:
            self._take(submission)
        if opened is not None:
            self._show(opened)
        self.wake()
        return submission

    async def undo(self, feedback_id: int) -> Feedback:
        """Take the newest click back: its proposal is open again, the one opened since is withdrawn."""
        async with self.turn:
            undone = await self._store.undo_feedback(feedback_id)
            self._crew.forget(feedback_id)
            dropped, self.judged = self.judged, None
            self._publish(FeedbackUndone(feedback=undone.feedback))
            if dropped is not None and dropped.id != undone.reopened.id:  # the critic's, which nothing comes of now
                self._publish(ProposalClosed(proposal=dropped))
            if undone.withdrawn is not None:
                self._publish(ProposalClosed(proposal=undone.withdrawn))
            self._show(undone.reopened)
        self._ledger.recount(label_of(undone.feedback.value), None)
        self.wake()
        return undone.feedback

    async def relabel(self, feedback_id: int, body: RelabelCreate, *, anybodys: bool) -> Relabelled:
        """Correct a click on a closed proposal, and have the learner follow. Nothing is judged or moved by it."""
        relabelled = await self._store.relabel(feedback_id, body, anybodys=anybodys)
        if not relabelled.duplicate:
            self._crew.relabel(feedback_id, relabelled.label)
            self._publish(FeedbackRelabelled(feedback=relabelled.feedback))
            self._ledger.recount(relabelled.before, relabelled.after)
        return relabelled

    async def withdraw(self, reason: CloseReason = CloseReason.WITHDRAWN) -> None:
        """Close the open proposal without a verdict; if a click was quicker, it counts."""
        async with self.turn:
            if self.open is not None:
                closed = await self._store.close_proposal(self.open.id, reason)
                if closed.close_reason is not CloseReason.JUDGED:
                    self.open = None
                    self._publish(ProposalClosed(proposal=closed))
        self.wake()

    def drop(self) -> None:
        """Put away what lies here, where the store can't be told: it closes a proposal with the verb that follows."""
        if self.open is not None:
            closed = {"close_reason": CloseReason.INTERRUPTED, "closed_at": datetime.now(UTC)}
            self._publish(ProposalClosed(proposal=self.open.model_copy(update=closed)))
            self.open = None
        self.drop_judged()
        self.forget_ahead()
        self.wake()

    def drop_judged(self) -> None:
        """Tell of a verdict that nothing came of, because the loop has ended."""
        if self.judged is not None:
            self._publish(ProposalClosed(proposal=self.judged))
            self.judged = None

    def draw_ahead(self, draw: Callable[[], asyncio.Task[NewProposal]]) -> None:
        """Draw the next proposal while a person thinks."""
        self.forget_ahead()
        self._ahead = draw()
        # one that fails is drawn again when it is needed, and fails there for everyone to see
        self._ahead.add_done_callback(lambda drawn: drawn.cancelled() or drawn.exception())

    def forget_ahead(self) -> None:
        """Drop what was drawn ahead."""
        self._take_ahead()

    def wake(self) -> None:
        """Have `verdict` look again."""
        self._news.set()

    def _take(self, submission: Submission) -> None:
        feedback, closed = submission.feedback, submission.closed
        if feedback.status is not FeedbackStatus.STORED:
            self._publish(FeedbackStored(feedback=feedback, undoable=False))
            return
        proposal = closed if closed is not None else self.open
        if proposal is not None and proposal.id == feedback.proposal_id:
            self._ledger.note(proposal, label_of(feedback.value))
        if closed is not None:
            self.open, self.judged = None, closed if closed.verdict is not None else None
            self._crew.learn(submission.labels)  # those on a proposal come together, once it has a verdict
        good = closed is not None and closed.verdict is Verdict.GOOD
        moves = good and self._experiment().mode is Mode.EXECUTE_APPROVED
        self._publish(FeedbackStored(feedback=feedback, undoable=not moves))
        if closed is not None and not good:  # a good one is told of together with the gate's decision
            self._publish(ProposalClosed(proposal=closed))

    def _show(self, proposal: Proposal) -> None:
        self.open = proposal
        self._since = time.monotonic()
        self._publish(ProposalOpened(proposal=proposal))

    def _is_open(self, proposal_id: int) -> bool:
        return self.open is not None and self.open.id == proposal_id

    def _take_ahead(self) -> NewProposal | None:
        """What was drawn ahead, if it is there and of what is on the desk."""
        ahead, self._ahead = self._ahead, None
        if ahead is None:
            return None
        if not ahead.done() or ahead.cancelled() or ahead.exception() is not None:
            ahead.cancel()
            return None
        drawn = ahead.result()
        return drawn if self.open is not None and drawn.observation_id == self.open.observation_id else None

    async def _try_open(self, drawn: NewProposal, *, after: int) -> Proposal | None:
        with contextlib.suppress(StoreError):  # the click was late, or the disk is full: the loop proposes as ever
            return await self._store.open_proposal(drawn, after=after)
        return None

    def _waits(self, proposal: Proposal | None, leave: asyncio.Event) -> bool:
        return proposal is not None and self.open is proposal and not leave.is_set()

    def _left(self) -> float | None:
        """Seconds until the proposal's time is over; None: it has all the time."""
        limit = self._experiment().feedback_timeout
        return None if limit is None else max(0.0, self._since + limit - time.monotonic())

    async def _news_or_death(self, seconds: float | None) -> bool:
        """Wait for news; False if there is none within so many seconds."""
        waits = {
            asyncio.ensure_future(self._news.wait()),
            asyncio.ensure_future(self._robot.post.death()),
            asyncio.ensure_future(self._crew.learner.death()),
        }
        try:
            done, _ = await asyncio.wait(waits, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for wait in waits:
                wait.cancel()
        for wait in done:
            if isinstance(death := wait.result(), WorkerDied):
                raise death
        return bool(done)
