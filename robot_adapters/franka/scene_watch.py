"""Whether the scene is as the picture shows it that people judge, and why not, from one look at it to the next."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from robot_adapters.base import SceneChanged, SceneUnclear

LOOK_AGAIN = 2.0
"""s between two looks at a scene that people judge: what is hidden counts as lost after three."""


class SceneWatch:
    """What came of the newest look."""

    def __init__(self) -> None:
        self.trouble: SceneUnclear | None = None
        """Why the scene can't be acted on as the picture shows it; None where it can."""
        self._looked_at = -math.inf

    @property
    def told(self) -> tuple[Literal["clear", "changed", "unclear"], str]:
        """How it is, and why, as telemetry has it."""
        if self.trouble is None:
            return "clear", ""
        return "changed" if isinstance(self.trouble, SceneChanged) else "unclear", str(self.trouble)

    def must_be_clear(self) -> None:
        """See that it was so at the newest look.

        Raises:
            SceneUnclear: it wasn't.
        """
        if self.trouble is not None:
            raise self.trouble

    def is_due(self) -> bool:
        """Whether it is time for another look; if so, the time counts from now."""
        due = time.monotonic() - self._looked_at > LOOK_AGAIN
        self._looked_at = time.monotonic() if due else self._looked_at
        return due

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Keep what comes of the look inside."""
        try:
            yield
        except SceneUnclear as unclear:
            self.trouble = unclear
            raise
        self.trouble = None
