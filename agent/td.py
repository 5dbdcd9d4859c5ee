"""What learners from reward share: targets of temporal differences, slow target networks, transitions, and a schedule.

Shapes: B transitions, K skills, E critics.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

Float32 = NDArray[np.float32]

INITIAL_CAPACITY = 1024


def targets(rewards: Tensor, terminated: Tensor, next_values: Tensor, discount: float) -> Tensor:
    """(B,) r + discount * V(s') where the episode goes on, r where it came to its end.

    terminated: (B,) 1 where the task ended at s' (it was solved), 0 anywhere else. An episode that is only cut short by
    its horizon isn't terminated: more would have come, so s' (the last state before the reset) still counts.
    """
    return rewards + discount * (1.0 - terminated) * next_values


def soft_value(values: Tensor, log_density: Tensor, temperature: Tensor) -> Tensor:
    """SAC's V(s) = Q(s, u) - alpha log pi(u|s) for a drawn u: (B,), (B,) -> (B,)."""
    return values - temperature * log_density


def soft_skill_value(
    values: Tensor,
    log_probabilities: Tensor,
    parameter_log_probabilities: Tensor,
    skill_temperature: Tensor,
    parameter_temperature: Tensor,
) -> Tensor:
    """MAPLE's V(s) = sum_a pi(a|s) [Q(s, a, x_a) - alpha_s log pi(a|s) - alpha_p log pi(x_a|s, a)], exact over skills.

    values, parameter_log_probabilities: (K, B) for x_a drawn by each skill's actor. log_probabilities: (B, K). -> (B,)
    """
    inside = soft_value(values, parameter_log_probabilities, parameter_temperature)
    return (log_probabilities.exp() * soft_value(inside.T, log_probabilities, skill_temperature)).sum(dim=1)


@torch.no_grad()
def copy_weights(slow: nn.Module, fast: nn.Module) -> None:
    """Make every weight of `slow` that of `fast`."""
    follow(slow, fast, 1.0)


@torch.no_grad()
def follow(slow: nn.Module, fast: nn.Module, rate: float) -> None:
    """Polyak averaging: each weight of `slow` goes the share `rate` of the way to that of `fast`."""
    for behind, ahead in zip(slow.parameters(), fast.parameters(), strict=True):
        behind.lerp_(ahead, rate)


class Memory:
    """The newest `capacity` records in arrays that double until they are that long; then the oldest is overwritten.

    widths: length of each column's vectors by name; 0 for a number.
    """

    def __init__(self, capacity: int, **widths: int) -> None:
        self.capacity = capacity
        self.size = 0
        self._next = 0
        first = min(capacity, INITIAL_CAPACITY)
        self._columns: dict[str, Float32] = {
            name: np.zeros((first, width) if width else (first,), dtype=np.float32) for name, width in widths.items()
        }

    def add(self, **values: Float32 | float) -> None:
        """Take one record: a value for every column."""
        if self._next == len(next(iter(self._columns.values()))):
            self._grow()
        for name, column in self._columns.items():
            column[self._next] = values[name]
        self.size = max(self.size, self._next + 1)
        self._next = (self._next + 1) % self.capacity

    def column(self, name: str) -> Float32:
        """(size, ...) every record's value of one column, in the order they are stored."""
        return self._columns[name][: self.size]

    def sample(self, size: int, rng: np.random.Generator) -> dict[str, Tensor]:
        """Draw `size` records uniformly, with replacement.

        Raises:
            ValueError: nothing is held.
        """
        return self.rows(rng.integers(self.size, size=size))

    def rows(self, rows: NDArray[np.int64]) -> dict[str, Tensor]:
        """These records, by column."""
        return {name: torch.from_numpy(column[rows]) for name, column in self._columns.items()}

    def contents(self) -> tuple[int, dict[str, Float32]]:
        """Where the next record goes, and the columns: what `restored` takes."""
        return self._next, {name: self.column(name) for name in self._columns}

    def restored(self, at: int, columns: Mapping[str, Float32]) -> Memory:
        """A memory like this one that holds those columns.

        Raises:
            KeyError: a column is missing.
            ValueError: the columns are longer than the capacity, of unequal length, or of other widths.
        """
        new = Memory(self.capacity)
        new._columns = {name: np.array(columns[name], dtype=np.float32) for name in self._columns}
        lengths = {len(column) for column in new._columns.values()}
        widths = [column.shape[1:] for column in new._columns.values()]
        new.size, new._next = max(lengths), at
        if len(lengths) != 1 or widths != [column.shape[1:] for column in self._columns.values()]:
            raise ValueError(f"transitions of lengths {sorted(lengths)} and widths {widths}")
        fits = at == new.size if new.size < self.capacity else new.size == self.capacity and 0 <= at < self.capacity
        if not fits:
            raise ValueError(f"{new.size} transitions, the next at {at}, for a replay of {self.capacity}")
        if not new.size:
            new._columns = {name: np.zeros_like(column) for name, column in self._columns.items()}
        return new

    def _grow(self) -> None:
        for name, column in self._columns.items():
            more = min(len(column), self.capacity - len(column))
            self._columns[name] = np.concatenate([column, np.zeros((more, *column.shape[1:]), dtype=np.float32)])


@dataclass
class Schedule:
    """`gradient_steps` owed every `train_frequency` observations, from the first after `warm_up` on."""

    gradient_steps: int
    train_frequency: int
    warm_up: int
    seen: int = field(default=0)
    owed: int = field(default=0)

    def observed(self) -> None:
        """One more observation."""
        self.seen += 1
        if self.seen > self.warm_up and (self.seen - self.warm_up) % self.train_frequency == 0:
            self.owed += self.gradient_steps

    def stepped(self) -> None:
        """One gradient step was taken."""
        self.owed = max(0, self.owed - 1)
