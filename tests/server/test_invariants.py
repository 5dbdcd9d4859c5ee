"""No sequence of proposals, clicks, verbs and crashes breaks DESIGN.md section 5 (1, 2, 3, 5): checked against a model.

Nor do a learner that lives on and one that starts anew ever learn from different labels.

The model is written apart from the store and knows only what the rules say; after every step the whole database is
compared with it.
"""

from __future__ import annotations

from typing import cast

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, rule, run_state_machine_as_test

from server.lifecycle import Verb
from server.schemas import ExecutionOutcome, Mode
from tests.server.driver import TRAINERS, Driver
from tests.server.model import AFTER, Experiment, Proposal

EXPERIMENTS = st.sampled_from([0, 1])
TOGETHER = ("parallel", "overtaken", "left", "ruled", "overruled", "in vain", "beside")
"""parallel: three are open on one observation. overtaken: two of them are approved, and the robot moves by the first.

left: a majority was split, and the third trainer has gone. ruled: a click waited for others, and the rule is `first`
now. overruled: a majority approved it, and before the gate was asked all have to. in vain: who was outvoted takes that
back. beside: a click is taken back while the next proposal has a vote.
"""
ALONE = ("ready", "open", "split", "again", "refused", "followed", "back", "approved", "halted", "moving", "dead")
"""split: one good, one bad. again: refused, and a click of that repeated. followed: refused, and the next one open on
the same observation. back: followed, and the refusal is taken back. halted: once approved. dead: crashed while moving.
"""
SITUATIONS = (*ALONE, *TOGETHER)
RULES = ("first", "majority", "unanimous")
DISTURBANCES = (
    *AFTER,
    *("halt", "rearm", "mode", "episode", "look", "propose", "crash", "crash"),
    *("click", "click", "click again", *("undo",) * 5, *("begin",) * 4, "end", "time out"),
    *("propose beside", "propose beside", "leave", "rule", "correct", "correct"),
)


class Machine(Driver, RuleBasedStateMachine):
    """Two experiments, one judged by the first click and one by a majority of three; for a while by another rule.

    `bring` leads one of them along the legal way to a situation, and then anything at all is done to it.
    """

    def teardown(self) -> None:
        self.close()

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
            self._compare(model)
            model = self.experiments[which] = self._made(model.rule)
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
        for left in model.open_proposals:
            self._time_out(left)
        if situation in TOGETHER:
            self._bring_together(model, situation, x)
            return
        self._rule(model, ("first", "majority")[which])
        self._propose(model, x, 0)
        (proposal,) = model.open_proposals
        bad = situation in ("again", "refused", "followed", "back")
        self._votes(proposal, *{"open": (), "split": (1, -1)}.get(situation, (-1,) * 3 if bad else (1,) * 3))
        if situation in ("followed", "back"):
            self._propose(model, x, 0)
        if situation == "back":
            self._undo(model.clicks[-1])
        if situation == "halted":
            self._halt(model)
            self._begin(proposal, current=True, inside=True)
        if situation == "again":
            self._submit_again(model.clicks[-1], proposal, model.clicks[-1].value)
        if situation in ("moving", "dead"):
            self._begin(proposal, current=True, inside=True)
            self._undo(model.clicks[-1])
        if situation == "dead":
            self._crash()

    def _bring_together(self, model: Experiment, situation: str, x: float) -> None:
        self._rule(model, "majority")
        for slot in range(3 if situation in ("parallel", "overtaken") else 1):
            self._propose(model, x + slot / 100, slot)
        proposal, *others = model.open_proposals
        if situation == "overtaken":
            self._votes(proposal, 1, 1)
            self._votes(others[0], 1, 1)
            self._begin(proposal, current=True, inside=True)
            self._click(others[1], self._new_id(), -1, TRAINERS[2], had=True)
            self._click(others[0], self._new_id(), 1, TRAINERS[2], had=True)  # judged, and overtaken only then
        elif situation == "left":
            self._votes(proposal, 1, -1)
            self._leave(model, TRAINERS[2])
        elif situation == "ruled":
            self._votes(proposal, 1)
            self._rule(model, "first")
        elif situation == "overruled":
            self._votes(proposal, 1, 1)
            self._rule(model, "unanimous")
            self._begin(proposal, current=True, inside=True)
        elif situation == "in vain":
            self._votes(proposal, -1, 1, 1)
            self._undo(model.votes(proposal)[0])
        elif situation == "beside":
            self._votes(proposal, -1, -1)
            self._propose(model, x + 0.1, 0)
            self._votes(model.open_proposals[0], -1)
            self._undo(model.votes(proposal)[1])

    def _votes(self, proposal: Proposal, *values: int) -> None:
        for trainer, value in zip(TRAINERS, values, strict=False):
            if proposal.open:
                self._click(proposal, self._new_id(), value, trainer)

    def _disturb(self, model: Experiment, what: str, data: st.DataObject) -> None:  # noqa: PLR0912 - one a line
        # the newest are likelier: an old proposal only ever gives late clicks
        proposals = model.proposals[-4:]
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
            self._propose(model, data.draw(st.floats(0.3, 0.8)), 0)
        elif what == "propose beside":
            self._propose(model, data.draw(st.floats(0.3, 0.8)), data.draw(st.sampled_from([1, 2])))
        elif what == "leave":
            self._leave(model, data.draw(st.sampled_from(TRAINERS)))
        elif what == "rule":
            self._rule(model, data.draw(st.sampled_from(RULES)))
        elif what == "crash":
            self._crash()
        elif what == "click again" and model.clicks:
            self._click_again(data.draw(st.sampled_from(model.clicks)), data)
        elif what == "undo" and model.clicks:
            self._undo(data.draw(st.sampled_from([model.clicks[-1], *model.clicks[:-6:-1]])))
        elif what == "correct" and model.clicks:
            self._correct(data.draw(st.sampled_from(model.clicks[:-6:-1])), data.draw(st.sampled_from([1, 0, -1])))
        elif what == "end" and model.executions:
            self._end(
                data.draw(st.sampled_from(model.executions[:-3:-1])), data.draw(st.sampled_from(ExecutionOutcome))
            )
        elif what == "click" and proposals:
            value, trainer = data.draw(st.sampled_from([1, 0, -1])), data.draw(st.sampled_from(TRAINERS))
            had = data.draw(st.booleans())
            self._click(data.draw(st.sampled_from(proposals[::-1])), self._new_id(), value, trainer, had=had)
        elif what == "time out" and proposals:
            self._time_out(data.draw(st.sampled_from(proposals[::-1])))
        elif what == "begin" and proposals:
            current, inside = data.draw(st.sampled_from([(True, True), (True, True), (False, True), (True, False)]))
            self._begin(data.draw(st.sampled_from([proposals[-1], *proposals[::-1]])), current=current, inside=inside)


def test_no_sequence_of_clicks_verbs_and_crashes_breaks_an_invariant() -> None:
    Machine.seen.clear()
    run_state_machine_as_test(
        Machine,
        settings=settings(
            max_examples=24,
            stateful_step_count=12,
            deadline=None,
            derandomize=True,  # the same sequences every time; change the numbers to look further
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
        ),
    )
    happened = ("click", "late click", "same click again", "undone", "withdrawn", "moved", "crash while moving")
    together = (
        "superseded",
        "overtaken label",
        "approved too late",
        "left to a verdict",
        "verdict by a new rule",
        "undone beside",
        "corrected",
        "others' labels let go",
    )
    shut = (
        "undo after a motion",
        "the emergency stop is latched",
        "no verdict",
        "the verdict is bad",
        "it was executed already",
        "its votes don't approve it by the rule of now",
    )
    assert all(Machine.seen[what] >= 2 for what in (*happened, *together, "undone in vain", *shut)), Machine.seen
