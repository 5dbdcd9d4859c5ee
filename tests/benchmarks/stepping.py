"""Skill executions per second on robosuite, against MuJoCo alone taking the same physics steps from the same states."""

from __future__ import annotations

import time
from typing import Literal, NamedTuple

import mujoco

from robot_adapters.base import StepHook
from robot_adapters.registry import task
from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from tests.benchmarks.result import Result

EPISODES = 10
REPEATS = 3  # of each episode, which always runs alike; the best counts, so that other processes disturb less
REFERENCE_EPISODES = 2  # robosuite's own loop takes seven times as long
SKILLS = 2  # an episode: pick and place
BAR = 0.90  # of the rate of `mj_step`


class Times(NamedTuple):
    """Seconds of processor time: with everything, and for `mj_step` alone."""

    ours: float
    raw: float
    executions: int
    set_points: int


def run() -> Result:
    """Time true picks and places, skill code included, and the physics under them; the same for robosuite's loop."""
    native, reference = _measure("native", EPISODES), _measure("reference", REFERENCE_EPISODES)
    ratio = native.raw / native.ours
    lines = tuple(
        f"{name}: {t.raw / t.ours:.3f} of mj_step's rate, {t.executions / t.ours:.1f} executions/s, "
        f"{t.ours / t.set_points * 1e3:.2f} ms a set-point, {t.set_points / t.executions:.0f} set-points a skill"
        for name, t in (("native", native), ("reference (env.step)", reference))
    )
    raw = native.executions / native.raw
    return Result("stepping", native.executions / native.ours, "executions/s", raw, BAR * raw, ratio >= BAR, lines)


def _measure(stepping: Literal["native", "reference"], episodes: int) -> Times:
    """Run each episode twice: timed as it is, then stopping at each set-point to time `mj_step` from there."""
    robot = FACTORY("stacking", RobosuiteSettings(stepping=stepping))
    assert isinstance(robot, RobosuiteAdapter)
    model, data = robot.simulator.model, robot.simulator.data
    substeps, twin, raw = round(1 / robot.info.control_hz / model.opt.timestep), mujoco.MjData(model), 0.0

    def physics_alone() -> None:
        nonlocal raw
        mujoco.mj_copyData(twin, model, data)
        mujoco.mj_step(model, twin)  # brings it into the processor's cache, where the robot's own is
        started = time.thread_time()
        mujoco.mj_step(model, twin, nstep=substeps)
        raw += time.thread_time() - started

    _episode(robot, 0, lambda: None)
    ours, physics, set_points = 0.0, 0.0, 0
    for seed in range(episodes):
        timed, alone = [], []
        for _ in range(REPEATS):
            seconds, sent = _episode(robot, seed, lambda: None)
            timed.append(seconds)
            raw = 0.0
            _episode(robot, seed, physics_alone)
            alone.append(raw)
        ours, physics, set_points = ours + min(timed), physics + min(alone), set_points + sent
    robot.close()
    return Times(ours, physics, SKILLS * episodes, set_points)


def _episode(robot: RobosuiteAdapter, seed: int, on_step: StepHook) -> tuple[float, int]:
    """Pick, then place: seconds in the two, without pictures, and the set-points they sent."""
    stacking = task("stacking")
    robot.reset(seed)
    seconds, sent = 0.0, 0
    for _ in range(SKILLS):
        call = stacking.true_call(stacking.state(robot.simulator.scene()))
        started = time.thread_time()
        sent += robot.execute(call, should_stop=lambda: False, on_step=on_step).low_level_steps
        seconds += time.thread_time() - started
    return seconds, sent
