"""One simulator a task for all tests of this folder: building one takes seconds."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robot_adapters.robosuite import FACTORY, RobosuiteSettings
from robot_adapters.robosuite.adapter import RobosuiteAdapter


def build(task: str) -> RobosuiteAdapter:
    """The adapter as its entry point makes it."""
    adapter = FACTORY(task, RobosuiteSettings())
    assert isinstance(adapter, RobosuiteAdapter)
    return adapter


@pytest.fixture(scope="package")
def stacking() -> Iterator[RobosuiteAdapter]:
    """The adapter with two blocks."""
    adapter = build("stacking")
    yield adapter
    adapter.close()


@pytest.fixture(scope="package")
def reaching() -> Iterator[RobosuiteAdapter]:
    """The adapter with a marked area."""
    adapter = build("reaching")
    yield adapter
    adapter.close()
