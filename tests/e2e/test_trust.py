"""What a trainer sees of the critic: how sure it is, how calibrated, and what it approves in simulation by itself."""

from __future__ import annotations

import re
from typing import Any

from playwright.sync_api import Page, expect

from tests.e2e.test_pages import PHONE, accessible, fits
from tests.e2e.trainer import START_MS, Opener, TrainerPage
from tests.live import LiveService, wait_for

RULE = {"after_feedback": 20, "audit_every": 5}


def judge_all(trainer: TrainerPage, service: LiveService, count: int, value: int) -> None:
    """Judge so many proposals over the API: the page follows."""

    def waiting() -> list[dict[str, Any]]:
        newest: list[dict[str, Any]] = service.get(f"{trainer.path}/proposals?limit=1")["items"]
        return [proposal for proposal in newest if proposal["closed_at"] is None]

    for number in range(count):
        (proposal,) = wait_for(waiting, "a proposal")
        body = {"click_id": f"trust-{trainer.experiment}-{number:03}", "value": value}
        service.post(f"/proposals/{proposal['id']}/feedback", body)


def test_the_critic_is_shown_with_its_doubts_and_may_approve_once_asked_to(
    page: Page, opener: Opener, service: LiveService
) -> None:
    # sure of itself, and always wrong: every proposal is another bad one
    trainer = opener(algorithm="confident", settings={"bad_first": 1_000_000})
    trainer.drawn()
    expect(trainer.test_id("predicted-feedback")).to_have_text("+0.95")
    expect(trainer.test_id("uncertainty")).to_have_text("± 0.02")
    expect(trainer.test_id("calibration-empty")).to_have_text("Needs 20 labels; there are 0.")
    expect(trainer.test_id("auto-approval")).to_have_attribute("data-on", "false")

    # the curve comes by itself with the twentieth label: all bad, where +0.95 was predicted
    judge_all(trainer, service, 20, -1)
    trainer.shows_feedback(20)
    expect(trainer.test_id("calibration-error")).to_have_text("± 1.95")
    expect(trainer.test_id("calibration").get_by_role("img")).to_have_accessible_name(re.compile("20 labels"))

    # nothing is approved before somebody has agreed to it
    trainer.test_id("auto-approval-on").click()
    trainer.test_id("cancel").click()
    assert service.get(trainer.path)["auto_approval"] is None
    trainer.test_id("auto-approval-on").click()
    trainer.test_id("auto-approval-confirm").click()
    expect(trainer.test_id("auto-approval")).to_have_attribute("data-on", "true")
    assert service.get(trainer.path)["auto_approval"]["after_feedback"] == 50
    service.http.patch(f"/api/v1{trainer.path}", json={"auto_approval": RULE}).raise_for_status()
    trainer.press(-1)
    expect(trainer.test_id("auto-approval")).to_contain_text(re.compile(r"[1-9]\d* motions? approved by the critic"))

    # an audit waits for a trainer, who disagrees: it ends by itself
    wait_for(lambda: service.get(f"{trainer.path}/proposals?limit=1")["items"][0]["audit"], "an audit")
    expect(trainer.activity).to_contain_text("Waiting for you", timeout=START_MS)
    trainer.press(-1)
    expect(trainer.test_id("auto-approval-suspended")).to_contain_text("0 of 1")
    expect(trainer.test_id("auto-approval-on")).to_have_text("Turn on again")
    accessible(page)
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    expect(trainer.test_id("uncertainty")).to_be_visible()
    fits(page)
