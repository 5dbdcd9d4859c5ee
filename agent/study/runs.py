"""Runs of one process, from their beginning or from where they were interrupted, to their budgets.

Most often that is one run. Where there is no physics, seeds of one curve share a process, in which they decide in turns
and learn in one pass.
"""

from __future__ import annotations

import contextlib
import fcntl
import logging
import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from agent.algorithm import AgentError
from agent.study.algorithms import Builders, course
from agent.study.claims import work_on_row
from agent.study.courses import LABELS, Course, FeedbackCourse
from agent.study.episodes import FIRST_START
from agent.study.evaluations import Row, append_row, keep_rows
from agent.study.files import write_json
from agent.study.plan import Axis, Plan, Run, StudyError
from agent.study.records import AGAIN, EVALUATIONS, LOCK, PROGRESS, RUN, RUNS, Checkpoint, Folder, Progress
from agent.study.versions import versions
from robot_adapters.base import AdapterError

log = logging.getLogger("seed.study")

TELL_EVERY = 0.5
"""s of a run between two notes of how far it is."""

Stop = Callable[[], bool]
"""Whether to end now; asked between any two decisions and rollouts."""


def work(group: Sequence[Run], plan: Plan, path: Path, builders: Builders, stop: Stop) -> list[Progress]:
    """Do runs of the study in `path`, or what is left of them; how far each came. Several are one of `Plan.groups`.

    What goes wrong ends the run as `failed` and says why; the study's other runs go on.
    """
    import torch  # noqa: PLC0415  the planning process needs none of it

    torch.set_num_threads(1)
    folder = Folder(path)
    with contextlib.ExitStack() as held:
        for run in group:
            folder.run(run.id).mkdir(parents=True, exist_ok=True)
            lock = held.enter_context((folder.run(run.id) / LOCK).open("ab"))
            fcntl.flock(lock, fcntl.LOCK_EX)  # the orphan of a killed study may still be ending
        if group[0].contestant.kind == "claim":
            return work_on_row(group, plan, folder, builders, stop)
        workers = [_Worker(run, plan, folder, len(group)) for run in group]
        _Group(workers, group, folder).work(builders, stop)
        return [worker.progress for worker in workers]


class _Group:
    """Runs that go on at the same time: all decide, then all learn; one checkpoint is of all of them."""

    def __init__(self, workers: Sequence[_Worker], group: Sequence[Run], folder: Folder) -> None:
        self._workers = workers
        self._group = group
        self._folder = folder
        self._checkpoints: dict[str, Checkpoint] = {}

    def work(self, builders: Builders, stop: Stop) -> None:
        """Train and evaluate until every budget is used up, or until `stop`."""
        begun = [worker for worker in self._workers if worker.progress.state != "finished"]
        with contextlib.ExitStack() as held:
            found, damage = self._found()
            for worker in begun:
                with worker.answering():
                    if damage is not None:
                        raise damage
                    worker.begin(builders, found.get(worker.id))
                    held.callback(worker.course.close)
            going = begun
            while going := [worker for worker in going if worker.going]:
                if stop() or not self._evaluated(going, stop):
                    break
                going = [worker for worker in going if worker.going]
                for worker in going:
                    with worker.answering():
                        worker.course.decide()
                self._learn([worker for worker in going if worker.going])
                for worker in going:
                    worker.tell_now_and_then()
            for worker in going:
                worker.tell("interrupted")

    def _found(self) -> tuple[Mapping[str, Checkpoint], StudyError | None]:
        try:
            self._checkpoints = self._folder.checkpoints(self._group)
        except StudyError as error:
            return {}, error
        return self._checkpoints, None

    def _evaluated(self, going: Sequence[_Worker], stop: Stop) -> bool:
        """Evaluate those that are due, and save; False where `stop` came in between, and nothing counts."""
        due = [worker for worker in going if worker.due]
        for worker in due:
            with worker.answering():
                if not worker.evaluate(stop):
                    return False
        if due:
            for worker in going:
                with worker.answering():
                    self._checkpoints[worker.id] = worker.save()
            self._folder.keep(self._group, self._checkpoints)
            for worker in going:
                if worker.going:
                    worker.tidy(self._checkpoints[worker.id].learner)
        for worker in due:
            worker.tell_evaluated()
        return True

    def _learn(self, going: Sequence[_Worker]) -> None:
        """Take every step that is owed: learners of judged skills in one pass."""
        from agent.seed import Seed  # noqa: PLC0415  loads torch
        from agent.stacked import StackedSeeds  # noqa: PLC0415  as above

        stacked = [each.course.learner for each in going if isinstance(each.course, FeedbackCourse)]
        if len(going) > 1:
            with contextlib.suppress(AgentError):  # whose losses diverged is found out below
                StackedSeeds([each for each in stacked if isinstance(each, Seed)]).work_off()
        for worker in going:
            with worker.answering():
                worker.course.learn()


def trained(folder: Folder, run_id: str) -> Path:
    """The checkpoint of a finished run's learner.

    Raises:
        StudyError: it isn't finished.
    """
    found = folder.checkpoint(run_id)
    if found is None or folder.progress(run_id, live=True).state != "finished":
        raise StudyError(
            f"the run {run_id}, whose learner judges this one's actions, isn't finished",
            remedy="see why it failed, then go on by --resume",
        )
    return folder.run(run_id) / found.learner


class _Worker:
    """A run's bookkeeping: when to evaluate, what to write down, what others may see."""

    course: Course

    def __init__(self, run: Run, plan: Plan, folder: Folder, company: int) -> None:
        """company: how many runs share the process, itself included."""
        self.id = run.id
        self._run = run
        self._plan = plan
        self._study = folder
        self._folder = folder.run(run.id)
        self._company = company
        self._evaluated = -1
        """The newest evaluation; 0 is the one before any training."""
        self._earlier = 0.0
        """Seconds spent before this process took over."""
        self._began = time.monotonic()
        self._told = -math.inf
        self._first: int | None = None
        self.progress = folder.progress(run.id, live=False)

    @property
    def going(self) -> bool:
        """Whether something is left to do here."""
        return self.progress.state == "running"

    @contextlib.contextmanager
    def answering(self) -> Iterator[None]:
        """What goes wrong inside ends this run, and no other."""
        try:
            yield
        except (AgentError, AdapterError) as error:
            self.tell("failed", error=f"{error}; {error.remedy}")
        except Exception as error:  # what nobody foresaw mustn't end the other runs; it is logged with its traceback
            log.exception("the run %s failed", self.id)
            self.tell("failed", error=f"{type(error).__name__}: {error}")

    def begin(self, builders: Builders, found: Checkpoint | None) -> None:
        """Set everything up, and go on from a checkpoint if there is one; what came after it is done again."""
        self.progress = Progress()
        oracle = None if self._run.oracle is None else trained(self._study, self._run.oracle)
        write_json(self._folder / RUN, _described(self._run, self._plan, oracle))
        if found is None:
            (self._folder / LABELS).unlink(missing_ok=True)
        self.course = course(self._run, builders, self._folder, oracle)
        rows = [] if found is None else self._rows(found.evaluated)
        if found is not None:
            self.course.load(self._folder / found.learner, found.course)
            self._evaluated, self._earlier = found.evaluated, found.seconds
            self.progress = Progress(evaluations=found.evaluated, success_rate=rows[-1].success_rate)
        keep_rows(self._folder / EVALUATIONS, rows)
        self._began = time.monotonic()
        self.tell("running")

    def tell(self, state: Any, error: str | None = None) -> None:
        """Write down how far it is, for whoever watches."""
        now = time.monotonic()
        counts: Mapping[str, int] = {}
        rate = None
        if error is None:
            counts, at = asdict(self.course.counts), self._at()
            self._first = at if self._first is None else self._first
            rate = (at - self._first) / (now - self._began) if now > self._began else None
        self.progress = self.progress.model_copy(
            update={**counts, "state": state, "error": error, "rate": rate, "seconds": round(self._seconds(), 3)}
        )
        write_json(self._folder / PROGRESS, self.progress.model_dump(mode="json"))
        self._told = now

    def tell_now_and_then(self) -> None:
        """The same where it is time to and nothing has ended."""
        if self.going and time.monotonic() - self._told >= TELL_EVERY * self._company:
            self.tell("running")

    def tell_evaluated(self) -> None:
        """The same after an evaluation that counts; the last one ends the run."""
        if self.going:
            self.tell("finished" if self._evaluated == self._plan.protocol.evaluations else "running")

    @property
    def due(self) -> bool:
        """Whether an evaluation is."""
        return self._number > self._evaluated

    def evaluate(self, stop: Stop) -> bool:
        """Roll out and write the row; False where `stop` came in between, and nothing was written."""
        number, rollouts, succeeded = self._number, self._plan.protocol.rollouts, 0
        for rollout in range(rollouts):
            if stop():
                return False
            succeeded += self.course.succeeds(FIRST_START + number * rollouts + rollout)
        row = Row(
            number,
            **asdict(self.course.counts),
            updates=self.course.updates,
            rollouts=rollouts,
            rollouts_succeeded=succeeded,
            seconds=round(self._seconds(), 3),
        )
        append_row(self._folder / EVALUATIONS, row)
        self._evaluated = number
        self.progress = self.progress.model_copy(update={"evaluations": number, "success_rate": row.success_rate})
        return True

    def save(self) -> Checkpoint:
        """Write down from where it could go on. It counts once `Folder.keep` has been told."""
        learner = f"learner-{self.course.counts.decisions}.ckpt"
        saved = self.course.save(self._folder / learner)
        return Checkpoint(learner=learner, evaluated=self._evaluated, seconds=self._seconds(), course=saved)

    def tidy(self, newest: str) -> None:
        """Delete the learners of checkpoints that no longer count."""
        for old in self._folder.glob("learner-*.ckpt"):
            if old.name != newest:
                old.unlink()

    def _rows(self, evaluated: int) -> list[Row]:
        rows = [row for row in self._study.rows(self.id) if row.evaluation <= evaluated]
        numbers = [row.evaluation for row in rows]  # a long skill may skip some
        if not numbers or (numbers[0], numbers[-1]) != (0, evaluated) or numbers != sorted(set(numbers)):
            raise StudyError(
                f"{self._study.path.name}/{RUNS}/{self.id}/{EVALUATIONS} lacks evaluations up to {evaluated}, from "
                "where the run would go on",
                remedy=AGAIN,
            )
        return rows

    @property
    def _number(self) -> int:
        """The evaluation that is due by now."""
        run, counts, evaluations = self._run, self.course.counts, self._plan.protocol.evaluations
        share = self._at() / run.budget
        if run.most_decisions is not None:
            share = max(share, counts.decisions / run.most_decisions)
        return min(evaluations, math.floor(share * evaluations + 1e-9))

    def _at(self) -> int:
        counts = self.course.counts
        return counts.low_level_steps if self._run.scenario.axis is Axis.LOW_LEVEL_STEPS else counts.decisions

    def _seconds(self) -> float:
        """Its share of the process's time."""
        return self._earlier + (time.monotonic() - self._began) / self._company


def _described(run: Run, plan: Plan, oracle: Path | None) -> dict[str, Any]:
    """Everything that a run was made of."""
    return {
        **run.model_dump(mode="json"),
        "together": [each.id for group in plan.groups if run in group for each in group],
        "adapter": plan.adapter,
        "protocol": plan.protocol.model_dump(mode="json"),
        "first_evaluation_seed": FIRST_START,
        "oracle_checkpoint": None if oracle is None else f"{oracle.parent.name}/{oracle.name}",
        "versions": versions(),
    }
