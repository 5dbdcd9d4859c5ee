"""The trainer's page as a test drives it: what is drawn, what a person presses, what the stream brought."""

from __future__ import annotations

import contextlib
import json
import re
import struct
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Locator, Page, WebSocket, expect

from tests.live import LiveService

START_MS = 60_000
"""How long the simulator may take to start on a loaded machine."""

ONE_KEPT = re.compile(r"1( click)? kept")
"""What the connection says while a click waits for it; short on a narrow screen."""

KEEP_NOTICES = """
window.told = [];
new MutationObserver(() => {
  for (const notice of document.querySelectorAll('.notice p'))
    if (!window.told.includes(notice.textContent)) window.told.push(notice.textContent);
}).observe(document, {childList: true, subtree: true});
"""
"""Keeps what notices have said on this page since it was loaded: they go by themselves."""

KEYS = {-1: ("3", "ArrowLeft"), 0: ("2", "ArrowDown"), 1: ("1", "ArrowRight")}
BUTTONS = {-1: "bad", 0: "neutral", 1: "good"}


class TrainerPage:
    """One open page of one experiment."""

    def __init__(self, page: Page, service: LiveService, experiment: int) -> None:
        self.page = page
        self.service = service
        self.experiment = experiment
        self.path = f"/experiments/{experiment}"
        self.frames: list[dict[str, Any]] = []
        """Headers of the live frames that arrived."""
        self.views = page.get_by_test_id("views")
        self.activity = page.get_by_test_id("activity")
        self.connection = page.get_by_test_id("connection")
        self.notices = page.get_by_test_id("notices")
        page.on("websocket", self._listen)
        page.add_init_script(KEEP_NOTICES)

    def _listen(self, socket: WebSocket) -> None:
        socket.on("framereceived", self._keep)

    def _keep(self, payload: str | bytes) -> None:
        if isinstance(payload, bytes):
            (length,) = struct.unpack(">I", payload[:4])
            self.frames.append(json.loads(payload[4 : 4 + length]))

    def open(self) -> TrainerPage:
        """Go there and wait until the page is in step with the service."""
        self.page.goto(self.service.url + self.path)
        self.connected()
        return self

    def connected(self) -> None:
        """Wait for the connection."""
        expect(self.connection).to_have_attribute("data-state", "open", timeout=START_MS)

    def disconnected(self) -> None:
        """Wait until the page has noticed that the connection is gone."""
        expect(self.connection).to_have_attribute("data-state", "lost", timeout=START_MS)

    def told(self, text: str) -> None:
        """Wait until a notice has said this, whether it is still there or not."""
        script = "text => window.told.some(said => said.includes(text))"
        self.page.wait_for_function(script, arg=text, timeout=START_MS)

    def test_id(self, name: str) -> Locator:
        """An element by its test id."""
        return self.page.get_by_test_id(name)

    def drawn(self, after: int | None = None, *, timeout: float = START_MS) -> int:
        """Wait until a proposal newer than `after` is drawn with its pictures; its id."""
        script = """after => {
          const id = Number(document.querySelector('[data-testid=views]')?.dataset.proposalId ?? 0);
          return id > after ? id : null;
        }"""
        return int(self.page.wait_for_function(script, arg=after or 0, timeout=timeout).json_value())

    def looked_at(self) -> None:
        """Wait until the drawn proposal was on the screen long enough for a press to count."""
        expect(self.views).to_have_attribute("data-ready", "true", timeout=START_MS)

    def press(self, value: int, *, arrow: bool = False) -> None:
        """Judge with a key, as soon as it counts."""
        self.looked_at()
        self.press_anyway(value, arrow=arrow)

    def press_anyway(self, value: int, *, arrow: bool = False) -> None:
        """Press the key whether it counts or not."""
        self.page.keyboard.press(KEYS[value][int(arrow)])

    def click(self, value: int) -> None:
        """Judge with the mouse, as soon as it counts."""
        self.looked_at()
        self.test_id(BUTTONS[value]).click()

    def escape_twice(self) -> None:
        """Stop by Escape twice; pressed again where a busy machine has taken so long over it that they were two."""
        halted = self.test_id("halted")
        for _ in range(5):
            self.page.keyboard.press("Escape")
            self.page.keyboard.press("Escape")
            with contextlib.suppress(AssertionError):
                expect(halted).to_be_visible(timeout=3000)
                return
        expect(halted).to_be_visible()

    def stored(self, proposal: int) -> dict[str, Any]:
        """The proposal as the service knows it."""
        return self.service.get(f"/proposals/{proposal}")

    def counters(self) -> dict[str, int]:
        """The experiment's counters as the service knows them."""
        return dict(self.service.get(self.path)["counters"])

    def shows_feedback(self, count: int) -> None:
        """Wait until the page counts `count` feedbacks."""
        expect(self.test_id("count-feedback")).to_have_text(str(count))


Opener = Callable[..., TrainerPage]
"""Creates an experiment (fields as in ExperimentCreate), starts it unless told not to, and opens its page."""
