"""Skill executions per second on robosuite, against MuJoCo alone taking the same number of physics steps."""

from __future__ import annotations

import time

import mujoco

from robot_adapters.base import SkillCall
from robot_adapters.registry import task
from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from tests.benchmarks.result import Result

EPISODES = 15


def run() -> Result:
    """Time true picks and places without rendering; then `mj_step` as often, from the same kind of start."""
    stacking = task("stacking")
    robot = FACTORY("stacking", RobosuiteSettings())
    assert isinstance(robot, RobosuiteAdapter)
    simulator = robot.simulator
    seconds, executions, set_points = 0.0, 0, 0
    for seed in range(EPISODES):
        robot.reset(seed)
        for _ in range(2):
            call: SkillCall = stacking.true_call(stacking.state(simulator.scene()))
            started = time.perf_counter()
            result = robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
            seconds += time.perf_counter() - started
            executions += 1
            set_points += result.low_level_steps
    substeps = round(set_points / robot.info.control_hz / simulator.model.opt.timestep)
    started = time.perf_counter()
    for _ in range(substeps):
        mujoco.mj_step(simulator.model, simulator.data)
    raw = time.perf_counter() - started
    robot.close()
    return Result(
        "stepping",
        executions / seconds,
        "executions/s",
        baseline=executions / raw,
        lines=(
            f"{set_points / executions:.0f} set-points a skill, {seconds / set_points * 1e3:.2f} ms each",
            f"{seconds / raw:.1f} times as long as mj_step alone for the same {substeps} physics steps",
        ),
    )
