"""From what was asked for on the command line to a study's plan; every error names the option and the remedy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

from agent.ablation import ABLATIONS, LADDER, Ablation
from agent.study.algorithms import CONTESTANTS, ORACLE
from agent.study.plan import Contestant, Plan, Protocol, Scenario, StudyError, planned
from robot_adapters import registry
from server.workers.study import WITHOUT_PHYSICS

SEEDS, FIRST_SEED, ADAPTER = 5, 10, "robosuite"
T = TypeVar("T")


def ablated() -> dict[str, Contestant]:
    """Ingredient -> SEED by the recommended preset without it."""
    return _changed(ABLATIONS)


def ladder() -> dict[str, Contestant]:
    """Ingredient -> SEED by the preset `paper_sim` with it and those before it."""
    return _changed(LADDER)


def _changed(rows: Mapping[str, Ablation]) -> dict[str, Contestant]:
    recommended = CONTESTANTS["seed-recommended"]
    return {
        name: recommended.model_copy(
            update={"name": name, "title": ablation.title, "settings": {**recommended.settings, **ablation.settings}}
        )
        for name, ablation in rows.items()
    }


def named(kind: str, asked: str | None, known: Mapping[str, T], option: str = "") -> list[T]:
    """Those that are asked for by an option, `a,b`, in that order; None: all.

    Raises:
        StudyError: one isn't known, or none is named.
    """
    if asked is None:
        return list(known.values())
    names = list(dict.fromkeys(name.strip() for name in asked.split(",") if name.strip()))
    unknown = [name for name in names if name not in known]
    if unknown or not names:
        raise StudyError(
            f"{option or f'--{kind}s'}: there is no {kind} {', '.join(map(repr, unknown)) or repr(asked)}",
            remedy=f"use one or more of: {', '.join(known)}; separated by commas",
        )
    return [known[name] for name in names]


def competing(scenario: Scenario, chosen: Sequence[Contestant] | None, *, strict: bool) -> list[Contestant]:
    """Who competes in a scenario: those chosen, or those of the paper's figure.

    strict: the scenario was asked for by name, so that one who can't compete in it is an error and not left out.

    Raises:
        StudyError: a learner of low-level actions in a scenario that ends at a skill's subgoal.
    """
    if chosen is None:
        return [CONTESTANTS[name] for name in scenario.algorithms]
    skilled = [each for each in chosen if each.kind in {"feedback", "reward"}]
    if scenario.first_subgoal and len(skilled) < len(chosen) and strict:
        raise StudyError(
            f"--algorithms: {scenario.name} compares learners of skills only",
            remedy=f"leave out {', '.join(each.name for each in chosen if each not in skilled)} or {scenario.name}",
        )
    return skilled if scenario.first_subgoal else list(chosen)


def plan_of(
    name: str, entries: Sequence[tuple[Scenario, Sequence[Contestant]]], given: Mapping[str, Any], jobs: int
) -> Plan:
    """The plan; `given` are the options, None where one wasn't. jobs: how many processes will work on it.

    Raises:
        StudyError: a value is wrong. UnknownName: there is no such adapter, or it doesn't stage a task.
    """
    adapter = given["adapter"] or ADAPTER
    staged = registry.staged(registry.adapter(adapter))
    missing = {scenario.task for scenario, _ in entries} - set(staged)
    if missing:
        raise StudyError(
            f"--adapter: {adapter} doesn't stage {', '.join(sorted(missing))}", remedy="choose others by --tasks"
        )
    first = FIRST_SEED if given["first_seed"] is None else given["first_seed"]
    standard = Protocol()
    return planned(
        name,
        adapter,
        entries,
        seeds=range(first, first + (given["seeds"] or SEEDS)),
        budgets=_budgets(given["budget"] or [], [scenario for scenario, _ in entries]),
        protocol=Protocol(
            evaluations=given["evaluations"] or standard.evaluations, rollouts=given["rollouts"] or standard.rollouts
        ),
        oracle=ORACLE,
        processes=jobs if adapter == WITHOUT_PHYSICS else None,
    )


def _budgets(asked: Sequence[str], scenarios: Sequence[Scenario]) -> dict[str, int]:
    """Scenario -> budget from `N` for all and `task=N` for one; a named one wins.

    Raises:
        StudyError: no number, none above 0, or a task that isn't studied.
    """
    general: dict[str, int] = {}
    special: dict[str, int] = {}
    known = {scenario.name.removesuffix("-clicks"): scenario.name for scenario in scenarios}
    for each in asked:
        task, equals, number = each.rpartition("=")
        if not number.isdecimal() or int(number) < 1:
            raise StudyError(
                f"--budget: {each!r} is no budget", remedy="write a whole number of 1 or more, or e.g. reaching=20000"
            )
        if equals and task not in known:
            raise StudyError(
                f"--budget: {task!r} is none of the tasks studied", remedy=f"use one of: {', '.join(known)}"
            )
        if equals:
            special[known[task]] = int(number)
        else:
            general = dict.fromkeys(known.values(), int(number))
    return general | special
