"""From settings to a connected arm with its limits: the only place that chooses a backend."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import cast

import numpy as np

from robot_adapters.base import Array, workspace
from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.arm import SILENCE, FrankaArm
from robot_adapters.franka.backend import FrankaBackend
from robot_adapters.franka.driving import Driving
from robot_adapters.franka.limits import Limits
from robot_adapters.skills import LOWEST, TRANSIT_CLEARANCE
from robot_adapters.tasks.base import Task

BACKENDS = {"franka_rs": "franka_rs:FrankaRs", "franky": "franky_control:Franky", "deoxys": "deoxys:Deoxys"}
MARGIN = 0.03
"""m around the task's bounds in which the hand may be: a push ends beyond them by design, and arms swing a little."""
CEILING = 0.65
"""m above the table: skills pass at 0.17 m, home is at 0.49 m above the base, which may stand on a pedestal."""


def driving(settings: FrankaSettings) -> Driving:
    """How the backend is to drive."""
    return Driving(
        host=settings.host,
        bind=settings.deoxys_bind,
        realtime=settings.realtime,
        speed=settings.speed,
        acceleration=settings.acceleration,
        stiffness=settings.stiffness,
        force=settings.force,
        reflex=settings.reflex,
        silence=max(SILENCE, settings.dead_man),
        dead_man=settings.dead_man,
    )


def backend(settings: FrankaSettings) -> FrankaBackend:
    """A connected arm.

    Raises:
        Unavailable: the driver isn't installed, or the arm can't be reached.
    """
    module, name = BACKENDS[settings.backend].split(":")
    chosen = getattr(import_module(f"robot_adapters.franka.{module}"), name)
    return cast("Callable[[Driving], FrankaBackend]", chosen)(driving(settings))


def offset(settings: FrankaSettings, task: Task) -> Array:
    """(3,) m to add to a place of the task to get the robot's: only the table's height may differ."""
    table = task.table_height if settings.table_height is None else settings.table_height
    return np.array([0.0, 0.0, table - task.table_height])


def limits(settings: FrankaSettings, task: Task) -> Limits:
    """The bounds of every set-point, robot base frame."""
    table = task.table_height + float(offset(settings, task)[2])
    if settings.workspace_low is not None and settings.workspace_high is not None:
        low, high = np.array(settings.workspace_low), np.array(settings.workspace_high)
    else:
        margin = np.full(3, MARGIN + _longest_push(task))
        corners = workspace(task.skills) or (np.array([0.35, -0.2, 0.0]), np.array([0.7, 0.2, 0.0]))
        low, high = corners[0] - margin, corners[1] + margin
        # home is farther back than any object
        low[0] = min(low[0], 0.28)
        low[2], high[2] = table + LOWEST, table + max(CEILING, TRANSIT_CLEARANCE)
    # never into the table, whatever the settings say
    low[2] = max(low[2], table + LOWEST)
    return Limits(
        low,
        high,
        table,
        speed=settings.speed,
        acceleration=settings.acceleration,
        approach_speed=min(settings.approach_speed, settings.speed),
        approach=settings.approach_height,
        force=settings.force,
    )


def arm(settings: FrankaSettings, task: Task) -> FrankaArm:
    """A connected arm that keeps to its limits.

    Raises:
        Unavailable: the driver isn't installed, or the arm can't be reached.
    """
    return FrankaArm(
        backend(settings),
        limits(settings, task),
        offset=offset(settings, task),
        silence=max(SILENCE, settings.dead_man),
    )


def _longest_push(task: Task) -> float:
    """M that a push may lead beyond where it begins."""
    lengths = [max(abs(p.low), abs(p.high)) for s in task.skills for p in s.parameters if p.name == "delta"]
    return max(lengths, default=0.0)
