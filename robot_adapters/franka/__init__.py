"""The Franka adapter: a Panda or FR3 with cameras. Importing this loads no robot driver; calling `FACTORY` does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from robot_adapters.base import PRIMITIVES

if TYPE_CHECKING:
    from robot_adapters.base import Adapter
    from robot_adapters.tasks.base import Task

Corner = tuple[float, float, float]


class FrankaSettings(BaseModel):
    """Settings of the Franka adapter. Lengths in m, robot base frame, where nothing else is said."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    host: str = Field("172.16.0.2", min_length=1, description="Address of the control box, or of Deoxys's computer.")
    backend: Literal["franka_rs", "franky", "deoxys"] = Field(
        "franka_rs", description="What drives the arm: franka-rs, franky, or a Deoxys that runs on the arm's computer."
    )
    deoxys_bind: str = Field("*", description="With deoxys: the address of this PC at which it listens.")
    realtime: bool = Field(
        True, description="Refuse to drive without a PREEMPT_RT kernel; only a simulated arm forgives late commands."
    )
    eyes: str = Field("perception", description="What sees the scene: a name of the entry points `seed.eyes`.")
    eyes_settings: dict[str, Any] = Field(default_factory=dict, description="Settings of what sees the scene.")
    table_height: float | None = Field(
        None, ge=-1.0, le=1.0, description="z of the table; none: where the task's simulated table is."
    )
    workspace_low: Corner | None = Field(
        None, description="Lowest corner of where the grip site may be; none: the task's own bounds and some more."
    )
    workspace_high: Corner | None = Field(None, description="Its highest corner.")
    speed: float = Field(0.25, gt=0.0, le=0.6, description="Fastest motion of the hand, m/s.")
    acceleration: float = Field(0.8, gt=0.0, le=3.0, description="m/s^2, likewise.")
    approach_speed: float = Field(0.04, gt=0.0, le=0.1, description="m/s, on the way down near the table.")
    approach_height: float = Field(0.07, ge=0.0, le=0.3, description="How near the table that is.")
    stiffness: float = Field(1000.0, ge=200.0, le=2000.0, description="N/m with which the hand is held on its way.")
    force: float = Field(25.0, gt=0.0, le=80.0, description="N at the hand at which a skill ends.")
    reflex: float = Field(45.0, gt=0.0, le=100.0, description="N at the hand at which the robot stops itself.")
    dead_man: float = Field(
        0.6, ge=0.1, le=10.0, description="s for which a motion doesn't ask whether to stop, until the arm is stopped."
    )

    @model_validator(mode="before")
    @classmethod
    def _as_stored(cls, given: Any) -> Any:
        """Experiments of before name a `jpeg_quality`, which was never read: that of the eyes counts."""
        return {k: v for k, v in given.items() if k != "jpeg_quality"} if isinstance(given, dict) else given

    @model_validator(mode="after")
    def _possible(self) -> FrankaSettings:
        if self.force >= self.reflex:
            raise ValueError("force must be below reflex: a skill should end before the robot stops itself")
        if (self.workspace_low is None) != (self.workspace_high is None):
            raise ValueError("give both workspace_low and workspace_high, or none of them")
        if self.workspace_low and self.workspace_high:
            for axis, low, high in zip("xyz", self.workspace_low, self.workspace_high, strict=True):
                if low >= high:
                    raise ValueError(f"workspace_low is not below workspace_high in {axis}")
        return self


class FrankaFactory:
    """Builds the adapter. `AdapterFactory` of the entry point `franka`."""

    name = "franka"
    description = "A real Franka Panda or FR3 with its hand and cameras; needs an operator present to move."
    simulated = False
    tasks: tuple[str, ...] = ("stacking", "sweeping", "collecting_toy", "cooking_hotdog")
    settings: type[BaseModel] = FrankaSettings

    def stages(self, task: Task) -> bool:
        """Any task whose skills an arm has: what is on the table is for people to put there."""
        return {spec.name for spec in task.skills} <= PRIMITIVES.keys()

    def __call__(self, task: str, settings: BaseModel) -> Adapter:
        """Connect to arm and cameras. Nothing moves.

        Raises:
            UnknownName: there is no such task, or nothing of this name that sees.
            Unavailable: arm, cameras or driver can't be had; the remedy says what to do.
        """
        from robot_adapters.franka.adapter import FrankaAdapter  # noqa: PLC0415  the server lists adapters without it

        return FrankaAdapter(task, FrankaSettings.model_validate(settings.model_dump()))


FACTORY = FrankaFactory()
