"""Experiments, proposals, executions and what is kept beside them, on SQLite and PostgreSQL."""

from __future__ import annotations

from typing import Any

import pytest

from robot_adapters.base import SafetyViolation, SkillCall
from server.schemas import CloseReason, ExecutionOutcome, ExperimentUpdate, Lifecycle, Mode, Phase, Verdict
from server.store import BadCursor, Conflict, NotFound, Store, StoredLabel
from tests.server.databases import begun, click, created, new, opened, running


async def test_an_experiment_is_kept_as_it_was_asked_for(store: Store) -> None:
    made = await created(
        store,
        settings={"alpha": 0.1, "nested": {"b": [1, 2]}},
        adapter_settings={"noise": 0.0},
        seed=7,
        teacher="synthetic",
    )
    assert made.lifecycle is Lifecycle.CREATED
    assert made.phase is Phase.IDLE
    assert made.settings == {"alpha": 0.1, "nested": {"b": [1, 2]}}
    assert (made.seed, made.teacher, made.lockstep, made.halted) == (7, "synthetic", False, False)
    assert set(made.counters.model_dump().values()) == {0}
    assert made.created_at.utcoffset() is not None
    assert await store.experiment(made.id) == made


async def test_only_what_a_change_names_is_changed(store: Store) -> None:
    made = await created(store, feedback_timeout=5.0)
    changed = await store.update_experiment(made.id, ExperimentUpdate(mode=Mode.PROPOSE_ONLY))
    assert (changed.mode, changed.name, changed.feedback_timeout) == (Mode.PROPOSE_ONLY, made.name, 5.0)
    changed = await store.update_experiment(made.id, ExperimentUpdate.model_validate({"feedback_timeout": None}))
    assert (changed.mode, changed.feedback_timeout) == (Mode.PROPOSE_ONLY, None)
    same = await store.update_experiment(made.id, ExperimentUpdate.model_validate({"name": None, "mode": None}))
    assert (same.mode, same.name) == (changed.mode, made.name)


async def test_lifecycle_verbs_are_stored_and_journalled(store: Store) -> None:
    experiment_id = await running(store)
    assert (await store.transition(experiment_id, "pause")).lifecycle is Lifecycle.PAUSED
    with pytest.raises(Conflict) as caught:
        await store.transition(experiment_id, "start")
    assert caught.value.current == "paused"
    assert "resume" in caught.value.allowed
    await store.transition(experiment_id, "resume")
    failed = await store.transition(experiment_id, "fail", failure="the robot worker died; look at its log")
    assert failed.failure == "the robot worker died; look at its log"
    assert (await store.transition(experiment_id, "resume")).failure is None
    kinds = [event.kind for event in (await store.events(experiment_id)).items]
    assert kinds == ["created", "start", "episode_started", "pause", "resume", "fail", "resume"]


async def test_a_halt_is_latched_until_it_is_rearmed(store: Store) -> None:
    experiment_id = await running(store)
    assert (await store.halt(experiment_id)).halted
    assert (await store.halt(experiment_id)).halted  # a stop is never refused
    with pytest.raises(Conflict, match="halted"):
        await opened(store, experiment_id)
    assert (await store.experiment(experiment_id)).lifecycle is Lifecycle.PAUSED
    with pytest.raises(Conflict, match="halted") as caught:
        await store.transition(experiment_id, "resume")
    assert "rearm" in caught.value.allowed
    assert not (await store.rearm(experiment_id)).halted
    with pytest.raises(Conflict):
        await store.rearm(experiment_id)
    assert (await store.transition(experiment_id, "resume")).lifecycle is Lifecycle.RUNNING


async def test_a_proposal_is_kept_with_the_pictures_it_was_drawn_on(store: Store) -> None:
    experiment_id = await running(store)
    asked = new(experiment_id)
    proposal = await store.open_proposal(asked)
    assert (proposal.episode, proposal.number, proposal.observation_id) == (1, 1, "o1")
    assert proposal.parameters == {"x": 0.5, "y": 0.1, "z": -0.1}
    assert proposal.digest == SkillCall(proposal.skill, tuple(proposal.parameters.values())).digest
    assert [(v.camera, v.image, v.overlay) for v in proposal.views] == [
        (v.camera, v.image, v.overlay) for v in asked.views
    ]
    assert proposal.views[0].url == f"/api/v1/proposals/{proposal.id}/images/left"
    assert await store.open_proposals(experiment_id) == [await store.proposal(proposal.id)] == [proposal]


async def test_parameters_of_any_float_keep_their_digest(store: Store) -> None:
    experiment_id = await running(store)
    call = SkillCall("pick", (0.1 + 0.2, 1e-17, -1 / 3))
    proposal = await opened(store, experiment_id, call=call)
    stored = await store.proposal(proposal.id)
    assert SkillCall(stored.skill, tuple(stored.parameters.values())) == call
    assert stored.digest == call.digest


async def test_one_proposal_at_a_time_and_only_while_running(store: Store) -> None:
    made = await created(store)
    with pytest.raises(Conflict) as caught:
        await opened(store, made.id)
    assert (caught.value.current, "start" in caught.value.allowed) == ("created", True)
    await store.transition(made.id, "start")
    with pytest.raises(Conflict, match="episode"):
        await opened(store, made.id)
    await store.begin_episode(made.id, 1)
    first = await opened(store, made.id)
    with pytest.raises(Conflict, match=f"proposal {first.id} is open"):
        await opened(store, made.id)
    closed = await store.close_proposal(first.id, CloseReason.TIMED_OUT)
    assert (closed.close_reason, closed.verdict) == (CloseReason.TIMED_OUT, None)
    assert await store.close_proposal(first.id, CloseReason.WITHDRAWN) == closed
    assert (await opened(store, made.id)).number == 2


async def test_one_observation_has_one_state(store: Store) -> None:
    experiment_id = await running(store)
    await store.close_proposal((await opened(store, experiment_id)).id, CloseReason.TIMED_OUT)
    with pytest.raises(Conflict, match="another state"):
        await opened(store, experiment_id, state=(9.0, 9.0, 9.0))
    other = await running(store)
    assert (await opened(store, other, state=(9.0, 9.0, 9.0))).state == [9.0, 9.0, 9.0]  # ids are an experiment's own


@pytest.mark.parametrize(
    ("verb", "reason"),
    [("pause", "withdrawn"), ("finish", "withdrawn"), ("reset", "withdrawn"), ("fail", "interrupted")],
)
async def test_leaving_closes_the_open_proposal(store: Store, verb: str, reason: str) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    await store.transition(experiment_id, verb)  # type: ignore[arg-type]
    assert (await store.proposal(proposal.id)).close_reason == reason
    assert await store.open_proposals(experiment_id) == []
    with pytest.raises(Conflict):
        await store.undo_feedback((await store.submit_feedback(proposal.id, click())).feedback.id)


async def test_an_approved_call_runs_once(store: Store) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    await store.submit_feedback(proposal.id, click(1))
    decision, execution = await begun(store, proposal.id)
    assert decision.allowed
    assert (execution.skill, execution.parameters) == (proposal.skill, proposal.parameters)
    assert await store.running_executions(experiment_id) == [execution]
    again, none = await begun(store, proposal.id)
    assert (again.allowed, none) == (False, None)
    with pytest.raises(Conflict, match="still moves"):
        await opened(store, experiment_id, "o2")
    ended = await store.end_execution(
        execution.id,
        ExecutionOutcome.FAILED,
        end_reason="timeout",
        low_level_steps=40,
        task_success=False,
        violations=[SafetyViolation("manual_reset", "a block fell")],
    )
    assert (ended.outcome, ended.end_reason, ended.low_level_steps) == (ExecutionOutcome.FAILED, "timeout", 40)
    with pytest.raises(Conflict, match="has ended"):
        await store.end_execution(
            execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=1, task_success=True
        )
    assert await store.execution(execution.id) == ended
    assert (await store.proposal(proposal.id)).gate == decision
    counters = (await store.experiment(experiment_id)).counters
    assert (counters.executions, counters.low_level_steps, counters.violations) == (1, 40, 1)
    assert (await begun(store, proposal.id))[1] is None  # nor is it run again once it has ended


@pytest.mark.parametrize(
    ("value", "ask", "reason"),
    [
        (-1, {}, "the verdict is bad"),
        (0, {}, "the verdict is neutral"),
        (1, {"workspace_ok": False}, "outside the workspace"),
        (1, {"current_observation_id": "o2"}, "changed since"),
        (1, {"simulated": False}, "operator"),
    ],
)
async def test_a_shut_gate_starts_nothing_and_stays_shut(
    store: Store, value: int, ask: dict[str, Any], reason: str
) -> None:
    experiment_id = await running(store)
    proposal = await opened(store, experiment_id)
    await store.submit_feedback(proposal.id, click(value))
    decision, execution = await begun(store, proposal.id, **ask)
    assert (decision.allowed, execution) == (False, None)
    assert reason in decision.reason
    assert (await store.proposal(proposal.id)).gate == decision
    assert await begun(store, proposal.id) == (decision, None)  # an old approval never fires later
    assert (await store.executions(experiment_id)).items == []


async def test_the_gate_reads_the_stored_state_anew(store: Store) -> None:
    experiment_id = await running(store)
    reasons = []
    for number, act in enumerate(("halt", "mode", "pause")):
        proposal = await opened(store, experiment_id, f"o{number}")
        await store.submit_feedback(proposal.id, click(1))
        if act == "halt":
            await store.halt(experiment_id)
        elif act == "mode":
            await store.update_experiment(experiment_id, ExperimentUpdate(mode=Mode.PROPOSE_ONLY))
        else:
            await store.transition(experiment_id, "pause")
        decision, execution = await begun(store, proposal.id, f"o{number}")
        assert execution is None
        reasons.append(decision.reason)
        if act == "halt":
            await store.rearm(experiment_id)
            await store.transition(experiment_id, "resume")
        await store.update_experiment(experiment_id, ExperimentUpdate(mode=Mode.EXECUTE_APPROVED))
    assert reasons == ["the emergency stop is latched", "the mode is propose only", "the experiment is paused"]


async def test_an_evaluation_goes_through_the_gate_and_trains_nothing(store: Store) -> None:
    made = await created(store)
    evaluation = await store.create_evaluation(made.id, rollouts=2, seed=5, policy_version=0)
    assert await store.begin_episode(made.id, 5, purpose="evaluation") == 1
    proposal = await opened(store, made.id, purpose="evaluation")
    with pytest.raises(Conflict, match="evaluation"):
        await store.submit_feedback(proposal.id, click(1))
    assert (await store.record_evaluation_approval(proposal.id)).verdict is Verdict.GOOD
    with pytest.raises(Conflict):
        await store.record_evaluation_approval(proposal.id)
    decision, execution = await begun(store, proposal.id)
    assert decision.allowed
    await store.end_execution(
        execution.id, ExecutionOutcome.SUCCEEDED, end_reason="arrived", low_level_steps=9, task_success=True
    )
    await store.end_episode(made.id, "success")
    half = await store.update_evaluation(evaluation.id, done=1, successes=1, low_level_steps=9)
    assert (half.success_rate, half.policy_version, half.ended_at) == (1.0, 7, None)
    ended = await store.update_evaluation(evaluation.id, done=2, successes=1, low_level_steps=20, ended=True)
    assert (ended.success_rate, ended.rollouts, ended.ended_at is not None) == (0.5, 2, True)
    with pytest.raises(Conflict):
        await store.update_evaluation(evaluation.id, done=2, successes=2, low_level_steps=20)
    assert await store.labels(made.id) == []
    assert await store.undoable(made.id) is None
    assert set((await store.experiment(made.id)).counters.model_dump().values()) == {0}
    assert [t.kind for t in (await store.trainers()).items] == ["evaluation"]


async def test_an_evaluation_never_moves_a_real_robot_nor_beside_training(store: Store) -> None:
    made = await created(store)
    proposal = await opened(store, made.id, purpose="evaluation")
    await store.record_evaluation_approval(proposal.id)
    decision, execution = await begun(store, proposal.id, simulated=False, operator_present=True)
    assert (decision.reason, execution) == ("evaluations move simulated robots only", None)
    with pytest.raises(Conflict):
        await opened(store, await running(store), purpose="evaluation")


async def test_episodes_are_numbered_and_their_successes_counted(store: Store) -> None:
    experiment_id = await running(store)
    await store.end_episode(experiment_id, "success")
    await store.end_episode(experiment_id, "success")  # there is none to end
    assert await store.begin_episode(experiment_id, 2) == 2
    assert await store.begin_episode(experiment_id, 3) == 3
    counters = (await store.experiment(experiment_id)).counters
    assert (counters.episodes, counters.successes) == (3, 1)
    outcomes = [e.payload["outcome"] for e in (await store.events(experiment_id)).items if e.kind == "episode_ended"]
    assert outcomes == ["success", "reset"]


async def test_labels_are_the_counted_clicks_in_order(store: Store) -> None:
    experiment_id = await running(store)
    values = [1, -1, 0, -1]
    for number, value in enumerate(values):
        proposal = await opened(store, experiment_id, f"o{number}", x=0.5 + number / 100)
        await store.submit_feedback(proposal.id, click(value))
        await store.submit_feedback(proposal.id, click(1))  # late
    labels = await store.labels(experiment_id)
    assert [label.value for label in labels] == values
    ids = (labels[1].feedback_id, labels[1].trainer)
    assert labels[1] == StoredLabel(ids[0], (0.1, 0.2, 0.3), "pick", (0.51, 0.1, -0.1), -1, ids[1])
    assert await store.labels(experiment_id, labels[1].feedback_id) == labels[2:]


async def test_a_time_out_trains_nothing(store: Store) -> None:
    experiment_id = await running(store, aggregation="majority")
    proposal = await opened(store, experiment_id, electorate=("ann", "bob", "cyd"))
    assert (await store.submit_feedback(proposal.id, click(1, trainer="ann"))).closed is None
    await store.close_proposal(proposal.id, CloseReason.TIMED_OUT)
    assert await store.labels(experiment_id) == []
    assert (await begun(store, proposal.id))[0].reason == "no verdict"


async def test_recovery_settles_what_was_left_behind(store: Store) -> None:
    moving, waiting, idle, halted = [await running(store) for _ in range(4)]
    await store.transition(idle, "pause")
    await store.halt(halted)
    approved = await opened(store, moving)
    await store.submit_feedback(approved.id, click(1))
    execution = (await begun(store, approved.id))[1]
    unjudged = await opened(store, waiting)
    evaluated = await created(store)
    evaluation = await store.create_evaluation(evaluated.id, rollouts=10, seed=0, policy_version=0)
    await store.update_evaluation(evaluation.id, done=3, successes=2, low_level_steps=30)

    assert await store.recover() == [moving, waiting, idle, halted, evaluated.id]

    for experiment_id in (moving, waiting, idle, halted):
        assert (await store.experiment(experiment_id)).lifecycle is Lifecycle.PAUSED
    assert (await store.experiment(halted)).halted
    assert (await store.execution(execution.id)).outcome is ExecutionOutcome.INTERRUPTED
    assert await store.running_executions(moving) == []
    assert (await store.proposal(unjudged.id)).close_reason is CloseReason.INTERRUPTED
    assert (await store.evaluation(evaluation.id)).rollouts == 3
    assert (await begun(store, approved.id))[1] is None
    assert (await store.labels(moving))[0].value == 1  # the click itself is kept
    assert await store.recover() == []


async def test_metrics_leave_out_what_cannot_be_drawn(store: Store) -> None:
    experiment_id = await running(store)
    await store.add_metrics(experiment_id, [(1, {"loss": 0.5, "ratio": float("nan"), "peak": float("inf")})])
    await store.add_metrics(experiment_id, [(2, {"loss": 0.25})])
    points = (await store.metrics(experiment_id)).items
    assert [(p.feedback, p.values["loss"]) for p in points] == [(1, 0.5), (2, 0.25)]
    assert not {"ratio", "peak"} & set(points[0].values)


async def test_the_newest_checkpoint_is_found(store: Store) -> None:
    experiment_id = await running(store)
    assert await store.latest_checkpoint(experiment_id) is None
    await store.add_checkpoint(experiment_id, policy_version=10, last_feedback_id=5, sha256="a" * 64)
    newest = await store.add_checkpoint(experiment_id, policy_version=20, last_feedback_id=9, sha256="b" * 64)
    assert await store.latest_checkpoint(experiment_id) == newest
    assert [c.policy_version for c in (await store.checkpoints(experiment_id)).items] == [20, 10]


async def test_a_retried_write_gets_its_first_answer(store: Store) -> None:
    assert await store.idempotent("key-12345", "POST /x", "a" * 64) is None
    await store.remember("key-12345", "POST /x", "a" * 64, 201, {"id": 1})
    await store.remember("key-12345", "POST /x", "a" * 64, 201, {"id": 2})
    stored = await store.idempotent("key-12345", "POST /x", "a" * 64)
    assert stored is not None
    assert (stored.status, stored.body) == (201, {"id": 1})
    assert await store.idempotent("key-12345", "POST /y", "a" * 64) is None
    with pytest.raises(Conflict, match="another body"):
        await store.idempotent("key-12345", "POST /x", "b" * 64)


async def test_pages_walk_over_everything_once(store: Store) -> None:
    made = [(await created(store, name=f"number {n}")).id for n in range(7)]
    seen, cursor = [], None
    while True:
        page = await store.experiments(cursor, limit=3)
        seen += [e.id for e in page.items]
        await created(store, name="meanwhile")
        cursor = page.next_cursor
        if cursor is None:
            break
    assert seen == made[::-1]
    oldest_first = [e.kind for e in (await store.events(made[0], limit=1)).items]
    assert oldest_first == ["created"]


async def test_a_cursor_that_no_page_gave_is_refused(store: Store) -> None:
    for cursor in ("x", "!!", "", "aWQ6", "aWQ6LTE", "b3RoZXI6MQ", "aWQ6MQ==\n", "ä", "aWQ6" + "OTk5" * 20):
        with pytest.raises(BadCursor) as caught:
            await store.experiments(cursor)
        assert caught.value.remedy


async def test_a_limit_out_of_bounds_is_the_nearest_one(store: Store) -> None:
    for _ in range(3):
        await created(store)
    for limit, rows in ((0, 1), (-5, 1), (10_000, 3)):
        assert len((await store.experiments(limit=limit)).items) == rows


async def test_what_is_not_there_is_said(store: Store) -> None:
    asked = [
        store.experiment(99),
        store.proposal(99),
        store.feedback(99),
        store.execution(99),
        store.evaluation(99),
        store.transition(99, "start"),
        store.halt(99),
        store.submit_feedback(99, click()),
        store.undo_feedback(99),
        store.begin_episode(99, 1),
        store.proposals(99),
        store.executions(99),
        store.metrics(99),
        store.events(99),
        store.add_event(99, "kind", {}),
        store.feedback_of_proposal(99),
        store.feedback_of_experiment(99),
        store.checkpoints(99),
        store.evaluations(99),
        begun(store, 99),
    ]
    for question in asked:
        with pytest.raises(NotFound) as caught:
            await question
        assert caught.value.remedy
    assert await store.open_proposals(99) == []
