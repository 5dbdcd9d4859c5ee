"""The learner holds exactly the labels that the store says train, whatever is clicked, taken back or broken off."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from typing import Any

from server.messages import ProposalClosed, WorkerChanged
from server.schemas import ExperimentUpdate, Feedback, FeedbackCreate, Proposal
from server.schemas_labels import RelabelCreate
from tests.server.stage import Stage, stage

CANDID: dict[str, Any] = {"algorithm": "candid", "settings": {"bad_first": 1_000_000}, "mode": "propose_only"}


async def say(s: Stage, trainer: str, proposal: Proposal, value: int) -> Feedback:
    body = FeedbackCreate(click_id=f"{trainer}-click-{proposal.id}-{s.now}", value=value, trainer=trainer)
    return (await s.hub.feedback(proposal.id, body))[0]


async def held(s: Stage, experiment_id: int, proposal: Proposal) -> dict[int, int]:
    """What the living learner holds, feedback id -> value; it is what the store would give to a new one."""
    runner = s.hub.at_work(experiment_id)
    assert runner is not None
    learner = await s.seen.until(lambda: runner.crew.knowing)
    told = await learner.call("propose", deadline=60, state=proposal.state, deterministic=True)
    holds = {int(feedback): int(value) for feedback, value in told["skill_probabilities"].items()}
    assert holds == {label.feedback_id: label.value for label in await s.store.labels(experiment_id)}
    return holds


async def test_the_others_labels_go_with_the_one_that_is_taken_back_and_come_again_with_a_verdict(
    tmp_path: Path, plugins: None
) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment(**CANDID, aggregation="majority")
        for name in ("ann", "bob"):
            s.hub.seats.of(experiment.id).arrive(name)
        await s.hub.act(experiment.id, "start")
        proposal = await s.proposal()
        anns, bobs = [await say(s, name, proposal, -1) for name in ("ann", "bob")]
        assert await held(s, experiment.id, proposal) == {anns.id: -1, bobs.id: -1}
        await s.hub.undo(bobs.id, by="bob")
        assert await held(s, experiment.id, proposal) == {}

        # as it was, once there is a verdict again; also where a label has been corrected meanwhile
        bobs = await say(s, "bob", proposal, -1)
        assert await held(s, experiment.id, proposal) == {anns.id: -1, bobs.id: -1}
        correction = RelabelCreate(click_id="correction-1", value=0, trainer="ann")
        await s.hub.relabel(anns.id, correction, anybodys=False)
        await s.hub.undo(bobs.id, by="bob")
        assert await held(s, experiment.id, proposal) == {}
        bobs = await say(s, "bob", proposal, -1)
        assert await held(s, experiment.id, proposal) == {anns.id: 0, bobs.id: -1}

        # no verdict any more: its time is over, or somebody pauses
        await s.hub.undo(bobs.id, by="bob")
        at = s.now
        await s.hub.update(experiment.id, ExperimentUpdate(feedback_timeout=1))
        await s.seen.next(ProposalClosed, at, where=lambda e: e.proposal.close_reason == "timed_out")
        await s.hub.update(experiment.id, ExperimentUpdate(feedback_timeout=None))
        assert await held(s, experiment.id, proposal) == {}
        following = (await s.seen.until(s.hub.seats.of(experiment.id).opened))[0]
        given = [await say(s, name, following, -1) for name in ("ann", "bob")]
        await s.hub.undo(given[1].id, by="bob")
        await s.hub.act(experiment.id, "pause")
        await s.hub.idle(experiment.id)
        assert await held(s, experiment.id, proposal) == {}

        # a learner that dies between the undo and the new verdict
        at = s.now
        await s.hub.act(experiment.id, "resume")
        last = await s.proposal(at)
        given = [await say(s, name, last, -1) for name in ("ann", "bob")]
        await s.hub.undo(given[1].id, by="bob")
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        await s.seen.next(WorkerChanged, at, where=lambda e: e.status == "restarted")
        assert await held(s, experiment.id, last) == {}
        again = await say(s, "bob", last, -1)
        assert await held(s, experiment.id, last) == {given[0].id: -1, again.id: -1}
