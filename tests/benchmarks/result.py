"""What a benchmark says: a value, the baseline measured in the same run, and the bar."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Result:
    """One line of `make bench`. `ok` is None where the benchmark only informs; `lines` are printed for a reader."""

    name: str
    value: float
    unit: str
    baseline: float | None = None
    bar: float | None = None
    ok: bool | None = None
    lines: tuple[str, ...] = field(default=())
