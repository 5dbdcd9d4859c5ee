"""At a real arm, simulated here: an operator says on the page that they are there, judges, and brings the arm home."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import expect

from tests.e2e.trainer import START_MS, Opener
from tests.live import wait_for
from tests.robot_adapters.franka.conftest import APART, BLOCKS, TABLE
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import UNHURRIED

pytestmark = pytest.mark.simulated_arm


@pytest.fixture
def lab() -> Iterator[SimulatedFranka]:
    with SimulatedFranka(table=TABLE, blocks=BLOCKS) as simulated:
        simulated.tell(place=APART)
        yield simulated


@pytest.mark.parametrize("backend", ["franka_rs", pytest.param("franky", marks=pytest.mark.long)])
def test_an_operator_attends_judges_and_brings_the_arm_home(backend: str, opener: Opener, lab: SimulatedFranka) -> None:
    settings = {
        "host": lab.host,
        "backend": backend,
        "realtime": False,
        "dead_man": UNHURRIED,
        "eyes": "onlooker",
        "eyes_settings": {"host": lab.host},
    }
    trainer = opener(adapter="franka", adapter_settings=settings, start=False)
    trainer.service.http.patch(f"/api/v1{trainer.path}", json={"mode": "execute_approved"})
    trainer.test_id("start").click()
    first = trainer.drawn()
    panel = trainer.test_id("operator")
    panel.locator("summary").first.click()
    expect(trainer.test_id("arm-state")).to_have_attribute("data-mode", "idle", timeout=START_MS)
    expect(trainer.test_id("attended-by")).to_contain_text("Nobody")
    trainer.test_id("attend").check()
    expect(trainer.test_id("attended-by")).to_contain_text("attends the robot")

    trainer.press(1)
    expect(trainer.test_id("arm-state")).to_have_attribute("data-mode", "moving", timeout=START_MS)
    second = trainer.drawn(first)
    assert trainer.stored(second)["skill"] == "place"
    trainer.press(1)
    wait_for(lambda: trainer.service.get(trainer.path)["lifecycle"] == "paused", "the end of the episode", 60)

    lab.tell(user_stop=True)
    expect(trainer.test_id("arm-state")).to_have_attribute("data-mode", "user_stopped", timeout=START_MS)
    lab.tell(user_stop=False)
    trainer.test_id("home").click()
    wait_for(lambda: abs(lab.truth()["tip"][0] - 0.307) < 0.01, "the arm to come home", 60)
    trainer.test_id("attend").uncheck()
    expect(trainer.test_id("attended-by")).to_contain_text("Nobody")
