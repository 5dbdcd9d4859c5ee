"""Imitation against evaluation (paper, introduction): cloning demonstrated skill calls, and SEED with as many labels.

The demonstrator is each task's scripted teacher: a good call, drawn anew at every step. It errs in some of them, or has
several ways to go. Both are given the same number: of demonstrated steps, or of labels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from agent.bc import Cloning, Demonstration
from agent.config import SEED, SeedSettings
from agent.study.episodes import FIRST_START, SkillEpisodes
from agent.study.lessons import (
    Heard,
    Policy,
    Stage,
    deterministic,
    kept,
    lessons,
    mean,
    success,
    unheard,
    whole,
    whole_problem,
)
from agent.study.tidying import TidyUp
from robot_adapters.base import SkillCall
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.collecting_toy import CollectingToy
from robot_adapters.tasks.stacking import Stacking
from robot_adapters.tasks.sweeping import Sweeping

CLONES, EVALUATED = ("bc", "bc-keypoints"), "evaluated"
CONTESTANTS: Mapping[str, str] = {
    "bc": "behaviour cloning",
    "bc-keypoints": "behaviour cloning with key points",
    "evaluated": "SEED",
}
STEPS = 40
"""Demonstrated steps, or labels: what SEED needs for the longest of these tasks, and a little more."""
BAD_STEPS = 0.3
"""Share of a suboptimal demonstrator's steps that the task's judge would call bad."""
ATTEMPTS = 1000
"""Random calls tried for one that is bad; nearly every one is."""

PLAIN: Mapping[str, Any] = {"keypoints": "none", "relative_critic": False, "grounded_actor": False}
"""What is left of the recommended networks without key points; augmentation has then no effect either."""


@dataclass(frozen=True)
class Demonstrator:
    """Who shows what. bad: share of bad steps."""

    name: str
    task: Callable[[], Any]
    bad: float = 0.0


DEMONSTRATORS = (
    *(
        Demonstrator(f"{task.title}, {name}", task, bad)
        for task in (Stacking, Sweeping, CollectingToy)
        for name, bad in (("clean", 0.0), ("30 % bad steps", BAD_STEPS))
    ),
    Demonstrator("Two toys, one way", lambda: TidyUp(one_way=True)),
    Demonstrator("Two toys, two orders, two places", TidyUp),
)


@dataclass(frozen=True)
class Outcome:
    """Success rates after `steps` demonstrated steps, or so many labels, with one seed."""

    name: str
    seed: int
    steps: int
    plain: float
    grounded: float
    seed_feedback: float


def demonstrated(who: Demonstrator, stage: Stage, steps: int, seed: int, heard: Heard = unheard) -> list[Demonstration]:
    """So many steps of a demonstrator, carried out one after another; a new episode wherever one is over."""
    task: Task = who.task()
    rng = np.random.default_rng(seed)
    robot = SkillEpisodes(task, stage(task), first_subgoal=False)
    shown = []
    try:
        robot.begin(int(rng.integers(FIRST_START)))
        for _ in range(steps):
            errs = rng.random() < who.bad
            call = kept(task, _bad(task, robot, rng) if errs else task.sample_good(robot.state, rng))
            shown.append(Demonstration(robot.state, call))
            done = robot.execute(call)
            heard(CLONES, done)
            if done.over:
                robot.begin(int(rng.integers(FIRST_START)))
        return shown
    finally:
        robot.close()


def run(stage: Stage, seeds: Sequence[int], *, rollouts: int = 100) -> list[Outcome]:
    """Clone every demonstrator twice, without and with key points, and train SEED with as many labels.

    All have the recommended networks, and as many gradient steps as SEED takes for so many labels.
    """
    return [outcome(who.name, stage, seed, rollouts, unheard) for seed in seeds for who in DEMONSTRATORS]


def rows() -> list[str]:
    """One for each demonstrator."""
    return [who.name for who in DEMONSTRATORS]


def budgets(row: str) -> dict[str, int]:  # noqa: ARG001 - of every row alike
    """Demonstrated steps, or labels."""
    return dict.fromkeys(CONTESTANTS, STEPS)


def outcome(row: str, stage: Stage, seed: int, rollouts: int, heard: Heard) -> Outcome:
    """One demonstrator and one seed."""
    who = next(each for each in DEMONSTRATORS if each.name == row)
    task: Task = who.task()
    shown = demonstrated(who, stage, STEPS, seed, heard)
    recommended = SEED.presets["recommended"]
    policies = [
        cloned(task, shown, SeedSettings(**{**recommended, **changed}), seed) for changed in (PLAIN, dict[str, Any]())
    ]
    learner = whole(task, SeedSettings(**recommended), seed)
    for lesson in lessons(learner, task, stage, seed=seed, feedback=STEPS):
        heard([EVALUATED], lesson.done)
    episodes = SkillEpisodes(task, stage(task), first_subgoal=False)
    try:
        solved = [success(episodes, policy, rollouts) for policy in (*policies, deterministic(learner, task))]
    finally:
        episodes.close()
    return Outcome(who.name, seed, STEPS, *solved)


def rates(of: Outcome) -> dict[str, float]:
    """Of each contestant."""
    return dict(zip(CONTESTANTS, (of.plain, of.grounded, of.seed_feedback), strict=True))


def read(told: Mapping[str, Any]) -> Outcome:
    """From JSON."""
    return Outcome(**told)


def cloned(task: Task, shown: Sequence[Demonstration], settings: SeedSettings, seed: int) -> Policy:
    """The policy that has learned to do as was shown."""
    clone = Cloning(whole_problem(task), settings, seed)
    clone.fit(shown, settings.gradient_steps * len(shown))
    return lambda state: kept(task, clone.propose(state))


def table_of(outcomes: Sequence[Outcome]) -> list[str]:
    """Markdown rows, one a demonstrator: mean success over seeds ± its standard error."""
    steps = outcomes[0].steps
    rows = [f"| {steps} demonstrated steps, or labels | BC | BC with key points | SEED |", "|---|---|---|---|"]
    for name in dict.fromkeys(o.name for o in outcomes):
        of = [o for o in outcomes if o.name == name]
        cells = [[100 * getattr(o, column) for o in of] for column in ("plain", "grounded", "seed_feedback")]
        rows.append(f"| {name} | " + " | ".join(f"{mean(values)} %" for values in cells) + " |")
    return rows


def _bad(task: Task, robot: SkillEpisodes, rng: np.random.Generator) -> SkillCall:
    """A call drawn uniformly from all that the task allows, but called bad."""
    for _ in range(ATTEMPTS):
        spec = task.skills[int(rng.integers(len(task.skills)))]
        call = SkillCall(spec.name, tuple(rng.uniform(spec.low, spec.high).tolist()))
        if task.judge(robot.state, call) < 0:
            break
    return call
