"""Teaching a learner by a task's own judge, in process: what the studies of claims share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from agent.algorithm import Algorithm, Label, Problem
from agent.config import SEED, SeedSettings
from agent.study.episodes import FIRST_START, Done, SkillEpisodes
from agent.study.scenes import across_the_table
from robot_adapters.base import Adapter, Array, SkillCall
from robot_adapters.tasks.base import Task, position_fields, state_bounds

Stage = Callable[[Task], Adapter]
"""Builds a robot that stages a task. Studies are handed it: which robot it is, they don't know."""
Policy = Callable[[Array], SkillCall]
Heard = Callable[[Iterable[str], Done | None], None]
"""Told of every label, or demonstrated step: for which contestants it counts, and what was executed upon it."""


@dataclass(frozen=True)
class Lesson:
    """One label: what was proposed in state (n,), and what the task's judge said of it."""

    number: int
    state: Array
    call: SkillCall
    value: int
    done: Done | None
    """What came of it where it was executed."""


def whole(task: Task, settings: SeedSettings, seed: int) -> Algorithm:
    """A learner of the whole task."""
    return SEED(whole_problem(task), settings, seed)


def whole_problem(task: Task) -> Problem:
    """What a learner of the whole task is told; positions are bounded by the table, not by its scene."""
    low, high = state_bounds(task.state_fields)
    fields = position_fields(task.state_fields)
    skills = across_the_table(*task.skills)
    return Problem(task.name, low, high, skills, keypoints=task.keypoints, position_fields=fields)


def lessons(learner: Algorithm, task: Task, stage: Stage, *, seed: int, feedback: int) -> Iterator[Lesson]:
    """Algorithm 1 of the paper, judged by the task's own rule, `feedback` labels long, each learned when it comes."""
    robot = SkillEpisodes(task, stage(task), first_subgoal=False)
    try:
        starts = np.random.default_rng(seed)
        robot.begin(int(starts.integers(FIRST_START)))
        for number in range(1, feedback + 1):
            state = robot.state
            call = kept(task, learner.propose(state).call)
            value = task.judge(state, call)
            learn(learner, [Label(number, state, call, value)])
            done = robot.execute(call) if value == 1 else None
            if done is not None and done.over:
                robot.begin(int(starts.integers(FIRST_START)))
            yield Lesson(number, state, call, value, done)
    finally:
        robot.close()


def learn(learner: Algorithm, labels: Sequence[Label]) -> None:
    """Take labels, and every gradient step that they owe."""
    learner.add(labels)
    while learner.owed_updates:
        learner.update()


def success(episodes: SkillEpisodes, policy: Policy, rollouts: int, *, least: float = 0.0) -> float:
    """Share of deterministic rollouts from fixed starts that succeed; 0 as soon as `least` can't be reached."""
    good = 0
    for start in range(rollouts):
        good += episodes.rollout(FIRST_START + start, policy)
        if good + rollouts - start - 1 < least * rollouts - 1e-9:
            return 0.0
    return good / rollouts


def deterministic(learner: Algorithm, task: Task) -> Policy:
    """What the learner would do, drawing nothing."""
    return lambda state: kept(task, learner.propose(state, deterministic=True).call)


def kept(task: Task, call: SkillCall) -> SkillCall:
    """The call with its parameters kept inside this task's bounds: learners here know only those of the table."""
    spec = next(s for s in task.skills if s.name == call.skill)
    return SkillCall(call.skill, tuple(np.clip(call.parameters, spec.low, spec.high).tolist()))


def unheard(names: Iterable[str], done: Done | None) -> None:
    """Nobody listens."""


def mean(values: Sequence[float]) -> str:
    """Mean ± standard error."""
    sem = np.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else 0.0
    return f"{np.mean(values):.0f} ± {sem:.0f}"
