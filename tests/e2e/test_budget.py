"""What the page may cost: bytes of a first load, frames until a proposal is drawn, memory over many of them.

Seconds and frames a second are measured, and held to their bars, by `python -m tests.benchmarks judging_page`, as is
memory over 2,000 proposals; nothing here asserts on a clock.
"""

from __future__ import annotations

import itertools

from playwright.sync_api import Page, Response

from tests.e2e.trainer import Opener, TrainerPage
from tests.live import LiveService

FIRST_LOAD = 250_000
"""Bytes of JavaScript, gzipped, until a proposal can be judged."""
MOST_REQUESTS = 40
"""Until a proposal can be judged: each costs a slow network or a loaded service some of the 1.5 s."""
PROPOSALS = 70
GROWTH = 1.25
"""How much larger the page's memory may be after twice as many proposals; lists that grow would double it."""

_clicks = itertools.count(1)

BEFORE_DRAWN = """
() => {
  const drawn = performance.getEntriesByName('seed:drawn').at(0).startTime;
  return performance.getEntriesByType('resource').filter((each) => each.startTime < drawn).map((each) => each.name);
}
"""
WATCH = """
() => {
  window.frames_ = 0;
  const count = () => { window.frames_ += 1; requestAnimationFrame(count); };
  requestAnimationFrame(count);
  window.arrivals = new Map();
  window.late = [];
  const views = document.querySelector('[data-testid=views]');
  new MutationObserver(() => {
    const id = document.querySelector('[data-testid=views]')?.dataset.proposalId;
    if (id && window.arrivals.has(id)) {
      window.late.push(window.frames_ - window.arrivals.get(id));
      window.arrivals.delete(id);
    }
  }).observe(document.querySelector('main'), {subtree: true, attributes: true, attributeFilter: ['data-proposal-id']});
}
"""

LISTEN = """
() => {
  const Native = WebSocket;
  window.WebSocket = class extends Native {
    constructor(...given) {
      super(...given);
      this.addEventListener('message', ({data}) => {
        if (typeof data !== 'string' || !data.includes('proposal_opened')) return;
        window.arrivals?.set(String(JSON.parse(data).proposal.id), window.frames_);
      });
    }
  };
}
"""


def test_a_first_load_stays_small(page: Page, opener: Opener) -> None:
    scripts: dict[str, int] = {}

    def weigh(response: Response) -> None:
        if response.request.resource_type == "script":
            assert response.headers["content-encoding"] == "gzip"
            scripts[response.url.rsplit("/", 1)[-1]] = int(response.headers["content-length"])

    page.on("response", weigh)
    opener(preset="stubborn").drawn()
    assert scripts
    assert sum(scripts.values()) < FIRST_LOAD, scripts
    assert not any("scene" in name for name in scripts), "three.js is for whoever asks for it"


def test_a_proposal_can_be_judged_after_few_requests(page: Page, opener: Opener) -> None:
    """What a first load waits for, counted. How long it takes is measured by `tests.benchmarks judging_page`."""
    trainer = opener(preset="stubborn", start=False)
    trainer.test_id("start").click()
    trainer.drawn()
    page.reload()
    trainer.drawn()
    before = page.evaluate(BEFORE_DRAWN)
    assert any("/images/" in each for each in before)
    assert len(before) <= MOST_REQUESTS, before


def test_the_next_proposal_is_drawn_within_a_frame_of_its_arrival(page: Page, opener: Opener) -> None:
    page.add_init_script(f"({LISTEN})()")
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    page.evaluate(WATCH)
    for _ in range(12):
        trainer.press(-1)
        proposal = trainer.drawn(proposal)
    late = page.evaluate("window.late")
    assert len(late) >= 10
    # the same scene, so its pictures are here already: only drawing is left
    assert sorted(late)[len(late) // 2] <= 1, f"frames from arrival to drawing: {late}"


def test_memory_stays_flat_over_many_proposals(page: Page, opener: Opener, service: LiveService) -> None:
    trainer = opener(preset="stubborn")
    trainer.drawn()
    judge_many(trainer, service, PROPOSALS)
    once = memory(page)
    judge_many(trainer, service, PROPOSALS)
    twice = memory(page)
    assert twice < GROWTH * once, f"{once / 1e6:.1f} MB after {PROPOSALS}, {twice / 1e6:.1f} MB after as many more"
    assert page.get_by_test_id("past").count() <= 50


def judge_many(trainer: TrainerPage, service: LiveService, count: int) -> None:
    """Click through REST, faster than anybody could; the page follows by its stream."""
    path = f"{trainer.path}/proposals?limit=1"
    last = 0
    for _ in range(count):
        newest = service.get(path)["items"][0]
        while newest["id"] == last or newest["closed_at"] is not None:
            newest = service.get(path)["items"][0]
        last = newest["id"]
        service.post(f"/proposals/{last}/feedback", {"click_id": f"budget-{next(_clicks):06}", "value": -1})
    trainer.drawn(last)


def memory(page: Page) -> float:
    """Bytes that the page's JavaScript holds after everything that can be thrown away is."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = float(session.send("Runtime.getHeapUsage")["usedSize"])
    session.detach()
    return used
