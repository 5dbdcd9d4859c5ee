"""Every page there is: nothing that axe objects to, all of it reached by keyboard, and no word to any other server."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect

from agent.study.figures import write_figures
from agent.study.results import write_results
from tests.e2e.test_pages import PHONE, accessible, fits
from tests.e2e.test_research import taught
from tests.live import ROOT, LiveService, running_service
from tests.server.study_folder import begun, plan

ENTRY = ROOT / "web" / "src" / "App.tsx"
DESK = {"width": 1440, "height": 900}
PATHS = {
    "sign_in": "/join",
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
    "study": "/studies/mine",
    "people": "/people",
    "nowhere": "/nowhere",
}
LOADING = ".skeleton[role=status]"

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
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveService]:
    """A service that asks who is there, with a study and somebody who is invited: something for every page."""
    with running_service(tmp_path_factory.mktemp("service"), SEED_LOGIN="1") as live:
        live.sign_in()
        folder = begun(live.data_dir / "studies" / "mine")
        write_results(folder, plan())
        write_figures(folder, plan())
        for name, role in (("Ann", "trainer"), ("Vic", "viewer")):
            made = live.post("/invitations", {"role": role, "note": "for the tests of every page", "uses": 2})
            live.post("/sign-in", {"token": made["token"], "name": name, "bearer": True})
        yield live
        live.stop()


@pytest.fixture(scope="module")
def experiment(service: LiveService) -> int:
    """An experiment with something on each of its pages."""
    return taught(service, 12, name="On every page")


@pytest.fixture
def owner(page: Page, service: LiveService) -> Page:
    """Somebody who may see every page."""
    token = service.http.headers["Authorization"].removeprefix("Bearer ")
    answer = page.request.post(f"{service.url}/api/v1/sign-in", data={"token": token})
    assert answer.ok
    return page


def test_every_page_of_the_code_is_looked_at() -> None:
    loaded = set(re.findall(r"pages/(\w+)Page\"", ENTRY.read_text("utf-8")))
    assert loaded == {
        "Cameras", "Compare", "Critic", "Episode", "Experiments", "Gallery", "NewExperiment", "People", "Practice",
        "Results", "SignIn", "Studies", "Study", "Trainer",
    }  # fmt: skip


@pytest.mark.parametrize(("colours", "language"), [("light", "en"), ("dark", "de")])
def test_no_page_breaks_a_rule_or_asks_another_server(
    owner: Page, service: LiveService, experiment: int, colours: Literal["light", "dark"], language: str
) -> None:
    """German is the language with the longest words."""
    page, foreign, broken = owner, set[str](), list[str]()
    home = urlsplit(service.url).netloc

    def note(address: str) -> None:
        parts = urlsplit(address)
        if parts.scheme in ("http", "https", "ws", "wss") and parts.netloc != home:
            foreign.add(address)

    page.on("request", lambda request: note(request.url))
    page.on("websocket", lambda socket: note(socket.url))
    page.on("pageerror", lambda error: broken.append(f"{page.url}: {error}"))
    page.emulate_media(color_scheme=colours)
    page.add_init_script(f"localStorage.setItem('seed.language', '{language}')")
    for path in PATHS.values():
        page.set_viewport_size(DESK)  # type: ignore[arg-type]
        page.goto(service.url + path.format(id=experiment))
        expect(page.locator("h1").first).to_be_visible()
        expect(page.locator(LOADING)).to_have_count(0)
        expect(page.locator("html")).to_have_attribute("lang", language)
        accessible(page)
        fits(page)
        page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
        fits(page)
    assert not foreign
    assert not broken
    sheets = page.evaluate("[...document.styleSheets].flatMap((s) => [...s.cssRules]).map((r) => r.cssText).join('')")
    assert "http" not in re.sub(r"http://www\.w3\.org/\S+", "", sheets)


@pytest.mark.parametrize("name", sorted(set(PATHS) - {"nowhere", "practice"}))
def test_everything_on_a_page_is_reached_by_tab(owner: Page, service: LiveService, experiment: int, name: str) -> None:
    page = owner
    page.goto(service.url + PATHS[name].format(id=experiment))
    expect(page.locator("h1").first).to_be_visible()
    expect(page.locator(LOADING)).to_have_count(0)
    count = page.evaluate(REACHED)
    assert count > 1
    for _ in range(2 * count + 40):  # lists that scroll take the focus too, and so does the browser itself
        page.keyboard.press("Tab")
        if not page.evaluate("window.wanted.size"):
            return
    left = page.evaluate("[...window.wanted].filter((each) => each.isConnected).map((each) => each.outerHTML)")
    assert left == []
