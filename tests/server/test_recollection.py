"""A learner that starts anew with many labels stored: it proposes before it has them all, and misses none."""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import AsyncIterator, Coroutine
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from server.messages import ExperimentChanged, ProposalOpened
from server.schemas import Experiment, Feedback, Proposal
from server.schemas_labels import RelabelCreate
from server.store import Store
from server.store_values import StoredLabel
from server.worker import Worker
from tests.server.stage import PATIENCE, SMALL, Stage, stage

CANDID: dict[str, Any] = {"algorithm": "candid", "settings": {"bad_first": 1_000_000}, "mode": "propose_only"}
GIVEN = 7


@pytest.fixture(autouse=True)
def _few_are_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a million labels come: the newest two at first, then one by one."""
    for name, value in (("FIRST", 2), ("LABELS_AT_ONCE", 2), ("MEANWHILE", 1)):
        monkeypatch.setattr(f"server.recollection.{name}", value)


@pytest.fixture
def old_ones(monkeypatch: pytest.MonkeyPatch) -> asyncio.Event:
    """Set: what is older than the newest may be read. It was read before whatever happens until then."""
    gate, read = asyncio.Event(), Store.labels_before

    async def labels_before(self: Store, experiment_id: int, before_id: int | None, limit: int) -> list[StoredLabel]:
        found = await read(self, experiment_id, before_id, limit)
        if before_id is not None:
            await gate.wait()
        return found

    monkeypatch.setattr(Store, "labels_before", labels_before)
    return gate


@asynccontextmanager
async def with_a_new_learner(
    tmp_path: Path, **fields: Any
) -> AsyncIterator[tuple[Stage, Experiment, list[Feedback], Proposal]]:
    """An experiment whose learner was killed; what was judged before, and what the new one proposes first."""
    async with stage(tmp_path) as s:
        experiment = await s.experiment(**(CANDID | fields))
        await s.hub.act(experiment.id, "start")
        given = [await s.judge(await s.proposal(number=number), -1) for number in range(1, GIVEN + 1)]
        proposal = await s.proposal(number=GIVEN + 1)
        at = s.now
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        await s.worker("restarted", at)
        at = s.now
        await s.judge(proposal, 0)
        yield s, experiment, given, (await s.seen.next(ProposalOpened, at)).proposal


async def held_by(s: Stage, proposal: Proposal) -> dict[int, float]:
    """What the learner holds by now, while this one is open."""
    for _ in range(2):  # the one drawn ahead may be of before
        at = s.now
        await s.hub.feedback(proposal.id, s.click(0, f"meanwhile-{proposal.id}"))
        proposal = (await s.seen.next(ProposalOpened, at)).proposal
    return held(proposal)


def held(proposal: Proposal) -> dict[int, float]:
    """What the learner held when it proposed this."""
    return {int(number): value for number, value in proposal.skill_probabilities.items()}


async def test_it_proposes_with_the_newest_and_gets_the_rest_meanwhile(
    tmp_path: Path, plugins: None, old_ones: asyncio.Event
) -> None:
    async with with_a_new_learner(tmp_path) as (s, experiment, given, first):
        ids = [each.id for each in given]
        assert set(ids) & held(first).keys() == set(ids[-2:])
        view = await s.hub.view(experiment.id)
        assert view.catching_up is not None
        assert (view.catching_up.taken, view.catching_up.of) == (2, GIVEN)
        for at, value in ((0, 1), (1, "cant_tell")):  # read already, and not yet with the learner
            body = RelabelCreate(click_id=f"correction-{at}", value=value, trainer="local")
            await s.hub.relabel(given[at].id, body)
        at = s.now
        old_ones.set()
        await s.seen.next(ExperimentChanged, at, where=lambda e: e.experiment.catching_up is None)
        told = [e.experiment.catching_up.taken for e in s.seen.of(ExperimentChanged) if e.experiment.catching_up]
        assert told == sorted(told)
        expected = {ids[0]: 1.0} | dict.fromkeys(ids[2:], -1.0)
        assert {number: value for number, value in (await held_by(s, first)).items() if number <= ids[-1]} == expected


async def test_a_run_that_must_be_repeatable_waits_for_all(tmp_path: Path, plugins: None) -> None:
    async with with_a_new_learner(tmp_path, lockstep=True) as (s, experiment, given, first):
        assert {each.id for each in given} <= held(first).keys()
        assert (await s.hub.view(experiment.id)).catching_up is None


async def test_the_service_can_end_in_the_middle_of_it(tmp_path: Path, plugins: None, old_ones: asyncio.Event) -> None:
    async with with_a_new_learner(tmp_path) as (s, experiment, given, _):
        assert (await s.hub.view(experiment.id)).catching_up is not None
    old_ones.set()
    async with stage(tmp_path) as s:
        await s.hub.act(experiment.id, "resume")
        first = await s.proposal()
        begun = await s.seen.next(ExperimentChanged, where=lambda e: e.experiment.catching_up is not None)
        await s.seen.next(ExperimentChanged, s.seen.events.index(begun), where=lambda e: not e.experiment.catching_up)
        assert {each.id for each in given} <= (await held_by(s, first)).keys()


async def test_what_is_corrected_again_while_a_new_one_starts_is_held_as_it_was_corrected_last(
    tmp_path: Path, plugins: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    reading, gate, read = asyncio.Event(), asyncio.Event(), Store.labels

    async def labels(self: Store, experiment_id: int, *where: int) -> list[StoredLabel]:
        found = await read(self, experiment_id, *where)
        reading.set()
        await gate.wait()
        return found

    async with stage(tmp_path) as s:
        experiment = await s.experiment(**CANDID, lockstep=True)
        await s.hub.act(experiment.id, "start")
        given = [await s.judge(await s.proposal(number=number), -1) for number in (1, 2, 3)]
        await s.proposal(number=4)
        monkeypatch.setattr(Store, "labels", labels)
        at = s.now
        os.kill(s.hub.worker_pids(experiment.id)["learner"], signal.SIGKILL)
        async with asyncio.timeout(PATIENCE):
            await reading.wait()
        for which, value in ((0, 1), (0, "cant_tell"), (1, "cant_tell"), (1, 1), (2, 1)):
            body = RelabelCreate(click_id=f"correction-{which}-{value}", value=value, trainer="local")
            await s.hub.relabel(given[which].id, body)
        await s.hub.undo(given[2].id)
        gate.set()
        await s.worker("restarted", at)
        [open_again] = [each for each in (await s.store.proposals(experiment.id)).items if each.closed_at is None]
        now_held = await held_by(s, open_again)
        assert {number: value for number, value in now_held.items() if number <= given[-1].id} == {given[1].id: 1.0}


async def test_a_learner_that_owes_many_steps_is_not_taken_for_hung(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    patient, call = asyncio.Event(), Worker.call

    def noted(self: Worker, command: str, *, deadline: float, **arguments: Any) -> Coroutine[Any, Any, dict[str, Any]]:
        if command == "flush" and deadline > PATIENCE + 100:
            patient.set()
        return call(self, command, deadline=deadline, **arguments)

    monkeypatch.setattr(Worker, "call", noted)
    async with stage(tmp_path) as s:
        experiment = await s.experiment(settings=SMALL | {"gradient_steps": 200, "train_frequency": 2})
        await s.hub.act(experiment.id, "start")
        for number in (1, 2):
            await s.judge(await s.proposal(number=number), -1)
        await s.proposal(number=3)
        async with asyncio.timeout(PATIENCE):
            await patient.wait()
