"""Evaluation: rollouts of the deterministic policy on the experiment's own simulator (paper, 'Evaluation metrics').

Every skill is a stored proposal of the purpose `evaluation`, approved by the evaluation itself, and goes through the
gate and the robot worker's checks like any other. Nothing is learned from it.
"""

from __future__ import annotations

import asyncio

from server.acting import Publish
from server.crew import Crew
from server.crew_values import Seen
from server.messages import EvaluationChanged
from server.schemas import Evaluation
from server.station import Station
from server.store import Store
from server.store_values import EpisodeOutcome


async def roll_out(
    evaluation: Evaluation, station: Station, crew: Crew, store: Store, *, leave: asyncio.Event, publish: Publish
) -> None:
    """Run all rollouts on this robot, or those until `leave`; what was done is stored after each.

    Raises:
        WorkerDied: a worker went away; the evaluation is stored as what it did until then.
    """
    experiment_id = evaluation.experiment_id
    successes = steps = done = 0
    try:
        await crew.bring_up([station.robot])
        await crew.flush()  # one policy for all rollouts
        while done < evaluation.rollouts and not leave.is_set():
            seed = evaluation.seed + done
            await store.begin_episode(experiment_id, seed, "evaluation", robot=station.robot.index)
            outcome: EpisodeOutcome = "interrupted"
            try:
                outcome, taken = await _one(await station.robot.reset(seed), station, store, leave)
            finally:
                await store.end_episode(experiment_id, outcome, robot=station.robot.index)
            steps += taken
            if outcome == "interrupted":
                return
            done += 1
            successes += outcome == "success"
            current = await store.update_evaluation(
                evaluation.id, done=done, successes=successes, low_level_steps=steps
            )
            publish(EvaluationChanged(evaluation=current, done=done))
    finally:
        ended = await store.update_evaluation(
            evaluation.id, done=done, successes=successes, low_level_steps=steps, ended=True
        )
        publish(EvaluationChanged(evaluation=ended, done=done))


async def _one(seen: Seen, station: Station, store: Store, leave: asyncio.Event) -> tuple[EpisodeOutcome, int]:
    """One rollout from a fresh start: how it ended, and its low-level steps."""
    acting, steps = station.acting, 0
    for _ in range(acting.task.horizon):
        if leave.is_set():
            return "interrupted", steps
        drawn = await acting.draw(seen, purpose="evaluation", deterministic=True)
        proposal = await store.open_proposal(drawn)
        approved = await store.record_evaluation_approval(proposal.id)
        execution = await acting.decide(approved, seen)
        if execution is None:
            return "interrupted", steps
        done = await acting.move(approved, execution)
        if done.stopped:
            return "interrupted", steps
        steps += done.low_level_steps
        violated = {kind for kind, _ in done.violations}
        if "damage" in violated:
            return "violation", steps
        if done.task_success:
            return "success", steps
        if violated:
            return "violation", steps
        seen = await station.robot.observe()
    return "horizon", steps
