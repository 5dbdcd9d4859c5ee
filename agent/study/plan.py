"""What a study does: scenarios of the paper, contestants, seeds, budgets, and the runs that follow. No torch here."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from agent.algorithm import AgentError


class StudyError(AgentError):
    """A study that can't be planned, or a folder that is of another study."""


class Axis(StrEnum):
    """What training is counted in: a budget's unit and a curve's x."""

    LOW_LEVEL_STEPS = "low_level_steps"
    DECISIONS = "decisions"
    """Skills proposed, or low-level actions where there are no skills: each is one feedback where a trainer judges."""


class Measure(StrEnum):
    """A curve's y."""

    SUCCESS_RATE = "success_rate"
    """Of deterministic rollouts."""
    SUCCESSES = "successes"
    """While training, counted up."""


Kind = Literal["feedback", "reward", "low_level", "low_level_feedback", "claim"]
"""Skills judged before they run; skills rewarded after; low-level actions rewarded; low-level actions judged; one of
those that a claim of the paper is about (`agent.study.claims`)."""


class Frozen(BaseModel):
    """A value that is written to `study.json` and read back."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Scenario(Frozen):
    """A task as one figure looks at it. usual_budget: where the axis of the paper's figure ends, if it has one."""

    name: str
    title: str
    task: str
    axis: Axis
    measure: Measure
    usual_budget: int
    algorithms: tuple[str, ...]
    """Who competes unless told otherwise."""
    first_subgoal: bool = False
    """The episode is solved once the task's first subgoal is."""


class Contestant(Frozen):
    """An algorithm with its settings. settings: what differs from the defaults of its settings model."""

    name: str
    title: str
    kind: Kind
    algorithm: str
    """What builds it: `seed`, or a name of `agent.baseline_config.BASELINES`."""
    settings: Mapping[str, Any] = {}


SIMULATED = ("seed", "seed-recommended", "tamer", "maple-aff", "maple", "sac")
JUDGED = ("seed", "seed-recommended", "tamer")

SCENARIOS: Mapping[str, Scenario] = {
    scenario.name: scenario
    for scenario in (
        Scenario(
            name="reaching",
            title="Reaching",
            task="reaching",
            axis=Axis.LOW_LEVEL_STEPS,
            measure=Measure.SUCCESS_RATE,
            usual_budget=300_000,
            algorithms=SIMULATED,
        ),
        Scenario(
            name="stacking",
            title="Stacking",
            task="stacking",
            axis=Axis.LOW_LEVEL_STEPS,
            measure=Measure.SUCCESS_RATE,
            usual_budget=1_000_000,
            algorithms=SIMULATED,
        ),
        *(
            Scenario(
                name=task,
                title=title,
                task=task,
                axis=Axis.DECISIONS,
                measure=Measure.SUCCESSES,
                usual_budget=budget,
                algorithms=JUDGED,
            )
            for task, title, budget in (
                ("sweeping", "Sweeping", 1400),
                ("collecting_toy", "Collecting-Toy", 1400),
                ("cooking_hotdog", "Cooking-Hotdog", 1230),
            )
        ),
        Scenario(
            name="first_subgoal",
            title="Cooking-Hotdog, first subgoal",
            task="cooking_hotdog",
            axis=Axis.DECISIONS,
            measure=Measure.SUCCESSES,
            usual_budget=250,
            algorithms=("seed", "seed-recommended", "maple-aff"),
            first_subgoal=True,
        ),
    )
}
"""The paper's comparisons. Its long tasks ran on a real robot; here they run on the chosen adapter."""

CLICKS: Mapping[str, Scenario] = {
    scenario.task: Scenario(
        name=f"{scenario.task}-clicks",
        title=scenario.title,
        task=scenario.task,
        axis=Axis.DECISIONS,
        measure=Measure.SUCCESS_RATE,
        usual_budget=budget,
        algorithms=("seed-recommended",),
    )
    for scenario, budget in zip(list(SCENARIOS.values())[:5], (120, 50, 120, 160, 240), strict=True)
}
"""How few feedbacks a task takes, by task. Budgets: twice what the preset `recommended` should need."""


class Protocol(Frozen):
    """How training is measured (paper, 'Evaluation metrics': 100 evaluations of 10 rollouts)."""

    evaluations: Annotated[int, Field(ge=1, le=10_000)] = 100
    rollouts: Annotated[int, Field(ge=1, le=1000)] = 10


class Run(Frozen):
    """One contestant in one scenario from one seed."""

    id: str
    contestant: Contestant
    scenario: Scenario
    seed: int
    budget: Annotated[int, Field(ge=1)]
    most_decisions: Annotated[int, Field(ge=1)] | None = None
    """Ends the run too where the budget is low-level steps: a rejected skill moves nothing and costs none."""
    oracle: str | None = None
    """Id of the run whose learner judges this one's actions."""
    without_physics: bool = False
    """It learns where there is no physics, and is evaluated on the plan's adapter all the same."""
    shown: bool = True
    """False for a run that only makes an oracle."""


class Plan(Frozen):
    """A whole study. It says nothing of where it is kept or how many processes work on it."""

    name: str
    adapter: str
    seeds: Annotated[tuple[int, ...], Field(min_length=1)]
    protocol: Protocol
    runs: Annotated[tuple[Run, ...], Field(min_length=1)]
    together: Annotated[int, Field(ge=1)] = 1
    """Seeds of one curve whose learners of judged skills train in one pass, in one process. Without physics that pays:
    training is most of the work. It is part of the plan because it changes the rounding of what is learned."""

    @property
    def groups(self) -> tuple[tuple[Run, ...], ...]:
        """Runs by process: those that train together, and every other by itself; in order of their first."""
        groups: list[list[Run]] = []
        latest: dict[tuple[str, str], list[Run]] = {}
        for run in self.runs:
            claim = run.contestant.kind == "claim"
            company = run.scenario.name, str(run.seed) if claim else run.contestant.name
            most = {"feedback": self.together, "claim": len(self.contestants)}.get(run.contestant.kind, 1)
            group = latest.get(company)
            if group is None or len(group) >= most:
                group = latest[company] = []
                groups.append(group)
            group.append(run)
        return tuple(tuple(group) for group in groups)

    @property
    def claim(self) -> bool:
        """Whether it is about a claim of the paper: measured at the end only, and by a table of its own."""
        return self.runs[0].contestant.kind == "claim"

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        """Those that runs are about, in order."""
        return tuple({run.scenario.name: run.scenario for run in self.runs if run.shown}.values())

    @property
    def contestants(self) -> tuple[Contestant, ...]:
        """Those that compete, in order."""
        return tuple({run.contestant.name: run.contestant for run in self.runs if run.shown}.values())

    def of(self, scenario: str, contestant: str) -> tuple[Run, ...]:
        """The runs of one curve."""
        return tuple(
            run
            for run in self.runs
            if run.shown and run.scenario.name == scenario and run.contestant.name == contestant
        )


ORACLE_STEPS = 8000
"""Least budget of a learner that judges: twice what the preset `quick` of SAC takes to learn Reaching without physics
(docs/baselines.md)."""
MOST_TOGETHER = 8
"""Learners of one pass: with more, what they read no longer fits into a core's cache, and little is saved."""
STEPS_OF_A_SKILL = 5
"""Low-level steps of the shortest skills here, reaches of some centimetres (the paper: typically around 100). A run of
judged skills may take as many decisions as its budget would pay if every one were that short and executed."""


def planned(
    name: str,
    adapter: str,
    entries: Sequence[tuple[Scenario, Sequence[Contestant]]],
    *,
    seeds: Sequence[int],
    budgets: Mapping[str, int],
    protocol: Protocol,
    oracle: Contestant,
    oracle_steps: int = ORACLE_STEPS,
    processes: int | None = None,
) -> Plan:
    """The runs of a study, seed by seed: what is interrupted has something of everything.

    budgets: scenario -> budget; the usual one where it is silent. oracle: the learner that judges low-level actions; it
    is trained first, from the first seed, on the same task without physics, as long as those whom it judges and for
    `oracle_steps` at least: with physics it would never meet the reward (docs/baselines.md). processes: so many will
    work on it, and seeds of one curve may share one; None: every run has its own.

    Raises:
        StudyError: nothing is left to run, or a budget is below 1.
    """
    runs: list[Run] = []
    for scenario, contestants in entries:
        budget = budgets.get(scenario.name, scenario.usual_budget)
        if budget < 1:
            raise StudyError(f"the budget of {scenario.name} is {budget}", remedy="give a budget of 1 or more")
        judge = _run(oracle, scenario, seeds[0], max(budget, oracle_steps)).model_copy(
            update={"shown": False, "without_physics": True}
        )
        if any(each.kind == "low_level_feedback" for each in contestants):
            runs.append(judge)
        for contestant in contestants:
            needs = judge.id if contestant.kind == "low_level_feedback" else None
            runs += [_run(contestant, scenario, seed, budget, needs) for seed in seeds]
    if not runs:
        raise StudyError("the study has nothing to run", remedy="name at least one algorithm, task and seed")
    ordered = sorted(runs, key=lambda run: (run.seed, run.shown))  # stable; an oracle before those whom it judges
    curves = sum(each.kind == "feedback" for _, contestants in entries for each in contestants)
    together = 1 if processes is None or not curves else _together(len(seeds), curves, processes)
    return Plan(
        name=name, adapter=adapter, seeds=tuple(seeds), protocol=protocol, runs=tuple(ordered), together=together
    )


def _together(seeds: int, curves: int, processes: int) -> int:
    """As many seeds of a curve in one process as leave no other process without work, and no more than `MOST`."""
    parts = max(math.ceil(processes / curves), math.ceil(seeds / MOST_TOGETHER))
    return math.ceil(seeds / parts)


def _run(contestant: Contestant, scenario: Scenario, seed: int, budget: int, oracle: str | None = None) -> Run:
    capped = contestant.kind == "feedback" and scenario.axis is Axis.LOW_LEVEL_STEPS
    return Run(
        id=f"{scenario.name}-{contestant.name}-{seed}",
        contestant=contestant,
        scenario=scenario,
        seed=seed,
        budget=budget,
        most_decisions=max(1, budget // STEPS_OF_A_SKILL) if capped else None,
        oracle=oracle,
    )
