"""Reads the studies below the data directory as they are now, also while another process works on them."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from agent.study import paper
from agent.study.algorithms import CONTESTANTS
from agent.study.curves import study_curve
from agent.study.figures import explained
from agent.study.plan import Plan, Run, Scenario, StudyError
from agent.study.records import FIGURES, RESULTS, TABLE, Folder, Progress
from server.errors import ServiceError
from server.schemas_studies import Study, StudyCurve, StudyPaperCurve, StudyRun, StudyScenario, StudySummary

STUDIES = "studies"
"""Folder of the data directory in which studies are looked for, and to which `seed study` writes by itself."""
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")


class Studies:
    """Every folder in `root` that holds a study, by the folder's name."""

    def __init__(self, data_dir: Path) -> None:
        self._root = data_dir / STUDIES

    def summaries(self) -> list[StudySummary]:
        """Newest first; one that can't be read says why."""
        folders = [path for path in self._root.iterdir() if NAME.fullmatch(path.name)] if self._root.is_dir() else []
        found = [_summary(folder) for path in folders if (folder := Folder(path)).exists]
        return sorted(found, key=lambda each: each.created_at or datetime.min.replace(tzinfo=UTC), reverse=True)

    def study(self, name: str) -> Study:
        """One with everything.

        Raises:
            ServiceError: there is none. StudyError: it can't be read.
        """
        folder = self._folder(name)
        plan, live = folder.plan(), folder.live
        summary, told = _summary(folder), [(run, folder.progress(run.id, live=live)) for run in plan.runs]
        return Study(
            **summary.model_dump(),
            versions=dict(folder.versions()),
            scenarios=[_scenario(folder, plan, scenario) for scenario in plan.scenarios],
            run_list=[_run(run, progress) for run, progress in told],
            files=[path.name for path in _files(folder)],
        )

    def file(self, name: str, file: str) -> Path:
        """A figure or table of a study.

        Raises:
            ServiceError: there is no such study, or no such file.
        """
        for path in _files(self._folder(name)):
            if path.name == file:
                return path
        raise ServiceError(
            404, f"the study {name!r} has no file {file!r}", remedy="it is written when the study comes to its end"
        )

    def _folder(self, name: str) -> Folder:
        folder = Folder(self._root / name)
        if not NAME.fullmatch(name) or not folder.exists:
            known = ", ".join(each.name for each in self.summaries()) or "there is none yet: seed study paper-sim"
            raise ServiceError(404, f"there is no study called {name!r}", remedy=f"use one of: {known}")
        return folder


def _summary(folder: Folder) -> StudySummary:
    told: dict[str, Any] = dict.fromkeys(("study", "adapter", "created_at", "problem"))
    told |= dict.fromkeys(("done", "runs", "finished", "failed"), 0)
    live = folder.live
    try:
        plan, created = folder.plan(), datetime.fromtimestamp(folder.created_at(), UTC)
        told |= {"study": plan.name, "adapter": plan.adapter, "runs": len(plan.runs), "created_at": created}
        seen = [(run, folder.progress(run.id, live=live)) for run in plan.runs]
        told |= {
            "done": sum(progress.done(run) for run, progress in seen) / len(seen),
            "finished": sum(progress.state == "finished" for _, progress in seen),
            "failed": sum(progress.state == "failed" for _, progress in seen),
        }
    except StudyError as error:  # one study's matter: the others are listed all the same
        told["problem"] = f"{error}; {error.remedy}"
    return StudySummary.model_validate({"name": folder.path.name, "live": live, **told})


def _run(run: Run, progress: Progress) -> StudyRun:
    return StudyRun(
        id=run.id,
        scenario=run.scenario.name,
        algorithm=run.contestant.name,
        title=run.contestant.title,
        seed=run.seed,
        budget=run.budget,
        done=progress.done(run),
        **progress.model_dump(exclude={"executions", "episodes"}),
    )


def _scenario(folder: Folder, plan: Plan, scenario: Scenario) -> StudyScenario:
    curves = []
    for contestant in plan.contestants:
        found = study_curve(folder, plan, scenario.name, contestant.name, axis=scenario.axis, measure=scenario.measure)
        if found is None:
            continue
        n = found.seeds
        sem = found.values.std(axis=0, ddof=1) / np.sqrt(n) if n > 1 else None
        curves.append(
            StudyCurve(
                algorithm=contestant.name,
                title=contestant.title,
                seeds=n,
                planned=len(plan.of(scenario.name, contestant.name)),
                x=found.x.tolist(),
                mean=found.values.mean(axis=0).tolist(),
                sem=[None] * len(found.x) if sem is None else sem.tolist(),
            )
        )
    drawn = (
        "Points: mean of the seeds." if plan.claim else "Lines: mean of the seeds; thin lines: one standard error away."
    )
    theirs = [
        StudyPaperCurve(
            algorithm=each.algorithm,
            title=CONTESTANTS[each.algorithm].title,
            trial=each.trial,
            x=list(each.x),
            y=list(each.y),
        )
        for each in paper.curves(scenario.name)
    ]
    return StudyScenario(
        name=scenario.name,
        title=scenario.title,
        axis=scenario.axis.value,
        measure=scenario.measure.value,
        caption=f"{drawn} {explained(folder, plan, scenario)}",
        curves=curves,
        paper=theirs,
    )


def _files(folder: Folder) -> list[Path]:
    """What may be downloaded and is there."""
    tables = [path for name in (TABLE, RESULTS) if (path := folder.path / name).is_file()]
    return [*(folder.path / FIGURES / name for name in folder.figures()), *tables]
