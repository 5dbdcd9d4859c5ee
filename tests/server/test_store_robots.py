"""Each robot of an experiment has what an experiment with one robot has, on SQLite and PostgreSQL."""

from __future__ import annotations

import pytest

from server.schemas import ExecutionOutcome
from server.store import Conflict, Store
from tests.server.databases import begun, click, opened, running


async def test_each_robot_has_an_episode_an_open_proposal_and_a_motion_of_its_own(store: Store) -> None:
    experiment_id = await running(store, num_envs=2)
    first = await opened(store, experiment_id, "o1", robot=0)
    with pytest.raises(Conflict, match="episode"):
        await opened(store, experiment_id, "o2", robot=1)
    assert await store.begin_episode(experiment_id, 2, robot=1) == 2
    second = await opened(store, experiment_id, "o2", robot=1)
    assert [(p.id, p.robot, p.episode) for p in (first, second)] == [(first.id, 0, 1), (second.id, 1, 2)]
    assert await store.open_proposals(experiment_id) == [first, second]
    for robot, observation in ((0, "o1"), (1, "o2")):
        with pytest.raises(Conflict, match="is open"):
            await opened(store, experiment_id, observation, robot=robot)

    # a bad click on one, a motion of the other: the click can still be taken back
    await store.submit_feedback(first.id, click(1, "click-good"))
    bad = (await store.submit_feedback(second.id, click(-1, "click-bad0"))).feedback
    _, moving = await begun(store, first.id, "o1")
    assert moving is not None
    assert (moving.robot, await store.running_executions(experiment_id)) == (0, [moving])
    assert (await store.undoable(experiment_id)) == bad
    third = await opened(store, experiment_id, "o2", robot=1)
    undone = await store.undo_feedback(bad.id)
    assert undone.withdrawn is not None
    assert (undone.withdrawn.id, undone.reopened.id) == (third.id, second.id)
    await store.submit_feedback(second.id, click(1, "click-good2"))
    _, other = await begun(store, second.id, "o2")
    assert other is not None
    assert await store.running_executions(experiment_id) == [moving, other]
    with pytest.raises(Conflict, match="moves"):
        await opened(store, experiment_id, "o3", robot=1)

    # the end of one robot's episode leaves the other's
    await ended(store, moving.id)
    await store.end_episode(experiment_id, "success", robot=0)
    with pytest.raises(Conflict, match="episode"):
        await opened(store, experiment_id, "o4", robot=0)
    await ended(store, other.id)
    assert (await opened(store, experiment_id, "o5", robot=1)).episode == 2


async def ended(store: Store, execution_id: int) -> None:
    await store.end_execution(
        execution_id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=1, task_success=False
    )
