"""Several trainers on one experiment: real workers, a real database, and everyone by the same door."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from server.errors import ServiceError
from server.messages import (
    ExecutionEnded,
    ExecutionStarted,
    FeedbackStored,
    JudgesChanged,
    ProposalChanged,
    ProposalClosed,
)
from server.schemas import (
    Aggregation,
    CloseReason,
    ExperimentUpdate,
    Feedback,
    FeedbackCreate,
    FeedbackStatus,
    Proposal,
    Verdict,
)
from server.schemas_together import Together, TogetherUpdate
from server.store import Conflict
from tests.server.stage import Stage, stage

FOUR = ("ann", "bob", "cyd", "dan")
ENDLESS = {"step_seconds": 1.0}
"""A skill would take twenty seconds."""


async def judges(s: Stage, experiment_id: int, *names: str) -> dict[str, Proposal]:
    """What these trainers have before them, once each has something of their own."""
    seating = s.hub.seats.of(experiment_id)

    def all_have() -> dict[str, Proposal] | None:
        opened = {proposal.id: proposal for proposal in seating.opened()}
        found = {name: opened.get(seating.proposal_of(name) or 0) for name in names}
        return {n: p for n, p in found.items() if p is not None} if all(found.values()) else None

    found: dict[str, Proposal] = await s.seen.until(all_have)
    return found


async def say(s: Stage, trainer: str, proposal: Proposal, value: int) -> Feedback:
    body = FeedbackCreate(click_id=f"{trainer}-click-{proposal.id}-{s.now}", value=value, trainer=trainer)
    return (await s.hub.feedback(proposal.id, body))[0]


def seat(s: Stage, experiment_id: int, *names: str) -> None:
    for name in names:
        s.hub.seats.of(experiment_id).arrive(name)


def closed(s: Stage, proposal: Proposal) -> Any:
    return next((e.proposal for e in s.seen.of(ProposalClosed) if e.proposal.id == proposal.id), None)


async def told_closed(s: Stage, proposal: Proposal) -> Any:
    return await s.seen.until(lambda: closed(s, proposal))


async def test_in_parallel_each_has_another_and_the_first_approved_closes_the_others(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(together=Together(parallel=True), adapter_settings=ENDLESS)
        seat(s, experiment.id, *FOUR)
        await s.hub.act(experiment.id, "start")
        first = await judges(s, experiment.id, *FOUR)
        assert len({p.id for p in first.values()}) == len({p.digest for p in first.values()}) == 4
        assert {p.observation_id for p in first.values()} == {first["ann"].observation_id}
        assert sorted(p.slot for p in first.values()) == [0, 1, 2, 3]

        # what one has is not another's to judge: it is kept, and the answer says why
        other = await say(s, "ann", first["bob"], 1)
        assert (other.status, other.late_because) == (
            FeedbackStatus.LATE,
            "it is before another trainer now, and waits for what they say of it",
        )
        # a rejected one moves nothing: whoever clicked gets the next, the others keep theirs
        await say(s, "ann", first["ann"], -1)
        second = await judges(s, experiment.id, *FOUR)
        assert second["ann"].id not in {p.id for p in first.values()}
        assert {n: second[n].id for n in FOUR[1:]} == {n: first[n].id for n in FOUR[1:]}

        at = s.now
        await say(s, "cyd", second["cyd"], 1)
        moving = (await s.seen.next(ExecutionStarted, at)).execution
        assert moving.proposal_id == second["cyd"].id
        for name in ("ann", "bob", "dan"):
            told = await told_closed(s, second[name])
            assert (told.close_reason, told.superseded_by) == (CloseReason.SUPERSEDED, second["cyd"].id)
        # who thought about another one may finish: it trains, and moves nothing
        finishing = {j.trainer: j.proposal_id for j in s.hub.seats.of(experiment.id).judges if j.finishing}
        assert finishing == {name: second[name].id for name in ("ann", "bob", "dan")}
        finished = await say(s, "bob", second["bob"], 1)
        why = f"another proposal, number {second['cyd'].number}, was approved first"
        assert (finished.status, finished.late_because) == (FeedbackStatus.OVERTAKEN, why)
        assert (await say(s, "bob", second["dan"], 1)).status is FeedbackStatus.LATE  # it wasn't before bob
        assert await s.store.open_proposals(experiment.id) == []

        await s.hub.act(experiment.id, "halt")
        await s.hub.idle(experiment.id)
        counters = (await s.hub.view(experiment.id)).counters
        assert (counters.feedback, counters.late, counters.executions) == (3, 2, 1)
        assert [label.value for label in await s.store.labels(experiment.id)] == [-1, 1, 1]
        # nothing is to be finished after a stop
        assert not any(judge.finishing for judge in s.hub.seats.of(experiment.id).judges)
        assert (await say(s, "ann", second["ann"], 1)).status is FeedbackStatus.LATE


async def test_who_leaves_or_says_nothing_leaves_theirs_to_the_others(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(together=Together(parallel=True, vanish_seconds=0))
        seat(s, experiment.id, "ann", "bob")
        await s.hub.act(experiment.id, "start")
        first = await judges(s, experiment.id, "ann", "bob")
        s.hub.seats.of(experiment.id).depart("ann")
        await say(s, "bob", first["bob"], -1)
        second = await judges(s, experiment.id, "bob")
        assert second["bob"].id == first["ann"].id
        # nobody is waited for who has only a page open: the lease runs out by itself
        at = s.now
        await s.hub.update(experiment.id, ExperimentUpdate(together=TogetherUpdate(lease_seconds=1)))
        away = await s.seen.next(JudgesChanged, at, where=lambda e: all(judge.away for judge in e.judges))
        assert [(judge.trainer, judge.proposal_id) for judge in away.judges] == [("bob", None)]
        assert (await s.hub.seats.look(experiment.id, "bob")).proposal is not None


async def test_a_majority_tells_who_was_heard_and_only_at_the_end_what_they_said(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(aggregation="majority", together=Together(vanish_seconds=0))
        seat(s, experiment.id, "ann", "bob", "cyd")
        await s.hub.act(experiment.id, "start")
        proposal = (await judges(s, experiment.id, "ann", "bob", "cyd"))["ann"]
        assert proposal.electorate == ["ann", "bob", "cyd"]
        seat(s, experiment.id, "eve")
        with pytest.raises(Conflict, match="not there"):
            await say(s, "eve", proposal, 1)
        at = s.now
        await say(s, "ann", proposal, -1)
        changed = await s.seen.next(ProposalChanged, at)
        assert (changed.proposal.heard, changed.proposal.closed_at) == (["ann"], None)
        assert not [event for event in s.seen.events[at:] if isinstance(event, FeedbackStored)]
        await say(s, "bob", proposal, 1)
        assert closed(s, proposal) is None
        assert (await s.store.feedback_of_proposal(proposal.id, told_to="nobody")).items == []
        assert len((await s.store.feedback_of_proposal(proposal.id)).items) == 2
        # cyd has gone for good: of the two who are left one said good and one bad
        s.hub.seats.of(experiment.id).depart("cyd")
        told = await told_closed(s, proposal)
        assert (told.verdict, told.rule, told.electorate) == (Verdict.NEUTRAL, Aggregation.MAJORITY, ["ann", "bob"])
        following = (await judges(s, experiment.id, "ann", "bob", "eve"))["ann"]
        assert following.electorate == ["ann", "bob", "eve"]
        # a new rule adds up what is open anew, and leaves what is closed
        await say(s, "eve", following, 0)
        await s.hub.update(experiment.id, ExperimentUpdate(aggregation=Aggregation.FIRST))
        told = await told_closed(s, following)
        assert (told.verdict, told.rule) == (Verdict.NEUTRAL, Aggregation.FIRST)
        assert (await s.store.proposal(proposal.id)).rule is Aggregation.MAJORITY
        assert (await s.hub.view(experiment.id)).counters.feedback == 3


async def test_who_gives_no_sign_of_life_holds_up_no_quorum_and_is_asked_again_once_back(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(aggregation="unanimous", mode="propose_only", together=Together(least=2))
        seats, here = s.hub.seats.of(experiment.id), experiment.id

        def is_away(*names: str) -> bool:
            return {judge.trainer for judge in seats.judges if judge.away} == {*names}

        seat(s, here, "ann", "bob", "cyd")
        await s.hub.act(here, "start")
        proposal = (await judges(s, here, "ann", "bob", "cyd"))["ann"]
        for name in ("ann", "bob"):
            await say(s, name, proposal, 1)
        assert closed(s, proposal) is None
        # cyd's page is open, and nobody is at it
        await s.hub.update(here, ExperimentUpdate(together=TogetherUpdate(lease_seconds=1)))
        told = await told_closed(s, proposal)
        assert (told.verdict, told.electorate) == (Verdict.GOOD, ["ann", "bob"])
        await s.seen.until(lambda: is_away("ann", "bob", "cyd"))  # they neither, by now
        await s.hub.update(here, ExperimentUpdate(together=TogetherUpdate(lease_seconds=3600)))
        following = await s.seen.until(lambda: [p for p in seats.opened() if not p.electorate])
        # nobody else is left to judge it: it is for whoever is back, and the least that have to say so hold
        for name in ("cyd", "bob"):
            await s.hub.seats.look(here, name)
        (proposal,) = await s.seen.until(lambda: [p for p in seats.opened() if len(p.electorate) == 2])
        assert (proposal.id, sorted(proposal.electorate)) == (following[0].id, ["bob", "cyd"])
        await say(s, "cyd", proposal, 1)
        assert closed(s, proposal) is None
        with pytest.raises(Conflict, match="has been away since"):
            await say(s, "ann", proposal, 1)
        assert is_away(), "a click is a sign of life, also where it comes too late"
        await say(s, "bob", proposal, 1)
        assert (await told_closed(s, proposal)).verdict is Verdict.GOOD
        assert (await judges(s, here, "ann", "bob", "cyd"))["ann"].electorate == ["ann", "bob", "cyd"]


async def test_what_is_opened_again_waits_for_nobody_who_has_gone_meanwhile(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(
            aggregation="unanimous", mode="propose_only", together=Together(vanish_seconds=0)
        )
        seat(s, experiment.id, "ann", "bob", "cyd")
        await s.hub.act(experiment.id, "start")
        proposal = (await judges(s, experiment.id, "ann", "bob", "cyd"))["ann"]
        await say(s, "ann", proposal, 1)
        veto = await say(s, "bob", proposal, -1)
        await told_closed(s, proposal)
        at = s.now
        s.hub.seats.of(experiment.id).depart("cyd")
        await s.seen.next(JudgesChanged, at, where=lambda e: len(e.judges) == 2)
        at = s.now
        await s.hub.undo(veto.id, by="bob")
        await say(s, "bob", proposal, 1)
        told = await s.seen.next(ProposalClosed, at, where=lambda e: e.proposal.id == proposal.id)
        assert (told.proposal.verdict, told.proposal.electorate) == (Verdict.GOOD, ["ann", "bob"])


async def test_nobody_there_and_it_waits_for_whoever_comes(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(aggregation="unanimous")
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        assert proposal.electorate == []
        at = s.now
        seat(s, experiment.id, "ann")
        entered = await s.seen.next(ProposalChanged, at)
        assert (entered.proposal.id, entered.proposal.electorate) == (proposal.id, ["ann"])
        assert (await s.hub.seats.look(experiment.id, "ann")).proposal == entered.proposal
        await say(s, "ann", entered.proposal, -1)
        assert (await s.store.proposal(proposal.id)).verdict is Verdict.BAD


async def test_an_undo_races_with_anothers_approval_and_everyone_is_told_one_story(tmp_path: Path) -> None:
    """A majority of two: ann takes her good back while bob's completes it, or the robot has started."""
    async with stage(tmp_path) as s:
        experiment = await s.experiment(aggregation="majority", adapter_settings={"step_seconds": 0.0})
        seat(s, experiment.id, "ann", "bob")
        await s.hub.act(experiment.id, "start")
        winners = []
        for turn in range(6):
            proposal = (await judges(s, experiment.id, "ann", "bob"))["ann"]
            hers = await say(s, "ann", proposal, 1)
            at = s.now
            his = asyncio.create_task(say(s, "bob", proposal, 1))
            for _ in range(turn * 40):  # nothing to wait for: it is to come sooner or later after the other
                await asyncio.sleep(0)
            undone = (await asyncio.gather(his, s.hub.undo(hers.id, by="ann"), return_exceptions=True))[1]
            if isinstance(undone, Conflict):
                winners.append("robot")
                ended = await s.seen.next(ExecutionEnded, at)
                assert ended.execution.proposal_id == proposal.id
            else:
                winners.append("undo")
                now = await s.store.proposal(proposal.id)
                assert (now.closed_at, now.heard) == (None, ["bob"])
                told = [e for e in s.seen.events[at:] if getattr(e, "proposal", None) and e.proposal.id == proposal.id]  # type: ignore[union-attr]
                assert told[-1].proposal == now  # type: ignore[union-attr]
                assert not [e for e in s.seen.events[at:] if isinstance(e, ExecutionStarted)]
                await say(s, "ann", proposal, -1)
                await told_closed(s, proposal)
        executions = (await s.store.executions(experiment.id)).items
        assert len(executions) == winners.count("robot")
        assert "undo" in winners


async def test_each_undoes_the_own_click_and_what_another_looks_at_stays(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(together=Together(parallel=True))
        seat(s, experiment.id, "ann", "bob")
        await s.hub.act(experiment.id, "start")
        first = await judges(s, experiment.id, "ann", "bob")
        hers, his = await say(s, "ann", first["ann"], -1), await say(s, "bob", first["bob"], -1)
        second = await judges(s, experiment.id, "ann", "bob")
        with pytest.raises(Conflict, match="somebody else's, not ann's"):
            await s.hub.undo(his.id, by="ann")
        await s.hub.undo(hers.id, by="ann")
        third = await judges(s, experiment.id, "ann", "bob")
        assert (third["ann"].id, third["bob"].id) == (first["ann"].id, second["bob"].id)
        assert [label.feedback_id for label in await s.store.labels(experiment.id)] == [his.id]


async def test_robots_and_slots_are_one_queue(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(num_envs=2, together=Together(parallel=True))
        seat(s, experiment.id, *FOUR)
        await s.hub.act(experiment.id, "start")
        found = await judges(s, experiment.id, *FOUR)
        assert sorted((p.robot, p.slot) for p in found.values()) == [(0, 0), (0, 1), (1, 0), (1, 1)]
        s.hub.seats.of(experiment.id).depart("dan")
        free = found["dan"]
        for name in ("ann", "bob", "cyd"):
            assert (await s.hub.seats.look(experiment.id, name)).proposal == found[name]
        await say(s, "ann", found["ann"], -1)
        assert (await judges(s, experiment.id, "ann"))["ann"].id == free.id, "it is the oldest that nobody is at"


async def test_parallel_can_be_turned_on_and_off_while_it_runs(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        seat(s, experiment.id, "ann", "bob")
        await s.hub.act(experiment.id, "start")
        first = await judges(s, experiment.id, "ann", "bob")
        assert first["ann"].id == first["bob"].id, "they look at the same one"
        await s.hub.update(experiment.id, ExperimentUpdate(together=TogetherUpdate(parallel=True)))
        second = await s.seen.until(
            lambda: len({s.hub.seats.of(experiment.id).proposal_of(name) for name in ("ann", "bob")} - {None}) == 2
        )
        assert second
        await s.hub.update(experiment.id, ExperimentUpdate(together=TogetherUpdate(parallel=False)))
        # what is open stays so until it is judged; then there is one
        for _ in range(2):
            opened = await s.store.open_proposals(experiment.id)
            await say(s, "ann", opened[0], -1)
        await s.seen.until(
            lambda: [len(station.desk.opened) for station in s.hub._runners[experiment.id].stations] == [1]
        )


async def test_what_is_to_be_repeatable_is_not_parallel(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        for fields in ({"teacher": "synthetic"}, {"lockstep": True}):
            with pytest.raises(ServiceError) as refused:
                await s.experiment(together=Together(parallel=True), **fields)
            assert refused.value.problem.fields[0].field == "together.parallel"
            experiment = await s.experiment(**fields)
            with pytest.raises(ServiceError, match="parallel"):
                await s.hub.update(experiment.id, ExperimentUpdate(together=TogetherUpdate(parallel=True)))
