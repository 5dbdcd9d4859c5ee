"""Off-line for longer than anybody waits: the network is gone without a word, and what was clicked meanwhile isn't."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect

from tests.cable import Cable
from tests.e2e.trainer import ONE_KEPT, START_MS, TrainerPage
from tests.live import LiveService, running_service, wait_for

VANISH = 1.0


@pytest.fixture
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveService]:
    """One that finds a dead connection within two seconds, by the protocol's pings."""
    with running_service(tmp_path_factory.mktemp("offline"), SEED_PING_INTERVAL="1") as live:
        yield live


@contextmanager
def _bob(
    browser: Browser, arguments: dict[str, Any], service: LiveService, experiment: int
) -> Iterator[tuple[TrainerPage, Cable, int]]:
    """Bob before the first proposal of an experiment, the cable of his browser, and that proposal's id."""
    cable = Cable(service.port)
    context = browser.new_context(**arguments | {"base_url": cable.url})
    context.add_init_script("localStorage.setItem('seed.trainer', 'bob')")
    try:
        bob = TrainerPage(context.new_page(), service, experiment)
        bob.page.goto(f"{cable.url}{bob.path}")
        bob.connected()
        service.post(f"{bob.path}/start")
        first = bob.drawn()
        bob.looked_at()
        yield bob, cable, first
    finally:
        context.close()
        cable.close()


def test_who_has_vanished_clicks_on_and_each_click_is_stored_once_when_the_network_is_back(
    browser: Browser, browser_context_args: dict[str, Any], service: LiveService
) -> None:
    experiment = service.experiment(
        adapter="kinematic", num_envs=2, preset="stubborn", together={"vanish_seconds": VANISH}
    )
    with _bob(browser, browser_context_args, service, experiment) as (bob, cable, first):
        opened = wait_for(lambda: _open(service, bob, 2), "a proposal of each robot", START_MS / 1000)
        (second,) = opened - {first}

        cable.pull()
        # nobody tells the page: it finds out by its own heartbeat, and the service by its pings
        bob.disconnected()
        wait_for(lambda: _people(service, bob) == [], "the service to notice", START_MS / 1000)
        bob.press(-1)
        expect(bob.connection).to_contain_text(ONE_KEPT)
        bob.test_id(f"robot-{service.get(f'/proposals/{second}')['robot'] + 1}").click()
        expect(bob.views).to_have_attribute("data-proposal-id", str(second))
        bob.press(-1)
        expect(bob.connection).to_contain_text("2")
        # no longer asked: another one is there alone, and judges what bob had before him
        _vanished(service, bob)
        answer = service.post(f"/proposals/{first}/feedback", _click("ann"))
        assert answer["status"] == "stored"

        cable.plug_in()
        bob.connected()
        bob.told("came too late")
        wait_for(lambda: len(_rows(service, bob)) == 3, "every click")
        assert _rows(service, bob) == [
            (first, "ann", "stored"),
            (first, "bob", "late"),
            (second, "bob", "stored"),
        ]
        bob.page.get_by_role("button", name="In turn").click()
        assert bob.drawn(max(opened)) > max(opened)


@pytest.mark.long
def test_thirty_seconds_off_line_with_the_settings_that_everybody_has(
    browser: Browser, browser_context_args: dict[str, Any], tmp_path: Path
) -> None:
    with running_service(tmp_path) as service:
        experiment = service.experiment(adapter="kinematic", preset="stubborn", aggregation="majority")
        with _bob(browser, browser_context_args, service, experiment) as (bob, cable, first):
            cable.pull()
            pulled = time.monotonic()
            bob.disconnected()
            bob.press(-1)
            expect(bob.connection).to_contain_text(ONE_KEPT)
            wait_for(lambda: _people(service, bob) == [], "the service to notice", START_MS / 1000)
            noticed = time.monotonic() - pulled
            _vanished(service, bob)
            wait_for(lambda: time.monotonic() > pulled + 30, "thirty seconds to be over", 60)
            cable.plug_in()
            bob.connected()
            wait_for(lambda: _rows(service, bob) == [(first, "bob", "stored")], "the click, once")
            assert bob.drawn(first) > first
            print(f"noticed after {noticed:.1f} s")


def _open(service: LiveService, page: TrainerPage, count: int) -> set[int] | None:
    found = {each["id"] for each in service.get(f"{page.path}/proposals")["items"] if each["closed_at"] is None}
    return found if len(found) == count else None


def _people(service: LiveService, page: TrainerPage) -> list[Any]:
    people: list[Any] = service.get(f"{page.path}/people")["items"]
    return people


def _vanished(service: LiveService, page: TrainerPage) -> None:
    """Wait until what is open is nobody's: the one who was there is waited for no longer."""

    def nobodys() -> bool:
        found = service.get(f"{page.path}/proposals")["items"]
        return all(each["electorate"] == [] for each in found if each["closed_at"] is None)

    wait_for(nobodys, "bob to be out of the electorate", START_MS / 1000)


def _click(trainer: str) -> dict[str, Any]:
    return {"click_id": "click-of-another", "value": -1, "trainer": trainer}


def _rows(service: LiveService, page: TrainerPage) -> list[tuple[int, str, str]]:
    query = (
        "SELECT proposal_id, trainer.name, status FROM feedback JOIN trainer ON trainer.id = trainer_id"
        " WHERE experiment_id = ? ORDER BY feedback.id"
    )
    return [(row[0], row[1], row[2]) for row in service.rows(query, page.experiment)]
