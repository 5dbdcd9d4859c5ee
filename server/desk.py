"""The proposals of one robot that lie before the trainers: presented, judged, timed out, taken back, withdrawn.

As many are open as are wanted: one, or in parallel one for each trainer who has none yet, all for the same scene. A
verdict of good stays here as `judged` until the gate has been asked, so that taking a click back and starting a motion
exclude each other.
"""

from __future__ import annotations

import asyncio
import contextlib
import dataclasses
import time
from collections.abc import Callable, Collection, Sequence
from datetime import UTC, datetime

from robot_adapters.base import SkillCall
from server.acting import Publish
from server.ahead import Ahead
from server.auto_approval import Decision
from server.crew import Crew
from server.ledger import Ledger
from server.messages import (
    FeedbackRelabelled,
    FeedbackStored,
    FeedbackUndone,
    ProposalChanged,
    ProposalClosed,
    ProposalOpened,
)
from server.opened import Opened
from server.robots import Robot
from server.schemas import (
    Aggregation,
    CloseReason,
    Experiment,
    Feedback,
    FeedbackCreate,
    FeedbackStatus,
    Mode,
    Proposal,
    Verdict,
)
from server.schemas_labels import RelabelCreate, label_of
from server.schemas_trust import VerdictSource
from server.seating import Seating
from server.store import Conflict, Store, StoreError
from server.store_values import Concluded, NewProposal, Relabelled, Submission
from server.waiting import news_or_death


class Desk:
    """The open proposals of one robot, and the clicks on them."""

    def __init__(
        self,
        store: Store,
        crew: Crew,
        robot: Robot,
        ledger: Ledger,
        publish: Publish,
        *,
        seating: Seating,
        experiment: Callable[[], Experiment],
        wanted: Callable[[], int],
    ) -> None:
        self._store = store
        self._crew = crew
        self._robot = robot
        self._ledger = ledger
        self._publish = publish
        self._seating = seating
        self._experiment = experiment
        self.wanted = wanted
        """How many proposals are to be open, from 1."""
        self._open = Opened()
        self._considered: set[int] = set()
        self._no_more: int | None = None
        """As many are open as there are different ones to propose; None: more may be asked for."""
        self.judged: list[Proposal] = []
        """Closed by clicks, and nothing has come of it yet; in that order."""
        self.turn = asyncio.Lock()
        """Presenting, starting an execution, taking a click back and pausing exclude each other."""
        self._news = asyncio.Event()
        self.ahead = Ahead()

    @property
    def opened(self) -> list[Proposal]:
        """What waits for clicks, oldest first."""
        return list(self._open)

    @property
    def missing(self) -> int:
        """How many more are to be opened now; none while something waits for the gate."""
        if self.judged:
            return 0
        most = self.wanted() if self._no_more is None else min(self._no_more, self.wanted())
        return max(0, most - len(self._open))

    @property
    def calls(self) -> list[SkillCall]:
        """What is proposed already: nothing like it is to be proposed beside it."""
        return [SkillCall(p.skill, tuple(p.parameters.values())) for p in self.opened]

    def find(self, proposal_id: int) -> Proposal | None:
        """A proposal that is open, or was a moment ago."""
        return self._open.find(proposal_id)

    async def present(self, drawn: NewProposal) -> None:
        """Open a proposal, unless an undo has just opened one. It is stored before it is shown.

        Raises:
            Conflict: the experiment doesn't run any more.
        """
        async with self.turn:
            if len(self._open) < self.wanted():
                self._show(await self._store.open_proposal(self._placed(drawn)))
        self._seating.deal()

    def no_more(self) -> None:
        """There is nothing else to propose until something is judged."""
        self._no_more = len(self._open)

    async def consider(self, *, simulated: bool) -> None:
        """Let the critic approve open proposals, if the experiment has a rule for that and they meet it.

        What it approves is judged as by a click, and waits for the gate; nothing is learned from it.
        """
        experiment = self._experiment()
        if experiment.auto_approval is None or experiment.auto_approval_suspended is not None:
            return
        for proposal in self.opened:
            if proposal.id in self._considered:
                continue
            async with self.turn:
                if proposal.id not in self._open:
                    continue
                self._considered.add(proposal.id)
                considered = await self._store.consider(proposal.id, simulated=simulated)
                if considered.decision is Decision.APPROVE:
                    self._gone(proposal.id)
                    self.judged.append(considered.proposal)
        # without clicks nothing else tells of the motions so far; nor that auto-approval has just suspended itself
        self._ledger.refresh()

    async def verdict(self, leave: asyncio.Event) -> Proposal | None:
        """Wait until one is judged, or others are to be opened; the one that waits for the gate, or one that it won't.

        Raises:
            WorkerDied: a worker went away while this waited.
        """
        while not (self.judged or self.missing or leave.is_set() or self._robot.outdated) and self._open:
            self._news.clear()
            if not await self._news_or_death(self._left()):
                # to its end, also where this robot's wait is broken off because another one has died
                await asyncio.shield(asyncio.create_task(self._time_out()))
        good = [proposal for proposal in self.judged if proposal.verdict is Verdict.GOOD]
        newest = self.judged[-1] if self.judged else None
        self.judged = good
        return good[0] if good else newest

    async def wait(self, proposal: Proposal, seconds: float, leave: asyncio.Event) -> bool:
        """Let a teacher think; False if the proposal closes, its time is over, or the loop is to end before that.

        Raises:
            WorkerDied: a worker went away meanwhile.
        """
        until = time.monotonic() + seconds
        while self._open.get(proposal.id) is proposal and not leave.is_set():
            thinking, left = max(0.0, until - time.monotonic()), self._left()
            self._news.clear()
            if not await self._news_or_death(thinking if left is None else min(thinking, left)):
                return left is None or thinking < left
        return False

    async def feedback(self, proposal_id: int, body: FeedbackCreate, kind: str) -> Submission:
        """Store a click, then act on it: it is committed before anybody hears of it, and before this returns.

        What will be proposed after a bad click is often known by then (`ahead`); it is committed with the click.
        """
        try:
            return await self._feedback(proposal_id, body, kind)
        except Conflict:
            self._seating.stir(body.trainer)  # they are there, although this isn't theirs to judge
            raise

    async def _feedback(self, proposal_id: int, body: FeedbackCreate, kind: str) -> Submission:
        clicked = self._open.get(proposal_id)
        refused = self._seating.why_not(body.trainer, clicked) if clicked is not None and kind == "person" else None
        ahead = None
        if clicked is not None and refused is None and self._ends(body) and not self._robot.unclear:
            ahead = self.ahead.take({proposal.observation_id for proposal in self._open})
        had = kind == "person" and self._seating.proposal_of(body.trainer) == proposal_id
        storing = self._store.submit_feedback(proposal_id, body, kind=kind, refused=refused, had=had)
        submission: Submission
        opened: Proposal | None = None
        if ahead is not None and clicked is not None:
            async with self.turn:
                placed = dataclasses.replace(self._placed(ahead), slot=clicked.slot)
                submission, opened = await asyncio.gather(storing, self._try_open(placed, after=proposal_id))
                self._take(submission)
        elif self._experiment().aggregation is Aggregation.FIRST:
            submission = await storing
            self._take(submission)
        else:  # another trainer may be taking a vote on it back
            async with self.turn:
                submission = await storing
                self._take(submission)
        if opened is not None:
            self._show(opened)
        if kind == "person":
            if submission.feedback.status is FeedbackStatus.OVERTAKEN:
                self._seating.finished(body.trainer, proposal_id)
            self._seating.look(body.trainer, counts=submission.feedback.status is not FeedbackStatus.PRACTICE)
        self.wake()
        return submission

    async def undo(self, feedback: Feedback, *, by: str | None = None) -> Feedback:
        """Take a trainer's newest click back: its proposal is open again, what was opened in its place is withdrawn.

        by: who asks, where that is known; nobody takes back another's.
        """
        async with self.turn:
            keep = self._seating.others_at(feedback.trainer)
            undone = await self._store.undo_feedback(feedback.id, keep=keep, by=by)
            self._crew.forget(feedback.id)
            self._crew.set_aside(undone.unlearned)
            self._publish(FeedbackUndone.of(undone.feedback))
            reopened = undone.reopened
            if reopened.closed_at is None:
                self._drop_critics(reopened.id)
            if undone.withdrawn is not None:
                self._gone(undone.withdrawn.id)
                self._publish(ProposalClosed(proposal=undone.withdrawn))
            if reopened.closed_at is not None:  # by the others' votes, as before
                self.judged = [reopened if proposal.id == reopened.id else proposal for proposal in self.judged]
                self._publish(ProposalChanged(proposal=reopened))
            elif reopened.id in self._open:
                self._change(reopened)
            else:
                self._show(reopened)
        self._ledger.undo(reopened.id, undone.feedback.id, label_of(undone.feedback.value))
        if reopened.closed_at is None:
            self._seating.give(feedback.trainer, reopened.id)
            if undone.again:
                self._seating.reopened(reopened)
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

    def conclude(self, concluded: Sequence[Concluded]) -> None:
        """Take over what votes add up to now that somebody has left, or the rule is another."""
        for each in concluded:
            proposal = each.proposal
            if proposal.id not in self._open:
                continue
            if proposal.closed_at is None:
                self._change(proposal)
                continue
            self._close(proposal)
            self._crew.learn(each.labels)
        self.wake()

    async def supersede(self, approved: Proposal) -> None:
        """The robot moves by this one: tell of the others, which its approval has closed, and learn from them."""
        if self._open or self.judged:
            closed, labels = await self._store.superseded_by(approved.id)
            # told first: whoever thinks about one of them may go on
            self._seating.overtaken([p for p in closed if p.close_reason is CloseReason.SUPERSEDED])
            for proposal in closed:
                self._gone(proposal.id)
                self.judged = [each for each in self.judged if each.id != proposal.id]
                self._publish(ProposalClosed(proposal=proposal))
            self._crew.learn(labels)
        self._seating.deal()

    async def withdraw(self, reason: CloseReason = CloseReason.WITHDRAWN, only: Collection[int] | None = None) -> None:
        """Close every open proposal, or these, without a verdict; where a click was quicker, it counts."""
        async with self.turn:
            for proposal_id in [each.id for each in self._open if only is None or each.id in only]:
                closed = await self._store.close_proposal(proposal_id, reason)
                if closed.close_reason is not CloseReason.JUDGED:
                    self._gone(proposal_id)
                    self._publish(ProposalClosed(proposal=closed))
        self._seating.deal()
        self.wake()

    def drop(self) -> None:
        """Put away what lies here, where the store can't be told: it closes proposals with the verb that follows."""
        for proposal in self.opened:
            closed = {"close_reason": CloseReason.INTERRUPTED, "closed_at": datetime.now(UTC)}
            self._gone(proposal.id)
            self._publish(ProposalClosed(proposal=proposal.model_copy(update=closed)))
        self.drop_judged()
        self.ahead.forget()
        self._seating.deal()
        self.wake()

    def drop_judged(self) -> None:
        """Tell of verdicts that nothing came of, because the loop has ended."""
        for proposal in self.judged:
            self._publish(ProposalClosed(proposal=proposal))
        self.judged = []

    def wake(self) -> None:
        """Have `verdict` look again."""
        self._news.set()

    # --- inside -------------------------------------------------------------------------------------------------

    def _take(self, submission: Submission) -> None:
        feedback, closed = submission.feedback, submission.closed
        if submission.duplicate:
            return
        if feedback.status is FeedbackStatus.OVERTAKEN and submission.heard is not None:
            self._ledger.note_closed(submission.heard, feedback.id, label_of(feedback.value))
            self._publish(FeedbackStored(feedback=feedback, undoable=True))
            self._crew.learn(submission.labels)
            return
        if feedback.status is not FeedbackStatus.STORED:
            if feedback.proposal_id not in self._open:  # what is said of an open one isn't told
                self._publish(FeedbackStored(feedback=feedback, undoable=False))
            return
        if submission.heard is not None:
            self._ledger.note(submission.heard, feedback.id, label_of(feedback.value))
        if closed is None:
            if submission.heard is not None and feedback.proposal_id in self._open:
                self._change(submission.heard)
            return
        good = closed.verdict is Verdict.GOOD
        moves = good and self._experiment().mode is Mode.EXECUTE_APPROVED
        self._publish(FeedbackStored(feedback=feedback, undoable=not moves))
        self._close(closed)
        self._crew.learn(submission.labels)  # those on a proposal come together, once it has a verdict

    def _close(self, closed: Proposal) -> None:
        """By its votes."""
        self._gone(closed.id)
        if closed.verdict is not None:
            self.judged.append(closed)
        if closed.verdict is not Verdict.GOOD:  # a good one is told of together with the gate's decision
            self._publish(ProposalClosed(proposal=closed))

    def _show(self, proposal: Proposal) -> None:
        self._open.put(proposal)
        self._publish(ProposalOpened(proposal=proposal))

    def _change(self, proposal: Proposal) -> None:
        self._open.change(proposal)
        self._publish(ProposalChanged(proposal=proposal))

    def _gone(self, proposal_id: int) -> None:
        """It isn't open any more; another may be proposed."""
        self._open.close(proposal_id)
        self._considered.discard(proposal_id)
        self._no_more = None
        self._ledger.release(proposal_id)

    def _placed(self, drawn: NewProposal) -> NewProposal:
        """In the first slot that is free, for whoever is there now."""
        return dataclasses.replace(drawn, slot=self._open.free_slot, electorate=tuple(self._seating.names))

    def _ends(self, body: FeedbackCreate) -> bool:
        """Whether this click alone closes its proposal, without a motion."""
        rule = self._experiment().aggregation
        vetoed = rule is Aggregation.UNANIMOUS and body.label == -1
        return body.label != 1 and (rule is Aggregation.FIRST or vetoed) and len(self._open) <= self.wanted()

    def _drop_critics(self, reopened: int) -> None:
        """What the critic approved after a click that is taken back: nothing comes of it now."""
        dropped = [p for p in self.judged if p.id != reopened and p.verdict_source is VerdictSource.CRITIC]
        self.judged = [p for p in self.judged if p.id != reopened and p not in dropped]
        for proposal in dropped:
            self._publish(ProposalClosed(proposal=proposal))

    async def _try_open(self, drawn: NewProposal, *, after: int) -> Proposal | None:
        with contextlib.suppress(StoreError):  # the click was late, or the disk is full: the loop proposes as ever
            return await self._store.open_proposal(drawn, after=after)
        return None

    async def _time_out(self) -> None:
        await self.withdraw(CloseReason.TIMED_OUT, self._open.overdue(self._experiment().feedback_timeout))

    def _left(self) -> float | None:
        """Seconds until the time of the oldest proposal is over; None: they have all the time."""
        return self._open.left(self._experiment().feedback_timeout)

    async def _news_or_death(self, seconds: float | None) -> bool:
        robot, learner = self._robot.post.death(), self._crew.learner.death()
        return await news_or_death(self._news, robot, learner, seconds=seconds)
