"""How the command line ends: exit codes, and an error with what to do."""

from __future__ import annotations

from typing import NoReturn

import typer
from rich.console import Console

FINDINGS, USAGE, FAILED, INTERRUPTED = 1, 2, 3, 130
"""Exit codes: a check found something; wrong arguments or set-up; robot, simulator or learner failed; interrupted."""

stderr = Console(stderr=True, highlight=False)


def give_up(message: str, remedy: str, code: int) -> NoReturn:
    """Say what is wrong and what to do, and end."""
    stderr.print(f"[bold red]error:[/] {message}", soft_wrap=True)
    stderr.print(f"[bold]remedy:[/] {remedy}", soft_wrap=True)
    raise typer.Exit(code)
