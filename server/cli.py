"""The command line: `seed serve`, `train`, `evaluate`, `study`, `robot`, `check`, `owner-token`, `openapi`.

Exit codes: 0 done; 1 `check` has findings; 2 wrong arguments, or a machine that isn't set up; 3 robot, simulator or
learner failed or can't be had; 130 interrupted.
"""

from __future__ import annotations

import asyncio
import json
import logging
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import ValidationError

from robot_adapters.base import AdapterError, Unavailable
from server.cli_ending import FAILED, INTERRUPTED, USAGE, give_up, stderr
from server.cli_robot import app as robot
from server.cli_runs import Interrupted, RunFailed, check_plug_in, evaluate_stored, train_headless
from server.cli_serve import run_server
from server.cli_set import settings_from
from server.cli_study import app as study
from server.errors import ServiceError
from server.origin import check_bind
from server.schemas import EvaluationCreate, ExperimentCreate
from server.settings import Settings
from server.store import Store
from server.store_errors import StoreError
from server.store_process import StoreProcess

app = typer.Typer(
    help="Train a robot arm from a browser tab by clicking good or bad.",
    epilog="Exit codes: 0 done; 1 check has findings; 2 wrong arguments or set-up; 3 robot, simulator or learner "
    "failed; 130 interrupted.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(study, name="study")
app.add_typer(robot, name="robot")

DataDir = Annotated[
    Path | None,
    typer.Option(help="directory of the database, images and checkpoints [default: data, or SEED_DATA_DIR]"),
]
AsJson = Annotated[bool, typer.Option("--json", help="print one JSON object as the last line")]


@app.command()
def serve(
    host: Annotated[str | None, typer.Option(help="address to listen on [default: 127.0.0.1, or SEED_HOST]")] = None,
    port: Annotated[int | None, typer.Option(help="port; 0 takes a free one [default: 8000, or SEED_PORT]")] = None,
    data_dir: DataDir = None,
) -> None:
    """Run the service and print its URL."""
    settings = _settings(host=host, port=port, data_dir=data_dir)
    _log(settings.log_level)
    try:
        check_bind(settings)
        with StoreProcess() as writer:
            asyncio.run(run_server(settings, writer, announce=typer.echo))
    except (ServiceError, StoreError) as error:
        give_up(str(error), error.remedy, USAGE)
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None  # before it served; afterwards a signal ends it in order


@app.command()
def train(  # noqa: PLR0917  Typer makes an option of each
    task: Annotated[str, typer.Option(help="a task, e.g. stacking")] = "stacking",
    adapter: Annotated[str, typer.Option(help="an adapter, e.g. robosuite or kinematic")] = "robosuite",
    algorithm: Annotated[str, typer.Option(help="an algorithm")] = "seed",
    preset: Annotated[str, typer.Option(help="a preset of the algorithm")] = "recommended",
    teacher: Annotated[str, typer.Option(help="the synthetic trainer that judges")] = "synthetic",
    feedback: Annotated[int, typer.Option(min=1, help="feedback to train with")] = 300,
    seed: Annotated[int, typer.Option(min=0, max=2**31 - 1, help="seed of robot and learner")] = 0,
    num_envs: Annotated[int, typer.Option(min=1, max=16, help="simulated robots at once; they share the learner")] = 1,
    evaluate: Annotated[int, typer.Option(min=0, max=1000, help="rollouts of the final evaluation; 0: none")] = 10,
    name: Annotated[str | None, typer.Option(help="name of the experiment")] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PART.NAME=VALUE",
            help="a setting of algorithm, adapter or teacher, e.g. teacher.noise=0.1; may be given again",
        ),
    ] = None,
    resume: Annotated[int | None, typer.Option(min=1, help="go on with this experiment instead of a new one")] = None,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """Train without a browser: a teacher judges, through the same door as a person."""
    settings = _settings(data_dir=data_dir)
    fields: dict[str, Any] = {
        "name": name or f"{task} by {teacher}, seed {seed}",
        "task": task,
        "adapter": adapter,
        "algorithm": algorithm,
        "preset": preset,
        "teacher": teacher,
        "seed": seed,
        "num_envs": num_envs,
    }
    try:
        fields |= settings_from(changes or [])
    except ValueError as error:
        give_up(str(error), "write e.g. --set teacher.noise=0.1 or --set algorithm.batch_size=32", USAGE)
    if changes and resume is not None:
        give_up("--set is for a new experiment", "leave it out, or leave --resume out", USAGE)

    async def run() -> dict[str, Any]:
        what = resume if resume is not None else ExperimentCreate(**fields)
        return await train_headless(settings, what, feedback, evaluate, stderr)

    _report(run, as_json)


@app.command()
def evaluate(
    experiment: Annotated[int, typer.Argument(min=1, help="id of the experiment")],
    rollouts: Annotated[int, typer.Option(min=1, max=1000, help="rollouts of the deterministic policy")] = 10,
    seed: Annotated[int, typer.Option(min=0, max=2**31 - 1, help="seed of the first rollout's start")] = 10_000,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """Roll out the deterministic policy of a stored experiment (simulated adapters only)."""
    settings = _settings(data_dir=data_dir)
    body = EvaluationCreate(rollouts=rollouts, seed=seed)
    _report(lambda: evaluate_stored(settings, experiment, body, stderr), as_json)


@app.command()
def check(
    name: Annotated[str, typer.Argument(help="a task or an adapter, of this project or your own")],
    task: Annotated[
        str | None, typer.Option(help="check an adapter with this task only [default: all it names]")
    ] = None,
    adapter: Annotated[str, typer.Option(help="the adapter that stages a task")] = "kinematic",
) -> None:
    """Tell the author of a task or an adapter what is wrong with it. Exit code 1: something is."""
    try:
        findings = check_plug_in(name, task, adapter)
    except AdapterError as error:
        give_up(str(error), error.remedy, FAILED if isinstance(error, Unavailable) else USAGE)
    for finding in findings:
        typer.echo(f"- {finding}")
    if findings:
        raise typer.Exit(1)
    typer.echo(f"{name}: nothing found")


@app.command()
def owner_token(data_dir: DataDir = None) -> None:
    """Print a token by which the owner signs in once; those of before end, with the owner's sessions."""
    settings = _settings(data_dir=data_dir)
    _log("warning")

    async def make() -> str:
        store = await Store.open(settings.database_url, settings.data_dir)
        try:
            return await store.people.owner_token()
        finally:
            await store.close()

    try:
        typer.echo(asyncio.run(make()))
    except StoreError as error:
        give_up(str(error), error.remedy, USAGE)


@app.command()
def openapi() -> None:
    """Print the OpenAPI document of the service."""
    from server.app import create_app  # noqa: PLC0415  building the app takes a moment that `--help` shouldn't

    typer.echo(json.dumps(create_app(Settings()).openapi(), indent=2))


def _report(run: Any, as_json: bool) -> None:
    """Run a long command, then print what came out of it; every foreseen end has its exit code."""
    _log("warning")
    try:
        summary = asyncio.run(run())
    except ValidationError as error:
        give_up(_first(error), "see seed train --help", USAGE)
    except RunFailed as error:
        give_up(str(error), error.remedy, FAILED)
    except Interrupted as error:
        give_up(str(error), error.remedy, INTERRUPTED)
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None  # before anything had begun
    except (ServiceError, StoreError) as error:
        give_up(str(error), error.remedy, USAGE)
    else:
        if as_json:
            typer.echo(json.dumps(summary))
        else:
            for key, value in summary.items():
                typer.echo(f"{key.replace('_', ' '):>16}  {value}")


def _settings(**options: Any) -> Settings:
    try:
        return Settings(**{key: value for key, value in options.items() if value is not None})
    except ValidationError as error:
        field = ".".join(map(str, error.errors()[0]["loc"]))
        give_up(
            f"the setting {_first(error)}",
            f"correct --{field.replace('_', '-')} or SEED_{field.upper()}; docs/settings.md lists all",
            USAGE,
        )


def _log(level: str) -> None:
    logging.basicConfig(level=level.upper(), format="%(levelname)s %(name)s: %(message)s")
    if level != "debug":
        for chatty in ("alembic", "uvicorn"):
            logging.getLogger(chatty).setLevel("WARNING")


def _first(error: ValidationError) -> str:
    first = error.errors()[0]
    return f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
