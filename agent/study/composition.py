"""Reward composition (paper, introduction): critics of single subgoals, put together where they were never trained.

A *piece* is a SEED learner of one subgoal. It is told where the subgoal acts (a key point) and nothing else of the
task. It learns from the labels that the learner of the whole task got while that subgoal was next: feedback doesn't ask
who proposed, so the same clicks teach both. A composition is a list of pieces in an order that its user writes down,
each with the key point of the new scene at which it now acts. In every state, the critic of the current subgoal
chooses the call. Beside it: the undivided learner of the whole task, asked in the new scene on states re-bound to what
it knows; and a learner trained there anew.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from agent.algorithm import Algorithm, Label, Problem
from agent.config import SEED, SeedSettings
from agent.study.episodes import Done, SkillEpisodes
from agent.study.lessons import (
    Heard,
    Lesson,
    Policy,
    Stage,
    deterministic,
    kept,
    learn,
    lessons,
    mean,
    success,
    unheard,
    whole,
)
from agent.study.scenes import FurtherPan, SwappedHotdog, ThreeBlocks, TwoToys, across_the_table
from robot_adapters.base import Array, SkillCall
from robot_adapters.tasks import collecting_toy as collecting
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.collecting_toy import CollectingToy
from robot_adapters.tasks.cooking_hotdog import CookingHotdog
from robot_adapters.tasks.stacking import Stacking
from robot_adapters.tasks.sweeping import Sweeping

CONTESTANTS: Mapping[str, str] = {"composed": "composed", "undivided": "undivided", "anew": "trained anew"}
UNTRAINED = ("composed", "undivided")
"""Those that get no feedback in the new scene: theirs is that of the tasks that they come from."""
REACHED = 0.9
EVERY = 5
"""Feedback between two looks at whether training may end."""


@dataclass(frozen=True)
class Place:
    """A key point of a task: the one of this number that this skill has."""

    skill: str
    number: int = 0

    def of(self, task: Task, state: Array) -> Array:
        """(3,) m, robot base frame."""
        at: Array = task.keypoints(state, self.skill)[self.number]
        return at


@dataclass(frozen=True)
class Source:
    """A task that pieces are trained on: where each of its subgoals acts, and feedback after which it is given up."""

    task: Callable[[], Any]
    places: tuple[Place, ...]
    budget: int


SOURCES: Mapping[str, Source] = {
    "stacking": Source(Stacking, (Place("pick"), Place("place")), 60),
    "sweeping": Source(Sweeping, (Place("pick"), Place("push")), 120),
    "collecting_toy": Source(CollectingToy, (Place("pick"), Place("place"), Place("push")), 160),
    "cooking_hotdog": Source(
        CookingHotdog,
        (Place("pick"), Place("place"), Place("pick", 1), Place("place", 1), Place("pick", 1), Place("place", 2)),
        240,
    ),
}


@dataclass(frozen=True)
class Step:
    """One subgoal of a composition: the piece for it (source task and its subgoal), and where that acts now."""

    source: str
    subgoal: int
    place: Place


@dataclass(frozen=True)
class Composition:
    """A scene or an order never trained: a step for each of the task's subgoals, in the task's order.

    rebound: the new state as one that an undivided learner knows: source task and its state vector.
    budget: feedback after which training anew is given up.
    """

    task: Callable[[], Any]
    steps: tuple[Step, ...]
    rebound: Callable[[Task, Array], tuple[str, Array]]
    budget: int


def _blocks(task: Task, state: Array) -> tuple[str, Array]:
    """A and B first; then C takes A's part, and A takes B's."""
    return "stacking", state[:6] if task.subgoal(state) < 2 else np.concatenate((state[6:], state[:3]))


def _hotdog(task: Task, state: Array) -> tuple[str, Array]:  # noqa: ARG001 - one signature for all
    """The same objects and flags: only places and order are new."""
    return "cooking_hotdog", state


def _sweeping(task: Task, state: Array) -> tuple[str, Array]:  # noqa: ARG001 - as above
    """Nothing that Sweeping's state tells has changed."""
    return "sweeping", state


def _toys(task: Task, state: Array) -> tuple[str, Array]:
    """Collecting with its tray where the dustpan is, then Sweeping."""
    if task.subgoal(state) >= 2:
        return "sweeping", state[:6]
    opening = collecting.TRAY_CLOSED[0] - float(task.keypoints(state, "place")[0, 0])
    return "collecting_toy", np.array([*state[6:9], opening, *state[9:]])


COMPOSITIONS: Mapping[str, Composition] = {
    "a third block": Composition(
        ThreeBlocks,
        (
            Step("stacking", 0, Place("pick", 0)),
            Step("stacking", 1, Place("place", 0)),
            Step("stacking", 0, Place("pick", 1)),
            Step("stacking", 1, Place("place", 1)),
        ),
        _blocks,
        200,
    ),
    "hotdog, stove moved, order swapped": Composition(
        SwappedHotdog,
        (
            Step("cooking_hotdog", 2, Place("pick", 1)),
            Step("cooking_hotdog", 3, Place("place", 1)),
            Step("cooking_hotdog", 0, Place("pick", 0)),
            Step("cooking_hotdog", 1, Place("place", 0)),
            Step("cooking_hotdog", 4, Place("pick", 1)),
            Step("cooking_hotdog", 5, Place("place", 2)),
        ),
        _hotdog,
        240,
    ),
    "Collecting's toy in Sweeping's scene": Composition(
        TwoToys,
        (
            Step("collecting_toy", 0, Place("pick", 0)),
            Step("collecting_toy", 1, Place("place", 0)),
            Step("sweeping", 0, Place("pick", 1)),
            Step("sweeping", 1, Place("push", 0)),
        ),
        _toys,
        240,
    ),
    "sweeping, dustpan further away": Composition(
        FurtherPan, (Step("sweeping", 0, Place("pick")), Step("sweeping", 1, Place("push"))), _sweeping, 120
    ),
}


def piece(task: Task, settings: SeedSettings, seed: int) -> Algorithm:
    """A learner of one subgoal: its state is the key point that it acts at, which every skill may act at."""
    low, high = (np.array(bound) for bound in zip(table.X, table.Y, table.Z, strict=True))
    problem = Problem(
        "a subgoal",
        low,
        high,
        across_the_table(*task.skills),
        keypoints=lambda at, _skill: np.asarray(at, dtype=np.float64).reshape(1, 3),
        position_fields=(0,),
    )
    return SEED(problem, settings, seed)


@dataclass(frozen=True)
class Trained:
    """What training came to. feedback: labels until 90 % of the rollouts succeeded; None if the budget ended before.

    rate: share of the rollouts that succeed at its end.
    """

    feedback: int | None
    budget: int
    rate: float

    @property
    def counted(self) -> int:
        """The feedback, or the budget where it wasn't enough."""
        return self.budget if self.feedback is None else self.feedback


class Trial:
    """Training a whole task until 90 % of the rollouts succeed and each subgoal was called good, or the budget ends."""

    def __init__(self, task: Task, settings: SeedSettings, seed: int) -> None:
        self._task = task
        self._settings = settings
        self._seed = seed
        self.learner = whole(task, settings, seed)
        self._lessons: list[tuple[int, Lesson]] = []
        """Each with the subgoal that was next."""

    def run(
        self, stage: Stage, budget: int, rollouts: int, heard: Callable[[Done | None], None] = lambda _: None
    ) -> Trained:
        """Give the lessons. heard: told of each, and what was executed upon it."""
        judged_on = SkillEpisodes(self._task, stage(self._task), first_subgoal=False)
        try:
            policy = deterministic(self.learner, self._task)
            for lesson in lessons(self.learner, self._task, stage, seed=self._seed, feedback=budget):
                heard(lesson.done)
                self._lessons.append((self._task.subgoal(lesson.state), lesson))
                served = {subgoal for subgoal, of in self._lessons if of.value == 1}
                if lesson.number % EVERY or len(served) < len(self._task.subgoals):
                    continue
                rate = success(judged_on, policy, rollouts, least=REACHED)
                if rate >= REACHED:
                    return Trained(lesson.number, budget, rate)
            return Trained(None, budget, success(judged_on, policy, rollouts))
        finally:
            judged_on.close()

    def pieces(self, places: Sequence[Place]) -> list[Algorithm]:
        """A piece for each subgoal, taught by the labels that were given while it was next."""
        seeds = np.random.SeedSequence(self._seed).generate_state(len(places))
        made = [piece(self._task, self._settings, int(s)) for s in seeds]
        for subgoal, lesson in self._lessons:
            at = places[subgoal].of(self._task, lesson.state)
            learn(made[subgoal], [Label(lesson.number, at, lesson.call, lesson.value)])
        return made


def composed(composition: Composition, task: Task, pieces: Mapping[str, Sequence[Algorithm]]) -> Policy:
    """The policy that asks, in each state, the critic of the subgoal that the user's order says is next."""

    def choose(state: Array) -> SkillCall:
        step = composition.steps[task.subgoal(state)]
        learner = pieces[step.source][step.subgoal]
        return kept(task, learner.propose(step.place.of(task, state), deterministic=True).call)

    return choose


def rebound(composition: Composition, task: Task, wholes: Mapping[str, Algorithm]) -> Policy:
    """The policy that asks the undivided learners of the source tasks on states they know."""

    def choose(state: Array) -> SkillCall:
        source, seen = composition.rebound(task, state)
        return kept(task, wholes[source].propose(seen, deterministic=True).call)

    return choose


@dataclass(frozen=True)
class Outcome:
    """One composition and one seed. Success rates of policies that got no feedback in the new scene, and feedbacks.

    sources: feedback that the source tasks took, of composed and re-bound alike. anew: that the new task itself takes.
    """

    name: str
    seed: int
    composed: float
    rebound: float
    sources: int
    anew: Trained


def run(stage: Stage, seeds: Sequence[int], *, rollouts: int = 100) -> list[Outcome]:
    """Train on the source tasks, compose without any more feedback, and train anew to compare.

    stage: builds the robot for a task, one of `agent.study.scenes` among them.
    """
    return [outcome(name, stage, seed, rollouts, unheard) for seed in seeds for name in COMPOSITIONS]


def rows() -> list[str]:
    """One for each new scene."""
    return list(COMPOSITIONS)


def budgets(row: str) -> dict[str, int]:
    """Labels of the source tasks, or in the new scene."""
    return dict.fromkeys(UNTRAINED, sum(SOURCES[source].budget for source in _sources(row))) | {
        "anew": COMPOSITIONS[row].budget
    }


def outcome(row: str, stage: Stage, seed: int, rollouts: int, heard: Heard) -> Outcome:
    """One scene and one seed."""
    composition, settings = COMPOSITIONS[row], SeedSettings(**SEED.presets["recommended"])
    pieces: dict[str, list[Algorithm]] = {}
    wholes: dict[str, Algorithm] = {}
    took = 0
    for name in _sources(row):
        source = SOURCES[name]
        trial = Trial(source.task(), settings, seed)
        took += trial.run(stage, source.budget, rollouts, partial(heard, UNTRAINED)).counted
        wholes[name], pieces[name] = trial.learner, trial.pieces(source.places)
    task: Task = composition.task()
    episodes = SkillEpisodes(task, stage(task), first_subgoal=False)
    policies = (composed(composition, task, pieces), rebound(composition, task, wholes))
    try:
        solved = [success(episodes, policy, rollouts) for policy in policies]
    finally:
        episodes.close()
    anew = Trial(task, settings, seed).run(stage, composition.budget, rollouts, partial(heard, ["anew"]))
    return Outcome(row, seed, solved[0], solved[1], took, anew)


def rates(of: Outcome) -> dict[str, float]:
    """Of each contestant."""
    return {"composed": of.composed, "undivided": of.rebound, "anew": of.anew.rate}


def read(told: Mapping[str, Any]) -> Outcome:
    """From JSON."""
    return Outcome(**{**told, "anew": Trained(**told["anew"])})


def _sources(row: str) -> list[str]:
    """The tasks that its pieces come from."""
    return list(dict.fromkeys(step.source for step in COMPOSITIONS[row].steps))


def table_of(outcomes: Sequence[Outcome]) -> list[str]:
    """Markdown rows, one a composition: means over seeds ± their standard errors."""
    rows = [
        "| scene | composed, no feedback | undivided, no feedback | feedback on the sources | feedback anew |",
        "|---|---|---|---|---|",
    ]
    for name in dict.fromkeys(o.name for o in outcomes):
        of = [o for o in outcomes if o.name == name]
        failed = sum(o.anew.feedback is None for o in of)
        lost = f" ({failed} of {len(of)} not within {of[0].anew.budget})" if failed else ""
        rows.append(
            f"| {name} | {mean([100 * o.composed for o in of])} % | {mean([100 * o.rebound for o in of])} % "
            f"| {mean([o.sources for o in of])} | {mean([o.anew.counted for o in of])}{lost} |"
        )
    return rows
