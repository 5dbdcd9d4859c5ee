"""What a task's objects are made of in physics: one module a task, found by the task's name."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from importlib.metadata import entry_points
from xml.etree.ElementTree import Element

from robot_adapters.tasks.base import ObjectSpec, Task

Build = Callable[[Mapping[str, ObjectSpec]], list[Element]]
"""Objects by name -> MJCF bodies, one called like each object that isn't an area."""

GROUP = "seed.scenes"
"""Entry points of scenes of tasks of your own: the task's name = "module:build"."""

BUILT_IN = ("sweeping", "collecting_toy", "cooking_hotdog")


PLAIN = {"block", "area"}
"""Shapes of `ObjectSpec` that need no scene: robosuite has blocks, and an area is only drawn."""


def stages(task: Task) -> bool:
    """Whether there is a scene for the task, or it needs none; loads nothing."""
    known = task.name in BUILT_IN or len(entry_points(group=GROUP, name=task.name)) > 0
    return known or {spec.shape for spec in task.objects} <= PLAIN


def find(task: str) -> Build | None:
    """The scene of a task; None where its blocks and areas say all."""
    if task in BUILT_IN:
        build: Build = importlib.import_module(f"{__name__}.{task}").build
        return build
    for point in entry_points(group=GROUP, name=task):
        loaded: Build = point.load()
        return loaded
    return None
