"""The store's part for label quality: known answers, everybody's figures and their estimates, as wire models."""

from __future__ import annotations

import asyncio
import logging
import time
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, func, select
from sqlalchemy.orm import Session

from server import store_clicks, store_gold, store_pages, store_practice
from server.agreement import agreement
from server.database import Database, writes
from server.models import FeedbackRow, ProposalRow
from server.models_quality import GoldMarkRow, PracticeRow, ReliabilityRow
from server.reliability import Reliability, estimate
from server.schemas_practice import PracticeAnswer, PracticeProgress
from server.schemas_quality import (
    AgreementInfo,
    Estimate,
    Gold,
    GoldMark,
    GoldPage,
    LabelQuality,
    TrainerFigures,
)
from server.store_errors import NotFound
from server.store_experiments import load, now
from server.trainer_figures import NOTHING, Clicks, figures

FRESH = 2.0
"""Seconds for which figures are told again instead of being computed anew: many look at them at once."""
QUICK = 0.2
"""Seconds that somebody who asks for figures is made to wait for newer ones; where they take longer, the last are told
meanwhile."""
SHARE = 10
"""They are computed no more than a tenth of the time, however many clicks there are."""


log = logging.getLogger("seed.quality")


@dataclass(frozen=True)
class _Told:
    """at: when it was computed, CLOCK_MONOTONIC; took: how long that was. In seconds. own: what each person may see."""

    at: float
    took: float
    everybodys: LabelQuality
    own: Mapping[str, TrainerFigures]

    @property
    def fresh(self) -> bool:
        """Whether it is told again as it is."""
        return time.monotonic() - self.at < max(FRESH, SHARE * self.took)


class QualityStore:
    """Reads and writes of `Store.quality`."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._turns: defaultdict[int, asyncio.Lock] = defaultdict(asyncio.Lock)
        self._kept: dict[int, _Told] = {}
        self._telling: dict[int, asyncio.Task[_Told]] = {}

    async def settle(self) -> None:
        """Wait for what is still computed."""
        if self._telling:
            await asyncio.wait(set(self._telling.values()))

    @writes
    async def mark_gold(self, proposal_id: int, body: GoldMark) -> None:
        """Know the answer to a closed proposal. See `store_gold.mark`."""
        await self._database.write(lambda s: store_gold.mark(s, proposal_id, body))

    @writes
    async def unmark_gold(self, proposal_id: int) -> None:
        """Show it no more."""
        await self._database.write(lambda s: store_gold.unmark(s, proposal_id))

    async def gold(self, experiment_id: int, cursor: str | None, limit: int) -> GoldPage:
        """Closed proposals whose answer was known, newest first."""

        def find(session: Session) -> tuple[list[Gold], str | None]:
            load(session, experiment_id)
            query = select(ProposalRow).where(*_closed_gold(experiment_id))

            def wire(row: ProposalRow) -> Gold:
                return store_gold.gold(session, row)

            return store_pages.page(session, query, ProposalRow.id, wire, cursor=cursor, limit=limit)

        items, after = await self._database.read(find)
        return GoldPage(items=items, next_cursor=after)

    async def quality(self, experiment_id: int) -> LabelQuality:
        """Everybody's figures, and how far they agree; at most `FRESH` seconds old."""
        return (await self._told(experiment_id)).everybodys

    async def figures_of(self, experiment_id: int, trainer: str) -> TrainerFigures | None:
        """One trainer's own, as they may see them; None where they haven't clicked."""
        return (await self._told(experiment_id)).own.get(trainer)

    async def _told(self, experiment_id: int) -> _Told:
        """Computed once for all who look at it, beside the event loop: it takes in every click of the experiment."""
        await self._database.read(lambda s: load(s, experiment_id) and None)
        kept = self._kept.get(experiment_id)
        if kept is None or kept.took < QUICK:
            return await self._told_anew(experiment_id)
        if not kept.fresh and experiment_id not in self._telling:
            telling = asyncio.create_task(self._told_anew(experiment_id), name=f"figures of experiment {experiment_id}")
            self._telling[experiment_id] = telling
            telling.add_done_callback(lambda task: self._end(experiment_id, task))
        return kept

    async def _told_anew(self, experiment_id: int) -> _Told:
        async with self._turns[experiment_id]:
            kept = self._kept.get(experiment_id)
            if kept is None or not kept.fresh:
                kept = self._kept[experiment_id] = await self._database.read(lambda s: _tell(s, experiment_id))
            return kept

    def _end(self, experiment_id: int, task: asyncio.Task[_Told]) -> None:
        del self._telling[experiment_id]
        if not task.cancelled() and (error := task.exception()) is not None:
            log.warning("figures of experiment %s can't be computed: %s", experiment_id, error)

    @writes
    async def measure(self, experiment_id: int) -> bool:
        """Estimate each trainer's reliability anew, and store it; False where there is nothing to compare yet."""
        if not await self._database.read(lambda s: _comparable(s, experiment_id)):
            return False
        said, known = await self._database.read(
            lambda s: (store_clicks.said(s, experiment_id), _known_answers(s, experiment_id))
        )
        estimated = await asyncio.to_thread(estimate, said, known)

        def keep(session: Session) -> None:
            for trainer_id, each in estimated.trainers.items():
                session.merge(_row(experiment_id, trainer_id, each))

        await self._database.write(keep)
        return True

    @writes
    async def practice_place(self, experiment_id: int, trainer: str) -> tuple[int, int, PracticeRow | None]:
        """The trainer's id, the number of their next practice proposal, and the one that is open, if any."""
        return await self._database.write(lambda s: store_practice.place(s, experiment_id, trainer))

    @writes
    async def open_practice(self, experiment_id: int, trainer: str, number: int, card: dict[str, Any]) -> PracticeRow:
        """Put a practice proposal before a trainer; one that is open stays."""
        return await self._database.write(lambda s: store_practice.open_card(s, experiment_id, trainer, number, card))

    @writes
    async def answer_practice(self, practice_id: int, body: PracticeAnswer) -> PracticeRow:
        """Store the answer, once; whoever passes by it is qualified from now on."""
        return await self._database.write(lambda s: store_practice.answer(s, practice_id, body))

    async def practice(self, practice_id: int) -> PracticeRow:
        """One practice proposal, open or answered."""

        def find(session: Session) -> PracticeRow:
            row = session.get(PracticeRow, practice_id)
            if row is None:
                raise NotFound("practice proposal", practice_id)
            return row

        return await self._database.read(find)

    async def practice_progress(self, experiment_id: int, trainer: str) -> PracticeProgress:
        """How a trainer does in an experiment's practice."""
        return await self._database.read(lambda s: store_practice.progress(s, load(s, experiment_id), trainer))


def weights(session: Session, experiment_id: int) -> dict[str, float]:
    """Trainer -> probability that their next label is true, as last estimated. Whoever is missing: 2/3 (`UNKNOWN`)."""
    rows = session.scalars(select(ReliabilityRow).where(ReliabilityRow.experiment_id == experiment_id))
    return {row.trainer.name: row.weight for row in rows}


def _closed_gold(experiment_id: int) -> tuple[ColumnElement[bool], ...]:
    return (
        ProposalRow.experiment_id == experiment_id,
        ProposalRow.known_answer.is_not(None),
        ProposalRow.closed_at.is_not(None),
    )


def _comparable(session: Session, experiment_id: int) -> bool:
    """Whether anything can be compared: there are two trainers, or known answers. Most runs have one teacher."""
    trainers = select(FeedbackRow.trainer_id).where(FeedbackRow.experiment_id == experiment_id).distinct().limit(2)
    return len(session.scalars(trainers).all()) > 1 or bool(_known_answers(session, experiment_id))


def _known_answers(session: Session, experiment_id: int) -> dict[int, int]:
    """Of gold proposals, and of those that an operator has marked: what was said of them before counts as well."""
    gold = select(ProposalRow.id, ProposalRow.known_answer).where(*_closed_gold(experiment_id))
    marked = (
        select(GoldMarkRow.proposal_id, GoldMarkRow.answer)
        .join(ProposalRow, ProposalRow.id == GoldMarkRow.proposal_id)
        .where(ProposalRow.experiment_id == experiment_id)
    )
    rows = [row for query in (gold, marked) for row in session.execute(query)]
    return {int(proposal): int(answer) for proposal, answer in rows if answer is not None}


def _estimates(session: Session, experiment_id: int) -> dict[int, Estimate]:
    rows = session.scalars(select(ReliabilityRow).where(ReliabilityRow.experiment_id == experiment_id))
    return {
        row.trainer_id: Estimate(
            accuracy=row.accuracy,
            interval=None if row.low is None or row.high is None else (row.low, row.high),
            informative=row.informative,
            weight=row.weight,
            at=row.at,
        )
        for row in rows
    }


def _row(experiment_id: int, trainer_id: int, each: Reliability) -> ReliabilityRow:
    low, high = each.interval or (None, None)
    return ReliabilityRow(
        experiment_id=experiment_id,
        trainer_id=trainer_id,
        weight=each.weight,
        accuracy=each.accuracy,
        low=low,
        high=high,
        labels=each.labels,
        informative=each.informative,
        at=now(),
    )


def _tell(session: Session, experiment_id: int) -> _Told:
    began = time.monotonic()
    clicks = store_clicks.clicks(session, experiment_id)
    made = figures(clicks, store_clicks.people(session, experiment_id), _estimates(session, experiment_id))
    told = LabelQuality(
        experiment_id=experiment_id,
        agreement=_agreement(clicks),
        gold=session.scalar(select(func.count(ProposalRow.id)).where(*_closed_gold(experiment_id))) or 0,
        trainers=made.everybodys,
    )
    own = {each.trainer: each for each in made.own if each.kind == "person"}
    ended = time.monotonic()
    return _Told(ended, ended - began, told, own)


def _agreement(clicks: Clicks) -> AgreementInfo:
    says = clicks.word & (clicks.value != NOTHING)
    found = agreement(clicks.proposal[says], clicks.trainer[says], clicks.value[says])
    return AgreementInfo(
        alpha=found.alpha, proposals=found.proposals, labels=found.labels, trainers=found.trainers, why=found.why
    )
