"""The house rules that no linter knows: who may import whom, and what a file of this project looks like."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
CODE = (".py", ".ts", ".tsx", ".mjs", ".css", ".sh")
GENERATED = {"web/src/api.ts"}
LONGEST = 400
VAGUE_NAMES = {"utils", "util", "helpers", "helper", "common", "misc", "manager", "managers"}
SIMULATOR = {"mujoco", "robosuite"}
DRIVERS = {"franka", "franky", "pylibfranka", "zmq", "pyrealsense2", "pyapriltags"}


@cache
def tracked() -> tuple[Path, ...]:
    """Every file of the project: what git tracks, or would."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return tuple(ROOT / name for name in sorted(set(listed.splitlines())) if (ROOT / name).is_file())


def name_of(path: Path) -> str:
    """Path below the root, as git writes it."""
    return path.relative_to(ROOT).as_posix()


def texts() -> Iterator[tuple[str, str]]:
    """Name and text of every tracked text file but licence and lock."""
    for path in tracked():
        if path.name in {"LICENSE", "package-lock.json"} or path.suffix in {".png", ".jpg", ".woff2", ".ico"}:
            continue
        yield name_of(path), path.read_text("utf-8")


@cache
def modules() -> tuple[tuple[str, ast.Module], ...]:
    """Name and syntax tree of every Python file."""
    return tuple((name_of(p), ast.parse(p.read_text("utf-8"))) for p in tracked() if p.suffix == ".py")


def imports(tree: ast.Module) -> Iterator[str]:
    """Every absolute module name that a file imports, wherever in the file; `from a import b` gives a and a.b."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module is not None:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def importers(folder: str, but: tuple[str, ...] = ()) -> Iterator[tuple[str, str]]:
    """(file, imported module) of every Python file below `folder`, leaving out the folders in `but`."""
    for name, tree in modules():
        if name.startswith(folder) and not name.startswith(but or ("//",)):
            yield from ((name, imported) for imported in imports(tree))


def top(module: str) -> str:
    """The package that a module belongs to."""
    return module.split(".", maxsplit=1)[0]


def test_only_the_agent_and_its_worker_import_torch() -> None:
    rest = [*importers("server/", but=("server/workers/",)), *importers("robot_adapters/")]
    assert not {f for f, m in rest if top(m) == "torch"}


def test_only_the_robosuite_adapter_imports_the_simulator() -> None:
    production = [pair for folder in ("agent/", "server/", "robot_adapters/") for pair in importers(folder)]
    offenders = {f for f, m in production if top(m) in SIMULATOR and not f.startswith("robot_adapters/robosuite/")}
    assert not offenders


def test_only_the_franka_adapter_imports_robot_drivers() -> None:
    production = [pair for folder in ("agent/", "server/", "robot_adapters/") for pair in importers(folder)]
    assert not {f for f, m in production if top(m) in DRIVERS and not f.startswith("robot_adapters/franka/")}
    foreign = {(f, m) for f, m in production if m.startswith("robot_adapters.franka") and not f.startswith("robot_ad")}
    assert not {(f, m) for f, m in foreign if not f.startswith("server/cli_robot")}  # `seed robot` sets one up


def test_adapters_know_nothing_of_learning_http_or_sql() -> None:
    foreign = {"agent", "server", "torch", "fastapi", "starlette", "uvicorn", "sqlalchemy", "alembic", "websockets"}
    assert not {(f, m) for f, m in importers("robot_adapters/") if top(m) in foreign}


def test_the_agent_sees_only_the_adapters_base_and_tasks() -> None:
    foreign = {"server", "fastapi", "starlette", "uvicorn", "sqlalchemy", "alembic", "websockets"}
    assert not {(f, m) for f, m in importers("agent/") if top(m) in foreign}
    allowed = re.compile(r"robot_adapters(\.(base|tasks)(\..*)?)?$")
    assert not {(f, m) for f, m in importers("agent/") if top(m) == "robot_adapters" and not allowed.match(m)}


def test_production_code_imports_no_tests() -> None:
    production = [pair for folder in ("agent/", "server/", "robot_adapters/", "scripts/") for pair in importers(folder)]
    assert not {f for f, m in production if top(m) in {"tests", "pytest", "hypothesis", "unittest"}}


def loaded_by(program: str) -> set[str]:
    """The packages that a fresh interpreter has loaded after `program`."""
    code = f"{program}\nimport sys; print(*sorted({{m.split('.')[0] for m in sys.modules}}))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return set(done.stdout.split())


def test_the_server_process_loads_neither_torch_nor_a_simulator() -> None:
    names = [name.removesuffix(".py").replace("/", ".").removesuffix(".__init__") for name, _ in modules()]
    server = [n for n in names if top(n) == "server" and not n.startswith(("server.workers", "server.migrations"))]
    assert "server.app" in server
    assert not loaded_by("import " + ", ".join(server)) & {"torch", *SIMULATOR, *DRIVERS}


@pytest.mark.parametrize("group", ["seed.tasks", "seed.adapters", "seed.algorithms", "seed.teachers", "seed.eyes"])
def test_plug_ins_are_light_until_they_are_used(group: str) -> None:
    loading = f"from importlib.metadata import entry_points\nfor e in entry_points(group={group!r}): e.load()"
    assert not loaded_by(loading) & {"torch", *SIMULATOR, *DRIVERS}


def test_every_python_file_says_what_it_is_for() -> None:
    assert not [name for name, tree in modules() if not ast.get_docstring(tree)]


def test_no_file_is_longer_than_it_should_be() -> None:
    lengths = {name: text.count("\n") for name, text in texts() if name.endswith(CODE) and name not in GENERATED}
    assert not {name: lines for name, lines in lengths.items() if lines > LONGEST}


def test_files_are_named_for_what_they_do() -> None:
    assert not [name_of(p) for p in tracked() if p.suffix in CODE and p.stem.lower() in VAGUE_NAMES]


def test_nothing_is_left_to_do() -> None:
    unfinished = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
    assert not [name for name, text in texts() if unfinished.search(text)]


def test_no_file_names_a_machine_or_a_registry() -> None:
    private = re.compile(
        r"(?<![\w.])/(work|root|home/(?!seed\b)\w+|Users)/"
        r"|/opt/(wheels|pypi)|regis"
        r"try\.npmjs|files\.pythonhosted|py"
        r"pi\.org|deb\.deb"
        r"ian\.org"
    )
    assert not [name for name, text in texts() if private.search(text)]
    lock = (ROOT / "web" / "package-lock.json").read_text("utf-8")
    assert '"resolved": "http' not in lock


def sleeps_outside_loops(tree: ast.AST, in_loop: bool = False) -> Iterator[int]:
    """Lines that sleep in straight-line code: a poll in a loop waits for a condition, anything else for luck."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and not in_loop:
            gives_way = bool(node.args) and isinstance(node.args[0], ast.Constant) and node.args[0].value == 0
            if node.func.attr in {"sleep", "wait_for_timeout"} and not gives_way:
                yield node.lineno
        is_function = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        inside = not is_function and (in_loop or isinstance(node, ast.While | ast.For | ast.AsyncFor))
        yield from sleeps_outside_loops(node, inside)


def test_no_test_sleeps_to_synchronise() -> None:
    tests = [(n, t) for n, t in modules() if n.startswith("tests/") and not n.startswith("tests/benchmarks/")]
    assert not {name: lines for name, tree in tests if (lines := list(sleeps_outside_loops(tree)))}
