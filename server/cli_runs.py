"""`seed train` and `seed evaluate`: runs without a browser, through the same hub and store, with a progress bar."""

from __future__ import annotations

import asyncio
import contextlib
import signal
import time
from collections.abc import Iterator
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from robot_adapters import registry
from server.errors import ServiceError
from server.hub import Act
from server.messages import (
    EvaluationChanged,
    ExperimentChanged,
    FeedbackStored,
    FrameHeader,
    StreamEvent,
    WorkerChanged,
)
from server.schemas import Evaluation, EvaluationCreate, ExperimentCreate, Lifecycle
from server.service import Service, opened
from server.settings import Settings
from server.store_errors import Conflict


class RunFailed(Exception):
    """The experiment failed on its way; `remedy` says what to do."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


class Interrupted(Exception):
    """Ctrl-C. Everything is stored; `remedy` says how to go on."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


class Bar:
    """A `Publisher` that draws what it hears as a progress bar on standard error."""

    shows_frames = False

    def __init__(self, console: Console) -> None:
        self._progress = Progress(
            TextColumn("{task.description:<28}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
            console=console,
        )
        self._bar = self._progress.add_task("starting", total=None)
        self._counts: type[FeedbackStored] | type[EvaluationChanged] = FeedbackStored
        self.done = 0

    @contextlib.contextmanager
    def shown(self) -> Iterator[None]:
        """Draw while inside."""
        with self._progress:
            yield

    def count(self, what: type[FeedbackStored] | type[EvaluationChanged], total: int, done: int = 0) -> None:
        """Begin to count feedback, or rollouts."""
        self._counts, self.done = what, done
        self._progress.reset(self._bar, total=total, completed=done, description="starting")

    def publish(self, experiment_id: int, event: StreamEvent) -> None:  # noqa: ARG002  there is one experiment
        """Draw an event; never blocks."""
        if isinstance(event, FeedbackStored) and self._counts is FeedbackStored:
            self.done += 1
        elif isinstance(event, EvaluationChanged) and self._counts is EvaluationChanged:
            self.done = event.done
        elif isinstance(event, ExperimentChanged):
            successes = event.experiment.counters.successes
            phase = event.experiment.phase.replace("_", " ")
            self._progress.update(self._bar, description=f"{phase}, {successes} successes")
        elif isinstance(event, WorkerChanged) and event.status in ("died", "restarted"):
            self._progress.console.print(f"the {event.worker} worker {event.status}: {event.detail}")
        self._progress.update(self._bar, completed=self.done)

    def publish_frame(self, experiment_id: int, header: FrameHeader, jpeg: bytes) -> None:
        """Nobody watches."""


async def train_headless(
    settings: Settings, what: ExperimentCreate | int, feedback: int, rollouts: int, console: Console
) -> dict[str, Any]:
    """Train a new experiment, or go on with a stored one, until it has `feedback`; then evaluate, and sum up.

    Raises:
        RunFailed, Interrupted, ServiceError, StoreError.
    """
    bar = Bar(console)
    async with opened(settings, bar) as service:
        experiment = await (service.hub.view(what) if isinstance(what, int) else service.create(what))
        if experiment.teacher is None:
            raise ServiceError(
                422,
                f"experiment {experiment.id} is judged by people, and here is nobody",
                remedy="train it in the browser: seed serve",
            )
        started = time.monotonic()
        with bar.shown(), _interrupts() as interrupted:
            bar.count(FeedbackStored, feedback, experiment.counters.feedback)
            verb: Act = "start" if experiment.lifecycle is Lifecycle.CREATED else "resume"
            await service.hub.act(experiment.id, verb, until=feedback)
            await _until_idle(service, experiment.id, interrupted)
            seconds = time.monotonic() - started
            trained = await service.store.experiment(experiment.id)
            evaluation = None
            if rollouts:
                evaluation = await _evaluate(
                    service, bar, experiment.id, EvaluationCreate(rollouts=rollouts), interrupted
                )
    counters = trained.counters
    return {
        "experiment": trained.id,
        "feedback": counters.feedback,
        "executions": counters.executions,
        "low_level_steps": counters.low_level_steps,
        "successes": counters.successes,
        "success_rate": None if evaluation is None else evaluation.success_rate,
        "violations": counters.violations,
        "seconds": round(seconds, 3),
    }


async def evaluate_stored(
    settings: Settings, experiment_id: int, body: EvaluationCreate, console: Console
) -> dict[str, Any]:
    """Evaluate a stored experiment.

    Raises:
        RunFailed, Interrupted, ServiceError, StoreError.
    """
    bar = Bar(console)
    async with opened(settings, bar) as service:
        with bar.shown(), _interrupts() as interrupted:
            evaluation = await _evaluate(service, bar, experiment_id, body, interrupted)
    return evaluation.model_dump(mode="json")


def check_plug_in(name: str, task: str | None, adapter: str = "kinematic") -> list[str]:
    """What is wrong with the task or adapter of this name, in plain words; this runs it.

    A task whose rules are sound is staged by `adapter`; an adapter stages `task`, or all that it names.

    Raises:
        UnknownName: there is no such thing. Unavailable: simulator, graphics or robot can't be had here.
    """
    from robot_adapters import check  # noqa: PLC0415  it runs what it checks; nothing else here should

    if name in registry.tasks() or name in registry.broken(registry.TASKS):
        registry.adapter(adapter)
        return check.check_task(name) or check.check_adapter(adapter, name)
    tasks = (task,) if task is not None else registry.adapter(name).tasks
    return [finding for staged in tasks for finding in check.check_adapter(name, staged)]


async def _evaluate(
    service: Service, bar: Bar, experiment_id: int, body: EvaluationCreate, interrupted: asyncio.Event
) -> Evaluation:
    bar.count(EvaluationChanged, body.rollouts)
    begun = await service.hub.evaluate(experiment_id, body)
    await _until_idle(service, experiment_id, interrupted)
    if bar.done < body.rollouts:
        raise RunFailed(
            f"the evaluation ended after {bar.done} of {body.rollouts} rollouts",
            remedy=f"try again: seed evaluate {experiment_id} --data-dir {service.settings.data_dir}",
        )
    stored = await service.store.evaluations(experiment_id, limit=1)
    return next(evaluation for evaluation in stored.items if evaluation.id == begun.id)


async def _until_idle(service: Service, experiment_id: int, interrupted: asyncio.Event) -> None:
    """Wait for the end of what goes on; on Ctrl-C pause it in order."""
    idle = asyncio.create_task(service.hub.idle(experiment_id))
    stop = asyncio.create_task(interrupted.wait())
    await asyncio.wait({idle, stop}, return_when=asyncio.FIRST_COMPLETED)
    if interrupted.is_set():
        with contextlib.suppress(Conflict):  # it has ended by itself meanwhile, or was being evaluated
            await service.hub.act(experiment_id, "pause")
        await idle
        where = service.settings.data_dir
        raise Interrupted(
            f"interrupted: experiment {experiment_id} is paused, and everything is stored",
            remedy=f"go on with seed train --resume {experiment_id} --feedback N --data-dir {where}, "
            f"or in the browser with seed serve --data-dir {where}",
        )
    stop.cancel()
    experiment = await service.store.experiment(experiment_id)
    if experiment.lifecycle is Lifecycle.FAILED:
        raise RunFailed(
            f"experiment {experiment_id} failed: {experiment.failure}",
            remedy=f"then go on with seed train --resume {experiment_id} --data-dir {service.settings.data_dir}",
        )


@contextlib.contextmanager
def _interrupts() -> Iterator[asyncio.Event]:
    """An event that SIGINT and SIGTERM set, instead of a traceback."""
    loop = asyncio.get_running_loop()
    interrupted = asyncio.Event()
    caught = (signal.SIGINT, signal.SIGTERM)
    for number in caught:
        loop.add_signal_handler(number, interrupted.set)
    try:
        yield interrupted
    finally:
        for number in caught:
            loop.remove_signal_handler(number)
