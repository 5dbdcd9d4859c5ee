"""What a study's processes build their surroundings with: tasks, robots and low-level environments by name."""

from __future__ import annotations

from functools import partial

from agent.study.algorithms import Builders
from agent.study.low_level import Env
from robot_adapters import low_level, registry
from robot_adapters.base import Adapter
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.tasks.base import Task
from server.settings import Settings

WITHOUT_PHYSICS = "kinematic"


def builders(adapter: str) -> Builders:
    """Everything on this adapter. It can be sent to another process.

    Raises:
        UnknownName: there is no such adapter.
    """
    registry.adapter(adapter)
    return Builders(
        registry.task,
        partial(_robot, adapter),
        partial(_environment, adapter),
        partial(_environment, WITHOUT_PHYSICS),
        any_task,
        Settings().learner_device,
    )


def any_task(task: Task) -> Adapter:
    """A kinematic robot with a task that may have no name: a scene made for one study."""
    from robot_adapters.kinematic.adapter import KinematicAdapter  # noqa: PLC0415  as its factory does

    return KinematicAdapter(task, KinematicSettings(draw=False))


def _robot(adapter: str, task: str) -> Adapter:
    factory = registry.adapter(adapter)
    # nobody looks at a study's pictures
    chosen = {"draw": False} if "draw" in factory.settings.model_fields else {}
    return factory(task, factory.settings.model_validate(chosen))


def _environment(adapter: str, task: str) -> Env:
    return low_level.make(task, adapter)
