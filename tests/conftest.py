"""Fixtures for tests through the outermost door: the real service as a process, and Chromium."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.live import LiveService, running_service
from tests.simulators.franka import PYTHON as SIMULATOR


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Browser tests come last: while Playwright's loop runs in the main thread, no asyncio test can.

    Those of the simulated arm are skipped where `make` makes no simulator.
    """
    if not SIMULATOR.exists():
        skip = pytest.mark.skip(reason="no simulated Franka on this machine (scripts/simulators.sh)")
        for item in items:
            if item.get_closest_marker("simulated_arm"):
                item.add_marker(skip)
    items.sort(key=lambda item: "/e2e/" in item.path.as_posix())


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveService]:
    """A running service without experiments; a test may kill and restart it."""
    with running_service(tmp_path_factory.mktemp("service")) as live:
        yield live
        live.stop()


@pytest.fixture
def own_service(tmp_path: Path) -> Iterator[LiveService]:
    """A running service that no other test sees."""
    with running_service(tmp_path) as live:
        yield live


@pytest.fixture(scope="session")
def browser_type_launch_args() -> dict[str, Any]:
    """Debian's Chromium; a browser that Playwright would download isn't needed."""
    chromium = shutil.which("chromium")
    assert chromium, "Chromium is missing: `make test` installs it, or: apt-get install chromium"
    return {
        "executable_path": chromium,
        "args": [
            "--no-sandbox",  # containers and CI run as root
            "--disable-dev-shm-usage",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ],
    }


@pytest.fixture(scope="session")
def browser_context_args() -> dict[str, Any]:
    """A desktop window; tests of the phone set their own size."""
    return {"viewport": {"width": 1280, "height": 800}, "reduced_motion": "reduce"}
