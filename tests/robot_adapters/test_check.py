"""The checker finds nothing wrong with what ships, and says plainly what is wrong with what doesn't fit."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot_adapters import registry
from robot_adapters.check import check_adapter, check_task

MODULE = """
import numpy as np
from robot_adapters.base import ParameterSpec, SkillCall, SkillSpec
from robot_adapters.kinematic import KinematicFactory
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.tasks.stacking import Stacking

class Backwards(Stacking):
    name = "backwards"
    def judge(self, state, call):
        return -super().judge(state, call)

class Unseeded(Stacking):
    name = "unseeded"
    def sample_layout(self, rng):
        return super().sample_layout(np.random.default_rng())

class Misnamed(Stacking):
    horizon = 1
    skills = (SkillSpec("throw", (ParameterSpec("x", "m", 1.0, 0.0),)),)

class Crashing(Stacking):
    name = "crashing"
    def keypoints(self, state, skill=None):
        return state["blocks"]

class Empty:
    name = "empty"

class Careless(KinematicAdapter):
    def execute(self, call, *, should_stop, on_step):
        return super().execute(call, should_stop=lambda: False, on_step=on_step)
    def reset(self, seed=None):
        return super().reset(None)

class CarelessFactory(KinematicFactory):
    name = "careless"
    def __call__(self, task, settings):
        return Careless(Stacking(), settings)

class BrokenFactory(KinematicFactory):
    name = "broken"
    def __call__(self, task, settings):
        raise OSError("cable unplugged")

CARELESS, BROKEN = CarelessFactory(), BrokenFactory()
"""
ENTRY_POINTS = """
[seed.tasks]
backwards = checked_plugin:Backwards
unseeded = checked_plugin:Unseeded
misnamed = checked_plugin:Misnamed
crashing = checked_plugin:Crashing
empty = checked_plugin:Empty
[seed.adapters]
careless = checked_plugin:CARELESS
broken = checked_plugin:BROKEN
"""


@pytest.fixture
def plugin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A package with tasks and adapters that each have something wrong."""
    (tmp_path / "checked_plugin.py").write_text(MODULE)
    info = tmp_path / "checked_plugin-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: checked-plugin\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(ENTRY_POINTS)
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path)])
    registry._load_all.cache_clear()
    yield
    registry._load_all.cache_clear()
    sys.modules.pop("checked_plugin", None)


@pytest.mark.parametrize("task", ["reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog"])
def test_what_ships_is_sound(task: str) -> None:
    assert check_task(task) == []
    assert check_adapter("kinematic", task) == []


def test_unknown_names_are_findings() -> None:
    assert "stacking" in check_task("stacknig")[0]
    assert "kinematic" in check_adapter("cinematic", "stacking")[0]
    assert "stacking" in check_adapter("kinematic", "stacknig")[0]


@pytest.mark.usefixtures("plugin")
@pytest.mark.parametrize(
    ("task", "words"),
    [
        ("backwards", "judge() finds the true call bad"),
        ("backwards", "judge() finds most random calls good"),
        ("unseeded", "draw only from the generator"),
        ("misnamed", "make them the same"),
        ("misnamed", "'throw' is no primitive"),
        ("misnamed", "low must be below high"),
        ("misnamed", "horizon 1 ends episodes before"),
        ("crashing", "a rule of the task raised IndexError"),
        ("empty", "empty has no skills: add a tuple of SkillSpec"),
        ("empty", "empty has no method judge"),
    ],
)
def test_a_task_gets_advice(task: str, words: str) -> None:
    assert any(words in finding for finding in check_task(task)), check_task(task)


@pytest.mark.usefixtures("plugin")
@pytest.mark.parametrize(
    ("adapter", "task", "words"),
    [
        ("careless", "stacking", "should_stop() was True from the start"),
        ("careless", "stacking", "np.random.default_rng(seed)"),
        ("careless", "unseeded", "can't stage unseeded"),
        ("broken", "stacking", "OSError: cable unplugged"),
    ],
)
def test_an_adapter_gets_advice(adapter: str, task: str, words: str) -> None:
    findings = check_adapter(adapter, task)
    assert any(words in finding for finding in findings), findings
