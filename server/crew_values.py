"""What the two workers report, as values."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robot_adapters.base import SkillCall


@dataclass(frozen=True)
class Picture:
    """One camera's still image of an observation; `image` is the hash of its JPEG."""

    camera: str
    image: str
    width: int
    height: int


@dataclass(frozen=True)
class Seen:
    """An observation as the robot worker reports it. state: (n,) in the task's units; success: the task is solved."""

    id: str
    state: tuple[float, ...]
    taken_at: float
    pictures: tuple[Picture, ...]
    success: bool


@dataclass(frozen=True)
class Idea:
    """A suggestion as the learner worker reports it."""

    call: SkillCall
    predicted_feedback: float
    skill_probabilities: dict[str, float]
    policy_version: int
    uncertainty: float | None = None


@dataclass(frozen=True)
class Done:
    """What one execution did. Times are CLOCK_MONOTONIC seconds; None where there was no set-point."""

    end: str
    arrived: bool
    stopped: bool
    low_level_steps: int
    task_success: bool
    violations: tuple[tuple[str, str], ...]
    first_set_point_at: float | None = None
    last_set_point_at: float | None = None

    @classmethod
    def nothing(cls, why: str, *, stopped: bool) -> Done:
        """The robot worker refused the call."""
        return cls(why, arrived=False, stopped=stopped, low_level_steps=0, task_success=False, violations=())


@dataclass(frozen=True)
class Saved:
    """A written checkpoint."""

    path: Path
    policy_version: int
    last_feedback_id: int
    sha256: str
