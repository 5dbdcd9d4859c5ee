"""Does to a store and to the model of it whatever may happen: what the model calls illegal has to be refused."""

from __future__ import annotations

import asyncio
import tempfile
from collections import Counter
from collections.abc import Coroutine, Sequence
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from hypothesis import strategies as st

from server.lifecycle import Verb
from server.schemas import Aggregation, CloseReason, ExecutionOutcome, ExperimentUpdate, FeedbackStatus, Lifecycle, Mode
from server.schemas_labels import RelabelCreate
from server.store import Conflict, Store
from server.store_values import StoredLabel
from tests.server.comparing import compare
from tests.server.databases import begun, click, created, new
from tests.server.model import AFTER, Click, Execution, Experiment, Proposal, verdict_of

T = TypeVar("T")

TRAINERS = ("ann", "bob", "cyd")


class Driver:
    """Two experiments, at first one judged by the first click and one by a majority of three."""

    seen: ClassVar[Counter[str]] = Counter()
    """What happened in all sequences: a test that never moves a robot would prove little."""

    def __init__(self) -> None:
        super().__init__()
        self._directory = tempfile.TemporaryDirectory(prefix="seed-invariants-")
        self._loop = asyncio.new_event_loop()
        self._number = 0
        self._store = self._run(Store.open(None, Path(self._directory.name)))
        self.experiments = [self._made(rule) for rule in ("first", "majority")]

    def close(self) -> None:
        """A last look, and everything is put away."""
        for model in self.experiments:
            self._compare(model)
        self._run(self._store.close())
        self._loop.close()
        self._directory.cleanup()

    def _made(self, rule: str) -> Experiment:
        return Experiment(self._run(created(self._store, aggregation=rule)).id, rule)

    def _compare(self, model: Experiment) -> None:
        self._run(compare(self._store, model))

    def _verb(self, model: Experiment, verb: Verb) -> None:
        after = AFTER[verb].get(model.lifecycle)
        legal = after is not None and not (model.halted and verb in ("start", "resume", "reset"))
        stored = self._expect(legal, self._store.transition(model.id, verb))
        if stored is not None and after is not None:
            assert stored.lifecycle is Lifecycle(after)
            model.lifecycle = after
            if verb not in ("start", "resume"):
                self._close_open(model)

    def _halt(self, model: Experiment) -> None:
        assert self._run(self._store.halt(model.id)).halted
        model.halted = True
        if model.lifecycle == "running":
            model.lifecycle = "paused"
        self._close_open(model)

    def _rearm(self, model: Experiment) -> None:
        self._expect(model.halted, self._store.rearm(model.id))
        model.halted = False

    def _mode(self, model: Experiment, mode: Mode) -> None:
        self._run(self._store.update_experiment(model.id, ExperimentUpdate(mode=mode)))
        model.mode = mode.value

    def _episode(self, model: Experiment) -> None:
        model.episode += 1
        model.episode_open = True
        assert self._run(self._store.begin_episode(model.id, 1)) == model.episode

    def _leave(self, model: Experiment, trainer: str) -> None:
        """Nobody waits for this trainer any more; a vote that they have cast counts."""
        for left in self._run(self._store.leave_electorates(model.id, [trainer])):
            self._learn(model, left.labels)
        for proposal in model.open_proposals:
            votes = model.votes(proposal)
            if trainer in proposal.electorate and trainer not in [vote.trainer for vote in votes]:
                proposal.electorate.remove(trainer)
                self._conclude(proposal, "left to a verdict")

    def _rule(self, model: Experiment, rule: str) -> None:
        """Open proposals are added up anew by it, closed ones are as they were."""
        change = ExperimentUpdate(aggregation=Aggregation(rule))
        _, concluded = self._run(self._store.update_and_conclude(model.id, change))
        changed, model.rule = model.rule != rule, rule
        closed = [p.id for p in model.open_proposals if changed and self._conclude(p, "verdict by a new rule")]
        assert [each.proposal.id for each in concluded] == closed
        for each in concluded:
            self._learn(model, each.labels)

    def _conclude(self, proposal: Proposal, how: str) -> bool:
        model = proposal.experiment
        proposal.verdict = verdict_of(model.rule, model.votes(proposal), proposal.electorate)
        proposal.open = proposal.verdict is None
        self.seen[how] += not proposal.open
        return not proposal.open

    def _propose(self, model: Experiment, x: float, slot: int) -> None:
        observation = f"o{model.observation}"
        asked = new(model.id, observation, x=x, electorate=TRAINERS, slot=slot)
        legal = model.at_work and model.episode_open and model.at(slot) is None and model.moving is None
        legal = legal and all(p.observation == observation for p in model.open_proposals)
        stored = self._expect(legal, self._store.open_proposal(asked))
        if stored is not None:
            parameters = {"x": x, "y": 0.1, "z": -0.1}
            model.proposals.append(
                Proposal(
                    stored.id, model, observation, model.episode, parameters, slot, list(TRAINERS), born=model.tick()
                )
            )

    def _click(self, proposal: Proposal, click_id: str, value: int, trainer: str, *, had: bool = False) -> None:
        """had: they have it before them, also where another's approval has closed it."""
        model = proposal.experiment
        before = [c for c in model.clicks if c.proposal is proposal and c.trainer == trainer and c.counted]
        overtaken = had and proposal.superseded and model.at_work and not before
        late = not proposal.open and not overtaken
        asked = model.rule == "first" or not proposal.electorate or trainer in proposal.electorate
        legal = not proposal.open or (asked and trainer not in [vote.trainer for vote in model.votes(proposal)])
        answer = self._expect(legal, self._store.submit_feedback(proposal.id, click(value, click_id, trainer), had=had))
        if answer is None:
            return
        self.seen["late click" if late else "overtaken label" if overtaken else "click"] += 1
        model.clicks.append(Click(answer.feedback.id, click_id, proposal, trainer, value, late, overtaken=overtaken))
        assert answer.feedback.status.value == model.clicks[-1].status
        self._learn(model, answer.labels)
        if overtaken:
            assert [label.feedback_id for label in answer.labels] == [answer.feedback.id]
        elif not late:
            proposal.electorate = proposal.electorate or [trainer]
            self._conclude(proposal, "judged")
        assert (answer.closed is not None) == (answer.feedback.status is FeedbackStatus.STORED and not proposal.open)

    def _click_again(self, known: Click, data: st.DataObject) -> None:
        every = [proposal for model in self.experiments for proposal in model.proposals]
        other = data.draw(st.sampled_from([known.proposal, *every]))
        value = data.draw(st.sampled_from([known.value, 0]))
        self._submit_again(known, other, value)

    def _submit_again(self, known: Click, other: Proposal, value: int) -> None:
        """The same id once more: harmless with the same content, else refused."""
        same = other is known.proposal and value == known.value
        answer = self._expect(same, self._store.submit_feedback(other.id, click(value, known.click_id, known.trainer)))
        if answer is not None:
            assert answer.duplicate
            assert answer.feedback.id == known.id
            self.seen["same click again"] += 1

    def _correct(self, chosen: Click, value: int) -> None:
        """The click's label is another; its verdict stays, and so do the votes if it is open again."""
        legal = chosen.counted and not chosen.proposal.open
        body = RelabelCreate(click_id=self._new_id(), value=value, trainer=chosen.trainer)
        corrected = self._expect(legal, self._store.relabel(chosen.id, body, anybodys=False))
        if corrected is None:
            return
        self.seen["corrected"] += 1
        chosen.corrected = value
        if corrected.label is not None:
            self._learn(chosen.proposal.experiment, [corrected.label])

    def _learn(self, model: Experiment, labels: Sequence[StoredLabel]) -> None:
        model.learner |= {label.feedback_id: label.value for label in labels}

    def _time_out(self, proposal: Proposal) -> None:
        self._run(self._store.close_proposal(proposal.id, CloseReason.TIMED_OUT))
        proposal.open = False

    def _undo(self, chosen: Click) -> None:
        model, judged = chosen.proposal.experiment, chosen.proposal
        since = model.proposals[model.proposals.index(judged) :]
        counted = [c for c in model.clicks if c.counted and c.trainer == chosen.trainer]
        legal = (
            bool(counted)
            and chosen is counted[-1]
            and model.at_work
            and (
                chosen.overtaken
                or (
                    model.episode_open
                    and judged.episode == model.episode
                    and all(p.observation == judged.observation for p in since)
                    and all(e.born < judged.born for e in model.executions)
                )
            )
        )
        undone = self._expect(legal, self._store.undo_feedback(chosen.id))
        if judged.execution is not None and model.at_work and chosen in counted[-1:]:
            self.seen["undo after a motion"] += 1
        if undone is None:
            return
        for feedback_id in (chosen.id, *undone.unlearned):
            model.learner.pop(feedback_id, None)
        self.seen["others' labels let go"] += len(undone.unlearned)
        if chosen.overtaken:  # nothing has come of it
            assert (undone.reopened.closed_at is not None, undone.withdrawn) == (True, None)
            chosen.undone = True
            self.seen["overtaken label undone"] += 1
            return
        left = [vote for vote in model.votes(judged) if vote is not chosen]
        still = judged.verdict is not None and verdict_of(model.rule, left, judged.electorate) == judged.verdict
        taken = {p.slot: p for p in model.open_proposals}
        withdrawn = None if judged.open or still else taken.get(judged.slot)
        older = withdrawn is not None and withdrawn.id < judged.id  # opened again as well
        if withdrawn is not None and (older or model.votes(withdrawn)):  # somebody has judged it: it stays
            judged.slot = min(set(range(len(taken) + 1)) - set(taken))
            withdrawn = None
            self.seen["undone beside"] += 1
        assert (undone.withdrawn.id if undone.withdrawn else None) == (withdrawn.id if withdrawn else None)
        if withdrawn is not None:
            withdrawn.open = False
            self.seen["withdrawn"] += 1
        self.seen["undone"] += 1
        assert undone.reopened.slot == judged.slot
        chosen.undone = True
        self.seen["undone in vain"] += still
        if not still:
            judged.open, judged.verdict, judged.decided = True, None, False

    def _begin(self, proposal: Proposal, *, current: bool, inside: bool) -> None:
        model = proposal.experiment
        observation = proposal.observation if current else "elsewhere"
        asked = not proposal.open and not proposal.decided
        answer = self._expect(
            not (asked and model.moving is not None),
            begun(self._store, proposal.id, observation, workspace_ok=inside),
        )
        if answer is None:
            return
        decision, execution = answer
        may = (
            asked
            and proposal.verdict == "good"
            and verdict_of(model.rule, model.votes(proposal), proposal.electorate) == "good"
            and model.mode == "execute_approved"
            and model.at_work
            and current
            and inside
        )
        self.seen["moved" if may else decision.reason] += 1
        assert decision.allowed == may
        assert (execution is not None) == may
        proposal.decided |= asked
        if execution is not None:
            assert execution.parameters == proposal.parameters
            _, labels = self._run(self._store.superseded_by(proposal.id))
            self._learn(model, labels)
            superseded, late = model.supersede()
            self.seen["superseded"] += superseded
            self.seen["approved too late"] += late
            proposal.execution = Execution(execution.id, proposal, born=model.tick())

    def _end(self, execution: Execution, outcome: ExecutionOutcome) -> None:
        ended = self._expect(
            execution.outcome is None,
            self._store.end_execution(
                execution.id, outcome, end_reason="arrived", low_level_steps=1, task_success=False
            ),
        )
        if ended is not None:
            execution.outcome = outcome.value

    def _crash(self) -> None:
        """The process ends with no word of farewell; the next one recovers. Committed is all that there is."""
        self._run(self._store.close())
        self._store = self._run(Store.open(None, Path(self._directory.name)))
        self._run(self._store.recover())
        for model in self.experiments:
            if model.lifecycle == "running":
                model.lifecycle = "paused"
            if model.moving is not None:
                model.moving.outcome = "interrupted"
                self.seen["crash while moving"] += 1
            self._close_open(model)
            model.episode_open = False
            self._compare(model)

    # --- what must hold ---------------------------------------------------------------------------------------------

    # ----------------------------------------------------------------------------------------------------------------

    def _close_open(self, model: Experiment) -> None:
        for proposal in model.open_proposals:
            proposal.open = False

    def _new_id(self) -> str:
        self._number += 1
        return f"click-{self._number:06}"

    def _run(self, work: Coroutine[Any, Any, T]) -> T:
        return self._loop.run_until_complete(work)

    def _expect(self, legal: bool, work: Coroutine[Any, Any, T]) -> T | None:
        """The result where the model says that it is legal; otherwise it must be refused."""
        refusal: Conflict | None = None
        result: T | None = None
        try:
            result = self._run(work)
        except Conflict as conflict:
            refusal = conflict
        assert legal == (refusal is None), refusal or result
        return result
