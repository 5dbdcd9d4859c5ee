"""What a trainer meets of label quality: the answer that nothing can be told, practice, and everybody's figures."""

from __future__ import annotations

import csv
import re

from playwright.sync_api import Page, expect

from tests.e2e.test_pages import PHONE, accessible, fits
from tests.e2e.trainer import KEYS, START_MS, Opener
from tests.live import LiveService, wait_for


def test_can_t_tell_brings_the_next_proposal_and_counts_as_no_feedback(opener: Opener) -> None:
    trainer = opener(mode="propose_only")
    first = trainer.drawn()
    trainer.looked_at()
    trainer.page.keyboard.press("4")
    second = trainer.drawn(first)
    trainer.looked_at()
    trainer.test_id("cant-tell").click()
    third = trainer.drawn(second)
    trainer.press(-1)
    trainer.shows_feedback(1)
    assert trainer.counters()["cant_tell"] == 2
    stored = [trainer.stored(number) for number in (first, second, third)]
    assert [(p["close_reason"], p["verdict"]) for p in stored] == [
        ("cant_tell", None),
        ("cant_tell", None),
        ("judged", "bad"),
    ]


def test_a_new_trainer_practises_by_keyboard_until_their_clicks_count(
    page: Page, opener: Opener, service: LiveService
) -> None:
    trainer = opener(mode="propose_only", practice_required={"proposals": 2, "accuracy": 1.0})
    proposal = trainer.drawn()
    trainer.press(-1)
    trainer.told("doesn't count yet")
    assert trainer.stored(proposal)["closed_at"] is None
    expect(trainer.test_id("practise-first")).to_be_visible()
    accessible(page)
    trainer.test_id("practise-first").get_by_role("link").press("Enter")

    def answer(*, right: bool) -> None:
        expect(trainer.test_id("views")).to_have_attribute("data-ready", "true", timeout=START_MS)
        card = trainer.test_id("practice").get_attribute("data-card-id")
        (row,) = service.rows("SELECT known_answer FROM practice WHERE id = ?", card)
        page.keyboard.press(KEYS[int(row["known_answer"]) * (1 if right else -1)][0])
        expect(trainer.test_id("correction")).to_have_attribute("data-right", str(right).lower())
        expect(trainer.test_id("reason")).to_contain_text(re.compile(r"comes next"))

    answer(right=False)
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    accessible(page)
    fits(page)
    for number in range(2):
        expect(trainer.test_id("next")).to_be_focused()
        page.keyboard.press("Enter")
        expect(trainer.test_id("correction")).to_have_count(0)
        answer(right=True)
        expect(trainer.test_id("score")).to_have_text(f"{number + 1} of {number + 2} right")
    expect(trainer.test_id("standing")).to_have_attribute("data-passed", "true")
    page.get_by_role("link", name="To the experiment").click()
    trainer.connected()
    expect(trainer.test_id("own-figures")).to_be_visible()
    expect(trainer.test_id("practise-first")).to_have_count(0)
    assert trainer.drawn() == proposal
    trainer.press(-1)
    trainer.shows_feedback(1)


def judged_on(service: LiveService, proposal: int) -> None:
    """Wait until the click has closed it."""
    wait_for(lambda: service.get(f"/proposals/{proposal}")["closed_at"], "the verdict")


def test_everybodys_figures_are_shown_and_taken_away_as_a_table(
    page: Page, opener: Opener, service: LiveService
) -> None:
    trainer = opener(mode="propose_only", settings={"bad_first": 1_000_000})
    for number in range(4):
        proposal = trainer.drawn()
        trainer.press(-1)
        judged_on(service, proposal)
        late = {"click_id": f"bobs-{number:05}", "value": -1 if number else 1, "trainer": "bob"}
        service.http.post(f"/api/v1/proposals/{proposal}/feedback", json=late)
        trainer.drawn(proposal)
    own = trainer.test_id("own-figures")
    expect(own).to_contain_text("75 % (3/4)", timeout=START_MS)
    table = trainer.test_id("trainers")
    expect(table.get_by_role("row")).to_have_count(3)
    expect(table.get_by_role("row", name="bob")).to_contain_text("75 % (3/4)")
    expect(trainer.test_id("agreement")).to_contain_text("from 4 proposals")
    expect(table.get_by_role("row", name="bob")).to_contain_text("labels)", timeout=START_MS)
    # the same estimate, beside who is there
    expect(trainer.test_id("judges").locator("tr", has_text="local")).to_contain_text(re.compile(r"[1-9]\d? %"))
    accessible(page)
    link = page.get_by_role("link", name="Feedback as CSV").get_attribute("href")
    rows = list(csv.DictReader(service.http.get(str(link)).text.splitlines()))
    assert [(row["trainer"], row["status"]) for row in rows][:2] == [("local", "stored"), ("bob", "late")]
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    fits(page)
    page.get_by_label("Practice before clicks count").select_option("on")
    expect(trainer.test_id("practise-first")).to_be_visible()
    page.get_by_label("Hidden known answers").select_option("0.05")
    wait_for(lambda: service.get(trainer.path)["gold_rate"] == 0.05, "the rate")
    trainer.test_id("past").first.click()
    accessible(page)
    trainer.test_id("mark-bad").click()
    trainer.told("shown again")
    (mark,) = service.rows("SELECT answer FROM gold_mark")
    assert mark["answer"] == -1
    page.keyboard.press("Escape")
    page.get_by_label("Practice before clicks count").select_option("off")
    expect(trainer.test_id("practise-first")).to_have_count(0)
