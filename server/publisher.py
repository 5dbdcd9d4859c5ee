"""Who is told what happens: the stream, or in a headless run a progress bar."""

from __future__ import annotations

from typing import Protocol

from server.messages import FrameHeader, StreamEvent


class Publisher(Protocol):
    """Takes events in their order. Neither method waits for anybody or raises."""

    shows_frames: bool
    """Whether live pictures are of any use; where not, none are rendered."""

    def publish(self, experiment_id: int, event: StreamEvent) -> None:
        """Tell all viewers of an experiment."""

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        """Show all viewers a live picture; one that comes too late for a viewer is left out."""
