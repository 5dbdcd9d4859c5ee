"""The desk of one robot where clicks and the critic meet, over a real store; no process runs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from server.messages import FeedbackUndone, ProposalClosed, ProposalOpened
from server.schemas_trust import VerdictSource
from tests.server.databases import new
from tests.server.stage import stage

SURE: dict[str, Any] = {"predicted_feedback": 0.95, "uncertainty": 0.02}


async def test_an_undo_across_the_critics_approval_tells_everyone_that_it_is_closed(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        rule = {"after_feedback": 1, "audit_every": 100}
        experiment = await s.experiment(preset="recommended", auto_approval=rule, seed=1)
        await s.store.transition(experiment.id, "start")
        await s.store.begin_episode(experiment.id, 0)
        desk = (await s.hub._runner(experiment.id)).stations[0].desk
        await desk.present(new(experiment.id, x=0.5))
        (clicked,) = desk.opened
        feedback = await s.judge(clicked, -1)
        await desk.present(new(experiment.id, x=0.51, **SURE))
        await desk.consider(simulated=True)
        refused, approved = desk.judged
        assert refused.id == clicked.id
        assert approved.verdict_source is VerdictSource.CRITIC

        at = s.now
        await s.hub.undo(feedback.id)
        told = [e for e in s.seen.events[at:] if isinstance(e, (FeedbackUndone, ProposalClosed, ProposalOpened))]
        assert [event.type for event in told] == ["feedback_undone", "proposal_closed", "proposal_opened"]
        assert told[1] == ProposalClosed(proposal=approved)
        assert desk.judged == []
        assert [proposal.id for proposal in desk.opened] == [clicked.id]
        # nothing moved by it, so it doesn't count
        assert (await s.hub.view(experiment.id)).counters.auto_approved == 0


async def test_an_undo_of_the_click_that_waits_for_the_gate_only_opens_its_proposal_again(tmp_path: Path) -> None:
    async with stage(tmp_path) as s:
        experiment = await s.experiment()
        await s.store.transition(experiment.id, "start")
        await s.store.begin_episode(experiment.id, 0)
        desk = (await s.hub._runner(experiment.id)).stations[0].desk
        await desk.present(new(experiment.id))
        feedback = await s.judge(desk.opened[0], 1)
        assert len(desk.judged) == 1
        at = s.now
        await s.hub.undo(feedback.id)
        assert not [event for event in s.seen.events[at:] if isinstance(event, ProposalClosed)]
        assert desk.judged == []
        assert len(desk.opened) == 1
