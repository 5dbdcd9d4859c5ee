"""Tasks and adapters are found by entry points; what is broken or unknown is said with a remedy."""

from __future__ import annotations

import logging
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from pydantic import ValidationError

from robot_adapters import registry


@pytest.fixture
def fresh() -> Iterator[None]:
    """Entry points are read once; a test that installs some needs them read again, before and after."""
    registry._load_all.cache_clear()
    yield
    registry._load_all.cache_clear()


def install(site: Path, entry_points: str) -> None:
    """A distribution in `site` that declares `entry_points`."""
    info = site / "foreign-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: foreign\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(entry_points)


def test_built_ins_are_found() -> None:
    assert {"reaching", "stacking"} <= registry.tasks().keys()
    assert {"kinematic", "robosuite"} <= registry.adapters().keys()
    assert registry.task("stacking").name == "stacking"
    assert registry.adapter("kinematic").name == "kinematic"


@pytest.mark.parametrize(("find", "known"), [(registry.task, "stacking"), (registry.adapter, "kinematic")])
def test_an_unknown_name_lists_the_known_ones(find: Callable[[str], object], known: str) -> None:
    with pytest.raises(registry.UnknownName, match="'stacknig'") as raised:
        find("stacknig")
    assert known in raised.value.remedy


@pytest.mark.usefixtures("fresh")
def test_a_broken_foreign_package_breaks_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "broken_plugin.py").write_text("raise RuntimeError('no licence found')\n")
    install(
        tmp_path,
        "[seed.tasks]\nbroken = broken_plugin:Task\nabsent = no_such_module:Task\n"
        "foreign = robot_adapters.tasks.reaching:Reaching\nstacking = robot_adapters.tasks.reaching:Reaching\n",
    )
    # after everything else on the path, as an installed package would be
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path)])
    with caplog.at_level(logging.WARNING):
        tasks = registry.tasks()
    assert {"reaching", "stacking", "foreign"} <= tasks.keys()
    assert not {"broken", "absent"} & tasks.keys()
    assert tasks["stacking"].name == "stacking", "a foreign package can't take a built-in's place"
    assert "broken_plugin" in caplog.text
    assert "no licence found" in caplog.text
    with pytest.raises(registry.UnknownName):
        registry.task("broken")


def test_listing_loads_no_simulator() -> None:
    code = (
        "import sys; from robot_adapters import registry; registry.tasks(); registry.adapters();"
        "print(sorted(m for m in ('mujoco', 'robosuite', 'torch', 'cv2') if m in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.strip() == "[]"


@pytest.mark.usefixtures("fresh")
def test_an_adapter_stages_foreign_tasks_that_it_accepts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "odd_tasks.py").write_text(
        "from robot_adapters.base import SkillSpec\nfrom robot_adapters.tasks.stacking import Stacking\n"
        "class Throwing(Stacking):\n    skills = (SkillSpec('throw'),)\n"
        "class Unbuildable(Stacking):\n    def __init__(self):\n        raise OSError('no file')\n"
    )
    install(
        tmp_path,
        "[seed.tasks]\nforeign = robot_adapters.tasks.reaching:Reaching\nthrowing = odd_tasks:Throwing\n"
        "unbuildable = odd_tasks:Unbuildable\n",
    )
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path)])
    kinematic = registry.adapter("kinematic")
    staged = registry.staged(kinematic)  # with what other tests have made known in this process
    assert staged[: len(kinematic.tasks)] == kinematic.tasks
    assert set(staged) & {"foreign", "throwing", "unbuildable"} == {"foreign"}


@pytest.mark.usefixtures("fresh")
def test_what_cannot_be_loaded_is_known_with_its_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(tmp_path, "[seed.tasks]\nabsent = no_such_module:Task\nstacking = no_such_module:Task\n")
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path)])
    assert registry.broken(registry.TASKS) == {"absent": "ModuleNotFoundError: No module named 'no_such_module'"}
    with pytest.raises(registry.UnknownName, match="no_such_module"):
        registry.task("absent")
    assert registry.task("stacking").name == "stacking"


def test_an_experiment_of_before_opens_although_a_setting_of_its_arm_is_gone() -> None:
    settings = registry.adapter("franka").settings
    stored = settings.model_validate({"host": "172.16.0.9", "jpeg_quality": 80})
    assert stored.model_dump()["host"] == "172.16.0.9"
    with pytest.raises(ValidationError, match="jpeg_qualities"):
        settings.model_validate({"jpeg_qualities": 80})
