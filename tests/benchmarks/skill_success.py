"""How often pick then place with true parameters stacks the blocks, over 100 random starts on robosuite."""

from __future__ import annotations

from robot_adapters.base import SkillResult
from robot_adapters.registry import adapter, task
from tests.benchmarks.result import Result

STARTS = 100
BAR = 98


def run() -> Result:
    """Stack from the seeds 0 to 99; failures are listed with how each skill ended."""
    stacking = task("stacking")
    factory = adapter("robosuite")
    robot = factory("stacking", factory.settings(draw=False))  # nobody looks at pictures
    solved, steps, failures = 0, 0, []
    for seed in range(STARTS):
        robot.reset(seed)
        ends: list[str] = []
        result: SkillResult | None = None
        for _ in range(2):
            call = stacking.true_call(robot.observe().state)
            result = robot.execute(call, should_stop=lambda: False, on_step=lambda: None)
            ends.append(f"{call.skill} {result.end} after {result.low_level_steps}")
            steps += result.low_level_steps
        if result is not None and result.success:
            solved += 1
        else:
            where = robot.observe().state.round(3).tolist()
            failures.append(f"seed {seed}: {', '.join(ends)}; blocks end at {where}")
    robot.close()
    lines = (f"{steps / (2 * STARTS):.1f} set-points a skill", *failures)
    return Result("skill_success", solved, f"of {STARTS} starts", bar=BAR, ok=solved >= BAR, lines=lines)
