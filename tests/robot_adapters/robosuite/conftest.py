"""One simulator a task for all tests of this folder: building one takes seconds."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robot_adapters import registry
from robot_adapters.robosuite.adapter import RobosuiteAdapter

_built: dict[str, RobosuiteAdapter] = {}


def build(task: str) -> RobosuiteAdapter:
    """An adapter as its entry point makes it."""
    factory = registry.adapter("robosuite")
    adapter = factory(task, factory.settings())
    assert isinstance(adapter, RobosuiteAdapter)
    return adapter


def shared(task: str) -> RobosuiteAdapter:
    """The task's adapter that all tests of the folder use."""
    if task not in _built:
        _built[task] = build(task)
    return _built[task]


@pytest.fixture(scope="package", autouse=True)
def _close() -> Iterator[None]:
    yield
    while _built:
        _built.popitem()[1].close()


@pytest.fixture
def stacking() -> RobosuiteAdapter:
    """The adapter with two blocks."""
    return shared("stacking")


@pytest.fixture
def reaching() -> RobosuiteAdapter:
    """The adapter with a marked area."""
    return shared("reaching")


@pytest.fixture
def sweeping() -> RobosuiteAdapter:
    """The adapter with broom, toy and dustpan."""
    return shared("sweeping")


@pytest.fixture
def collecting_toy() -> RobosuiteAdapter:
    """The adapter with a toy and a drawer."""
    return shared("collecting_toy")


@pytest.fixture
def cooking_hotdog() -> RobosuiteAdapter:
    """The adapter with skillet, sausage, stove and bun."""
    return shared("cooking_hotdog")
