"""The judging page in a browser: until it can be used, frames and long tasks while motions are watched, memory.

Each has a bar, and all of them together are what is judged.
"""

from __future__ import annotations

import gzip
import itertools
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from playwright.sync_api import Page, Response, sync_playwright

from tests.benchmarks.result import Result
from tests.live import LiveService, wait_for

BAR = 1.5
"""Seconds until a first load can be used."""
LOADS = 5
MOTIONS = 4
LEAST_RATE = 55.0
"""Frames a second while motions are watched: a screen's 60, without what the clocks disagree by."""
LONG_MS = 50
"""What a browser calls a long task; at 60 frames a second, three are lost in one. There may be none."""
FEW, MANY = 200, 2000
"""Proposals after which the page's memory is looked at."""
GROWTH = 1.25
"""How much more may be held after many than after few."""
FLAGS = ("--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update")

_clicks = itertools.count(1)

OBSERVE = """
window.since_ = Infinity;
window.long_ = [];
window.gaps_ = [];
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) if (entry.startTime >= window.since_) window.long_.push(entry.duration);
}).observe({type: 'longtask'});
let last_ = performance.now();
(function tick(now) {
  if (last_ >= window.since_) window.gaps_.push(now - last_);
  last_ = now;
  requestAnimationFrame(tick);
})(last_);
"""
TAKE = """
() => {
  const taken = [window.long_, window.gaps_];
  [window.since_, window.long_, window.gaps_] = [Infinity, [], []];
  return taken;
}
"""


@dataclass(frozen=True)
class Watched:
    """Of all motions together."""

    long: list[float]
    """Milliseconds of each task over `LONG_MS`."""
    gaps: list[float]
    """Milliseconds from each frame to the next."""

    @property
    def rate(self) -> float:
        """Frames a second over the whole time."""
        return 1000 * len(self.gaps) / sum(self.gaps)


def run() -> Result:
    """Load it several times, watch motions, let very many proposals pass; `ok` where everything keeps to its bar."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = LiveService(Path(folder) / "data")
        service.start()
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(FLAGS))
        try:
            waiting = service.experiment(adapter="kinematic", preset="stubborn")
            service.post(f"/experiments/{waiting}/start")
            first = [load(chromium.new_context().new_page(), service, waiting) for _ in range(LOADS)]
            seen = watched(chromium.new_context().new_page(), service)
            few, many = remembered(chromium.new_context().new_page(), service, waiting)
        finally:
            chromium.close()
            service.stop()
    seconds = median(s for s, _ in first)
    return Result(
        "judging_page",
        seconds,
        "s to use",
        bar=BAR,
        ok=seconds <= BAR and seen.rate >= LEAST_RATE and not seen.long and many < GROWTH * few,
        lines=(
            f"first load: {seconds:.2f} s to use, {first[0][1] / 1000:.0f} kB of scripts; at most {BAR} s",
            f"while {MOTIONS} motions are watched: {seen.rate:.1f} frames/s, at least {LEAST_RATE:.0f}"
            f" (at the median {1000 / median(seen.gaps):.0f})",
            f"tasks over {LONG_MS} ms meanwhile: {len(seen.long)}; at most none"
            f" (the longest {max(seen.long, default=0):.0f} ms)",
            f"memory: {few:.1f} MB after {FEW} proposals, {many:.1f} MB after {MANY}; less than {GROWTH} times as much",
        ),
    )


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


def watched(page: Page, service: LiveService) -> Watched:
    """Long tasks and frames while motions are streamed, from each click to the next proposal."""
    experiment = service.experiment(adapter_settings={"speed": 1.0})
    page.goto(f"{service.url}/experiments/{experiment}")
    page.evaluate(OBSERVE)
    service.post(f"/experiments/{experiment}/start")
    long: list[float] = []
    gaps: list[float] = []
    for _ in range(MOTIONS):
        page.wait_for_selector("[data-ready]", timeout=120_000)
        page.evaluate("window.since_ = performance.now()")
        page.keyboard.press("1")
        page.wait_for_selector("[data-live=true]", timeout=60_000)
        page.wait_for_selector("[data-ready]", timeout=120_000)
        for kept, taken in zip((long, gaps), page.evaluate(TAKE), strict=True):
            kept.extend(taken)
    service.post(f"/experiments/{experiment}/finish")
    page.close()
    return Watched(long, gaps)


def remembered(page: Page, service: LiveService, experiment: int) -> tuple[float, float]:
    """Megabytes that the page holds after few proposals, and after many."""
    page.goto(f"{service.url}/experiments/{experiment}")
    page.wait_for_selector("[data-proposal-id]", timeout=60_000)
    few, many = (held(page, service, experiment, count) for count in (FEW, MANY - FEW))
    page.close()
    return few, many


def held(page: Page, service: LiveService, experiment: int, count: int) -> float:
    """Megabytes after so many more proposals, each judged as soon as it is there."""
    path = f"/experiments/{experiment}/proposals?limit=1"
    for _ in range(count):
        proposal = wait_for(lambda: _open(service, path), "the next proposal")
        service.post(f"/proposals/{proposal}/feedback", {"click_id": f"page-{next(_clicks):07}", "value": -1})
    wait_for(
        lambda: page.get_attribute("[data-proposal-id]", "data-proposal-id") != str(proposal), "the page to follow"
    )
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = float(session.send("Runtime.getHeapUsage")["usedSize"]) / 1e6
    session.detach()
    return used


def _open(service: LiveService, path: str) -> int | None:
    newest = service.get(path)["items"][0]
    return int(newest["id"]) if newest["closed_at"] is None else None
