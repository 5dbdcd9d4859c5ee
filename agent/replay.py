"""The balanced replay: labels by ascending id, drawn half good and half bad (paper, "Balanced replay buffer")."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Float32 = NDArray[np.float32]
Int64 = NDArray[np.int64]
"""A float32 array, ready for a network."""

NO_KEYPOINTS = (0, 0, 3)

INITIAL_CAPACITY = 1024
RECENT = 512
"""How many of the newest labels are looked at when a proposal is made."""


@dataclass(frozen=True)
class Entry:
    """A label as the networks see it.

    state: (n,) scaled. skill: index. parameters: (P,) in [-1, 1], padded with 0. value: -1, 0 or +1.
    target: what the critic regresses: the value, less the affordance penalty where it applies.
    keypoints: (K, M, 3) m, robot base frame, of each skill; empty where no setting asks for them.
    trainer: as in `agent.algorithm.Label`.
    """

    id: int
    state: Float32
    skill: int
    parameters: Float32
    value: int
    target: float
    keypoints: Float32 = field(default_factory=lambda: np.zeros(NO_KEYPOINTS, dtype=np.float32))
    trainer: int = 0


@dataclass(frozen=True)
class Batch:
    """B entries as arrays: states (B, n), skills (B,), parameters (B, P), targets (B,), keypoints (B, K, M, 3) m."""

    states: Float32
    skills: NDArray[np.int64]
    parameters: Float32
    targets: Float32
    keypoints: Float32

    @staticmethod
    def joined(batches: Sequence[Batch]) -> Batch:
        """One after another in one."""
        if len(batches) == 1:
            return batches[0]
        names = [field.name for field in dataclasses.fields(Batch)]
        return Batch(**{name: np.concatenate([getattr(batch, name) for batch in batches]) for name in names})

    def split(self, count: int) -> list[Batch]:
        """So many of equal size, as they were `joined`."""
        named = {field.name: np.split(getattr(self, field.name), count) for field in dataclasses.fields(self)}
        return [Batch(**{name: parts[at] for name, parts in named.items()}) for at in range(count)]


Believed = Callable[[Batch, NDArray[np.int8], Int64], NDArray[np.int8]]
"""B labels, their values (B,) and whose they are (B,) -> the values that they are believed to mean (B,)."""


def shares(counts: Mapping[int, int], size: int) -> dict[int, int]:
    """How many of a batch of `size` (at least 4) are drawn of each value, given how many labels there are of each.

    Neutral labels get the share they have among all labels, at least one and leaving room for the others. The rest is
    half good and half bad; where only one of these exists it takes the whole rest.
    """
    total = sum(counts.values())
    judged = counts[1] + counts[-1]
    neutral = 0
    if counts[0]:
        neutral = min(max(1, round(size * counts[0] / total)), size - 2) if judged else size
    rest = size - neutral
    if not judged:
        good = 0
    elif not counts[1] or not counts[-1]:
        good = rest if counts[1] else 0
    else:
        good = rest // 2
    return {1: good, 0: neutral, -1: rest - good}


class Replay:
    """Labels in arrays allocated ahead, doubled when full.

    Always in ascending order of id, so what `sample` draws depends on the labels held and the random state only, not
    on the order of arrival, undone labels or a restart.
    """

    def __init__(
        self,
        state_size: int,
        parameter_size: int,
        keypoints: tuple[int, ...] = NO_KEYPOINTS,
        *,
        balanced: bool = True,
        believed: Believed | None = None,
    ) -> None:
        """balanced: whether `sample` keeps to `shares`; otherwise every label is as likely.

        believed: what the newest `RECENT` labels count as, in view of each other; None takes each at its word.
        """
        self._balanced, self._believed = balanced, believed
        self._size = 0
        self._room: tuple[NDArray[Any], ...] = (
            np.zeros(INITIAL_CAPACITY, dtype=np.int64),
            np.zeros((INITIAL_CAPACITY, state_size), dtype=np.float32),
            np.zeros(INITIAL_CAPACITY, dtype=np.int64),
            np.zeros((INITIAL_CAPACITY, parameter_size), dtype=np.float32),
            np.zeros(INITIAL_CAPACITY, dtype=np.int8),
            np.zeros(INITIAL_CAPACITY, dtype=np.int64),
            np.zeros(INITIAL_CAPACITY, dtype=np.float32),
            np.zeros((INITIAL_CAPACITY, *keypoints), dtype=np.float32),
        )
        self._begin_at(0)
        self._by_value: dict[int, NDArray[np.int64]] | None = None
        self._means: NDArray[np.int8] | None = None

    def __len__(self) -> int:
        return self._size

    def __contains__(self, label_id: int) -> bool:
        at = self._position(label_id)
        return at < self._size and int(self._ids[at]) == label_id

    def counts(self) -> dict[int, int]:
        """How many labels of each value are held."""
        return {value: len(rows) for value, rows in self._rows().items()}

    def add(self, entry: Entry) -> None:
        """Take one label.

        Raises:
            ValueError: its id is held already, or its value is none of -1, 0, +1.
        """
        if entry.id in self:
            raise ValueError(f"label {entry.id} is held already")
        if entry.value not in (-1, 0, 1):
            raise ValueError(f"value is {entry.value}, not -1, 0 or 1")
        if self._size == len(self._ids):
            self._grow()
        at = self._position(entry.id)
        if at < self._size:
            for column in self._columns():
                column[at + 1 : self._size + 1] = column[at : self._size]
        self._ids[at] = entry.id
        self._states[at] = entry.state
        self._skills[at] = entry.skill
        self._parameters[at] = entry.parameters
        self._values[at] = entry.value
        self._trainers[at] = entry.trainer
        self._targets[at] = entry.target
        self._keypoints[at] = entry.keypoints
        self._size += 1
        self._by_value = self._means = None

    def empty(self) -> Replay:
        """Another one of the same widths, with nothing in it."""
        return Replay(self._states.shape[1], self._parameters.shape[1], self._keypoints.shape[1:])

    def take(self, other: Replay) -> None:
        """Take all labels of another replay of the same widths at once: moves every row once, whatever the order.

        Where all of them are older than those held, or newer, only theirs are moved.

        Raises:
            ValueError: one of its ids is held already; nothing was taken.
        """
        ids, theirs = self._ids[: self._size], other._ids[: other._size]
        at = np.searchsorted(ids, theirs)
        inside = at < len(ids)
        if (held := theirs[inside][ids[at[inside]] == theirs[inside]]).size:
            raise ValueError(f"label {held[0]} is held already")
        if len(ids) and len(theirs) and theirs[-1] < ids[0]:
            self._put_before(other)
            return
        before, self._size = self._size, self._size + other._size
        while self._size > len(self._ids):
            self._grow()
        for column, added in zip(self._columns(), other._columns(), strict=True):
            column[before : self._size] = added[: other._size]
        if inside.any():  # some are older than the newest held
            order = np.argsort(self._ids[: self._size], kind="stable")
            for column in self._columns():
                column[: self._size] = column[: self._size][order]
        self._by_value = self._means = None

    def forget(self, label_id: int) -> None:
        """Take a label out; an unknown id is ignored."""
        if label_id not in self:
            return
        at = self._position(label_id)
        for column in self._columns():
            column[at : self._size - 1] = column[at + 1 : self._size]
        self._size -= 1
        self._by_value = self._means = None

    def clear(self) -> None:
        """Take every label out."""
        self._size = 0
        self._by_value = self._means = None

    def sample(self, size: int, rng: np.random.Generator) -> Batch:
        """Draw `size` labels with replacement, in the proportions of `shares` where it is balanced.

        Raises:
            ValueError: the replay is empty.
        """
        if not self._size:
            raise ValueError("the replay is empty")
        if not self._balanced:
            return self._batch(rng.integers(self._size, size=size))
        rows = self._rows()
        wanted = shares({value: len(found) for value, found in rows.items()}, size)
        drawn = np.concatenate(
            [found[rng.integers(len(found), size=wanted[value])] for value, found in rows.items() if wanted[value]]
        )
        return self._batch(drawn)

    def good(self) -> Batch:
        """The newest labels that said good, `RECENT` at most."""
        return self._batch(self._rows()[1][-RECENT:])

    def bad(self) -> Batch:
        """Those of the newest `RECENT` labels that said bad."""
        return self._batch(self._rows()[-1][-RECENT:])

    def refused(self, state: Float32, tolerance: float) -> Batch:
        """Those of the newest `RECENT` labels that said bad in this state (n,), give or take.

        A single one that the others outvote is let pass, so that the call is asked about again; two are not. Neutral
        ones say nothing of the call: they put it off, and count only until the next label that is not neutral.
        """
        recent = np.arange(max(0, self._size - RECENT), self._size)
        here = np.abs(self._states[recent] - state).max(axis=1, initial=0.0) <= tolerance
        values = self._values[recent]
        decided = np.logical_or.accumulate(values[::-1] != 0)[::-1]
        rows = recent[here & ((values < 0) | ~decided)]
        outvoted = self._meanings()[rows] > 0
        return self._batch(rows if np.count_nonzero(outvoted) > 1 else rows[~outvoted])

    def _batch(self, rows: NDArray[np.int64]) -> Batch:
        said = self._said(rows)
        if self._believed is None:
            return said
        return dataclasses.replace(said, targets=said.targets + (self._meanings()[rows] - self._values[rows]))

    def _said(self, rows: NDArray[np.int64]) -> Batch:
        """Labels at their word."""
        return Batch(
            self._states[rows], self._skills[rows], self._parameters[rows], self._targets[rows], self._keypoints[rows]
        )

    def _meanings(self) -> NDArray[np.int8]:
        """(N,) what each label is believed to mean."""
        if self._believed is None:
            return self._values[: self._size]
        if self._means is None:
            newest = np.arange(max(0, self._size - RECENT), self._size)
            self._means = self._values[: self._size].copy()
            self._means[newest] = self._believed(self._said(newest), self._values[newest], self._trainers[newest])
        return self._means

    def _rows(self) -> dict[int, NDArray[np.int64]]:
        """Row numbers by what the labels mean."""
        if self._by_value is None:
            means = self._meanings()
            self._by_value = {value: np.flatnonzero(means == value) for value in (1, 0, -1)}
        return self._by_value

    def _position(self, label_id: int) -> int:
        return int(np.searchsorted(self._ids[: self._size], label_id))

    def _columns(self) -> tuple[NDArray[Any], ...]:
        return (
            self._ids,
            self._states,
            self._skills,
            self._parameters,
            self._values,
            self._trainers,
            self._targets,
            self._keypoints,
        )

    def _put_before(self, other: Replay) -> None:
        """Take labels that are all older than those held."""
        # what the newest mean doesn't depend on older ones, once there are as many of them as are looked at
        means = self._means if self._believed is not None and self._size >= RECENT else None
        if self._first < other._size:
            self._make_room(before=max(other._size, self._size), behind=0)
        self._begin_at(self._first - other._size)
        self._size += other._size
        for column, added in zip(self._columns(), other._columns(), strict=True):
            column[: other._size] = added[: other._size]
        self._by_value = None
        self._means = None if means is None else np.concatenate([other._values[: other._size], means])

    def _grow(self) -> None:
        self._make_room(before=0, behind=len(self._ids))

    def _make_room(self, *, before: int, behind: int) -> None:
        """Room for so many more labels older and newer than those held."""
        held, first = self._columns(), self._first + before
        self._room = tuple(
            np.zeros((before + len(old) + behind, *old.shape[1:]), dtype=old.dtype) for old in self._room
        )
        self._begin_at(first)
        for column, old in zip(self._columns(), held, strict=True):
            count = min(self._size, len(old))
            column[:count] = old[:count]  # no more than these: what isn't written takes no memory

    def _begin_at(self, first: int) -> None:
        """Have the columns begin at this row of the room."""
        self._first = first
        (
            self._ids,
            self._states,
            self._skills,
            self._parameters,
            self._values,
            self._trainers,
            self._targets,
            self._keypoints,
        ) = (column[first:] for column in self._room)
