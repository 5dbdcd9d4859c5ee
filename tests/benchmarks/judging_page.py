"""The judging page in a browser: a first load until it can be used, long tasks while a motion is watched, memory."""

from __future__ import annotations

import gzip
import itertools
import shutil
import tempfile
from pathlib import Path
from statistics import median

from playwright.sync_api import Page, Response, sync_playwright

from tests.benchmarks.result import Result
from tests.live import LiveService

BAR = 1.5
"""Seconds until a first load can be used."""
LOADS = 5
PROPOSALS = 2000
LONG_MS = 50
"""What a browser calls a long task; at 60 frames a second, three are lost in one."""
FLAGS = ("--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update")

_clicks = itertools.count(1)

OBSERVE = """
window.long_ = [];
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) window.long_.push(entry.duration);
}).observe({type: 'longtask', buffered: true});
window.gaps = [];
let last_ = performance.now();
(function tick(now) { window.gaps.push(now - last_); last_ = now; requestAnimationFrame(tick); })(last_);
"""


def run() -> Result:
    """Load it several times, watch motions, and let a thousand proposals and more pass."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = LiveService(Path(folder) / "data")
        service.start()
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(FLAGS))
        try:
            waiting = service.experiment(adapter="kinematic", preset="stubborn")
            service.post(f"/experiments/{waiting}/start")
            first = [load(chromium.new_context().new_page(), service, waiting) for _ in range(LOADS)]
            lines = [f"first load: {median(s for s, _ in first):.2f} s to use, {first[0][1] / 1000:.0f} kB of scripts"]
            lines.append(watched(chromium.new_context().new_page(), service))
            lines.append(remembered(chromium.new_context().new_page(), service, waiting))
        finally:
            chromium.close()
            service.stop()
    seconds = median(s for s, _ in first)
    return Result("judging_page", seconds, "s to use", bar=BAR, ok=seconds <= BAR, lines=tuple(lines))


def load(page: Page, service: LiveService, experiment: int) -> tuple[float, int]:
    """Seconds until a proposal can be judged, and bytes of scripts, gzipped; nothing is cached."""
    weights: list[int] = []

    def weigh(response: Response) -> None:
        if response.request.resource_type == "script":
            weights.append(len(gzip.compress(response.body())))

    page.on("response", weigh)
    page.goto(f"{service.url}/experiments/{experiment}")
    page.wait_for_selector("[data-proposal-id]", timeout=60_000)
    marks = "performance.getEntriesByName('seed:drawn').at(0).startTime / 1000"
    seconds = float(page.evaluate(marks))
    page.close()
    return seconds, sum(weights)


def watched(page: Page, service: LiveService) -> str:
    """Long tasks and frame gaps while motions are streamed."""
    experiment = service.experiment(adapter_settings={"speed": 1.0})
    page.goto(f"{service.url}/experiments/{experiment}")
    page.evaluate(OBSERVE)
    service.post(f"/experiments/{experiment}/start")
    for _ in range(4):
        page.wait_for_selector("[data-ready]", timeout=120_000)
        page.evaluate("window.long_ = []; window.gaps = []")
        page.keyboard.press("1")
        page.wait_for_selector("[data-live=true]", timeout=60_000)
        page.wait_for_selector("[data-ready]", timeout=120_000)
    long, gaps = page.evaluate("[window.long_, window.gaps]")
    service.post(f"/experiments/{experiment}/finish")
    page.close()
    rate = 1000 / median(gaps)
    return f"while a motion is watched: {len(long)} tasks over {LONG_MS} ms, {rate:.0f} frames/s at the median"


def remembered(page: Page, service: LiveService, experiment: int) -> str:
    """What the page holds after some proposals, and after very many."""
    page.goto(f"{service.url}/experiments/{experiment}")
    page.wait_for_selector("[data-proposal-id]", timeout=60_000)
    held = []
    for count in (200, PROPOSALS - 200):
        for _ in range(count):
            newest = service.get(f"/experiments/{experiment}/proposals?limit=1")["items"][0]
            if newest["closed_at"] is None:
                click = {"click_id": f"page-{next(_clicks):07}", "value": -1}
                service.post(f"/proposals/{newest['id']}/feedback", click)
        session = page.context.new_cdp_session(page)
        session.send("HeapProfiler.collectGarbage")
        held.append(float(session.send("Runtime.getHeapUsage")["usedSize"]) / 1e6)
        session.detach()
    page.close()
    return f"memory: {held[0]:.1f} MB after 200 proposals, {held[1]:.1f} MB after {PROPOSALS}"
