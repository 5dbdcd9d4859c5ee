"""One robot at work: its open proposal, its episode, and what was seen last in it."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

from server.acting import Acting, Publish
from server.crew import Crew
from server.crew_values import Done, Seen
from server.desk import Desk
from server.judging import Judge
from server.ledger import Ledger
from server.quota import Quota
from server.robots import UNCLEAR, Robot
from server.schemas import CloseReason, Execution, Experiment, Phase, Proposal
from server.seating import Seating
from server.seeds import episode_seed
from server.standing import Standing
from server.store import Conflict, Store
from server.store_values import EpisodeOutcome, NewProposal
from server.violations import Response, respond
from server.waiting import news_or_death
from server.witness import Witness
from server.worker import CommandFailed, WorkerDied

AskOperator = Callable[[Literal["halt", "pause"], Sequence[str]], Awaitable[None]]


LOOK_AGAIN = 1.0
"""s from one attempt to see the scene to the next, where people still have to put something right."""
AHEAD = 2
"""Proposals drawn ahead where trainers judge in parallel: two of them may click before the next are drawn."""


@dataclass(frozen=True)
class Shared:
    """What the robots of one experiment share."""

    store: Store
    crew: Crew
    standing: Standing
    ledger: Ledger
    quota: Quota
    publish: Publish
    ask_operator: AskOperator
    stop: Callable[[], None]
    """Emergency stop of every robot of the experiment."""
    witness: Witness
    seating: Seating
    still: Callable[[], int]
    """How many robots of the experiment don't move."""
    beginning: asyncio.Lock = field(default_factory=asyncio.Lock)
    """Episodes begin one after another: each has a number and a seed of its own."""


class Station:
    """The steps of Algorithm 1 for one robot; `server.training` puts them in their order."""

    def __init__(self, robot: Robot, shared: Shared) -> None:
        self.robot = robot
        self._shared = shared
        self._store = shared.store
        self._standing = shared.standing
        standing = shared.standing
        self.desk = Desk(
            shared.store,
            shared.crew,
            robot,
            shared.ledger,
            shared.publish,
            seating=shared.seating,
            experiment=lambda: standing.experiment,
            wanted=lambda: shared.seating.wanted(shared.still()),
        )
        self.acting = Acting(
            standing.experiment,
            shared.store,
            shared.crew,
            robot,
            publish=shared.publish,
            owed=standing.owed,
            gold_rate=lambda: standing.experiment.gold_rate,
        )
        # the episode that goes on, and what was seen last in it; None: look again
        self._episode_open = False
        self._executed = 0
        self._start: int | None = None
        """Seed of an episode whose start is still to be made."""
        self._seen: Seen | None = None
        self._reset_wanted = False
        self.homing: asyncio.Task[bool] | None = None
        """A real arm's way home, while it is on it."""

    @property
    def experiment(self) -> Experiment:
        """The experiment that it works for."""
        return self._standing.experiment

    @cached_property
    def judge(self) -> Judge | None:
        """The teacher at this robot's desk, if there is one."""
        if not self.experiment.teacher:
            return None
        return Judge(self.experiment, self.acting.task, self.desk, self._shared.quota)

    @property
    def moving(self) -> bool:
        """Whether the robot moves, as far as this process knows."""
        phase = self._standing.phase_of(self.robot.index)
        return self.homing is not None or phase in (Phase.EXECUTING, Phase.EVALUATING)

    @property
    def resting(self) -> Robot | None:
        """The robot, unless it moves or is away."""
        return self.robot if self.robot.post.ready and not self.moving else None

    def enter(self, phase: Phase) -> None:
        """Tell everyone what goes on here."""
        self._standing.enter(phase, self.robot.index)

    # --- the steps, in their order ------------------------------------------------------------------------------

    async def begin(self) -> None:
        """Have an episode: a new one where the last has ended, or is to end."""
        if self._reset_wanted:
            self._reset_wanted = False
            await self.desk.withdraw()
            self.desk.ahead.forget()
            await self.end_episode("reset")
        if self._episode_open:
            return
        self.enter(Phase.OBSERVING)
        async with self._shared.beginning:
            number = (await self._store.experiment(self.experiment.id)).counters.episodes + 1
            seed = episode_seed(self.experiment.seed, number)
            async with self.desk.turn:
                await self._store.begin_episode(self.experiment.id, seed, robot=self.robot.index)
        self._episode_open, self._executed, self._start = True, 0, seed

    async def look(self, leave: asyncio.Event) -> Seen:
        """What the robot sees now: of a new episode, or of the one that goes on. Waits until it sees all it has to.

        Raises:
            Conflict: the loop is to end before that.
        """
        while self._seen is None or self._start is not None:
            self.enter(Phase.OBSERVING)
            try:
                self._seen = await (self.robot.observe() if self._start is None else self.robot.reset(self._start))
                self._start = None
            except CommandFailed as refusal:
                if refusal.kind not in UNCLEAR:
                    raise
                if await news_or_death(leave, self.robot.post.death(), seconds=LOOK_AGAIN):
                    raise Conflict(str(refusal), remedy=refusal.remedy) from refusal
        return self._seen

    async def propose(self, seen: Seen) -> None:
        """Have as many proposals open as are wanted, unless one waits for the gate; clicks and undo open some too."""
        missing = self.desk.missing
        if not missing:
            return
        if not self.desk.opened:
            self.enter(Phase.PROPOSING)
        try:
            drawn = await self.acting.draw_batch(seen, missing, self.desk.calls)
        except CommandFailed as refusal:
            if refusal.kind not in UNCLEAR:
                raise
            self.forget()  # `look` waits until it is clear again
            return
        for each in drawn:
            if not self.desk.judged:  # one was approved meanwhile: this one would be closed at once
                await self.desk.present(each)
        if len(drawn) < missing:
            self.desk.no_more()
        if self._reset_wanted:  # it came meanwhile: there was nothing to withdraw yet
            await self.desk.withdraw()

    async def consider(self) -> None:
        """Let the critic judge what is open, where the experiment has a rule for that."""
        await self.desk.consider(simulated=self.acting.simulated)

    async def query(self, seen: Seen, leave: asyncio.Event) -> Proposal | None:
        """The proposal that was judged, by a person or by the teacher; None where none was.

        Raises:
            WorkerDied: a worker went away while this waited.
        """
        if self.desk.opened:
            self.enter(Phase.AWAITING_FEEDBACK)
            if not self.experiment.lockstep:  # where all are in step, a round's clicks are written down at its end
                self._shared.ledger.write()
            asked = self.desk.opened[0]
            if self.judge is not None and not self.judge.has_judged(asked):
                await self.judge.judge(asked, self.acting.call_of(asked), leave)
            elif not self.experiment.lockstep:
                self.desk.ahead.draw(lambda: asyncio.create_task(self._draw_ahead(seen)))
        judged = await self.desk.verdict(leave)
        if judged is None and self.robot.outdated and not leave.is_set():
            await self.desk.withdraw()
            self.desk.ahead.forget()
            self.forget()
        return judged

    async def decide(self, judged: Proposal, seen: Seen) -> Execution | None:
        """Ask the gate; if it opens, the execution is stored as started, and `carry_out` is to follow."""
        self.enter(Phase.DECIDING)
        async with self.desk.turn:
            if not any(proposal is judged for proposal in self.desk.judged):  # taken back in the meantime
                return None
            self.desk.judged = [proposal for proposal in self.desk.judged if proposal is not judged]
            execution = await self.acting.decide(judged, seen)
            if execution is not None:
                await self.desk.supersede(judged)
            return execution

    async def written(self) -> None:
        """Write down what has been counted, and wait for it."""
        self._shared.ledger.write()
        await self._shared.ledger.settled()

    async def carry_out(self, judged: Proposal, execution: Execution, before: asyncio.Task[None] | None = None) -> None:
        """Run the approved call, and end the episode if that solved or spoiled the task.

        before: what has to be stored, another robot's motion, before anything of this one is.
        """
        self.enter(Phase.EXECUTING)
        if self.experiment.num_envs > 1:
            self._shared.ledger.refresh()  # others are judged meanwhile: their trainer sees the click counted
        done = await self.acting.move(judged, execution, heed=self._latch_after_damage, before=before)
        self._seen = None
        self._executed += 1
        for kind, detail in done.violations:
            self._shared.witness.tell(kind, detail, execution_id=execution.id, robot=self.robot.index)
        response = self._response(done)
        if response in (Response.HALT, Response.PAUSE):
            verb: Literal["halt", "pause"] = "halt" if response is Response.HALT else "pause"
            await self._shared.ask_operator(verb, [detail for _, detail in done.violations])
        if response is not Response.NOTHING:
            await self.end_episode("violation")
        elif done.task_success:
            await self._next_episode("success")
        elif self._executed >= self.acting.task.horizon:
            await self._next_episode("horizon")

    async def _next_episode(self, outcome: EpisodeOutcome) -> None:
        """End the episode. A simulator lays the next one out by itself; at a real robot somebody has to, by hand."""
        await self.end_episode(outcome)
        if not self.acting.simulated:
            by_hand = getattr(self.acting.task, "reset_by_hand", "") or "put everything back to where an episode starts"
            await self._shared.ask_operator("pause", [f"the episode ended ({outcome}): {by_hand}"])

    # --- around them --------------------------------------------------------------------------------------------

    async def home(self) -> bool:
        """Bring a real arm out of the way; whether it arrived. To an emergency stop it is a motion like any other.

        Raises:
            CommandFailed: it can't, or it broke off on the way. WorkerDied: its worker is gone.
        """
        self.forget()
        self.homing = asyncio.create_task(self.robot.home(), name=f"bring {self.robot.post.name} home")
        try:
            return await self.homing
        finally:
            self.homing = None

    async def want_reset(self) -> None:
        """Begin a new episode: now if a proposal waits, else as soon as the skill has ended, or at resume."""
        self._reset_wanted = True
        await self.desk.withdraw()

    async def end_episode(self, outcome: EpisodeOutcome) -> None:
        """End the episode that goes on; what was seen in it is no longer so."""
        self.forget()
        if self._episode_open:
            self._episode_open = False
            await self._store.end_episode(self.experiment.id, outcome, robot=self.robot.index)

    def forget(self) -> None:
        """The scene isn't what was seen last."""
        self._seen = None

    async def interrupt(self) -> None:
        """The robot, or all of the experiment, broke off in the middle."""
        await self.desk.withdraw(CloseReason.INTERRUPTED)
        await self.end_episode("interrupted")

    async def mend(self, death: WorkerDied | None = None) -> None:
        """Clear up after a death that was met, or one of this robot's that nobody has noticed.

        Raises:
            TooManyDeaths: it is of no use.
        """
        met = death or await self.robot.post.unnoticed_death()
        if met is None:
            return
        await self._shared.crew.bury(met)
        if met.worker == self.robot.post.name:
            await self.interrupt()

    async def close_up(self) -> None:
        """Put away what lies on the desk: nobody works here any more."""
        await self.desk.withdraw()
        self.desk.drop_judged()
        self.desk.ahead.forget()

    async def _draw_ahead(self, seen: Seen) -> list[NewProposal]:
        """What would be proposed next if nothing moves, once the learner is done.

        Alone, its policy stands still from then on; where others are judged, what is drawn is of the policy before.
        """
        if self.desk.wanted() == 1:
            await self._shared.crew.flush()
            return [await self.acting.draw(seen)]
        # in parallel clicks come faster than the learner is done: it is asked between two steps
        return await self.acting.draw_batch(seen, AHEAD, self.desk.calls)

    def _response(self, done: Done) -> Response:
        kinds = [kind for kind, _ in done.violations]
        return respond(kinds, simulated=self.acting.simulated, taught=self.judge is not None)

    def _latch_after_damage(self, done: Done) -> None:
        """The robots first, then the database."""
        if self._response(done) is Response.HALT:
            self._shared.stop()
            self._standing.tell()
