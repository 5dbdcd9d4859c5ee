"""What a researcher does in the browser: finds, tags, clones and compares experiments, and reads their live charts."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, expect

from tests.e2e.test_pages import PHONE, accessible, fits
from tests.e2e.trainer import START_MS
from tests.live import LiveService, wait_for

SMALL = {"hidden_size": 16, "batch_size": 16}


def taught(service: LiveService, until: int, **fields: Any) -> int:
    """An experiment that a teacher has judged so often, on a table without physics; paused."""
    body = {"adapter": "kinematic", "algorithm": "seed", "settings": SMALL, "teacher": "synthetic"} | fields
    experiment = service.experiment(**body)
    service.post(f"/experiments/{experiment}/start")
    judged_until(service, experiment, until)
    service.post(f"/experiments/{experiment}/pause")
    return experiment


def judged_until(service: LiveService, experiment: int, count: int) -> None:
    """Wait for so many labels."""
    wait_for(
        lambda: service.get(f"/experiments/{experiment}")["counters"]["feedback"] >= count, "the teacher", timeout=90
    )


def test_experiments_are_found_tagged_cloned_and_compared(page: Page, service: LiveService) -> None:
    service.ensure()
    made = [taught(service, 12, name=f"sought {n}", seed=n, tags=["sought"]) for n in range(2)]
    other = service.experiment(name="something else", adapter="kinematic")
    page.goto(service.url)
    rows = page.get_by_test_id("experiment")
    expect(page.locator(f"[data-id='{other}']")).to_be_visible()
    page.get_by_test_id("search").fill("SOUGHT")
    expect(rows).to_have_count(2)
    page.get_by_test_id("sort-name").click()
    expect(rows.first).to_have_attribute("data-id", str(made[0]))
    page.get_by_test_id("sort-name").click()
    expect(rows.first).to_have_attribute("data-id", str(made[1]))
    page.reload()  # the address says what is looked for
    expect(rows).to_have_count(2)
    expect(rows.first).to_have_attribute("data-id", str(made[1]))

    rows.first.get_by_test_id("edit-tags").click()
    page.get_by_label("New tag").fill("best")
    page.keyboard.press("Enter")
    expect(rows.first.get_by_role("button", name="Only with the tag best")).to_be_visible()
    assert service.get(f"/experiments/{made[1]}")["tags"] == ["best", "sought"]
    page.keyboard.press("Escape")
    rows.first.get_by_role("button", name="Only with the tag best").click()
    expect(rows).to_have_count(1)
    page.get_by_test_id("narrow-task").select_option("reaching")
    expect(page.get_by_test_id("none-such")).to_be_visible()
    accessible(page)
    page.goto(f"{service.url}/?text=sought")
    expect(rows).to_have_count(2)
    for row in rows.all():
        row.get_by_role("checkbox").check()
    accessible(page)
    page.get_by_test_id("compare").click()
    chart = page.get_by_test_id("chart-successes")
    expect(chart.get_by_text("sought 0")).to_be_visible()
    page.get_by_test_id("by-algorithm").click()
    expect(chart.get_by_text("mean of 2")).to_be_visible()
    expect(page.get_by_test_id("compared")).to_contain_text("seed")
    page.get_by_test_id("measure").select_option("success_rate")
    page.get_by_test_id("paper").select_option("stacking")
    expect(page.get_by_test_id("paper-note")).to_contain_text("Hiranaka")
    expect(page.get_by_test_id("chart-success_rate").get_by_text("SEED, paper")).to_be_visible()
    accessible(page)

    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    fits(page)
    page.goto(f"{service.url}/?text=sought")
    page.get_by_test_id("clone").first.click()
    page.get_by_test_id("create").click()
    page.wait_for_url(re.compile(r"/experiments/\d+$"))
    clone = service.get(page.url.removeprefix(service.url))
    model = service.get(f"/experiments/{made[1]}")
    kept = ("task", "adapter", "algorithm", "preset", "settings", "teacher", "seed", "tags")
    assert {key: clone[key] for key in kept} == {key: model[key] for key in kept}


def test_settings_come_from_the_schema_and_only_what_differs_is_sent(page: Page, service: LiveService) -> None:
    service.ensure()
    page.goto(f"{service.url}/experiments/new")
    page.get_by_label("Algorithm").select_option("seed")
    page.get_by_label("Preset").select_option("paper_real")
    page.get_by_label("Robot", exact=True).select_option("kinematic")
    part = page.get_by_test_id("part-settings")
    part.locator("summary").click()
    batch = page.get_by_test_id("setting-batch_size")
    expect(batch.locator("input")).to_have_value("1024")
    expect(batch).to_contain_text("labels in one gradient step")
    expect(batch).to_contain_text("[4, 65536]")
    batch.locator("input").fill("3")
    page.get_by_test_id("create").click()
    expect(batch.get_by_role("alert")).to_contain_text("greater than or equal to 4")
    accessible(page)
    batch.locator("input").fill("1024")
    page.get_by_test_id("setting-critics").locator("input").fill("3")
    with page.expect_request(lambda request: request.method == "POST") as sent:
        page.get_by_test_id("create").click()
    body: dict[str, Any] = sent.value.post_data_json or {}
    assert (body["preset"], body["settings"], body["adapter_settings"]) == ("paper_real", {"critics": 3}, {})
    page.wait_for_url(re.compile(r"/experiments/\d+$"))
    made = service.get(page.url.removeprefix(service.url))
    assert (made["settings"]["critics"], made["settings"]["batch_size"]) == (3, 1024)


def test_charts_grow_while_somebody_looks_and_are_zoomed_and_downloaded(
    page: Page, service: LiveService, tmp_path: Path
) -> None:
    service.ensure()
    experiment = taught(service, 25, name="Charted")
    page.goto(f"{service.url}/experiments/{experiment}/results")
    chart = page.get_by_test_id("chart-successes")
    plot = chart.get_by_role("img")
    expect(plot).to_have_attribute("data-points", re.compile(r"^\d{2,}$"))
    for name in ("good_share", "critic_loss", "estimates", "estimate_error", "temperatures", "skills"):
        expect(page.get_by_test_id(f"chart-{name}")).to_be_visible()
    accessible(page)
    before = int(plot.get_attribute("data-points") or 0)
    service.post(f"/experiments/{experiment}/resume")
    judged_until(service, experiment, before + 10)
    service.post(f"/experiments/{experiment}/finish")
    page.wait_for_function(
        "least => Number(document.querySelector('[data-testid=chart-successes] [role=img]').dataset.points) > least",
        arg=before,
        timeout=START_MS,
    )
    chart.get_by_test_id("zoom-in").click()
    expect(plot).to_have_attribute("data-zoomed", "true")
    chart.get_by_test_id("zoom-reset").click()
    expect(plot).to_have_attribute("data-zoomed", "false")
    page.get_by_test_id("smoothing").fill("0.6")
    files = {}
    for form in ("csv", "svg", "png"):
        chart.get_by_test_id("download").click()
        with page.expect_download() as coming:
            chart.get_by_test_id(f"download-{form}").click()
        files[form] = tmp_path / f"chart.{form}"
        coming.value.save_as(files[form])
        assert coming.value.suggested_filename == f"experiment-{experiment}-successes.{form}"
    rows = list(csv.reader(files["csv"].read_text("utf-8").splitlines()))
    assert rows[0] == ["feedback", "successes", "executions"]
    assert len(rows) > before
    assert files["svg"].read_text("utf-8").startswith("<svg")
    assert files["png"].read_bytes().startswith(b"\x89PNG")


def test_the_past_is_looked_through_and_replayed_by_keyboard_while_nothing_runs(
    page: Page, service: LiveService
) -> None:
    service.ensure()
    experiment = taught(service, 12, name="Remembered")
    service.post(f"/experiments/{experiment}/finish")
    page.goto(f"{service.url}/experiments/{experiment}/gallery")
    items = page.get_by_test_id("gallery-item")
    told = service.get(f"/experiments/{experiment}/history?limit=200")["items"]
    expect(items).to_have_count(min(100, len(told)))
    expect(page.get_by_test_id("timeline")).to_be_visible()
    accessible(page)
    bad = [entry for entry in told if entry["proposal"]["verdict"] == "bad"]
    page.get_by_test_id("narrow-verdict").select_option("bad")
    expect(items).to_have_count(min(100, len(bad)))
    page.get_by_test_id("narrow-violation").select_option("true")
    expect(page.get_by_test_id("no-proposals")).to_be_visible()

    number = bad[0]["proposal"]["number"]
    episode = bad[0]["proposal"]["episode"]
    page.goto(f"{service.url}/experiments/{experiment}/gallery?verdict=bad")
    items.first.focus()
    page.keyboard.press("Enter")
    page.wait_for_url(re.compile(rf"/episodes/{episode}\?proposal={number}$"))
    replay = page.get_by_test_id("replay")
    expect(replay).to_have_attribute("data-stage", "proposed")
    expect(page.get_by_role("heading", name=f"Proposal {number}")).to_be_visible()
    expect(page.get_by_test_id("replay-verdict")).to_have_count(0)
    page.keyboard.press("ArrowRight")
    expect(replay).to_have_attribute("data-stage", "judged")
    expect(page.get_by_test_id("replay-verdict")).to_contain_text("bad")
    page.keyboard.press("Home")
    expect(replay).to_have_attribute("data-at", "0")
    accessible(page)
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    fits(page)
    page.goto(f"{service.url}/experiments/{experiment}/episodes/999")
    expect(page.get_by_role("alert")).to_contain_text("999")


def test_what_the_critic_thinks_is_drawn_beside_what_was_said(page: Page, service: LiveService) -> None:
    service.ensure()
    experiment = taught(service, 12, name="Thoughtful")
    page.goto(f"{service.url}/experiments/{experiment}/critic")
    picture = page.get_by_test_id("critic-picture")
    expect(picture).to_have_attribute("data-source", "learner", timeout=START_MS)
    expect(picture.get_by_text("block a")).to_be_visible()
    page.get_by_test_id("critic-skill").select_option("place")
    expect(page.get_by_role("img", name=re.compile("Table from above: expected feedback for place"))).to_be_visible()
    held = page.get_by_test_id("held-z")
    before = held.input_value()
    held.focus()
    page.keyboard.press("ArrowRight")
    assert held.input_value() != before
    with page.expect_response(lambda answer: "other=z" in answer.url) as told:
        page.keyboard.press("ArrowRight")
    assert told.value.status == 200
    picture.hover()
    expect(page.get_by_test_id("critic-read")).to_contain_text("x 0.")
    accessible(page)
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    fits(page)
    quiet = service.experiment(adapter="kinematic", name="Silent", teacher="synthetic")
    service.post(f"/experiments/{quiet}/start")
    judged_until(service, quiet, 2)
    service.post(f"/experiments/{quiet}/finish")
    page.goto(f"{service.url}/experiments/{quiet}/critic")
    expect(page.get_by_test_id("critic-problem")).to_contain_text("Scripted: this algorithm can't", timeout=START_MS)
