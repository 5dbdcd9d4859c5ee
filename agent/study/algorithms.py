"""Who can compete, and how each is set up. Imports torch only when something is built."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from agent.algorithm import DeviceName, Problem
from agent.baseline_config import BASELINES, BaselineSettings, MapleFactory, SacFactory, TamerFactory
from agent.config import SEED, SeedSettings
from agent.study.courses import Course, FeedbackCourse, RewardCourse, Stage
from agent.study.low_level import Env, LowLevelCourse, LowLevelStage
from agent.study.plan import Contestant, Kind, Run
from robot_adapters.base import Adapter, Array
from robot_adapters.tasks.base import Task, entry_names, position_fields, state_bounds
from robot_adapters.tasks.low_level import low_level_fields

if TYPE_CHECKING:
    from agent.sac import Sac


def _seed(name: str, title: str, preset: str) -> Contestant:
    return Contestant(name=name, title=title, kind="feedback", algorithm="seed", settings=SEED.presets[preset])


def _baseline(name: str, title: str, kind: Kind, **settings: float) -> Contestant:
    chosen = {**BASELINES[name].presets["paper_sim"], **settings}
    return Contestant(name=name, title=title, kind=kind, algorithm=name, settings=chosen)


CONTESTANTS: Mapping[str, Contestant] = {
    contestant.name: contestant
    for contestant in (
        _seed("seed", "SEED", "paper_sim"),
        _seed("seed-recommended", "SEED, recommended preset", "recommended"),
        # without a warm-up, like SEED, with which they are compared by the number of feedbacks or skills
        _baseline("tamer", "TAMER", "low_level_feedback", warm_up=0),
        _baseline("maple-aff", "MAPLE-aff", "reward", warm_up=0),
        _baseline("maple", "MAPLE", "reward", warm_up=0),
        _baseline("sac", "SAC", "low_level"),
    )
}
"""By name: the paper's five by its hyper-parameters for simulation, and the preset that needs the fewest clicks."""

ORACLE = Contestant(
    name="sac-oracle",
    title="SAC, TAMER's oracle",
    kind="low_level",
    algorithm="sac",
    settings=BASELINES["sac"].presets["quick"],
)
"""Who judges TAMER's actions: a fully trained SAC agent, the paper says. By its table or SAC's own publication none is
trained that far within these budgets (docs/baselines.md), so by the preset that gets there."""


@dataclass(frozen=True)
class Builders:
    """How a run gets its surroundings: handed in, for `agent` knows no adapter. They are sent to other processes."""

    task: Callable[[str], Task]
    robot: Callable[[str], Adapter]
    """A robot with the task of this name, on which skills are executed."""
    low_level: Callable[[str], Env]
    """The same commanded step by step."""
    without_physics: Callable[[str], Env]
    """The same where commands are carried out exactly: quicker, and fresh policies come across the reward."""
    stage: Callable[[Task], Adapter]
    """A robot without physics with a task that may have no name: a scene made for one study."""
    device: DeviceName = "cpu"
    """Where SEED trains; the baselines train on the CPU."""


def course(run: Run, builders: Builders, folder: Path, oracle: Path | None) -> Course:
    """The run from its beginning. oracle: checkpoint of the learner that judges, where one does.

    Raises:
        AgentError: settings or checkpoint don't fit. AdapterError: robot or simulator can't be had.
    """
    return _COURSES[run.contestant.kind](run, builders, folder, oracle)


def problem_of(task: Task) -> Problem:
    """What a learner of skills is told of a task."""
    low, high = state_bounds(task.state_fields)
    return Problem(
        task.name,
        low,
        high,
        task.skills,
        state_names=entry_names(task.state_fields),
        keypoints=task.keypoints,
        position_fields=position_fields(task.state_fields),
    )


def _feedback(run: Run, builders: Builders, folder: Path, oracle: Path | None) -> Course:  # noqa: ARG001
    from agent.device import place  # noqa: PLC0415  it imports torch

    stage = _stage(run, builders, folder)
    problem = problem_of(stage.task)
    learner = SEED(problem, SeedSettings(**run.contestant.settings), run.seed)
    place(learner, builders.device)
    return FeedbackCourse(stage, learner, problem)


def _reward(run: Run, builders: Builders, folder: Path, oracle: Path | None) -> Course:  # noqa: ARG001
    stage, build = _stage(run, builders, folder), BASELINES[run.contestant.algorithm]
    assert isinstance(build, MapleFactory)
    return RewardCourse(stage, build(problem_of(stage.task), _settings(run.contestant), run.seed))


def _low_level(run: Run, builders: Builders, folder: Path, oracle: Path | None) -> Course:  # noqa: ARG001
    stage, low, high, size = _low_level_stage(run, builders)
    learner = _sac(run.contestant, low, high, size, run.seed)
    return LowLevelCourse(stage, learner, learner.observe)


def _low_level_feedback(run: Run, builders: Builders, folder: Path, oracle: Path | None) -> Course:  # noqa: ARG001
    assert oracle is not None, "the plan gives every learner of judged actions an oracle"
    stage, low, high, size = _low_level_stage(run, builders)
    judge, build = _sac(ORACLE, low, high, size, seed=0), BASELINES[run.contestant.algorithm]
    judge.load(oracle)
    assert isinstance(build, TamerFactory)
    learner = build(low, high, size, _settings(run.contestant), run.seed, oracle=judge)

    def observe(state: Array, action: Array, reward: float, next_state: Array, terminated: bool) -> None:  # noqa: ARG001
        learner.observe(state, action, reward)

    return LowLevelCourse(stage, learner, observe)


def _sac(contestant: Contestant, low: Array, high: Array, size: int, seed: int) -> Sac:
    build = BASELINES[contestant.algorithm]
    assert isinstance(build, SacFactory)
    return build(low, high, size, _settings(contestant), seed)


def _settings(contestant: Contestant) -> BaselineSettings:
    return BASELINES[contestant.algorithm].settings(**contestant.settings)


_COURSES: Mapping[str, Callable[[Run, Builders, Path, Path | None], Course]] = {
    "feedback": _feedback,
    "reward": _reward,
    "low_level": _low_level,
    "low_level_feedback": _low_level_feedback,
}


def _stage(run: Run, builders: Builders, folder: Path) -> Stage:
    name = run.scenario.task
    return Stage(
        builders.task(name), builders.robot(name), builders.robot(name), run.scenario.first_subgoal, run.seed, folder
    )


def _low_level_stage(run: Run, builders: Builders) -> tuple[LowLevelStage, Array, Array, int]:
    """The environments, usual bounds of the state (n,), and the size of an action."""
    name = run.scenario.task
    train_in = builders.without_physics if run.without_physics else builders.low_level
    stage = LowLevelStage(train_in(name), builders.low_level(name), run.seed)
    low, high = state_bounds(low_level_fields(builders.task(name)))
    shape = stage.env.action_space.shape
    assert shape is not None
    return stage, low, high, shape[0]
