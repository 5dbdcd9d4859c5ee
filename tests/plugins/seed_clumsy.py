"""The kinematic adapter, but every so many executions it breaks a safety rule: what a simulator does by accident."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from pydantic import BaseModel, Field

from robot_adapters.base import Adapter, EndReason, SafetyViolation, SkillCall, SkillResult, StepHook, StopCheck
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.registry import task as task_by_name
from robot_adapters.tasks.base import Task


class ClumsySettings(KinematicSettings):
    """Settings of `Clumsy`."""

    violation: Literal["damage", "manual_reset"] = Field("damage", description="the kind of every violation")
    every: int = Field(1, ge=1, description="executions from one violation to the next")


class Clumsy(KinematicAdapter):
    """Moves as the kinematic adapter does; what it reports of every n-th execution is a violation."""

    def __init__(self, task: Task, settings: ClumsySettings) -> None:
        super().__init__(task, settings)
        self._chosen = settings
        self._executed = 0

    def execute(self, call: SkillCall, *, should_stop: StopCheck, on_step: StepHook) -> SkillResult:
        """Run one skill, and spoil it if it is its turn."""
        result = super().execute(call, should_stop=should_stop, on_step=on_step)
        self._executed += 1
        if self._executed % self._chosen.every:
            return result
        broken = SafetyViolation(self._chosen.violation, "bumped into the table")
        end = EndReason.FORCE_LIMIT if broken.kind == "damage" else result.end
        return replace(result, end=end, success=False, violations=(broken,))


class ClumsyFactory:
    """Builds `Clumsy`."""

    name = "clumsy"
    description = "The kinematic adapter with accidents; for tests."
    simulated = True
    tasks: tuple[str, ...] = ("reaching", "stacking")
    settings: type[BaseModel] = ClumsySettings

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build it."""
        chosen = ClumsySettings.model_validate(settings.model_dump())
        return Clumsy(task_by_name(task, chosen.layout), chosen)


CLUMSY = ClumsyFactory()
