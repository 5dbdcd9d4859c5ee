"""The kinematic adapter: no physics, skills take effect at once. For learner studies, load tests and teaching."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import BaseModel, ConfigDict, Field

from robot_adapters.base import PRIMITIVES

if TYPE_CHECKING:
    from robot_adapters.base import Adapter
    from robot_adapters.low_level import Plant
    from robot_adapters.tasks.base import Task

SHAPES = {"block", "area", "thing", "fixture", "slider"}
"""The shapes of `ObjectSpec` that the world moves and the painter draws."""


class KinematicSettings(BaseModel):
    """Settings of the kinematic adapter."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    draw: bool = Field(True, description="Whether there are cameras; without, a study doesn't pay for pictures.")
    jpeg_quality: int = Field(90, ge=30, le=100, description="JPEG quality of the pictures.")
    step_seconds: float = Field(
        0.0, ge=0, le=1, description="Duration of one set-point; 0 lets every skill take effect at once."
    )
    layout: dict[str, tuple[float, float]] = Field(
        default_factory=dict,
        description="Ranges of the start layout, [from, to] in m, that replace some of the task's; see docs/tasks.md.",
    )


class KinematicFactory:
    """Builds the adapter. `AdapterFactory` of the entry point `kinematic`."""

    name = "kinematic"
    description = "A drawn table without physics: skills take effect at once, and fail where they would miss."
    simulated = True
    tasks: tuple[str, ...] = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")
    settings: type[BaseModel] = KinematicSettings

    def stages(self, task: Task) -> bool:
        """Whether it knows the shapes of all objects, and every skill."""
        return {o.shape for o in task.objects} <= SHAPES and {s.name for s in task.skills} <= PRIMITIVES.keys()

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build the adapter; takes milliseconds.

        Raises:
            UnknownName: there is no such task.
            InvalidLayout: the task has no such range of starts.
        """
        # here and not above: listing adapters shouldn't load a drawing library
        from robot_adapters.kinematic.adapter import KinematicAdapter  # noqa: PLC0415
        from robot_adapters.registry import task as task_by_name  # noqa: PLC0415

        chosen = KinematicSettings.model_validate(settings.model_dump())
        return KinematicAdapter(task_by_name(task, chosen.layout), chosen)

    def low_level(self, task: Task) -> Plant:
        """The task for control step by step (`Commandable` of `low_level.py`)."""
        from robot_adapters.kinematic.plant import KinematicPlant  # noqa: PLC0415  as above

        return KinematicPlant(task)


FACTORY = KinematicFactory()
