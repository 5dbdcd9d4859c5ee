"""What the baselines need until 90 % of 20 deterministic rollouts reach the area, on Reaching without physics.

For each seed: SAC; TAMER, with that SAC agent as its oracle; MAPLE over skills. The figure is low-level steps of MAPLE,
the baseline TAMER's. `BENCH_PRESET` names the preset (default `quick`), `BENCH_SEEDS` how many seeds (default 3).
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable
from functools import partial

import torch

from agent.algorithm import Problem
from agent.baseline_config import BASELINES, MapleFactory, SacFactory, TamerFactory
from agent.maple import Maple
from agent.sac import Sac
from agent.tamer import Tamer
from robot_adapters import low_level, registry
from robot_adapters.base import Adapter, SkillCall, SkillResult
from robot_adapters.low_level import LowLevelEnv
from robot_adapters.tasks.base import state_bounds
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.result import Result

TASK = "reaching"
ROLLOUTS, ALLOWED_FAILURES = 20, 2
SAC_STEPS, TAMER_STEPS, MAPLE_CALLS = 8000, 8000, 1500
EVERY = {"sac": 200, "tamer": 200, "maple": 25}
"""Actions or calls between two evaluations."""

Needed = int | None
"""Low-level steps until the task was learned; None: not within the budget."""


def run() -> Result:
    """A line for each baseline."""
    preset, seeds = os.environ.get("BENCH_PRESET", "quick"), clicks.seeds(3)
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    needed: dict[str, list[Needed]] = {"sac": [], "tamer": [], "maple": []}
    seconds = dict.fromkeys(needed, 0.0)

    def timed(name: str, train: Callable[[], Needed]) -> None:
        started = time.perf_counter()
        needed[name].append(train())
        seconds[name] += time.perf_counter() - started

    try:
        for seed in seeds:
            env, tried = low_level.make(TASK, "kinematic", seed=seed), low_level.make(TASK, "kinematic")
            oracle = _sac(env, preset, seed)
            timed("sac", partial(_steps, oracle, env, tried, SAC_STEPS, EVERY["sac"], stop=False))
            taught = _tamer(env, preset, seed, oracle)
            timed("tamer", partial(_steps, taught, env, tried, TAMER_STEPS, EVERY["tamer"], stop=True))
            timed("maple", partial(_calls, preset, seed))
    finally:
        torch.set_num_threads(threads)
    lines = tuple(
        f"{name} {preset}: {', '.join('not within its budget' if n is None else str(n) for n in each)} low-level steps"
        f" ({seconds[name]:.0f} s)"
        for name, each in needed.items()
    )
    means = {
        name: statistics.fmean(n for n in each if n is not None) if None not in each else float("inf")
        for name, each in needed.items()
    }
    unit = f"low-level steps to 90 % (MAPLE on Reaching, mean of {seeds} seeds; baseline: TAMER)"
    return Result("baselines", means["maple"], unit, baseline=means["tamer"], lines=lines)


def _sac(env: LowLevelEnv, preset: str, seed: int) -> Sac:
    factory = BASELINES["sac"]
    assert isinstance(factory, SacFactory)
    size = (env.action_space.shape or (0,))[0]
    return factory(env.low, env.high, size, factory.settings(**factory.presets[preset]), seed)


def _tamer(env: LowLevelEnv, preset: str, seed: int, oracle: Sac) -> Tamer:
    factory = BASELINES["tamer"]
    assert isinstance(factory, TamerFactory)
    settings = factory.settings(**factory.presets[preset])
    return factory(env.low, env.high, oracle.action_size, settings, seed, oracle=oracle)


def _steps(
    learner: Sac | Tamer, env: LowLevelEnv, tried: LowLevelEnv, budget: int, every: int, *, stop: bool
) -> Needed:
    """Train for `budget` steps, or until it is learned; after how many it was."""
    state, _ = env.reset()
    needed: Needed = None
    for taken in range(1, budget + 1):
        action = learner.act(state)
        reached, reward, terminated, truncated, _ = env.step(action)
        if isinstance(learner, Sac):
            learner.observe(state, action, float(reward), reached, terminated)
        else:
            learner.observe(state, action, float(reward))
        while learner.owed_updates:
            learner.update()
        state = env.reset()[0] if terminated or truncated else reached
        if needed is None and taken % every == 0 and _reaches(learner, tried):
            needed = taken
            if stop:
                break
    return needed


def _reaches(learner: Sac | Tamer, env: LowLevelEnv) -> bool:
    failed = 0
    for start in range(ROLLOUTS):
        state, _ = env.reset(seed=10_000 + start)
        over = terminated = False
        while not over:
            state, _, terminated, truncated, _ = env.step(learner.act(state, deterministic=True))
            over = terminated or truncated
        failed += not terminated
        if failed > ALLOWED_FAILURES:
            return False
    return True


def _calls(preset: str, seed: int) -> Needed:
    factory, task = BASELINES["maple"], registry.task(TASK)
    assert isinstance(factory, MapleFactory)
    low, high = state_bounds(task.state_fields)
    problem = Problem(task.name, low, high, task.skills, keypoints=task.keypoints)
    learner = factory(problem, factory.settings(**factory.presets[preset]), seed)
    robot, tried = _kinematic(), _kinematic()
    state, executed, steps = robot.reset(seed).state, 0, 0
    for taken in range(1, MAPLE_CALLS + 1):
        call = learner.propose(state).call
        result = _execute(robot, call)
        reached, executed, steps = robot.observe().state, executed + 1, steps + result.low_level_steps
        learner.observe(state, call, float(result.success), reached, result.success)
        while learner.owed_updates:
            learner.update()
        if result.success or result.violations or executed == task.horizon:
            reached, executed = robot.reset().state, 0
        state = reached
        if taken % EVERY["maple"] == 0 and _solves(learner, tried, task.horizon):
            return steps
    return None


def _solves(learner: Maple, robot: Adapter, horizon: int) -> bool:
    failed = 0
    for start in range(ROLLOUTS):
        state = robot.reset(10_000 + start).state
        for _ in range(horizon):
            if _execute(robot, learner.propose(state, deterministic=True).call).success:
                break
            state = robot.observe().state
        failed += not robot.success()
        if failed > ALLOWED_FAILURES:
            return False
    return True


def _kinematic() -> Adapter:
    factory = registry.adapter("kinematic")
    return factory(TASK, factory.settings.model_validate({"draw": False}))


def _execute(robot: Adapter, call: SkillCall) -> SkillResult:
    return robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
