"""The checker finds nothing wrong with what ships, and says plainly what is wrong with what doesn't fit."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot_adapters import registry
from robot_adapters.base import Unavailable
from robot_adapters.check import check_adapter, check_task

MODULE = """
import numpy as np
from robot_adapters.base import ParameterSpec, SafetyViolation, SkillCall, SkillSpec, Unavailable
from robot_adapters.kinematic import KinematicFactory
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal
from robot_adapters.tasks.stacking import PLACE_Z, A, B, Stacking, X, Y
from robot_adapters.tasks import table

class Loose(Stacking):
    name = "loose"
    skills = (
        SkillSpec("pick", table.position("", x=X, y=Y)[::-1]),
        SkillSpec("pick", ()),
        SkillSpec("release", (ParameterSpec("x", "m", 0.0, 1.0),)),
    )
    state_fields = (StateField("at", 3, "m", "", (1.0,), ()), StateField("at", 3, "m", "", (1.0,) * 3, (0.0,) * 3))
    objects = (
        ObjectSpec("cube", "block"), ObjectSpec("cube", "area", 0.1), ObjectSpec("gripper", "thing", fixed=(0, 0, 0)),
    )

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

class CrashingLater(Stacking):
    name = "crashing_later"
    def success(self, scene):
        return 1 / (scene.held is None) < 0

class Solved(Stacking):
    name = "solved"
    def success(self, scene):
        return np.bool_(True)

class Nan(Stacking):
    name = "nan"
    def state(self, scene):
        return super().state(scene) * np.array([1, 1, 1, 1, np.nan, 1])

class Short(Stacking):
    name = "short"
    def state(self, scene):
        return super().state(scene)[:3]

class Listed(Stacking):
    name = "listed"
    def state(self, scene):
        return super().state(scene).tolist()

class Displaced(Stacking):
    name = "displaced"
    def sample_layout(self, rng):
        return super().sample_layout(rng) | {A: np.array([0.5, 0.0])}

class Forgetful(Stacking):
    name = "forgetful"
    def sample_layout(self, rng):
        return {k: v for k, v in super().sample_layout(rng).items() if k != "gripper"}

class Ruled(Stacking):
    name = "ruled"
    def violations(self, scene):
        return (SafetyViolation("bump", "it bumped"),)

class Sloppy(Stacking):
    name = "sloppy"
    def keypoints(self, state, skill=None):
        return state[:3]
    def subgoal(self, state):
        return 2
    def true_call(self, state):
        return SkillCall("pick", (0.0, 0.0, 0.0))

class Torn(Stacking):
    name = "torn"
    def margin(self, state, call):
        return 1.0
    def sample_good(self, state, rng):
        call = super().sample_good(state, rng)
        return SkillCall(call.skill, (call.parameters[0] + 0.03, *call.parameters[1:]))

class Undecided(Stacking):
    name = "undecided"
    def judge(self, state, call):
        return super().judge(state, call) if super().judge(state, call) > 0 else 0

class Endless(Stacking):
    name = "endless"
    def success(self, scene):
        return False

class Padded(Stacking):
    name = "padded"
    subgoals = (*Stacking.subgoals, Subgoal("rest", "rest a while"))

class Narrow(Stacking):
    name = "narrow"
    skills = (Stacking.skills[0], SkillSpec("place", table.position("", x=X, y=(0.1, 0.14), z=PLACE_Z)))

class Greedy(Stacking):
    name = "greedy"
    def __init__(self, layout):
        pass

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

class PickyFactory(KinematicFactory):
    name = "picky"
    def stages(self, task):
        return False

class AbsentFactory(KinematicFactory):
    name = "absent"
    def __call__(self, task, settings):
        raise Unavailable("no robot answers", remedy="switch it on")

class BrokenFactory(KinematicFactory):
    name = "broken"
    def __call__(self, task, settings):
        raise OSError("cable unplugged")

CARELESS, BROKEN, PICKY, ABSENT = CarelessFactory(), BrokenFactory(), PickyFactory(), AbsentFactory()
"""
ENTRY_POINTS = """
[seed.tasks]
backwards = checked_plugin:Backwards
unseeded = checked_plugin:Unseeded
misnamed = checked_plugin:Misnamed
crashing = checked_plugin:Crashing
empty = checked_plugin:Empty
loose = checked_plugin:Loose
crashing_later = checked_plugin:CrashingLater
solved = checked_plugin:Solved
nan = checked_plugin:Nan
short = checked_plugin:Short
listed = checked_plugin:Listed
displaced = checked_plugin:Displaced
forgetful = checked_plugin:Forgetful
ruled = checked_plugin:Ruled
sloppy = checked_plugin:Sloppy
torn = checked_plugin:Torn
undecided = checked_plugin:Undecided
endless = checked_plugin:Endless
padded = checked_plugin:Padded
narrow = checked_plugin:Narrow
greedy = checked_plugin:Greedy
absent = checked_plugin:Missing
[seed.adapters]
picky = checked_plugin:PICKY
absent = checked_plugin:ABSENT
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
        ("misnamed", "throw"),
        ("loose", "two skills have the same name"),
        ("loose", "pick has the parameters (z, y, x): arms expect (x, y, z) in this order"),
        ("loose", "release has the parameters (x): arms expect ()"),
        ("loose", "two state fields are called 'at'"),
        ("loose", "at has 3 components: give as many low and high values"),
        ("loose", "at has a low that isn't below its high"),
        ("loose", "two objects are called 'cube'"),
        ("loose", "the block cube has half_size 0.0"),
        ("loose", "the area cube is nowhere: give it fixed"),
        ("loose", "an object is called 'gripper'"),
        ("loose", "the thing gripper has no parts"),
        ("crashing", "keypoints() raised IndexError: only integers"),
        ("crashing", "(checked_plugin.py, line "),
        ("crashing", "given the state block_a_position (0."),
        ("crashing_later", "success() raised ZeroDivisionError"),
        ("crashing_later", "given the scene with block_a at (0."),
        ("crashing_later", "block_a held"),
        ("solved", "a start is already solved"),
        ("solved", "no plain bool: wrap it in bool(...)"),
        ("nan", "state() isn't finite: block_b_position is (0."),
        ("short", "state() has shape (3,), its fields make (6,): block_a_position 3 + block_b_position 3"),
        ("listed", "state() gives list: give a numpy array of float64, shape (6,)"),
        ("displaced", "sample_layout() places block_a at [0.5 0. ]: give a finite array of shape (3,)"),
        ("forgetful", "place exactly what moves and `gripper`"),
        ("ruled", "a start already breaks a rule (it bumped)"),
        ("ruled", "a violation is of kind 'bump': use damage or manual_reset"),
        ("sloppy", "keypoints() gives shape (3,): give (k, 3)"),
        ("sloppy", "subgoal() gives 2: give an int, an index into the 2 subgoals"),
        ("sloppy", "true_call() is outside the skills' bounds"),
        ("sloppy", "pick.x = 0.0 is outside the workspace; keep x within [0.42, 0.7] m"),
        ("torn", "judge() finds a call of sample_good() bad"),
        ("torn", "judge() and margin() disagree"),
        ("undecided", "judge() gives 0: give the int +1 or -1"),
        ("endless", "6 true calls (the horizon) don't solve the task"),
        ("endless", "in the episode of seed 0: pick(x=0."),
        ("padded", "the subgoal 'rest' never comes up"),
        ("narrow", "judge() finds the true call bad"),
        ("narrow", "y at its bound 0.100"),
        ("greedy", "can't be built without arguments: TypeError"),
        ("absent", "the task 'absent' can't be loaded: AttributeError"),
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
        ("picky", "unseeded", "picky can't stage unseeded"),
        ("kinematic", "unseeded", "np.random.default_rng(seed)"),
        ("broken", "stacking", "OSError: cable unplugged"),
    ],
)
def test_an_adapter_gets_advice(adapter: str, task: str, words: str) -> None:
    findings = check_adapter(adapter, task)
    assert any(words in finding for finding in findings), findings


@pytest.mark.usefixtures("plugin")
def test_each_finding_is_told_once() -> None:
    assert len(check_task("unseeded")) == 1
    assert len(check_task("solved")) == 2


@pytest.mark.usefixtures("plugin")
def test_an_adapter_that_cannot_be_had_is_not_at_fault() -> None:
    with pytest.raises(Unavailable, match="no robot answers"):
        check_adapter("absent", "stacking")
