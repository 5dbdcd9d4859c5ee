"""Fixtures for tests of the server's parts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robot_adapters import registry
from tests.live import PLUGINS
from tests.server.databases import postgres, sqlite_store, store, url

__all__ = ["plugins", "postgres", "sqlite_store", "store", "url"]


@pytest.fixture
def plugins() -> Iterator[None]:
    """The plug-ins for tests, here and in the workers; found anew, because this process has looked before."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(PLUGINS))
        patch.setenv("PYTHONPATH", str(PLUGINS))
        registry._load_all.cache_clear()
        yield
    registry._load_all.cache_clear()
