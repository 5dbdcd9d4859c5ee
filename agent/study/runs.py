"""One run from its beginning, or from where it was interrupted, to its budget. Runs in a process of its own."""

from __future__ import annotations

import fcntl
import logging
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from agent.algorithm import AgentError
from agent.study.algorithms import Builders, course
from agent.study.courses import Course
from agent.study.episodes import FIRST_START
from agent.study.evaluations import Row, append_row, keep_rows
from agent.study.files import write_json
from agent.study.plan import Axis, Plan, Run, StudyError
from agent.study.records import AGAIN, EVALUATIONS, LOCK, PROGRESS, RUN, RUNS, STATE, Checkpoint, Folder, Progress
from agent.study.versions import versions
from robot_adapters.base import AdapterError

log = logging.getLogger("seed.study")

TELL_EVERY = 0.5
"""s between two notes of how far a run is."""

Stop = Callable[[], bool]
"""Whether to end now; asked between any two decisions and rollouts."""


def work(run: Run, plan: Plan, path: Path, builders: Builders, stop: Stop) -> Progress:
    """Do a run of the study in `path`, or what is left of it.

    What goes wrong ends the run as `failed` and says why; the study's other runs go on.
    """
    import torch  # noqa: PLC0415  the planning process needs none of it

    torch.set_num_threads(1)
    folder = Folder(path).run(run.id)
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / LOCK).open("ab") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # the orphan of a killed study may still be ending
        worker = _Worker(run, plan, folder)
        if worker.progress.state == "finished":
            return worker.progress
        try:
            oracle = None if run.oracle is None else trained(Folder(path), run.oracle)
            write_json(folder / RUN, _described(run, plan, oracle))
            each = course(run, builders, folder, oracle)
            try:
                worker.train(each, stop)
            finally:
                each.close()
        except (AgentError, AdapterError) as error:
            worker.tell("failed", error=f"{error}; {error.remedy}")
        except Exception as error:  # what nobody foresaw mustn't end the other runs; it is logged with its traceback
            log.exception("the run %s failed", run.id)
            worker.tell("failed", error=f"{type(error).__name__}: {error}")
        return worker.progress


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
    """The course's bookkeeping: when to evaluate, what to write down, what others may see."""

    def __init__(self, run: Run, plan: Plan, folder: Path) -> None:
        self._run = run
        self._protocol = plan.protocol
        self._folder = folder
        self._evaluated = -1
        """The newest evaluation; 0 is the one before any training."""
        self._earlier = 0.0
        """Seconds spent before this process took over."""
        self._began = time.monotonic()
        self._told = -math.inf
        self._first: float | None = None
        self.progress = Folder(folder.parent.parent).progress(run.id, live=False)

    def train(self, each: Course, stop: Stop) -> None:
        """Train and evaluate until the budget is used up, or until `stop`."""
        self._load(each)
        while not stop():
            due = self._due(each)
            if due > self._evaluated and not self._evaluate(each, due, stop):
                break
            if due == self._protocol.evaluations:
                self.tell("finished", each)
                return
            each.step()
            if time.monotonic() - self._told >= TELL_EVERY:
                self.tell("running", each)
        self.tell("interrupted", each)

    def tell(self, state: Any, each: Course | None = None, error: str | None = None) -> None:
        """Write down how far it is, for whoever watches."""
        now = time.monotonic()
        counts: Mapping[str, int] = {} if each is None else asdict(each.counts)
        rate = None
        if each is not None:
            at = self._at(each)
            self._first = at if self._first is None else self._first
            rate = (at - self._first) / (now - self._began) if now > self._began else None
        self.progress = self.progress.model_copy(
            update={**counts, "state": state, "error": error, "rate": rate, "seconds": round(self._seconds(), 3)}
        )
        write_json(self._folder / PROGRESS, self.progress.model_dump(mode="json"))
        self._told = now

    def _evaluate(self, each: Course, number: int, stop: Stop) -> bool:
        """Roll out, write the row and a checkpoint; False where `stop` came in between, and nothing was written."""
        succeeded = 0
        for rollout in range(self._protocol.rollouts):
            if stop():
                return False
            succeeded += each.succeeds(FIRST_START + number * self._protocol.rollouts + rollout)
        row = Row(
            number,
            **asdict(each.counts),
            updates=each.updates,
            rollouts=self._protocol.rollouts,
            rollouts_succeeded=succeeded,
            seconds=round(self._seconds(), 3),
        )
        append_row(self._folder / EVALUATIONS, row)
        self._evaluated = number
        self._save(each)
        self.progress = self.progress.model_copy(update={"evaluations": number, "success_rate": row.success_rate})
        self.tell("running", each)
        return True

    def _save(self, each: Course) -> None:
        learner = f"learner-{self._evaluated}.ckpt"
        saved = each.save(self._folder / learner)
        found = Checkpoint(learner=learner, evaluated=self._evaluated, seconds=self._seconds(), course=saved)
        write_json(self._folder / STATE, found.model_dump(mode="json"))  # from here on the new checkpoint counts
        for old in self._folder.glob("learner-*.ckpt"):
            if old.name != learner:
                old.unlink()

    def _load(self, each: Course) -> None:
        """Go on from the newest checkpoint, if there is one; what came after it is forgotten, and done again."""
        study, run = Folder(self._folder.parent.parent), self._run.id
        found, rows = study.checkpoint(run), []
        self.progress = Progress()
        if found is not None:
            rows = [row for row in study.rows(run) if row.evaluation <= found.evaluated]
            numbers = [row.evaluation for row in rows]  # a long skill may skip some
            if not numbers or (numbers[0], numbers[-1]) != (0, found.evaluated) or numbers != sorted(set(numbers)):
                raise StudyError(
                    f"{study.path.name}/{RUNS}/{run}/{EVALUATIONS} lacks evaluations up to {found.evaluated}, from "
                    "where the run would go on",
                    remedy=AGAIN,
                )
            each.load(self._folder / found.learner, found.course)
            self._evaluated, self._earlier = found.evaluated, found.seconds
            rate = rows[-1].success_rate
            self.progress = Progress(evaluations=found.evaluated, success_rate=rate)
        keep_rows(self._folder / EVALUATIONS, rows)
        self._began = time.monotonic()
        self.tell("running", each)

    def _due(self, each: Course) -> int:
        """The evaluation that is due by now."""
        run, counts = self._run, each.counts
        share = self._at(each) / run.budget
        if run.most_decisions is not None:
            share = max(share, counts.decisions / run.most_decisions)
        return min(self._protocol.evaluations, math.floor(share * self._protocol.evaluations + 1e-9))

    def _at(self, each: Course) -> int:
        low_level = self._run.scenario.axis is Axis.LOW_LEVEL_STEPS
        return each.counts.low_level_steps if low_level else each.counts.decisions

    def _seconds(self) -> float:
        return self._earlier + time.monotonic() - self._began


def _described(run: Run, plan: Plan, oracle: Path | None) -> dict[str, Any]:
    """Everything that a run was made of."""
    return {
        **run.model_dump(mode="json"),
        "adapter": plan.adapter,
        "protocol": plan.protocol.model_dump(mode="json"),
        "first_evaluation_seed": FIRST_START,
        "oracle_checkpoint": None if oracle is None else f"{oracle.parent.name}/{oracle.name}",
        "versions": versions(),
    }
