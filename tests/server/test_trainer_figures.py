"""Everybody's figures are counted over columns: the same as one click at a time, whatever can be said of a click."""

from __future__ import annotations

import random
from datetime import UTC, datetime, timedelta
from itertools import pairwise
from typing import Any

import krippendorff
import numpy as np
import pytest
from sqlalchemy import select
from sqlalchemy.orm import Session

from server.models import COUNTING, EpisodeRow, FeedbackRow, ObservationRow, ProposalRow, RelabelRow, TrainerRow
from server.models_quality import GoldMarkRow, ReliabilityRow
from server.reliability import Said, estimate
from server.schemas_quality import LabelQuality
from server.store import Store
from tests.server.databases import running

BEGAN = datetime(2026, 1, 1, tzinfo=UTC)
WORDS = {"good": 1, "neutral": 0, "bad": -1, None: None}


def fill(session: Session, experiment_id: int, rng: random.Random, proposals: int) -> None:
    """Clicks of every kind on proposals of every kind, at random."""
    episode = session.scalars(select(EpisodeRow).where(EpisodeRow.experiment_id == experiment_id)).one()
    names = ("Ann", "Bo", "Cleo", "Dan"), ("synthetic", "Ann")
    trainers = [
        TrainerRow(name=f"{name} {experiment_id}", kind=kind, created_at=BEGAN)
        for kind, some in zip(("person", "teacher"), names, strict=True)
        for name in some
    ]
    session.add_all(trainers)
    clicks = []
    for number in range(proposals):
        proposal = _proposal(episode, number, rng, last=number == proposals - 1)
        session.add(proposal)
        session.flush()
        for trainer in rng.sample(trainers, rng.choice((0, 1, 1, 2, 3, 6))):
            kinds = ["stored", "overtaken", "late", "practice", "late", "stored"]
            drawn = rng.sample(kinds[:4], 2) if rng.random() < 0.2 else [rng.choice(kinds)]
            clicks += [(proposal, trainer, status) for status in drawn]
    rng.shuffle(clicks)  # late ones come long after
    when, taken = BEGAN, set()
    for n, (proposal, trainer, meant) in enumerate(clicks):
        # a clock may be put back
        when += timedelta(
            microseconds=rng.choice((1, 70_000_000, 800_000, 2_999_999, 60_000_000, 12_000_001, -500_000))
        )
        undone, vote = rng.random() < 0.1, (proposal.id, trainer.id)
        status = "late" if meant in COUNTING and vote in taken else meant
        if status in COUNTING and not undone:
            taken.add(vote)
        value = rng.choice((-1, -1, 0, 1, 1, None))
        row = FeedbackRow(click_id=f"click-{experiment_id}-{n:05}", experiment_id=experiment_id, value=value)
        row.proposal_id, row.trainer, row.status, row.received_at = proposal.id, trainer, status, when
        row.undone_at = when if undone else None
        for again in range(rng.choice((0, 0, 0, 1, 2))):
            said = rng.choice((-1, 0, 1, None))
            click = f"again-{experiment_id}-{n:05}-{again}"
            row.relabels.append(RelabelRow(click_id=click, trainer=trainer, value=said, at=when))
        session.add(row)
        session.flush()
    closed = {p.id: p for p, _, _ in clicks if p.closed_at is not None and p.known_answer is None}
    for marked in rng.sample(list(closed.values()), len(closed) // 10):
        session.add(GoldMarkRow(proposal=marked, answer=rng.choice((-1, 1)), trainer=trainers[0], at=BEGAN))


def _proposal(episode: EpisodeRow, number: int, rng: random.Random, *, last: bool) -> ProposalRow:
    uid = f"o-{episode.experiment_id}-{number}"
    seen = ObservationRow(experiment_id=episode.experiment_id, uid=uid, state=[0.0], taken_at=1.0)
    verdict = rng.choice(("good", "bad", "neutral", "bad", "good", None))
    reason = "judged" if verdict else rng.choice(("timed_out", "cant_tell", "superseded"))
    fields: dict[str, Any] = {"closed_at": BEGAN, "close_reason": reason, "verdict": verdict}
    if last:
        fields = {}
    return ProposalRow(
        experiment_id=episode.experiment_id,
        episode=episode,
        observation=seen,
        number=number,
        purpose=rng.choice(("training",) * 9 + ("evaluation",)),
        skill="pick",
        parameters=[0.5, 0.0, 0.0],
        parameter_names=["x", "y", "z"],
        digest=f"{number:064}",
        predicted_feedback=0.0,
        skill_probabilities={},
        policy_version=0,
        views=[],
        electorate=[],
        opened_at=BEGAN,
        known_answer=rng.choice((None, None, None, -1, 1)),
        **fields,
    )


def one_by_one(session: Session, experiment_id: int) -> dict[str, Any]:
    """The same figures, in the plainest way: every rule once more, click after click."""
    rows = session.execute(
        select(FeedbackRow, ProposalRow)
        .join(ProposalRow, ProposalRow.id == FeedbackRow.proposal_id)
        .where(FeedbackRow.experiment_id == experiment_id)
        .order_by(FeedbackRow.id)
    ).all()
    heard = [
        (click, proposal)
        for click, proposal in rows
        if click.undone_at is None
        and click.status != "practice"
        and proposal.purpose == "training"
        and proposal.closed_at is not None
    ]
    # everybody's one word on a proposal: what counts, else what they said first
    words: dict[tuple[int, int], FeedbackRow] = {}
    for click, _ in sorted(heard, key=lambda each: each[0].status not in COUNTING):
        words.setdefault((click.proposal_id, click.trainer_id), click)
    of: dict[int, list[FeedbackRow]] = {}
    for click in words.values():
        of.setdefault(click.proposal_id, []).append(click)
    told = []
    for trainer in {click.trainer_id: click.trainer for click, _ in heard}.values():
        mine = [(click, proposal) for click, proposal in heard if click.trainer_id == trainer.id]
        told.append(_one(trainer, mine, of))
    return {
        "trainers": sorted(told, key=lambda each: (each["kind"], each["trainer"])),
        "words": [click for click, _ in heard if click in words.values()],
    }


def _one(
    trainer: TrainerRow, mine: list[tuple[FeedbackRow, ProposalRow]], of: dict[int, list[FeedbackRow]]
) -> dict[str, Any]:
    counted = [(c, p) for c, p in mine if c.status in COUNTING]
    labels = [c.label for c, _ in counted]
    gold = [c.value == p.known_answer for c, p in mine if p.known_answer is not None and c in of[p.id]]
    fifty = [
        c.value == p.known_answer
        for c, p in mine[: len(mine) // 50 * 50]
        if p.known_answer is not None and c in of[p.id]
    ]
    words = [(c, p) for c, p in mine if c in of[p.id] and c.value is not None]
    judged = [(c, p) for c, p in words if p.verdict is not None and len(of[p.id]) > 1]
    pairs = [
        c.value == other.value
        for c, p in words
        for other in of[p.id]
        if None not in (c.value, other.value) and other.trainer_id != trainer.id
    ]
    streak = 0
    for c, p in reversed(counted):
        if c.value is not None:
            if c.label != c.value or (p.verdict is not None and len(of[p.id]) > 1 and WORDS[p.verdict] != c.value):
                break
            streak += 1
    gaps = [(after.received_at - before.received_at).total_seconds() for (before, _), (after, _) in pairwise(mine)]
    worked = [gap for gap in gaps if gap <= 60]
    return {
        "trainer": trainer.name,
        "kind": trainer.kind,
        **{"labels": len(labels) - labels.count(None), "cant_tell": labels.count(None)},
        **{"good": labels.count(1), "neutral": labels.count(0), "bad": labels.count(-1)},
        "late": len(mine) - len(counted),
        "relabelled": sum(bool(c.relabels) for c, _ in mine),
        "with_verdicts": {"count": sum(WORDS[p.verdict] == c.value for c, p in judged), "of": len(judged)},
        "with_others": {"count": sum(pairs), "of": len(pairs)},
        "gold": {"count": sum(gold), "of": len(gold)},
        "own gold": {"count": sum(fifty), "of": len(fifty)},
        "streak": streak,
        "per_minute": 60 * len(worked) / sum(worked) if sum(worked) > 0 else None,
    }


def alpha_of(clicks: list[FeedbackRow]) -> tuple[float, int, int]:
    """By the package, from the whole matrix of trainers and proposals; and how many proposals and labels are in it."""
    said = {(c.trainer_id, c.proposal_id): c.value for c in clicks if c.value is not None}
    trainers, proposals = sorted({t for t, _ in said}), sorted({p for _, p in said})
    matrix = np.array([[said.get((t, p), np.nan) for p in proposals] for t in trainers])
    several = (~np.isnan(matrix)).sum(axis=0) > 1
    found = krippendorff.alpha(matrix, value_domain=[-1, 0, 1], level_of_measurement="ordinal")
    return float(found), int(several.sum()), int((~np.isnan(matrix[:, several])).sum())


@pytest.mark.parametrize("seed", [1, 2])
async def test_figures_are_those_of_counting_one_click_after_the_other(store: Store, seed: int) -> None:
    rng, others = random.Random(seed), await running(store)
    experiment_id = await running(store)
    await store._database.write(lambda s: fill(s, others, rng, 20))
    await store._database.write(lambda s: fill(s, experiment_id, rng, 250))
    plain = await store.read(lambda s: one_by_one(s, experiment_id))
    told: LabelQuality = await store.quality.quality(experiment_id)
    assert len(told.trainers) == 6
    for expected, found in zip(plain["trainers"], told.trainers, strict=True):
        own_gold, pace = expected.pop("own gold"), expected.pop("per_minute")
        assert found.model_dump(exclude={"estimate", "per_minute"}) == expected
        assert found.per_minute == pytest.approx(pace, rel=1e-12)
        own = await store.quality.figures_of(experiment_id, found.trainer)
        if found.kind == "person":
            assert own is not None
            assert own == found.model_copy(update={"estimate": None, "gold": own.gold})
            assert own.gold.model_dump() == own_gold
    alpha, proposals, labels = alpha_of(plain["words"])
    assert told.agreement.alpha == pytest.approx(alpha, abs=1e-12)
    assert (told.agreement.proposals, told.agreement.labels, told.agreement.trainers) == (proposals, labels, 6)


async def test_trainers_are_measured_by_what_they_clicked_and_by_every_known_answer(store: Store) -> None:
    experiment_id, others = await running(store), await running(store)
    await store._database.write(lambda s: fill(s, others, random.Random(3), 20))
    await store._database.write(lambda s: fill(s, experiment_id, random.Random(4), 120))
    assert await store.quality.measure(experiment_id)

    def check(session: Session) -> None:
        clicks = [c for c in one_by_one(session, experiment_id)["words"] if c.value is not None]
        closed = select(ProposalRow).where(
            ProposalRow.experiment_id == experiment_id, ProposalRow.closed_at.is_not(None)
        )
        known = {p.id: p.known_answer for p in session.scalars(closed) if p.known_answer is not None}
        marks = {m.proposal_id: m.answer for m in session.scalars(select(GoldMarkRow))}
        assert marks
        columns = (np.array([getattr(c, name) for c in clicks]) for name in ("proposal_id", "trainer_id", "value"))
        expected = estimate(Said(*columns), known | marks).trainers
        stored = session.scalars(select(ReliabilityRow).where(ReliabilityRow.experiment_id == experiment_id)).all()
        assert {r.trainer_id: (r.labels, r.informative) for r in stored} == {
            who: (each.labels, each.informative) for who, each in expected.items()
        }
        assert [r.weight for r in stored] == pytest.approx([expected[r.trainer_id].weight for r in stored])

    await store.read(check)
