"""docs/custom-task.md holds: what it lists, installed as a foreign package, is checked and trained with `seed`."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[1] / "docs" / "custom-task.md").read_text("utf-8")
FILES = dict(re.findall(r"^\*\*`([\w.]+)`\*\*\n\n```\w+\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))
MISTAKES = re.findall(r"^```diff\n-(.*?)\n\+(.*?)\n```\n\n```\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
SEED = [sys.executable, "-c", "from server.cli import app; app(prog_name='seed')"]
SOLVE = """
from robot_adapters import registry
task, factory = registry.task("sorting"), registry.adapter("robosuite")
assert "sorting" in registry.staged(factory)
adapter = factory("sorting", factory.settings())
state, solved = adapter.reset(3).state, False
for _ in task.subgoals:
    assert not solved
    result = adapter.execute(task.true_call(state), should_stop=lambda: False, on_step=lambda: None)
    state, solved = adapter.observe().state, result.success
adapter.close()
print("solved" if solved and not result.violations else result)
"""


CATALOGUE = """
import asyncio, httpx, tempfile
from pathlib import Path
from server.app import create_app
from server.settings import Settings

async def ask(folder):
    app = create_app(Settings(data_dir=Path(folder), create_first_experiment=False))
    transport = httpx.ASGITransport(app)
    client = httpx.AsyncClient(transport=transport, base_url="http://localhost")
    async with app.router.lifespan_context(app), client as http:
        tasks = (await http.get("/api/v1/tasks")).json()
        adapters = (await http.get("/api/v1/adapters")).json()
    print(*(task["name"] for task in tasks), *(task for adapter in adapters for task in adapter["tasks"]))

with tempfile.TemporaryDirectory() as folder:
    asyncio.run(ask(folder))
"""


def install(site: Path, files: dict[str, str]) -> Path:
    """The page's package in `site`, as pip would leave it."""
    project = tomllib.loads(files["pyproject.toml"])["project"]
    info = site / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
    groups = project["entry-points"].items()
    lines = [f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in points.items()) for group, points in groups]
    (info / "entry_points.txt").write_text("\n".join(lines))
    for name, text in files.items():
        (site / name).write_text(text)
    return site


def run(site: Path, *command: str, **settings: str) -> subprocess.CompletedProcess[str]:
    """A process that finds the package in `site`."""
    environment = os.environ | {"PYTHONPATH": str(site), "OMP_NUM_THREADS": "1", "COLUMNS": "200"} | settings
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=180, check=False)


@pytest.fixture(scope="module")
def sorting(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package exactly as the page lists it."""
    return install(tmp_path_factory.mktemp("sorting"), FILES)


def mistaken(site: Path, old: str, new: str) -> Path:
    """The package with one line of the task changed."""
    assert FILES["sorting.py"].count(old) == 1
    return install(site, FILES | {"sorting.py": FILES["sorting.py"].replace(old, new)})


def test_the_page_lists_the_files_it_names() -> None:
    assert set(FILES) == {"pyproject.toml", "sorting.py", "sorting_scene.py"}
    assert len(MISTAKES) == 2
    compile(FILES["sorting_scene.py"], "sorting_scene.py", "exec")


def test_the_pages_task_is_sound(sorting: Path) -> None:
    done = run(sorting, *SEED, "check", "sorting")
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"```\n{done.stdout}```" in PAGE


def test_the_pages_task_can_be_trained(sorting: Path, tmp_path: Path) -> None:
    command = re.search(r"^seed (train .* --json)$", PAGE, re.MULTILINE)
    assert command is not None
    done = run(sorting, *SEED, *command[1].split(), "--evaluate", "1", "--data-dir", str(tmp_path / "data"))
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout.splitlines()[-1])["feedback"] == 20


@pytest.mark.parametrize(("old", "new", "told"), MISTAKES)
def test_mistakes_are_told_as_the_page_shows(old: str, new: str, told: str, tmp_path: Path) -> None:
    done = run(mistaken(tmp_path, old, new), *SEED, "check", "sorting")
    assert done.stdout == told
    assert done.returncode == 1, done.stderr


def test_an_error_is_told_with_its_method_line_and_arguments(tmp_path: Path) -> None:
    old = "        if self.subgoal(state) == 0:\n"
    site = mistaken(tmp_path, old, "        if self.subgoal(state['blue']) == 0:\n")
    done = run(site, *SEED, "check", "sorting")
    assert done.returncode == 1, done.stderr
    line = FILES["sorting.py"][: FILES["sorting.py"].index(old)].count("\n") + 1
    assert "true_call() raised IndexError: only integers" in done.stdout
    assert f"(sorting.py, line {line})\n  given the state blue_position (" in done.stdout


def test_a_file_that_cannot_be_imported_is_a_finding(tmp_path: Path) -> None:
    site = mistaken(tmp_path, "from robot_adapters.tasks import table\n", "from robot_adapters.tasks import tabel\n")
    done = run(site, *SEED, "check", "sorting")
    assert done.returncode == 1, done.stderr
    assert "can't be loaded: ImportError: cannot import name 'tabel'" in done.stdout


def test_the_service_offers_it_and_leaves_a_broken_one_out(sorting: Path, tmp_path: Path) -> None:
    sound = run(sorting, sys.executable, "-c", CATALOGUE).stdout.split()
    assert sound.count("sorting") == 4, "in the list of tasks, by both simulators, and by the real arm"
    broken = run(mistaken(tmp_path, "    horizon = 6\n", ""), sys.executable, "-c", CATALOGUE)
    assert sound.count("stacking") == broken.stdout.split().count("stacking") == 4
    assert "the task sorting is left out" in broken.stderr


def test_the_pages_task_is_solved_in_physics(sorting: Path) -> None:
    done = run(sorting, sys.executable, "-c", SOLVE)
    assert done.stdout.splitlines()[-1:] == ["solved"], done.stdout + done.stderr


def test_an_unknown_adapter_is_a_wrong_argument(sorting: Path) -> None:
    done = run(sorting, *SEED, "check", "sorting", "--adapter", "cinematic")
    assert done.returncode == 2, done.stdout
    assert "kinematic" in done.stderr


def test_an_adapter_without_graphics_is_no_finding() -> None:
    # GLFW needs a display; a machine without one is what this stands for
    done = run(
        Path(), *SEED, "check", "robosuite", "--task", "reaching", MUJOCO_GL="glfw", DISPLAY="", WAYLAND_DISPLAY=""
    )
    assert done.returncode == 3, done.stdout
    assert "MUJOCO_GL" in done.stderr
