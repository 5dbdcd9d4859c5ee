"""What one trainer has done in an experiment, in figures: pure functions over everybody's clicks."""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime

from server.models import COUNTING
from server.reliability import CORRECT, OTHER
from server.schemas_quality import Estimate, Share, TrainerFigures

PAUSE = 60.0
"""Seconds between two clicks after which a trainer was away."""
TOLD_IN = 5
"""A trainer is told of known answers in steps of so many: nobody finds out which proposal was one."""
UNKNOWN = Estimate(accuracy=None, interval=None, informative=0, weight=CORRECT / (CORRECT + OTHER), at=None)

_OF_VERDICT = {"good": 1, "neutral": 0, "bad": -1}


@dataclass(frozen=True)
class Click:
    """A click that wasn't taken back. value: as clicked; label: as it is now; None: can't tell."""

    proposal: int
    trainer: int
    name: str
    kind: str
    value: int | None
    label: int | None
    status: str
    at: datetime
    relabelled: bool
    verdict: str | None
    known_answer: int | None


def figures(clicks: Sequence[Click], estimates: Mapping[int, Estimate], *, own: bool = False) -> list[TrainerFigures]:
    """Everybody's, by name. own: as each may see their own, so that no single click turns out to be a known answer."""
    mine: defaultdict[int, list[Click]] = defaultdict(list)
    theirs: defaultdict[int, list[Click]] = defaultdict(list)
    for click in clicks:
        if click.status != "practice":
            mine[click.trainer].append(click)
            theirs[click.proposal].append(click)
    made = [_figures(by, theirs, None if own else estimates.get(who, UNKNOWN)) for who, by in mine.items()]
    return sorted(made, key=lambda each: (each.kind, each.trainer))


def nothing_yet(name: str) -> TrainerFigures:
    """One's own figures before the first click."""
    none = Share(count=0, of=0)
    counts = dict.fromkeys(("labels", "good", "neutral", "bad", "cant_tell", "late", "relabelled", "streak"), 0)
    shares = dict.fromkeys(("with_verdicts", "with_others", "gold"), none)
    return TrainerFigures.model_validate(
        {"trainer": name, "kind": "person", "per_minute": None, "estimate": None, **counts, **shares}
    )


def _figures(own: Sequence[Click], all_of: Mapping[int, Sequence[Click]], estimate: Estimate | None) -> TrainerFigures:
    counted = [click for click in own if click.status in COUNTING]
    labels = [click.label for click in counted if click.label is not None]
    gold = [click.value == click.known_answer for click in own if click.known_answer is not None]
    told = gold[: len(gold) // TOLD_IN * TOLD_IN] if estimate is None else gold
    shared = [click for click in own if click.value is not None and len(all_of[click.proposal]) > 1]
    judged = [click for click in shared if click.verdict is not None]
    pairs = [
        click.value == other.value
        for click in shared
        for other in all_of[click.proposal]
        if other.trainer != click.trainer and other.value is not None
    ]
    return TrainerFigures(
        trainer=own[0].name,
        kind="teacher" if own[0].kind == "teacher" else "person",
        labels=len(labels),
        good=labels.count(1),
        neutral=labels.count(0),
        bad=labels.count(-1),
        cant_tell=len(counted) - len(labels),
        late=len(own) - len(counted),
        relabelled=sum(click.relabelled for click in own),
        per_minute=_pace([click.at for click in own]),
        with_verdicts=Share(count=sum(map(_agrees, judged)), of=len(judged)),
        with_others=Share(count=sum(pairs), of=len(pairs)),
        gold=Share(count=sum(told), of=len(told)),
        streak=_streak(counted, all_of),
        estimate=estimate,
    )


def _agrees(click: Click) -> bool:
    return click.verdict is not None and _OF_VERDICT[click.verdict] == click.value


def _streak(counted: Sequence[Click], all_of: Mapping[int, Sequence[Click]]) -> int:
    length = 0
    for click in reversed(counted):
        if click.value is None:
            continue
        alone = len(all_of[click.proposal]) == 1 or click.verdict is None
        if click.label != click.value or not (alone or _agrees(click)):
            break
        length += 1
    return length


def _pace(times: Sequence[datetime]) -> float | None:
    """Clicks a minute while at work; None before there are two in a row."""
    gaps = [(after - before).total_seconds() for before, after in itertools.pairwise(times)]
    worked = [gap for gap in gaps if gap <= PAUSE]
    return 60 * len(worked) / sum(worked) if sum(worked) > 0 else None
