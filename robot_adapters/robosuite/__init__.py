"""The robosuite adapter: a simulated Panda at a table. Importing this loads no simulator; calling `FACTORY` does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import BaseModel, ConfigDict, Field

from robot_adapters.base import PRIMITIVES
from robot_adapters.robosuite.scenes import find, stages

if TYPE_CHECKING:
    from robot_adapters.base import Adapter
    from robot_adapters.low_level import Plant
    from robot_adapters.tasks.base import Task


class RobosuiteSettings(BaseModel):
    """Settings of the robosuite adapter."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    draw: bool = Field(
        True, description="Whether there are cameras; without, a study pays for no pictures and needs no graphics."
    )
    stills: Literal["fast", "smooth"] = Field(
        "fast",
        description="The images that trainers judge: as fast as live video, or anti-aliased in 2.5 times the time.",
    )
    jpeg_quality: int = Field(90, ge=30, le=100, description="JPEG quality of the images that trainers judge.")
    speed: float = Field(
        0.0, ge=0.0, le=20.0, description="Simulated seconds a second, for watching; 0 is as fast as it goes."
    )
    stepping: Literal["native", "reference"] = Field(
        "native",
        description="How the physics is stepped: compiled, or by robosuite's own loop, the same but slow.",
    )
    live_jpeg_quality: int = Field(70, ge=30, le=100, description="JPEG quality of the live video while a skill runs.")
    layout: dict[str, tuple[float, float]] = Field(
        default_factory=dict,
        description="Ranges of the start layout, [from, to] in m, that replace some of the task's; see docs/tasks.md.",
    )


class RobosuiteFactory:
    """Builds the adapter. `AdapterFactory` of the entry point `robosuite`."""

    name = "robosuite"
    description = "A Franka Panda at a table, simulated by robosuite and MuJoCo, seen by two cameras."
    simulated = True
    tasks: tuple[str, ...] = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")
    settings: type[BaseModel] = RobosuiteSettings

    def stages(self, task: Task) -> bool:
        """Whether it has a scene for the task's objects (or needs none), and every skill."""
        return stages(task) and {spec.name for spec in task.skills} <= PRIMITIVES.keys()

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Build the adapter; takes a few seconds, most of it loading the simulator.

        Raises:
            UnknownName: there is no such task.
            InvalidLayout: the task has no such range of starts.
            Unavailable: robosuite or software graphics can't be had; the remedy says what to install or set.
        """
        # here and not above: the server lists adapters without loading a simulator
        from robot_adapters.registry import task as task_by_name  # noqa: PLC0415
        from robot_adapters.robosuite.adapter import RobosuiteAdapter  # noqa: PLC0415

        chosen = RobosuiteSettings.model_validate(settings.model_dump())
        return RobosuiteAdapter(task_by_name(task, chosen.layout), chosen)

    def low_level(self, task: Task) -> Plant:
        """The task for control step by step (`Commandable` of `low_level.py`): physics without any graphics.

        Raises:
            Unavailable: robosuite can't be had; the remedy says what to install.
        """
        from robot_adapters.robosuite.graphics import load_robosuite  # noqa: PLC0415  as above

        load_robosuite()
        from robot_adapters.robosuite.simulator import Simulator  # noqa: PLC0415  once MuJoCo is loaded

        return Simulator(task.objects, build=find(task.name))


FACTORY = RobosuiteFactory()
