"""The newest events of one experiment's stream, numbered, so that a viewer who was away hears what it missed."""

from __future__ import annotations

from collections import deque

from server.messages import StreamEvent


class Backlog:
    """Remembers the last `limit` events: as text where somebody has listened, which no garbage collection looks at."""

    def __init__(self, limit: int) -> None:
        self._events: deque[StreamEvent | str] = deque(maxlen=limit)
        self.newest = 0
        """Number of the last event; 0 before the first."""

    def add(self, event: StreamEvent) -> StreamEvent:
        """The event with its number."""
        self.newest += 1
        numbered = event.model_copy(update={"seq": self.newest})
        self._events.append(numbered)
        return numbered

    def put_into_words(self, text: str) -> None:
        """Keep the last event as its text (JSON, with every name)."""
        self._events[-1] = text

    def since(self, number: int) -> list[StreamEvent | str] | None:
        """Every event after that number, in order; None where some of them are forgotten, or never were."""
        missed = self.newest - number
        if not 0 <= missed <= len(self._events):
            return None
        return list(self._events)[len(self._events) - missed :]
