"""The whole database against the model: clicks, proposals, motions and counters, row by row."""

from __future__ import annotations

from server.store import Store
from tests.server.model import Experiment


async def compare(store: Store, model: Experiment) -> None:
    """Every row of it, against what the model says."""
    await _every_click_is_there_once_and_where_it_was_put(store, model)
    await _nothing_moves_without_a_verdict_for_exactly_this_and_only_once(store, model)
    await _states_and_counters_are_those_of_the_rows(store, model)


async def _every_click_is_there_once_and_where_it_was_put(store: Store, model: Experiment) -> None:
    rows = (await store.feedback_of_experiment(model.id, limit=500)).items[::-1]
    stored = [
        (r.id, r.click_id, r.proposal_id, r.trainer, r.value, r.status.value, r.undone_at is not None) for r in rows
    ]
    assert stored == [(c.id, c.click_id, c.proposal.id, c.trainer, c.value, c.status, c.undone) for c in model.clicks]
    labels = await store.labels(model.id)
    assert [(label.feedback_id, label.value) for label in labels] == [
        (c.id, c.label) for c in model.clicks if c.counted and (c.proposal.verdict is not None or c.proposal.superseded)
    ]
    # one that starts anew learns the same
    assert {label.feedback_id: label.value for label in labels} == model.learner


async def _nothing_moves_without_a_verdict_for_exactly_this_and_only_once(store: Store, model: Experiment) -> None:
    proposals = {p.id: p for p in (await store.proposals(model.id, limit=500)).items}
    assert [
        (p.id, p.slot, p.closed_at is None, p.verdict, p.close_reason == "superseded", p.electorate, p.heard)
        for p in reversed(proposals.values())
    ] == [
        (p.id, p.slot, p.open, p.verdict, p.superseded, p.electorate, [vote.trainer for vote in model.votes(p)])
        for p in model.proposals
    ]
    opened = [p for p in proposals.values() if p.closed_at is None]
    assert len({p.slot for p in opened}) == len(opened)
    assert len({p.observation_id for p in opened}) <= 1
    executions = (await store.executions(model.id, limit=500)).items[::-1]
    assert [(e.id, e.proposal_id, e.outcome) for e in executions] == [
        (e.id, e.proposal.id, e.outcome) for e in sorted(model.executions, key=lambda e: e.id)
    ]
    assert len({e.proposal_id for e in executions}) == len(executions)
    assert sum(e.outcome is None for e in executions) <= 1
    for execution in executions:
        proposal = proposals[execution.proposal_id]
        assert proposal.verdict == "good"
        assert proposal.rule in ("first", "majority", "unanimous")
        assert (proposal.skill, proposal.parameters) == (execution.skill, execution.parameters)


async def _states_and_counters_are_those_of_the_rows(store: Store, model: Experiment) -> None:
    stored = await store.experiment(model.id)
    assert (stored.lifecycle, stored.halted) == (model.lifecycle, model.halted)
    # not while others are still asked: the counters must not tell what somebody has said
    counted = [c.label for c in model.clicks if c.counted and not c.proposal.open]
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
