"""What each trainer has done in an experiment, in figures: pure functions over everybody's clicks, as columns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from server.agreement import how_many
from server.reliability import CORRECT, OTHER
from server.schemas_quality import Estimate, Share, TrainerFigures

PAUSE = 60.0
"""Seconds between two clicks after which a trainer was away."""
TOLD_IN = 50
"""A trainer is told of known answers in steps of so many clicks: nobody finds out which of them was one."""
UNKNOWN = Estimate(accuracy=None, interval=None, informative=0, weight=CORRECT / (CORRECT + OTHER), at=None)
NOTHING = 2
"""In a column of -1, 0 and +1: there is none."""

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
Small = NDArray[np.int8]


@dataclass(frozen=True)
class Person:
    """Who clicks; a teacher may have a person's name."""

    name: str
    kind: str


@dataclass(frozen=True)
class Clicks:
    """Those that weren't taken back, without practice, in the order they came: (N,) each.

    proposal, trainer: ids. value: as clicked; label: as it is now; verdict, known: the proposal's; each -1, 0, +1 or
    `NOTHING`. counted: not late. word: the trainer's one word on the proposal, see `store_clicks.words`. at:
    microseconds since the epoch.
    """

    proposal: Ints
    trainer: NDArray[np.int32]
    value: Small
    label: Small
    counted: Bools
    word: Bools
    relabelled: Bools
    verdict: Small
    known: Small
    at: Ints


@dataclass(frozen=True)
class Figures:
    """By kind and name. own: as each may see their own, so that no single click turns out to be a known answer."""

    everybodys: list[TrainerFigures]
    own: list[TrainerFigures]


def figures(clicks: Clicks, people: Mapping[int, Person], estimates: Mapping[int, Estimate]) -> Figures:
    """Of everybody who has clicked. people: by id, and estimates, where there are any."""
    if not len(clicks.trainer):
        return Figures([], [])
    trainers, who = np.unique(clicks.trainer, return_inverse=True)
    _, item = np.unique(clicks.proposal, return_inverse=True)
    says = clicks.word & (clicks.value != NOTHING)
    judged = (np.bincount(item[clicks.word])[item] > 1) & (clicks.verdict != NOTHING)
    agrees = clicks.verdict == clicks.value
    contradicted = (clicks.label != clicks.value) | (judged & ~agrees)
    alike, others = _others(item[says], who[says], clicks.value[says], len(trainers))
    counts: dict[str, Ints] = {
        "good": np.bincount(who[clicks.counted & (clicks.label == 1)], minlength=len(trainers)),
        "neutral": np.bincount(who[clicks.counted & (clicks.label == 0)], minlength=len(trainers)),
        "bad": np.bincount(who[clicks.counted & (clicks.label == -1)], minlength=len(trainers)),
        "cant_tell": np.bincount(who[clicks.counted & (clicks.label == NOTHING)], minlength=len(trainers)),
        "late": np.bincount(who[~clicks.counted], minlength=len(trainers)),
        "relabelled": np.bincount(who[clicks.relabelled], minlength=len(trainers)),
    }
    made = Figures([], [])
    for n, (trainer, mine) in enumerate(zip(trainers.tolist(), _by(who, len(trainers)), strict=True)):
        known = (clicks.word & (clicks.known != NOTHING))[mine]
        hits = (clicks.value == clicks.known)[mine]
        told = slice(len(mine) // TOLD_IN * TOLD_IN)
        numbers: dict[str, Any] = {name: int(column[n]) for name, column in counts.items()}
        person = people[trainer]
        full = TrainerFigures(
            trainer=person.name,
            kind="teacher" if person.kind == "teacher" else "person",
            labels=numbers["good"] + numbers["neutral"] + numbers["bad"],
            **numbers,
            per_minute=_pace(clicks.at[mine]),
            with_verdicts=_share(agrees[mine[(says & judged)[mine]]]),
            with_others=Share(count=int(alike[n]), of=int(others[n])),
            gold=_share(hits[known]),
            streak=_streak(contradicted[mine[(says & clicks.counted)[mine]]]),
            estimate=estimates.get(trainer, UNKNOWN),
        )
        made.everybodys.append(full)
        made.own.append(full.model_copy(update={"gold": _share(hits[told][known[told]]), "estimate": None}))
    for each in (made.everybodys, made.own):
        each.sort(key=lambda one: (one.kind, one.trainer))
    return made


def nothing_yet(name: str) -> TrainerFigures:
    """One's own figures before the first click."""
    none = Share(count=0, of=0)
    counts = dict.fromkeys(("labels", "good", "neutral", "bad", "cant_tell", "late", "relabelled", "streak"), 0)
    shares = dict.fromkeys(("with_verdicts", "with_others", "gold"), none)
    return TrainerFigures.model_validate(
        {"trainer": name, "kind": "person", "per_minute": None, "estimate": None, **counts, **shares}
    )


def _by(who: Ints, trainers: int) -> list[Ints]:
    """Which clicks are each trainer's, in the order they came."""
    return np.split(np.argsort(who, kind="stable"), np.cumsum(np.bincount(who, minlength=trainers))[:-1])


def _others(item: Ints, who: Ints, value: Small, trainers: int) -> tuple[Ints, Ints]:
    """By trainer: how much of what others said of the same proposals agrees with their one word, and how much it is."""
    everybodys = how_many(item, value)
    alike = everybodys[item, value + 1] - 1
    others = everybodys.sum(axis=1)[item] - 1
    return _summed(who, alike, trainers), _summed(who, others, trainers)


def _summed(who: Ints, what: Ints, trainers: int) -> Ints:
    return np.bincount(who, weights=what, minlength=trainers).astype(np.int64)


def _share(hits: Bools) -> Share:
    return Share(count=int(hits.sum()), of=len(hits))


def _streak(contradicted: Bools) -> int:
    """How many of the newest ones aren't."""
    return int(contradicted[::-1].argmax()) if contradicted.any() else len(contradicted)


def _pace(at: Ints) -> float | None:
    """Clicks a minute while at work; None before there are two in a row."""
    gaps = np.diff(at) / 1e6
    worked = gaps[gaps <= PAUSE]
    return float(60 * len(worked) / worked.sum()) if worked.sum() > 0 else None
