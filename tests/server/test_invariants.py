"""No sequence of proposals, clicks, verbs and crashes breaks DESIGN.md section 5 (1, 2, 3, 5): checked against a model.

The model is written apart from the store and knows only what the rules say; after every step the whole database is
compared with it.
"""

from __future__ import annotations

import asyncio
import tempfile
from collections import Counter
from collections.abc import Coroutine
from pathlib import Path
from typing import Any, ClassVar, TypeVar, cast

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, rule, run_state_machine_as_test

from server.lifecycle import Verb
from server.schemas import CloseReason, ExecutionOutcome, ExperimentUpdate, FeedbackStatus, Lifecycle, Mode
from server.store import Conflict, Store
from tests.server.databases import begun, click, created, new
from tests.server.model import AFTER, Click, Execution, Experiment, Proposal, verdict_of

T = TypeVar("T")

TRAINERS = ("ann", "bob", "cyd")
EXPERIMENTS = st.sampled_from([0, 1])
SITUATIONS = ("ready", "open", "split", "refused", "followed", "approved", "halted", "moving")
"""split: one good, one bad. followed: refused, and the next one open on the same observation. halted: once approved."""
DISTURBANCES = (
    *AFTER,
    *("halt", "rearm", "mode", "episode", "look", "propose", "crash", "crash"),
    *("click", "click", "click again", *("undo",) * 5, *("begin",) * 4, "end", "time out"),
)


class Machine(RuleBasedStateMachine):
    """Two experiments, one judged by the first click and one by a majority of three.

    `bring` leads one of them along the legal way to a situation, and then anything at all is done to it.
    """

    seen: ClassVar[Counter[str]] = Counter()
    """What happened in all sequences: a test that never moves a robot would prove little."""

    def __init__(self) -> None:
        super().__init__()
        self._directory = tempfile.TemporaryDirectory(prefix="seed-invariants-")
        self._loop = asyncio.new_event_loop()
        self._number = 0
        self._store = self._run(Store.open(None, Path(self._directory.name)))
        self.experiments = []
        for majority in (False, True):
            made = self._run(created(self._store, aggregation="majority" if majority else "first"))
            self.experiments.append(Experiment(made.id, majority))

    def teardown(self) -> None:
        for model in self.experiments:
            self._compare(model)
        self._run(self._store.close())
        self._loop.close()
        self._directory.cleanup()

    @rule(
        which=EXPERIMENTS,
        situation=st.sampled_from(SITUATIONS),
        x=st.floats(0.3, 0.8),
        then=st.lists(st.sampled_from(DISTURBANCES), min_size=1, max_size=6),
        data=st.data(),
    )
    def bring(self, which: int, situation: str, x: float, then: list[str], data: st.DataObject) -> None:
        self._bring(which, situation, x)
        for what in then:
            self._disturb(self.experiments[which], what, data)
        self._compare(self.experiments[which])

    def _bring(self, which: int, situation: str, x: float) -> None:  # noqa: PLR0912 - one after the other
        model = self.experiments[which]
        if model.lifecycle in ("finished", "archived"):
            made = self._run(created(self._store, aggregation="majority" if model.majority else "first"))
            self._compare(model)
            model = self.experiments[which] = Experiment(made.id, model.majority)
        if model.moving is not None:
            self._end(model.moving, ExecutionOutcome.SUCCEEDED)
            model.observation += 1
        if model.halted:
            self._rearm(model)
        if model.lifecycle != "running":
            self._verb(model, "start" if model.lifecycle == "created" else "resume")
        if not model.episode_open:
            self._episode(model)
        if model.mode != "execute_approved":
            self._mode(model, Mode.EXECUTE_APPROVED)
        if situation == "ready":
            return
        if model.open_proposal is None:
            self._propose(model, x)
        proposal = model.open_proposal
        assert proposal is not None
        values = {"open": (), "split": (1, -1), "refused": (-1,) * 3, "followed": (-1,) * 3}.get(situation, (1,) * 3)
        for trainer, value in zip(TRAINERS, values, strict=False):
            if proposal.open:
                self._click(proposal, self._new_id(), value, trainer)
        if situation == "followed":
            self._propose(model, x)
        if situation == "halted":
            self._halt(model)
        if situation == "moving":
            self._begin(proposal, current=True, inside=True)

    def _disturb(self, model: Experiment, what: str, data: st.DataObject) -> None:  # noqa: PLR0912 - one a line
        # the newest are likelier: an old proposal only ever gives late clicks
        proposals = model.proposals[-3:]
        if what in AFTER:
            self._verb(model, cast(Verb, what))
        elif what == "halt":
            self._halt(model)
        elif what == "rearm":
            self._rearm(model)
        elif what == "mode":
            self._mode(model, data.draw(st.sampled_from(Mode)))
        elif what == "episode":
            self._episode(model)
        elif what == "look":
            model.observation += 1
        elif what == "propose":
            self._propose(model, data.draw(st.floats(0.3, 0.8)))
        elif what == "crash":
            self._crash()
        elif what == "click again" and model.clicks:
            self._click_again(data.draw(st.sampled_from(model.clicks)), data)
        elif what == "undo" and model.clicks:
            self._undo(data.draw(st.sampled_from([model.clicks[-1], *model.clicks[:-4:-1]])))
        elif what == "end" and model.executions:
            self._end(
                data.draw(st.sampled_from(model.executions[:-3:-1])), data.draw(st.sampled_from(ExecutionOutcome))
            )
        elif what == "click" and proposals:
            value, trainer = data.draw(st.sampled_from([1, 0, -1])), data.draw(st.sampled_from(TRAINERS))
            self._click(data.draw(st.sampled_from(proposals[::-1])), self._new_id(), value, trainer)
        elif what == "time out" and proposals:
            self._time_out(data.draw(st.sampled_from(proposals[::-1])))
        elif what == "begin" and proposals:
            current, inside = data.draw(st.sampled_from([(True, True), (True, True), (False, True), (True, False)]))
            self._begin(data.draw(st.sampled_from([proposals[-1], *proposals[::-1]])), current=current, inside=inside)

    # --- what may happen --------------------------------------------------------------------------------------------

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

    def _propose(self, model: Experiment, x: float) -> None:
        observation = f"o{model.observation}"
        asked = new(model.id, observation, x=x, electorate=TRAINERS)
        legal = model.at_work and model.episode_open and model.open_proposal is None and model.moving is None
        stored = self._expect(legal, self._store.open_proposal(asked))
        if stored is not None:
            parameters = {"x": x, "y": 0.1, "z": -0.1}
            model.proposals.append(Proposal(stored.id, model, observation, model.episode, parameters))

    def _click(self, proposal: Proposal, click_id: str, value: int, trainer: str) -> None:
        model = proposal.experiment
        late = not proposal.open
        legal = late or trainer not in [vote.trainer for vote in model.votes(proposal)]
        answer = self._expect(legal, self._store.submit_feedback(proposal.id, click(value, click_id, trainer)))
        if answer is None:
            return
        self.seen["late click" if late else "click"] += 1
        assert (answer.feedback.status is FeedbackStatus.LATE) == late
        model.clicks.append(Click(answer.feedback.id, click_id, proposal, trainer, value, late))
        if not late:
            proposal.verdict = verdict_of(model.majority, [vote.value for vote in model.votes(proposal)])
            proposal.open = proposal.verdict is None
        assert (answer.closed is not None) == (not late and not proposal.open)

    def _click_again(self, known: Click, data: st.DataObject) -> None:
        every = [proposal for model in self.experiments for proposal in model.proposals]
        other = data.draw(st.sampled_from([known.proposal, *every]))
        value = data.draw(st.sampled_from([known.value, 0]))
        same = other is known.proposal and value == known.value
        answer = self._expect(same, self._store.submit_feedback(other.id, click(value, known.click_id, known.trainer)))
        if answer is not None:
            assert answer.duplicate
            assert answer.feedback.id == known.id
            self.seen["same click again"] += 1

    def _time_out(self, proposal: Proposal) -> None:
        self._run(self._store.close_proposal(proposal.id, CloseReason.TIMED_OUT))
        proposal.open = False

    def _undo(self, chosen: Click) -> None:
        model, judged = chosen.proposal.experiment, chosen.proposal
        since = model.proposals[model.proposals.index(judged) :]
        counted = [c for c in model.clicks if c.counted]
        legal = (
            bool(counted)
            and chosen is counted[-1]
            and model.at_work
            and model.episode_open
            and judged.episode == model.episode
            and all(p.execution is None and p.observation == judged.observation for p in since)
        )
        undone = self._expect(legal, self._store.undo_feedback(chosen.id))
        if judged.execution is not None and model.at_work and chosen in counted[-1:]:
            self.seen["undo after a motion"] += 1
        if undone is None:
            return
        withdrawn = model.open_proposal if model.open_proposal is not judged else None
        assert (undone.withdrawn.id if undone.withdrawn else None) == (withdrawn.id if withdrawn else None)
        if withdrawn is not None:
            withdrawn.open = False
            self.seen["withdrawn"] += 1
        self.seen["undone"] += 1
        chosen.undone = True
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
            proposal.execution = Execution(execution.id, proposal)

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

    def _compare(self, model: Experiment) -> None:
        self._every_click_is_there_once_and_where_it_was_put(model)
        self._nothing_moves_without_a_verdict_for_exactly_this_and_only_once(model)
        self._states_and_counters_are_those_of_the_rows(model)

    def _every_click_is_there_once_and_where_it_was_put(self, model: Experiment) -> None:
        rows = self._run(self._store.feedback_of_experiment(model.id, limit=500)).items[::-1]
        stored = [
            (r.id, r.click_id, r.proposal_id, r.trainer, r.value, r.status == "late", r.undone_at is not None)
            for r in rows
        ]
        assert stored == [(c.id, c.click_id, c.proposal.id, c.trainer, c.value, c.late, c.undone) for c in model.clicks]
        labels = self._run(self._store.labels(model.id))
        assert [(label.feedback_id, label.value) for label in labels] == [
            (c.id, c.value) for c in model.clicks if c.counted and c.proposal.verdict is not None
        ]

    def _nothing_moves_without_a_verdict_for_exactly_this_and_only_once(self, model: Experiment) -> None:
        proposals = {p.id: p for p in self._run(self._store.proposals(model.id, limit=500)).items}
        assert [(p.id, p.closed_at is None, p.verdict) for p in reversed(proposals.values())] == [
            (p.id, p.open, p.verdict) for p in model.proposals
        ]
        executions = self._run(self._store.executions(model.id, limit=500)).items[::-1]
        assert [(e.id, e.proposal_id, e.outcome) for e in executions] == [
            (e.id, e.proposal.id, e.outcome) for e in sorted(model.executions, key=lambda e: e.id)
        ]
        assert len({e.proposal_id for e in executions}) == len(executions)
        for execution in executions:
            proposal = proposals[execution.proposal_id]
            assert proposal.verdict == "good"
            assert (proposal.skill, proposal.parameters) == (execution.skill, execution.parameters)

    def _states_and_counters_are_those_of_the_rows(self, model: Experiment) -> None:
        stored = self._run(self._store.experiment(model.id))
        assert (stored.lifecycle, stored.halted) == (model.lifecycle, model.halted)
        counted = [c.value for c in model.clicks if c.counted]
        counters = stored.counters
        assert (counters.feedback, counters.good, counters.neutral, counters.bad) == (
            len(counted),
            counted.count(1),
            counted.count(0),
            counted.count(-1),
        )
        assert counters.late == sum(c.late for c in model.clicks)
        assert (counters.proposals, counters.executions, counters.episodes) == (
            len(model.proposals),
            len(model.executions),
            model.episode,
        )

    # ----------------------------------------------------------------------------------------------------------------

    def _close_open(self, model: Experiment) -> None:
        if model.open_proposal is not None:
            model.open_proposal.open = False

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


def test_no_sequence_of_clicks_verbs_and_crashes_breaks_an_invariant() -> None:
    Machine.seen.clear()
    run_state_machine_as_test(
        Machine,
        settings=settings(
            max_examples=20,
            stateful_step_count=12,
            deadline=None,
            derandomize=True,  # the same sequences every time; change the numbers to look further
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
        ),
    )
    happened = ("click", "late click", "same click again", "undone", "withdrawn", "moved", "crash while moving")
    shut = (
        "undo after a motion",
        "the emergency stop is latched",
        "no verdict",
        "the verdict is bad",
        "it was executed already",
    )
    assert all(Machine.seen[what] >= 2 for what in happened + shut), Machine.seen
