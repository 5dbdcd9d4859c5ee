"""Run one benchmark, several, or all of them: `python -m tests.benchmarks [NAME ...] [--json]`."""

from __future__ import annotations

import argparse
import dataclasses
import importlib
import json
import pkgutil

import tests.benchmarks
from tests.benchmarks.result import Result

NOT_BENCHMARKS = {"result", "__main__"}
ASKED_FOR = {"franka_arm", "franka_stops"}
"""Run only by name: a simulator of their own, and a good part of an hour."""


def names() -> list[str]:
    """Every benchmark in this folder."""
    found = (m.name for m in pkgutil.iter_modules(tests.benchmarks.__path__))
    return sorted(n for n in found if n not in NOT_BENCHMARKS and not n.startswith("_"))


def main() -> None:
    """Parse the command line, run, print."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument(
        "name", nargs="*", help=f"one or more of: {', '.join(names())}; none: all that need no simulator of their own"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object a benchmark")
    arguments = parser.parse_args()
    unknown = sorted(set(arguments.name) - set(names()))
    if unknown:
        parser.error(f"no benchmark named {', '.join(unknown)}; there are: {', '.join(names())}")
    for name in arguments.name or [n for n in names() if n not in ASKED_FOR]:
        result: Result = importlib.import_module(f"tests.benchmarks.{name}").run()
        if arguments.json:
            fields = dataclasses.asdict(result)
            fields.pop("lines")
            print(json.dumps(fields), flush=True)
        else:
            for line in result.lines:
                print(f"  {line}")
            baseline = "" if result.baseline is None else f"  baseline {result.baseline:.4g}"
            bar = "" if result.bar is None else f"  bar {result.bar:.4g}"
            ok = "" if result.ok is None else ("  ok" if result.ok else "  NOT REACHED")
            print(f"{name}: {result.value:.4g} {result.unit}{baseline}{bar}{ok}", flush=True)


if __name__ == "__main__":
    main()
