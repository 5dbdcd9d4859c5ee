"""Several simulated robots in one experiment: what they execute a second, and a core, against one robot in this run.

Every proposal is the true call, so that the synthetic teacher approves it and the robots are what is measured, with
everything around them: the database, the stills of each proposal, and the service's own process.
"""

from __future__ import annotations

import asyncio
import os
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from server.messages import FrameHeader, StreamEvent
from server.schemas import Counters, ExperimentCreate
from server.service import Service, opened
from server.settings import Settings
from tests.benchmarks.result import Result

ROBOTS = (1, 2, 4)
EXECUTIONS = {"kinematic": 240, "robosuite": 60}
"""How many are measured; some ten seconds each with one robot."""
WARM_UP = 2
"""Executions of each robot before the clock starts."""
PLUGINS = Path(__file__).resolve().parents[1] / "plugins"
TICKS = os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Rate:
    """What one run did in `seconds`, with so many seconds of CPU time in all its processes."""

    executions: int
    steps: int
    seconds: float
    cpu: float

    @property
    def speed(self) -> float:
        """Executions a second."""
        return self.executions / self.seconds

    @property
    def per_core(self) -> float:
        """Executions a second of CPU time."""
        return self.executions / self.cpu


class Nobody:
    """A `Publisher` for a run that nobody watches."""

    shows_frames = False

    def publish(self, experiment_id: int, event: StreamEvent) -> None:
        """Nobody hears it."""

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        """Nobody sees it."""


def run() -> Result:
    """Measure each adapter with each number of robots, in rounds as a study runs them, and each at its own pace."""
    _with_plugins()
    lines = [f"{os.cpu_count()} cores; Stacking, true calls, synthetic teacher, pictures stored with every proposal"]
    ratios: dict[tuple[str, bool, int], float] = {}
    for adapter, executions in EXECUTIONS.items():
        for lockstep in (True, False):
            one: Rate | None = None
            for robots in ROBOTS:
                rate = asyncio.run(_measure(adapter, robots, executions, lockstep=lockstep))
                one = one or rate
                ratios[adapter, lockstep, robots] = rate.speed / one.speed
                lines.append(
                    f"{adapter}, {robots} robot{'s' if robots > 1 else ''}, {'in step' if lockstep else 'own pace'}:"
                    f" {rate.speed:.1f} executions/s ({rate.speed / one.speed:.2f} x),"
                    f" {rate.steps / rate.seconds:.0f} steps/s, {rate.cpu / rate.seconds:.2f} cores busy,"
                    f" {rate.per_core:.1f} executions/s a core ({rate.per_core / one.per_core:.2f} x)"
                )
    value = ratios["robosuite", True, 2]
    return Result("envs", value, "x one robot (2 on robosuite, in step)", baseline=1.0, lines=tuple(lines))


async def _measure(adapter: str, robots: int, executions: int, *, lockstep: bool) -> Rate:
    with tempfile.TemporaryDirectory() as directory:
        settings = Settings(data_dir=Path(directory), create_first_experiment=False, log_level="error")
        async with opened(settings, Nobody()) as service:
            body = ExperimentCreate(
                name="envs",
                task="stacking",
                adapter=adapter,
                algorithm="scripted",
                teacher="synthetic",
                num_envs=robots,
                lockstep=lockstep,
            )
            experiment = (await service.create(body)).id
            warm = WARM_UP * robots
            before = await _train(service, experiment, "start", warm)
            cpu, started = _cpu(service, experiment), time.monotonic()
            after = await _train(service, experiment, "resume", warm + executions)
            seconds, cpu = time.monotonic() - started, _cpu(service, experiment) - cpu
    steps = after.low_level_steps - before.low_level_steps
    return Rate(after.executions - before.executions, steps, seconds, cpu)


async def _train(service: Service, experiment: int, verb: Any, until: int) -> Counters:
    await service.hub.act(experiment, verb, until=until)
    await service.hub.idle(experiment)
    stored = await service.store.experiment(experiment)
    if stored.failure is not None:
        raise RuntimeError(stored.failure)
    return stored.counters


def _cpu(service: Service, experiment: int) -> float:
    """Seconds of CPU time used so far by this process and by the experiment's workers (proc_pid_stat(5): 14, 15)."""
    total = 0
    for pid in (os.getpid(), *service.hub.worker_pids(experiment).values()):
        fields = Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()
        total += int(fields[11]) + int(fields[12])
    return total / TICKS


def _with_plugins() -> None:
    """Let this process and its workers find the scripted algorithm."""
    sys.path.append(str(PLUGINS))
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(PLUGINS), os.environ.get("PYTHONPATH")]))
