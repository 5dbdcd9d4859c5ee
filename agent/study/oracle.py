"""The learner that judges low-level actions in a study: how far it was trained, and how well it does itself."""

from __future__ import annotations

from dataclasses import dataclass

from agent.study.evaluations import Row
from agent.study.plan import Plan, Run, Scenario
from agent.study.records import Folder

GOOD = 0.9
"""Share of its last rollouts that a judge worth learning from solves: the paper's is "fully trained"."""


@dataclass(frozen=True)
class Oracle:
    """The run that makes it, and its last evaluation: on the study's adapter, as the judged ones'."""

    run: Run
    adapter: str
    last: Row | None
    finished: bool

    @property
    def poor(self) -> bool:
        """Whether it fails itself too often to be a judge."""
        return self.finished and self.last is not None and self.last.success_rate < GOOD

    def told(self) -> str:
        """In words, for tables and captions."""
        where = " without physics" if self.run.without_physics else ""
        about = f"TAMER's actions are judged by {self.run.contestant.title}, {self.run.budget:,} low-level steps{where}"
        if self.last is None or not self.finished:
            return f"{about}: not trained yet."
        solved = (
            f"it solves {self.last.rollouts_succeeded} of {self.last.rollouts} rollouts on the {self.adapter} adapter."
        )
        warning = f" Warning: below {GOOD:.0%} it is a poor judge, and TAMER's results say little." if self.poor else ""
        return f"{about}; {solved}{warning}"


def oracle_of(folder: Folder, plan: Plan, scenario: Scenario) -> Oracle | None:
    """Who judges in a scenario; None where nobody's low-level actions are judged."""
    for run in plan.runs:
        if run.scenario.name == scenario.name and not run.shown:
            rows = folder.rows(run.id)
            last = rows[-1] if rows else None
            finished = last is not None and last.evaluation == plan.protocol.evaluations
            return Oracle(run, plan.adapter, last, finished)
    return None
