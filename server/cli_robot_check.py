"""`seed robot check`: whether a real arm, its settings and its cameras are ready, in plain words."""

from __future__ import annotations

import json
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
from pydantic import ValidationError

from robot_adapters.base import AdapterError
from robot_adapters.franka import FrankaSettings
from server.cli_ending import FAILED, FINDINGS, INTERRUPTED, USAGE, give_up, stderr
from server.cli_set import settings_from


def check(  # noqa: PLR0917  Typer makes an option of each
    host: Annotated[str, typer.Option(help="address of the control box, or of Deoxys's computer")] = "172.16.0.2",
    backend: Annotated[str, typer.Option(help="franka_rs, franky or deoxys")] = "franka_rs",
    task: Annotated[str, typer.Option(help="the task whose workspace and cameras are meant")] = "stacking",
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="adapter.NAME=VALUE",
            help="a setting of the adapter, as for an experiment, e.g. adapter.table_height=0.02; may be given again",
        ),
    ] = None,
    yes: Annotated[bool, typer.Option("--yes", help="move without asking: somebody stands at the stop button")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="print one JSON object as the last line")] = False,
) -> None:
    """Check a real arm: connection, state, limits, cameras, and a slow dry run above the table, which asks first.

    Exit codes: 0 all is well; 1 something isn't; 2 wrong arguments; 3 the arm can't be reached; 130 interrupted.
    """
    from robot_adapters.franka import checking  # noqa: PLC0415  it takes a moment that `--help` shouldn't

    settings = _settings(host, backend, changes or [])
    findings = []
    try:
        with _interruptible() as interrupted:
            for finding in checking.check(
                settings, task, permit=lambda question: yes or _asked(question), should_stop=interrupted.is_set
            ):
                findings.append(finding)
                _tell(finding)
    except AdapterError as error:
        give_up(str(error), error.remedy, USAGE)
    bad = [f.what for f in findings if f.verdict is checking.Verdict.BAD]
    if as_json:
        typer.echo(json.dumps({"ok": not bad, "findings": [_plain(f) for f in findings]}))
    elif bad:
        typer.echo(f"not ready: {', '.join(bad)}")
    else:
        skipped = [f.what for f in findings if f.verdict is checking.Verdict.SKIPPED]
        typer.echo("ready" + (f", but not tried: {', '.join(skipped)}" if skipped else ""))
    if interrupted.is_set():
        raise typer.Exit(INTERRUPTED)
    if bad:
        raise typer.Exit(FAILED if "connection" in bad else FINDINGS)


def _settings(host: str, backend: str, changes: list[str]) -> FrankaSettings:
    try:
        given = settings_from(changes).get("adapter_settings", {})
        return FrankaSettings.model_validate({"host": host, "backend": backend} | given)
    except ValidationError as error:
        first = error.errors()[0]
        name = ".".join(str(part) for part in first["loc"]) or "settings"
        message, remedy = f"{name}: {first['msg']}", "see docs/franka.md"
    except ValueError as error:
        message, remedy = str(error), "write e.g. --set adapter.table_height=0.02"
    give_up(message, remedy, USAGE)


def _asked(question: str) -> bool:
    """Whether somebody says yes; no, where nobody can be asked."""
    try:
        return typer.confirm(question, default=False, err=True)
    except typer.Abort:
        return False


def _tell(finding: Any) -> None:
    marks = {"good": "[green]ok  [/]", "note": "[yellow]note[/]", "bad": "[bold red]no  [/]", "skipped": "[dim]--  [/]"}
    stderr.print(f"{marks[finding.verdict]} {finding.what}: ", end="")
    stderr.print(finding.said, markup=False, soft_wrap=True)
    if finding.remedy:
        stderr.print("     remedy: ", end="")
        stderr.print(finding.remedy, markup=False, soft_wrap=True)


def _plain(finding: Any) -> dict[str, str]:
    return {"what": finding.what, "verdict": str(finding.verdict), "said": finding.said, "remedy": finding.remedy}


@contextmanager
def _interruptible() -> Iterator[threading.Event]:
    """Ctrl-C stops the arm and ends in order; a second one ends at once."""
    asked = threading.Event()

    def heard(*_: object) -> None:
        if asked.is_set():
            raise KeyboardInterrupt
        asked.set()

    before = signal.signal(signal.SIGINT, heard)
    try:
        yield asked
    finally:
        signal.signal(signal.SIGINT, before)
