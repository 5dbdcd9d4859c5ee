"""Films of a rendered table: picture after picture of each camera, as recordings; and tasks laid out before them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array
from robot_adapters.franka.perception.rays import View
from robot_adapters.registry import task as task_by_name
from tests.robot_adapters.franka.perception.recording import record
from tests.robot_adapters.franka.perception.rendering import EYES, Stage


class Film:
    """Takes one picture of each camera after the other, and makes recordings of them."""

    def __init__(self, stage: Stage, folder: Path) -> None:
        self._stage, self._folder = stage, folder
        self._taken: dict[str, list[NDArray[np.uint8]]] = {name: [] for name in EYES}

    def shoot(self, times: int = 1) -> None:
        """What both cameras see now."""
        for name, taken in self._taken.items():
            taken.extend(self._stage.draw(name) for _ in range(times))

    def sources(self, views: dict[str, View]) -> dict[str, str]:
        """The recordings, a camera's each."""
        return {n: record(self._folder / f"{n}.db3", views[n].lens, taken) for n, taken in self._taken.items()}


def lay(stage: Stage, task: str, seed: int) -> tuple[dict[str, Array], dict[str, float]]:
    """The task's objects as an episode starts, turned a little; where they are, and what slides."""
    staged, rng = task_by_name(task), np.random.default_rng(seed)
    layout = staged.sample_layout(rng)
    slides = {s.name: s.fixed for s in staged.objects if s.shape == "slider" and s.fixed is not None}
    joints = {}
    for name, at in layout.items():
        if name == "gripper":
            continue
        if (closed := slides.get(name)) is not None:
            joints[name] = float(at[0])
            stage.place(f"{task}/{name}", np.array(closed) - [joints[name], 0.0, 0.0])
        else:
            stage.place(f"{task}/{name}", at, float(rng.uniform(-0.3, 0.3)))
    return {n: a for n, a in layout.items() if n != "gripper" and n not in slides}, joints
