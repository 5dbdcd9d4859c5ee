"""`seed study ...`: the paper's comparisons and others, at one command each, without a browser."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from agent.algorithm import AgentError
from agent.study.algorithms import CONTESTANTS
from agent.study.claims import CLAIMS, claimed
from agent.study.execution import ProcessDied
from agent.study.plan import CLICKS, SCENARIOS, Plan, StudyError
from robot_adapters.base import AdapterError, Unavailable
from server.cli_ending import FAILED, INTERRUPTED, USAGE, give_up, stderr
from server.study_plans import FIRST_SEED, SEEDS, ablated, competing, ladder, named, plan_of
from server.study_runs import Place, run_study
from server.study_screen import results_table

app = typer.Typer(
    help="Run a study: algorithms x tasks x seeds, ending in curves, tables and figures.", no_args_is_help=True
)

Seeds = Annotated[int | None, typer.Option(min=1, help="seeds of each algorithm on each task [default: 5]")]
FirstSeed = Annotated[
    int | None, typer.Option(min=0, max=2**31 - 1, help="the first of them; presets were chosen on 0-4 [default: 10]")
]
Budget = Annotated[
    list[str] | None,
    typer.Option(
        metavar="[TASK=]N",
        help="low-level steps a run on reaching and stacking, decisions (feedbacks) on the others; may be given again "
        "[default: where the paper's figure ends]",
    ),
]
Tasks = Annotated[str | None, typer.Option(help="tasks, separated by commas [default: all]")]
Adapter = Annotated[str | None, typer.Option(help="robosuite or kinematic [default: robosuite]")]
Jobs = Annotated[int | None, typer.Option(min=1, help="processes at a time, one thread each [default: one a core]")]
Evaluations = Annotated[
    int | None, typer.Option(min=1, max=10_000, help="evaluations along a run, beside one before it [default: 100]")
]
Rollouts = Annotated[int | None, typer.Option(min=1, max=1000, help="rollouts of an evaluation [default: 10]")]
Out = Annotated[
    Path | None, typer.Option(help="folder to write; the web page shows those in DATA/studies [default: one there]")
]
Resume = Annotated[bool, typer.Option("--resume", help="go on with the study in that folder, as it was planned")]
DataDir = Annotated[Path | None, typer.Option(help="data directory [default: data, or SEED_DATA_DIR]")]
AsJson = Annotated[bool, typer.Option("--json", help="print one JSON object as the last line")]

ClaimRollouts = Annotated[
    int | None, typer.Option("--rollouts", min=1, max=1000, help="rollouts of a success rate [default: 100]")
]


@app.command("list")
def list_studies() -> None:
    """List the studies there are, with their tasks and algorithms."""
    typer.echo("paper-sim: the paper's comparisons on a simulator")
    for scenario in SCENARIOS.values():
        unit = scenario.axis.value.replace("_", " ")
        typer.echo(f"  {scenario.name:<16} {scenario.usual_budget:>9,} {unit}: {', '.join(scenario.algorithms)}")
    typer.echo(
        "ablation: the preset recommended, one ingredient taken away at a time; --ladder: from paper_sim up to it"
    )
    typer.echo(f"  tasks: {', '.join(CLICKS)}; ingredients: {', '.join(ablated())}; --ladder: {', '.join(ladder())}")
    for claim, title in CLAIMS.items():
        typer.echo(f"{claim}: {title}")


@app.command("paper-sim")
def paper_sim(  # noqa: PLR0917  Typer makes an option of each
    seeds: Seeds = None,
    first_seed: FirstSeed = None,
    budget: Budget = None,
    algorithms: Annotated[
        str | None, typer.Option(help="algorithms, separated by commas [default: those of the paper's figure]")
    ] = None,
    tasks: Tasks = None,
    adapter: Adapter = None,
    jobs: Jobs = None,
    evaluations: Evaluations = None,
    rollouts: Rollouts = None,
    out: Out = None,
    resume: Resume = False,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """The paper's figures and its safety table: SEED, TAMER, MAPLE, MAPLE-aff and SAC on the five tasks."""
    given = {
        "seeds": seeds,
        "first_seed": first_seed,
        "budget": budget,
        "algorithms": algorithms,
        "tasks": tasks,
        "adapter": adapter,
        "evaluations": evaluations,
        "rollouts": rollouts,
    }

    def plan() -> Plan:
        scenarios = named("task", tasks, SCENARIOS)
        chosen = None if algorithms is None else named("algorithm", algorithms, CONTESTANTS)
        entries = [(each, competing(each, chosen, strict=tasks is not None)) for each in scenarios]
        return plan_of("paper-sim", entries, given, place.processes)

    place = Place(out, data_dir, jobs, resume)
    _run("paper-sim", plan, given, place, as_json=as_json)


@app.command()
def ablation(  # noqa: PLR0917  as above
    seeds: Seeds = None,
    first_seed: FirstSeed = None,
    budget: Budget = None,
    without: Annotated[
        str | None, typer.Option(help="ingredients to take away, separated by commas [default: each in turn, and none]")
    ] = None,
    up: Annotated[
        bool, typer.Option("--ladder", help="from paper_sim to recommended, one ingredient more at each step")
    ] = False,
    tasks: Annotated[str | None, typer.Option(help="tasks, separated by commas [default: stacking]")] = None,
    adapter: Adapter = None,
    jobs: Jobs = None,
    evaluations: Evaluations = None,
    rollouts: Rollouts = None,
    out: Out = None,
    resume: Resume = False,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """What each ingredient of the preset `recommended` is worth: success over feedbacks without it, or step by step."""
    given = {
        "seeds": seeds,
        "first_seed": first_seed,
        "budget": budget,
        "without": without,
        "ladder": up or None,
        "tasks": tasks,
        "adapter": adapter,
        "evaluations": evaluations,
        "rollouts": rollouts,
    }

    def plan() -> Plan:
        if up and without is not None:
            raise StudyError("--without: a ladder takes nothing away", remedy="leave out --without or --ladder")
        rows = list(ladder().values()) if up else named("ingredient", without, ablated(), option="--without")
        scenarios = named("task", tasks or "stacking", CLICKS)
        return plan_of("ablation", [(each, rows) for each in scenarios], given, place.processes)

    place = Place(out, data_dir, jobs, resume)
    _run("ablation", plan, given, place, as_json=as_json)


@app.command()
def composition(  # noqa: PLR0917  as above
    seeds: Seeds = None,
    first_seed: FirstSeed = None,
    rollouts: ClaimRollouts = None,
    jobs: Jobs = None,
    out: Out = None,
    resume: Resume = False,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """Zero-shot reward composition: critics of subgoals in scenes and orders they were never trained in."""
    given = {"seeds": seeds, "first_seed": first_seed, "rollouts": rollouts}
    _claim("composition", given, Place(out, data_dir, jobs, resume), as_json=as_json)


@app.command()
def imitation(  # noqa: PLR0917  as above
    seeds: Seeds = None,
    first_seed: FirstSeed = None,
    rollouts: ClaimRollouts = None,
    jobs: Jobs = None,
    out: Out = None,
    resume: Resume = False,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """Imitation: behaviour cloning from clean, bad and mixed demonstrations, beside SEED with as many labels."""
    given = {"seeds": seeds, "first_seed": first_seed, "rollouts": rollouts}
    _claim("imitation", given, Place(out, data_dir, jobs, resume), as_json=as_json)


def _claim(name: str, given: Mapping[str, Any], place: Place, *, as_json: bool) -> None:
    """Run a study of a claim, without physics."""

    def plan() -> Plan:
        first = FIRST_SEED if given["first_seed"] is None else given["first_seed"]
        return claimed(name, range(first, first + (given["seeds"] or SEEDS)), given["rollouts"] or 100)

    _run(name, plan, given, place, as_json=as_json)


def _run(name: str, plan: Callable[[], Plan], given: Mapping[str, Any], place: Place, *, as_json: bool) -> None:
    """Run a study to its end and tell what came out; every foreseen end has its exit code."""
    logging.basicConfig(level="WARNING", format="%(levelname)s %(name)s: %(message)s")
    try:
        done = run_study(name, plan, given, place, stderr)
    except (AgentError, AdapterError) as error:
        give_up(str(error), error.remedy, FAILED if isinstance(error, ProcessDied | Unavailable) else USAGE)
    except KeyboardInterrupt:
        again = f"seed study {name} --resume --out {place.folder(name)}"
        give_up(
            "interrupted: what is finished stays, and every other run goes on from its last evaluation",
            again,
            INTERRUPTED,
        )
    for run, why in done.failed.items():
        stderr.print(f"[bold red]failed:[/] {run}: {why}", soft_wrap=True)
    for warning in done.warnings:
        stderr.print(f"[bold yellow]warning:[/] {warning}", soft_wrap=True)
    if as_json:
        typer.echo(json.dumps(done.told()))
    else:
        Console().print(results_table(done.outcomes))
        typer.echo(f"{done.folder}: table.md, results.csv, {len(done.figures)} figures")
    if done.failed:
        raise typer.Exit(FAILED)
