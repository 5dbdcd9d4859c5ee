"""Who is on-line: in which experiment, with which role, and since when. Used from the event loop only.

Two tabs of one person are one person. Someone whose access ends is cut off here, at once, also from what they download.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime

from server.principal import Principal, Role


@dataclass(eq=False)
class Visit:
    """One open stream of someone."""

    who: Principal
    experiment_id: int
    since: datetime
    silence: float = 0.0
    """Seconds for which its network has been dead when that was noticed; see `server.stream`."""
    cut: asyncio.Event = field(default_factory=asyncio.Event)
    """Set when their access has ended: the stream is closed at once."""


@dataclass(eq=False)
class Download:
    """A table that is on its way to someone."""

    who: Principal
    cut: bool = False
    """Whether their access has ended: they get no more of it."""


@dataclass(frozen=True)
class Present:
    """Someone who is on-line in one experiment, with all their open streams together."""

    who: Principal
    since: datetime
    streams: int


Listener = Callable[[int], None]


class Presence:
    """The open streams of every experiment."""

    def __init__(self) -> None:
        self._attending: dict[int, list[Visit]] = {}
        self._downloads: set[Download] = set()
        self._listeners: list[Listener] = []

    def subscribe(self, listener: Listener) -> None:
        """Be told the experiment's id whenever someone comes or goes; a second tab of the same person is no news."""
        self._listeners.append(listener)

    @contextmanager
    def visit(self, experiment_id: int, who: Principal) -> Iterator[Visit]:
        """Be there until the block is left."""
        visit = Visit(who, experiment_id, datetime.now(UTC))
        before = self.people(experiment_id)
        self._attending.setdefault(experiment_id, []).append(visit)
        self._tell(experiment_id, before)
        try:
            yield visit
        finally:
            before = self.people(experiment_id)
            left = [each for each in self._attending[experiment_id] if each is not visit]
            if left:
                self._attending[experiment_id] = left
            else:
                del self._attending[experiment_id]
            self._tell(experiment_id, before)

    @contextmanager
    def download(self, who: Principal) -> Iterator[Download]:
        """Be sent a table until the block is left."""
        download = Download(who)
        self._downloads.add(download)
        try:
            yield download
        finally:
            self._downloads.discard(download)

    def present(self, experiment_id: int) -> list[Present]:
        """Who is there, who came first first."""
        together: dict[str, list[Visit]] = {}
        for each in self._attending.get(experiment_id, []):
            together.setdefault(each.who.name, []).append(each)
        return [
            Present(
                who=tabs[-1].who,
                since=min(tab.since for tab in tabs),
                streams=len(tabs),
            )
            for tabs in together.values()
        ]

    def people(self, experiment_id: int, at_least: Role = Role.VIEWER) -> dict[str, Role]:
        """Names and roles of who is there with this role or more; cheaper than `present`."""
        there = self._attending.get(experiment_id, [])
        return {each.who.name: each.who.role for each in there if each.who.role.covers(at_least)}

    def everywhere(self) -> dict[int, list[Present]]:
        """Who is on-line, by experiment."""
        return {experiment_id: self.present(experiment_id) for experiment_id in sorted(self._attending)}

    def streams(self) -> list[Visit]:
        """Every open stream."""
        return [each for there in self._attending.values() for each in there]

    def served(self) -> list[Principal]:
        """Whose every open stream is, and every download."""
        return [visit.who for visit in self.streams()] + [download.who for download in self._downloads]

    def cut_off(self, ended: Callable[[Principal], bool]) -> None:
        """Close the streams of those whose access has ended, and break their downloads off."""
        for visit in self.streams():
            if ended(visit.who):
                visit.cut.set()
        for download in self._downloads:
            download.cut = download.cut or ended(download.who)

    def _tell(self, experiment_id: int, before: dict[str, Role]) -> None:
        if self.people(experiment_id) != before:
            for listener in self._listeners:
                listener(experiment_id)
