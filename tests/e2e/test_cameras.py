"""A lab with two live cameras and an arm without physics: calibrated in a browser, then judged by what they see.

The pictures are rendered and come over the network as an OpenCV device's; the arm is a Deoxys peer of our own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, ViewportSize, expect

from tests.e2e.test_pages import fits
from tests.e2e.trainer import START_MS, Opener
from tests.live import LiveService, wait_for
from tests.robot_adapters.franka.conftest import APART
from tests.robot_adapters.franka.perception.broadcasting import Lab
from tests.robot_adapters.franka.perception.poses import as_told, facing, hand

ASKED, POSES = 8, 12
"""A camera that tells nothing of its lens needs four more than one that does."""
DESK: ViewportSize = {"width": 1280, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 844}
BOTH = ("left", "right")
PATIENCE = 90.0


@pytest.fixture
def lab() -> Iterator[Lab]:
    made = Lab({name: np.array(at) for name, at in APART.items()})
    yield made
    made.close()


def taken(page: Page, count: int) -> None:
    for camera in BOTH:
        counted = page.get_by_test_id(f"guide-{camera}").get_by_test_id("taken")
        expect(counted).to_have_text(f"{count} of {POSES} poses", timeout=START_MS)


def test_cameras_are_calibrated_by_clicks_also_over_a_reload_and_on_a_phone(
    opener: Opener, lab: Lab, service: LiveService, tmp_path: Path
) -> None:
    where = tmp_path / "calibration"
    settings = lab.settings(where)
    trainer = opener(adapter="franka", adapter_settings=settings, start=False)
    page, path = trainer.page, f"/api/v1{trainer.path}/camera-calibration"
    page.set_viewport_size(DESK)
    page.goto(f"{service.url}{trainer.path}/cameras")
    page.get_by_label("Poses of each camera").fill(str(ASKED))
    page.get_by_test_id("calibrate").click()
    expect(page.get_by_test_id("guide-advice")).to_have_attribute("data-advice", "unseen", timeout=START_MS)
    early = service.http.post(f"{path}/solution")
    assert early.status_code == 409
    assert "poses" in early.json()["detail"] + early.json()["remedy"]

    rng = np.random.default_rng(5)
    eyes = [lab.views[name].eye for name in BOTH]
    for number in range(1, POSES + 1):
        held = facing(eyes, rng)
        lab.guide(hand(held), as_told(hand(held), rng))
        taken(page, number)
        if number == POSES // 2:
            page.reload()
            taken(page, number)
    expect(page.get_by_test_id("guide-advice")).to_have_attribute("data-advice", "enough")
    fits(page)
    page.get_by_test_id("guide-solve").click()
    result = page.get_by_test_id("guide-result")
    for camera in BOTH:
        expect(result.get_by_text(re.compile(rf"{camera}: \d\.\d mm off, from {POSES} poses"))).to_be_visible(
            timeout=START_MS
        )
    page.set_viewport_size(PHONE)
    page.reload()
    expect(result).to_be_visible(timeout=START_MS)
    fits(page)
    assert not list(where.glob("*.json"))
    lab.let_go()
    page.get_by_test_id("guide-store").click()
    expect(page.get_by_test_id("guide-stored")).to_be_visible(timeout=START_MS)
    assert {file.stem for file in where.glob("*.json")} == set(BOTH)
    assert service.get(f"{trainer.path}/camera-calibration") == {"step": None, "outcome": None}

    page.set_viewport_size(DESK)
    trainer.open()
    trainer.test_id("start").click()
    state = trainer.stored(trainer.drawn())["state"]
    truth = np.concatenate([lab.arm.blocks["block_a"], lab.arm.blocks["block_b"]])
    assert np.abs(np.array(state) - truth).max() < 0.006


def test_a_trainer_stacks_by_what_the_cameras_see_and_reads_what_they_dont(
    opener: Opener, lab: Lab, service: LiveService, tmp_path: Path
) -> None:
    lab.calibrate(tmp_path)
    trainer = opener(adapter="franka", adapter_settings=lab.settings(tmp_path), start=False)
    service.http.patch(f"/api/v1{trainer.path}", json={"mode": "execute_approved"})
    trainer.test_id("start").click()
    first = trainer.drawn()
    assert {view["camera"] for view in trainer.stored(first)["views"]} == set(BOTH)
    trainer.test_id("operator").locator("summary").first.click()
    trainer.test_id("attend").check()
    expect(trainer.test_id("attended-by")).to_contain_text("attends the robot")
    trainer.press(1)
    second = trainer.drawn(first)
    seen = trainer.stored(second)
    assert seen["skill"] == "place", "the eyes must have seen, or known, the block in the hand"
    assert np.abs(np.array(seen["state"][:3]) - lab.arm.blocks["block_a"]).max() < 0.02

    # hidden while it is judged: told, and even approved nothing moves by it; then it goes on by itself
    notice = trainer.test_id("scene-notice")
    lab.hide("block_b")
    expect(notice).to_have_attribute("data-scene", "unclear", timeout=START_MS)
    expect(notice).to_contain_text("block_b: not seen for")
    trainer.press(1)
    gate = wait_for(lambda: trainer.stored(second)["gate"], "the gate to decide", PATIENCE)
    assert not gate["allowed"]
    assert "block_b: not seen for" in gate["reason"]
    expect(notice).to_be_visible()
    lab.hide()
    third = trainer.drawn(second)
    expect(notice).to_have_count(0)

    # moved while it is judged: it is looked at anew, without a click
    lab.move("block_b", lab.arm.blocks["block_b"] + np.array([0.0, 0.03, 0.0]))
    fourth = trainer.drawn(third)
    assert trainer.stored(third)["close_reason"] == "withdrawn"
    moved = trainer.stored(fourth)
    assert np.abs(np.array(moved["state"][3:6]) - lab.arm.blocks["block_b"]).max() < 0.006
    (only,) = service.get(f"{trainer.path}/executions?limit=5")["items"]
    assert only["proposal_id"] == first
    assert lab.arm.held == "block_a"
    trainer.press(1)
    wait_for(lambda: service.get(trainer.path)["lifecycle"] == "paused", "the end of the episode", PATIENCE)
    last = service.get(f"{trainer.path}/executions?limit=1")["items"][0]
    assert (last["proposal_id"], last["outcome"], last["task_success"]) == (fourth, "succeeded", True)

    # hidden before there is anything to judge, and a camera that is knocked and put back
    for name, at in APART.items():
        lab.move(name, np.array(at))
    lab.hide("block_a")
    wait_for(lambda: lab.shown, "the cameras to see it", PATIENCE)
    trainer.test_id("resume").click()
    expect(notice).to_contain_text("block_a: not seen for", timeout=START_MS)
    assert service.get(trainer.path)["lifecycle"] == "running"
    lab.hide()
    fifth = trainer.drawn(fourth)
    knock = np.array([0.0, 0.02, 0.0])
    lab.push("left", knock)
    expect(notice).to_contain_text("left has moved since it was calibrated", timeout=START_MS)
    lab.push("left", -knock)
    expect(notice).to_have_count(0, timeout=START_MS)
    assert trainer.stored(fifth)["closed_at"] is None
    assert service.get(trainer.path)["lifecycle"] == "running"
