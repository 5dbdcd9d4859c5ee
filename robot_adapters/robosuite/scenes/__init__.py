"""What a task's objects are made of in physics: one module a task, found by the task's name."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from importlib.metadata import entry_points
from xml.etree.ElementTree import Element

from robot_adapters.tasks.base import ObjectSpec

Build = Callable[[Mapping[str, ObjectSpec]], list[Element]]
"""Objects by name -> MJCF bodies, one called like each object that isn't an area."""

GROUP = "seed.scenes"
"""Entry points of scenes of tasks of your own: the task's name = "module:build"."""

BUILT_IN = ("sweeping", "collecting_toy", "cooking_hotdog")


def find(task: str) -> Build | None:
    """The scene of a task; None where its blocks and areas say all."""
    if task in BUILT_IN:
        build: Build = importlib.import_module(f"{__name__}.{task}").build
        return build
    for point in entry_points(group=GROUP, name=task):
        loaded: Build = point.load()
        return loaded
    return None
