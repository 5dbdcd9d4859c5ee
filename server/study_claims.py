"""`seed study composition` and `imitation`: studies of claims, each seed in a process of its own, ending in a table."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict, dataclass
from types import ModuleType
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from agent.study.execution import THREADS, ProcessDied, follow_parent
from agent.study.files import write_json
from agent.study.records import TABLE, Folder
from agent.study.versions import versions
from server.study_runs import Place
from server.workers.study import any_task

OUTCOMES = "outcomes.json"


@dataclass(frozen=True)
class Claim:
    """A study that is one function of stage and seeds: what it asks, and the module that has `run` and `table_of`."""

    name: str
    title: str
    load: Callable[[], ModuleType]


def _composition() -> ModuleType:
    from agent.study import composition  # noqa: PLC0415  its learners load torch, which listing studies doesn't need

    return composition


def _imitation() -> ModuleType:
    from agent.study import imitation  # noqa: PLC0415  as above

    return imitation


CLAIMS: Mapping[str, Claim] = {
    claim.name: claim
    for claim in (
        Claim("composition", "critics of subgoals, composed for scenes and orders never trained", _composition),
        Claim("imitation", "behaviour cloning of skill calls beside SEED with as many labels", _imitation),
    )
}


def run_claim(claim: Claim, seeds: Sequence[int], rollouts: int, place: Place, console: Console) -> dict[str, Any]:
    """Run every seed on the kinematic adapter; writes table and outcomes to the folder and returns them for `--json`.

    Raises:
        StudyError: the folder isn't empty, or another process writes to it. ProcessDied: a seed's process was killed.
    """
    folder = Folder(place.folder(claim.name))
    with folder.worked_on():
        folder.require_empty()
        return _run(claim, seeds, rollouts, place, console)


def _run(claim: Claim, seeds: Sequence[int], rollouts: int, place: Place, console: Console) -> dict[str, Any]:
    folder, jobs = place.folder(claim.name), place.processes
    began = time.monotonic()
    for name in THREADS:  # read when a library is loaded, in the processes to come
        os.environ.setdefault(name, "1")
    context = multiprocessing.get_context("spawn")
    found: dict[int, list[Any]] = {}
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    try:
        with (
            ProcessPoolExecutor(min(jobs, len(seeds)), context, follow_parent) as pool,
            Progress(*columns, console=console, transient=True) as bar,
        ):
            shown = bar.add_task(f"{claim.name}, seeds", total=len(seeds))
            going = {pool.submit(_one, claim.name, seed, rollouts): seed for seed in seeds}
            for future in as_completed(going):
                found[going[future]] = future.result()
                bar.advance(shown)
    except BrokenProcessPool as error:
        raise ProcessDied("a seed's process died, perhaps for want of memory", remedy="try fewer --jobs") from error
    outcomes = [outcome for seed in seeds for outcome in found[seed]]
    table = claim.load().table_of(outcomes)
    about = f"{len(seeds)} seeds from {seeds[0]}, kinematic adapter, {rollouts} rollouts each."
    (folder / TABLE).write_text("\n".join([f"# {claim.name}", "", about, "", *table, ""]), "utf-8")
    told = {
        "study": claim.name,
        "folder": str(folder),
        "seeds": list(seeds),
        "rollouts": rollouts,
        "seconds": round(time.monotonic() - began, 3),
        "outcomes": [asdict(outcome) for outcome in outcomes],
    }
    write_json(folder / OUTCOMES, told | {"versions": versions()})
    return told | {"table": table}


def _one(name: str, seed: int, rollouts: int) -> list[Any]:
    """One seed, in a process of its own."""
    outcomes: list[Any] = CLAIMS[name].load().run(any_task, [seed], rollouts=rollouts)
    return outcomes
