"""Practice in the database: each trainer's proposals and answers, and who has passed. One transaction each."""

from __future__ import annotations

from typing import Any

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server.models import ExperimentRow, TrainerRow
from server.models_quality import PracticeRow, QualificationRow
from server.schemas_labels import label_of
from server.schemas_practice import PracticeAnswer, PracticeProgress
from server.schemas_quality import PracticeRequired, Share
from server.store_audit import record
from server.store_errors import Conflict, NotFound
from server.store_experiments import journal, load, now
from server.store_labels import trainer


def place(session: Session, experiment_id: int, name: str) -> tuple[int, int, PracticeRow | None]:
    """The trainer's id, the number of their next practice proposal, and the one that is open, if any."""
    load(session, experiment_id)
    by = trainer(session, name, "person")
    mine = (PracticeRow.experiment_id == experiment_id, PracticeRow.trainer_id == by.id)
    newest = session.scalar(select(func.max(PracticeRow.number)).where(*mine)) or 0
    opened = session.scalars(select(PracticeRow).where(*mine, PracticeRow.answered_at.is_(None))).one_or_none()
    return by.id, newest + 1, opened


def open_card(session: Session, experiment_id: int, name: str, number: int, card: dict[str, Any]) -> PracticeRow:
    """Put it before the trainer; another request of theirs may have been quicker, and then its one stays."""
    by, following, opened = place(session, experiment_id, name)
    if opened is not None:
        return opened
    if following != number:
        raise Conflict("another window of yours has gone on", remedy="ask for the next one again")
    row = PracticeRow(
        experiment_id=experiment_id,
        trainer_id=by,
        number=number,
        card=card,
        known_answer=card["answer"],
        opened_at=now(),
    )
    session.add(row)
    session.flush()
    return row


def answer(session: Session, practice_id: int, body: PracticeAnswer) -> PracticeRow:
    """Store the answer, once; whoever passes by it is qualified from now on.

    Raises:
        NotFound: no such practice proposal of this trainer. Conflict: it was answered otherwise.
    """
    row = session.get(PracticeRow, practice_id)
    if row is None or row.trainer.name != body.trainer:
        raise NotFound("practice proposal of yours", practice_id)
    if row.answered_at is not None:
        if (row.click_id, row.value) != (body.click_id, label_of(body.value)):
            raise Conflict("this practice proposal is answered", remedy="ask for the next one")
        return row
    row.click_id, row.value, row.answered_at = body.click_id, label_of(body.value), now()
    session.flush()
    experiment = load(session, row.experiment_id)
    record(session, "practised", experiment.id, by=row.trainer.name, practice=row.id, value=row.value)
    told = progress(session, experiment, row.trainer.name)
    if experiment.practice_required is not None and told.passed and not told.counts:
        session.add(QualificationRow(experiment_id=experiment.id, trainer_id=row.trainer_id, at=now()))
        session.flush()
        journal(session, experiment.id, "qualified", trainer=row.trainer.name, answered=told.answered, right=told.right)
    return row


def progress(session: Session, experiment: ExperimentRow, name: str) -> PracticeProgress:
    """How this trainer does. Without a requirement the default one tells when somebody would have passed."""
    required = required_of(experiment)
    bar = required or PracticeRequired()
    query = (
        select(PracticeRow.value, PracticeRow.known_answer)
        .join(TrainerRow, TrainerRow.id == PracticeRow.trainer_id)
        .where(
            PracticeRow.experiment_id == experiment.id,
            PracticeRow.answered_at.is_not(None),
            TrainerRow.name == name,
            TrainerRow.kind == "person",
        )
        .order_by(PracticeRow.number)
    )
    mine = [value == known for value, known in session.execute(query)]
    newest = mine[-bar.proposals :]
    enough = len(newest) >= bar.proposals and sum(newest) >= bar.accuracy * len(newest) - 1e-9
    counts = may_count(session, experiment.id, experiment.practice_required, name)
    return PracticeProgress(
        required=required,
        answered=len(mine),
        right=sum(mine),
        newest=Share(count=sum(newest), of=len(newest)),
        passed=enough or (counts and required is not None),
        counts=counts,
    )


def may_count(session: Session, experiment_id: int, required: dict[str, Any] | None, name: str) -> bool:
    """Whether this person's clicks count: no practice is required, or they have passed. A teacher's always do.

    required: the experiment's `practice_required`.
    """
    if required is None:
        return True
    passed = (
        select(QualificationRow.at)
        .join(TrainerRow, TrainerRow.id == QualificationRow.trainer_id)
        .where(QualificationRow.experiment_id == experiment_id, TrainerRow.name == name, TrainerRow.kind == "person")
    )
    return session.scalar(passed) is not None


def required_of(experiment: ExperimentRow) -> PracticeRequired | None:
    """What an experiment asks for."""
    stored = experiment.practice_required
    return None if stored is None else PracticeRequired.model_validate(stored)
