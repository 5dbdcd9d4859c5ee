"""What is drawn while a person thinks: the next proposals, should nothing move by what they say."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Collection

from server.store_values import NewProposal


class Ahead:
    """Proposals of one robot that are being drawn, or are drawn and not yet opened."""

    def __init__(self) -> None:
        self._drawing: asyncio.Task[list[NewProposal]] | None = None

    def draw(self, draw: Callable[[], asyncio.Task[list[NewProposal]]]) -> None:
        """Draw anew; what was drawn before is dropped."""
        self.forget()
        self._drawing = draw()
        # one that fails is drawn again when it is needed, and fails there for everyone to see
        self._drawing.add_done_callback(lambda drawn: drawn.cancelled() or drawn.exception())

    def forget(self) -> None:
        """Drop it."""
        if self._drawing is not None:
            self._drawing.cancel()
        self._drawing = None

    def take(self, scenes: Collection[str]) -> NewProposal | None:
        """The next one, if it is there and of a scene (observation id) that is on the desk."""
        if self._drawing is None or not self._drawing.done() or self._drawing.cancelled():
            self.forget()
            return None
        if self._drawing.exception() is not None or not self._drawing.result():
            return None
        drawn = self._drawing.result().pop(0)
        return drawn if drawn.observation_id in scenes else None
