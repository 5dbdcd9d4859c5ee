"""Fixtures of the browser tests."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from playwright.sync_api import Page, expect

from tests.e2e.trainer import Opener, TrainerPage
from tests.live import LiveService

expect.set_options(timeout=30_000)  # ms; Playwright's own five seconds are few on two cores that others work on too


@pytest.fixture
def opener(page: Page, service: LiveService) -> Iterator[Opener]:
    """Opens trainer's pages of new experiments, which are finished at the end so that their workers go."""
    made: list[int] = []
    service.ensure()

    def open_page(*, start: bool = True, **fields: Any) -> TrainerPage:
        experiment = service.experiment(**{"adapter": "kinematic", **fields})
        made.append(experiment)
        if start:
            service.post(f"/experiments/{experiment}/start")
        return TrainerPage(page, service, experiment).open()

    yield open_page
    for experiment in made:
        with contextlib.suppress(AssertionError, httpx.TransportError):  # ended already, or its service was killed
            service.post(f"/experiments/{experiment}/finish")
