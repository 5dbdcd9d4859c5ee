"""Every page there is: nothing that axe objects to, all of it reached by keyboard, and no word to any other server."""

from __future__ import annotations

import re
from typing import Literal
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect

from tests.e2e.test_pages import FITS, PHONE, accessible
from tests.e2e.test_research import taught
from tests.live import ROOT, LiveService

ENTRY = ROOT / "web" / "src" / "App.tsx"
PATHS = {
    "list": "/",
    "new": "/experiments/new",
    "judge": "/experiments/{id}",
    "practice": "/experiments/{id}/practice",
    "results": "/experiments/{id}/results",
    "gallery": "/experiments/{id}/gallery",
    "critic": "/experiments/{id}/critic",
    "cameras": "/experiments/{id}/cameras",
    "episode": "/experiments/{id}/episodes/1",
    "compare": "/compare?experiment={id}",
    "studies": "/studies",
    "nowhere": "/nowhere",
}

REACHED = """
() => {
  const shown = (element) => element.checkVisibility({visibilityProperty: true}) && !element.closest('[inert]');
  const all = [...document.querySelectorAll('a[href], button, input, select, summary, [tabindex="0"]')];
  window.wanted = new Set(all.filter((each) => shown(each) && !each.disabled && each.tabIndex >= 0
    && (each.type !== 'radio' || each.checked)));
  document.activeElement?.blur();
  addEventListener('focusin', (event) => window.wanted.delete(event.target));
  return window.wanted.size;
}
"""


@pytest.fixture(scope="module")
def experiment(service: LiveService) -> int:
    """An experiment with something on each of its pages."""
    service.ensure()
    return taught(service, 12, name="On every page")


def test_every_page_of_the_code_is_looked_at() -> None:
    loaded = set(re.findall(r"pages/(\w+)Page\"", ENTRY.read_text("utf-8")))
    assert loaded == {
        "Cameras", "Compare", "Critic", "Episode", "Experiments", "Gallery", "NewExperiment", "People", "Practice",
        "Results", "SignIn", "Studies", "Study", "Trainer",
    }  # fmt: skip


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_no_page_breaks_a_rule_or_asks_another_server(
    page: Page, service: LiveService, experiment: int, colours: Literal["light", "dark"]
) -> None:
    foreign: set[str] = set()
    home = urlsplit(service.url).netloc

    def note(address: str) -> None:
        parts = urlsplit(address)
        if parts.scheme in ("http", "https", "ws", "wss") and parts.netloc != home:
            foreign.add(address)

    page.on("request", lambda request: note(request.url))
    page.on("websocket", lambda socket: note(socket.url))
    page.emulate_media(color_scheme=colours)
    for path in PATHS.values():
        page.goto(service.url + path.format(id=experiment))
        expect(page.locator("h1").first).to_be_visible()
        expect(page.get_by_role("status", name="Loading")).to_have_count(0)
        accessible(page)
        page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
        page.wait_for_function(FITS)
        page.set_viewport_size({"width": 1280, "height": 800})
    assert not foreign
    sheets = page.evaluate("[...document.styleSheets].flatMap((s) => [...s.cssRules]).map((r) => r.cssText).join('')")
    assert "http" not in re.sub(r"http://www\.w3\.org/\S+", "", sheets)


@pytest.mark.parametrize("name", sorted(set(PATHS) - {"nowhere", "practice"}))
def test_everything_on_a_page_is_reached_by_tab(page: Page, service: LiveService, experiment: int, name: str) -> None:
    page.goto(service.url + PATHS[name].format(id=experiment))
    expect(page.locator("h1").first).to_be_visible()
    expect(page.get_by_role("status", name="Loading")).to_have_count(0)
    count = page.evaluate(REACHED)
    assert count > 2
    for _ in range(2 * count + 40):  # lists that scroll take the focus too, and so does the browser itself
        page.keyboard.press("Tab")
        if not page.evaluate("window.wanted.size"):
            return
    left = page.evaluate("[...window.wanted].filter((each) => each.isConnected).map((each) => each.outerHTML)")
    assert left == []
