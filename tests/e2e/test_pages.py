"""Both pages for everybody: forms that say what is wrong, keyboard alone, a phone's width, and no axe violation."""

from __future__ import annotations

import re
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.e2e.trainer import START_MS, Opener
from tests.live import LiveService

PHONE = {"width": 390, "height": 844}
LEAST_TARGET = 44
"""CSS pixels: the least height of a button that a thumb hits (WCAG 2.5.5)."""


def accessible(page: Page) -> None:
    """Axe finds nothing wrong with the page as it is shown now."""
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()


FITS = "() => document.documentElement.scrollWidth <= document.documentElement.clientWidth"


def fits(page: Page) -> None:
    """Wait until nothing sticks out sideways: a chart takes a frame to follow a new width."""
    page.wait_for_function(FITS)


def tab_to(page: Page, selector: str) -> None:
    """Press Tab until the focus is on the first element that matches."""
    for _ in range(60):
        page.keyboard.press("Tab")
        if page.evaluate("s => document.activeElement?.matches(s) ?? false", selector):
            return
    raise AssertionError(f"Tab never reached {selector}")


def test_the_form_of_a_new_experiment_says_what_is_wrong(page: Page, service: LiveService) -> None:
    page.goto(service.url)
    page.get_by_test_id("new").click()
    form = page.locator("form")
    form.get_by_label("Name").fill("")
    form.get_by_label("Seed", exact=True).fill("-3")
    form.get_by_test_id("create").click()
    for label in ("Name", "Seed"):
        field = form.get_by_label(label, exact=True)
        expect(field).to_have_attribute("aria-invalid", "true")
        error = (field.get_attribute("aria-describedby") or "").split()[0]
        expect(page.locator(f"[id='{error}']")).not_to_be_empty()
    assert page.url.endswith("/new")

    form.get_by_label("Name").fill("Made in the browser")
    form.get_by_label("Seed", exact=True).fill("3")
    form.get_by_label("Algorithm").select_option("scripted")
    form.get_by_label("Robot", exact=True).select_option("kinematic")
    form.get_by_test_id("create").click()
    page.wait_for_url(re.compile(r"/experiments/\d+$"))
    expect(page.get_by_role("heading", name="Made in the browser")).to_be_visible()
    made = service.get(page.url.removeprefix(service.url))
    assert (made["seed"], made["algorithm"], made["adapter"]) == (3, "scripted", "kinematic")


def test_an_experiment_that_does_not_exist_says_so(page: Page, service: LiveService) -> None:
    page.goto(f"{service.url}/experiments/999999")
    expect(page.get_by_role("alert")).to_contain_text("There is no experiment 999999.")
    page.evaluate("localStorage.setItem('seed.language', 'de')")
    page.reload()
    expect(page.get_by_role("alert")).to_contain_text("Experiment 999999 gibt es nicht.")
    page.evaluate("localStorage.setItem('seed.language', 'en')")
    page.goto(f"{service.url}/nowhere")
    expect(page.get_by_role("heading")).to_have_text("There is no such page")


def test_colours_and_language_are_chosen_and_remembered(page: Page, service: LiveService) -> None:
    page.emulate_media(color_scheme="dark")
    page.goto(service.url)
    body = page.locator("body")
    dark = body.evaluate("body => getComputedStyle(body).backgroundColor")
    page.get_by_test_id("preferences").click()
    page.get_by_test_id("theme-light").check(force=True)  # the input lies invisibly over its label
    page.get_by_label("Language").select_option("de")
    expect(page.locator("html")).to_have_attribute("lang", "de")
    accessible(page)
    page.get_by_test_id("preferences-done").click()
    page.reload()
    expect(page.get_by_role("heading", name="Experimente")).to_be_visible()
    assert body.evaluate("body => getComputedStyle(body).backgroundColor") != dark


def test_everything_works_by_keyboard_alone(page: Page, service: LiveService) -> None:
    experiment = service.experiment(adapter="kinematic", name="By keyboard", preset="stubborn")
    page.goto(service.url)
    expect(page.get_by_role("link", name="By keyboard", exact=True)).to_be_visible()
    tab_to(page, f"a[href='/experiments/{experiment}']")
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("start")).to_be_enabled()
    tab_to(page, "[data-testid=start]")
    page.keyboard.press("Enter")
    views = page.get_by_test_id("views")
    expect(views).to_have_attribute("data-proposal-id", re.compile(r"\d+"), timeout=START_MS)
    first = views.get_attribute("data-proposal-id")
    expect(views).to_have_attribute("data-ready", "true")
    page.keyboard.press("3")
    expect(views).not_to_have_attribute("data-proposal-id", str(first))
    expect(views).to_have_attribute("data-proposal-id", re.compile(r"\d+"))
    second = views.get_attribute("data-proposal-id")
    tab_to(page, "[data-testid=bad]")
    expect(views).to_have_attribute("data-ready", "true")
    page.keyboard.press("Space")
    expect(views).not_to_have_attribute("data-proposal-id", str(second))
    for mode in ("propose_only", "execute_approved"):
        tab_to(page, f"[data-testid=mode-{mode}]")
        page.keyboard.press("Enter")
        if mode == "execute_approved":
            tab_to(page, "[data-testid=mode-confirm]")
            page.keyboard.press("Enter")
        expect(page.get_by_test_id(f"mode-{mode}")).to_have_attribute("aria-pressed", "true")
        stored = service.get(f"/experiments/{experiment}")
        assert (stored["mode"], stored["counters"]["feedback"]) == (mode, 2)
    tab_to(page, "[data-testid=pause]")
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("lifecycle")).to_have_text("paused")
    expect(page.get_by_test_id("resume")).to_be_enabled()
    tab_to(page, "[data-testid=finish]")
    page.keyboard.press("Enter")
    page.keyboard.press("Escape")  # once closes the question, and stops nothing
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(page.get_by_test_id("halted")).to_have_count(0)
    expect(page.get_by_test_id("finish")).to_be_focused()
    page.keyboard.press("Enter")
    tab_to(page, "[data-testid=finish-confirm]")
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("lifecycle")).to_have_text("finished")
    assert service.get(f"/experiments/{experiment}")["counters"]["bad"] == 2


def test_a_phone_shows_everything_within_its_width(page: Page, opener: Opener, service: LiveService) -> None:
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    fits(page)
    for name in ("good", "neutral", "bad", "halt"):
        button = page.get_by_test_id(name)
        expect(button).to_be_in_viewport(ratio=1)
        box = button.bounding_box()
        assert box is not None
        assert box["height"] >= LEAST_TARGET
    trainer.click(-1)
    trainer.drawn(proposal)
    page.goto(service.url)
    expect(page.get_by_test_id("experiment").first).to_be_visible()
    fits(page)
    page.get_by_test_id("new").click()
    expect(page.get_by_test_id("create")).to_be_visible()
    fits(page)


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_axe_finds_no_violation(
    page: Page, opener: Opener, service: LiveService, colours: Literal["light", "dark"]
) -> None:
    page.emulate_media(color_scheme=colours)
    trainer = opener(start=False, preset="stubborn")
    accessible(page)
    trainer.test_id("start").click()
    proposal = trainer.drawn()
    trainer.press(-1)
    trainer.drawn(proposal)
    trainer.looked_at()
    for button in ("good", "neutral", "bad"):
        trainer.test_id(button).hover()
        accessible(page)
    trainer.test_id("finish").click()
    expect(page.get_by_role("dialog")).to_be_visible()
    accessible(page)
    trainer.test_id("cancel").click()
    trainer.test_id("halt").click()
    expect(trainer.test_id("halted")).to_be_visible()
    accessible(page)
    page.goto(service.url)
    expect(page.get_by_test_id("experiment").first).to_be_visible()
    accessible(page)
    page.get_by_test_id("new").click()
    page.get_by_label("Name").fill("")
    page.get_by_test_id("create").click()
    expect(page.get_by_role("alert").first).to_be_visible()
    accessible(page)
    page.goto(f"{service.url}/nowhere")
    expect(page.get_by_role("heading")).to_have_text("There is no such page")
    accessible(page)
