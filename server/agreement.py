"""How far trainers agree: Krippendorff's alpha over good, neutral and bad, whoever judged what."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import krippendorff
import numpy as np

VALUES = (-1, 0, 1)
"""In their order: bad and good are further apart than either is from neutral."""


@dataclass(frozen=True)
class Agreement:
    """alpha: 1 is perfect, 0 what chance gives, negative worse; None where `why` says that it can't be told.

    proposals: those that two or more trainers judged; labels: their labels; trainers: whose.
    """

    alpha: float | None
    proposals: int
    labels: int
    trainers: int
    why: str | None = None


def agreement(clicks: Mapping[int, Mapping[int, int]]) -> Agreement:
    """Ordinal alpha of proposal -> trainer -> value. Who can't tell, or wasn't there, is missing."""
    pairable = [values for values in clicks.values() if len(values) > 1]
    trainers = sorted({trainer for values in pairable for trainer in values})
    labels = sum(map(len, pairable))
    why = _why_not(pairable)
    if why is not None:
        return Agreement(None, len(pairable), labels, len(trainers), why)
    counts = np.array([[Counter(values.values())[value] for value in VALUES] for values in pairable])
    alpha = krippendorff.alpha(value_counts=counts, value_domain=VALUES, level_of_measurement="ordinal")
    return Agreement(float(alpha), len(pairable), labels, len(trainers))


def _why_not(pairable: Sequence[Mapping[int, int]]) -> str | None:
    if not pairable:
        return "no proposal was judged by two trainers yet"
    if len({value for values in pairable for value in values.values()}) < 2:
        return "all labels are the same: whether that is agreement or habit can't be told"
    return None
