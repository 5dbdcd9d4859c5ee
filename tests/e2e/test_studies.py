"""The pages of studies: what to do where there is none, and one that another process works on, live."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from agent.study.figures import write_figures
from agent.study.results import write_results
from tests.e2e.test_pages import PHONE, accessible, fits
from tests.live import LiveService
from tests.server.study_folder import begun, evaluate, plan


def test_a_study_is_watched_live(page: Page, own_service: LiveService) -> None:
    page.goto(own_service.url)
    page.get_by_role("link", name="Studies").click()
    expect(page.get_by_test_id("no-studies")).to_contain_text("seed study paper-sim")
    accessible(page)

    folder = begun(own_service.data_dir / "studies" / "mine")
    with folder.worked_on():
        expect(page.get_by_test_id("study")).to_contain_text("running")
        page.get_by_role("link", name="mine").click()
        expect(page.get_by_role("heading", name="mine")).to_be_visible()
        second = page.locator("[data-id='first_subgoal-seed-11']")
        expect(second).to_contain_text("25 %")
        chart = page.get_by_test_id("study-chart")
        expect(chart).to_have_attribute("data-points", "5")
        expect(page.get_by_test_id("scenario")).to_contain_text("SEED (1 of 2 seeds)")
        expect(chart.locator("canvas")).to_be_visible()
        expect(page.get_by_test_id("scenario")).to_contain_text("MAPLE-aff, paper")

        evaluate(folder, "first_subgoal-seed-11", [3, 8, 9], "finished")
        expect(second).to_have_attribute("data-state", "finished")
        expect(second).to_contain_text("90 %")
        expect(page.get_by_test_id("scenario")).to_contain_text("SEED (2 seeds)")
    expect(page.get_by_test_id("study-state").first).to_have_text("interrupted")
    expect(page.get_by_text("--resume")).to_be_visible()

    write_results(folder, plan())
    write_figures(folder, plan())
    figure = page.get_by_role("img", name="Figure first_subgoal.png")
    expect(figure).to_be_visible()
    assert figure.evaluate("image => image.decode().then(() => image.naturalWidth)") > 500
    with page.expect_download() as download:
        page.get_by_role("link", name="first_subgoal.svg").click()
    assert download.value.suggested_filename == "first_subgoal.svg"
    accessible(page)
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    fits(page)

    page.goto(f"{own_service.url}/studies/other")
    expect(page.get_by_role("alert")).to_contain_text("other")
