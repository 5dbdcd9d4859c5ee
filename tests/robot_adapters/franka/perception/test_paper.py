"""The three real tasks and their tag files against the paper (section 'Long-horizon manipulation tasks')."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from robot_adapters.base import Array
from robot_adapters.franka import FrankaFactory
from robot_adapters.franka.perception import tagging
from robot_adapters.franka.perception.tagging import FACES, TagOn
from robot_adapters.franka.perception.tags import TagDetector, square
from robot_adapters.registry import task as task_by_name
from robot_adapters.tasks.base import ObjectSpec, Part
from robot_adapters.tasks.low_level import low_level_fields
from server.cli import app
from tests.robot_adapters.franka.perception.rendering import EYES, HEIGHT, WIDTH, view

PARAMETERS = {
    "pick": ("x", "y", "z"),  # 'Picks up an object at location (x,y,z)'
    "place": ("x", "y", "z"),  # 'Places an object at location (x,y,z)'
    "push": ("x", "y", "z", "direction", "delta"),  # 'pushes end-effector in x or y direction by delta'
}
FINGER = 0.010
"""m, half of what a finger covers along the object's x while it closes along y."""


@dataclass(frozen=True)
class Facts:
    """What the paper says. state: what MAPLE's and SEED's has, in numbers; low_level: SAC's and TAMER's size.

    seen: what has to be found by the cameras for that. rests: heights above the table, m, at which the steps leave it:
    those of what is under it, which are the tasks' own, and of half the object.
    """

    skills: frozenset[str]
    state: tuple[tuple[str, int], ...]
    low_level: int
    steps: tuple[str, ...]
    rests: dict[str, tuple[float, ...]]


PAPER = {
    # 'pick up a broom and sweep a toy into a dustpan'; R^10: 'the 3D positions of the gripper and broom, 2D position of
    # the toy, the gripper state, and a flag indicating whether the broom is being grasped'
    "sweeping": Facts(
        frozenset({"pick", "push"}),
        (("broom_position", 3), ("toy_position", 2), ("broom_grasped", 1)),
        10,
        ("pick up the broom", "sweep the toy"),
        {"broom": (0.080,), "toy": (0.020, 0.002 + 0.020)},
    ),
    # 'picking up a toy, placing it in a drawer, and pushing the drawer closed'; R^10: 'the 3D positions of the gripper
    # and toy, the gripper state, the delta value of the drawer's current position from the closed position, and flags
    # indicating whether the toy is being grasped and whether it is in the drawer'
    "collecting_toy": Facts(
        frozenset({"pick", "place", "push"}),
        (("toy_position", 3), ("drawer_opening", 1), ("toy_grasped", 1), ("toy_in_drawer", 1)),
        10,
        ("pick up the toy", "put it in the drawer", "close the drawer"),
        {"toy": (0.020, 0.006 + 0.020), "drawer": (0.006,)},
    ),
    # 'picking up a skillet and placing it on a stove, placing a sausage on the skillet, picking up the sausage again,
    # and placing it in a bun'; R^15: '3D positions of the gripper, sausage, and skillet, as well as flags indicating
    # the gripper state and the status of various steps in the task'
    "cooking_hotdog": Facts(
        frozenset({"pick", "place"}),
        (
            ("sausage_position", 3),
            ("skillet_position", 3),
            ("skillet_held", 1),
            ("skillet_on_stove", 1),
            ("sausage_held", 1),
            ("sausage_cooked", 1),
            ("sausage_in_bun", 1),
        ),
        15,
        (
            "pick up the skillet",
            "put it on the stove",
            "pick up the sausage",
            "put it in the skillet",
            "pick up the cooked sausage",
            "put it in the bun",
        ),
        {"skillet": (0.015, 0.030 + 0.015), "sausage": (0.012, 0.030 + 0.004 + 0.012, 0.010 + 0.012, 0.004 + 0.012)},
    ),
}
EVERY = pytest.mark.parametrize("name", PAPER)


@EVERY
def test_a_real_task_is_the_papers(name: str) -> None:
    task, facts = task_by_name(name), PAPER[name]
    assert name in FrankaFactory.tasks
    assert {spec.name for spec in task.skills} == facts.skills
    for spec in task.skills:
        assert tuple(p.name for p in spec.parameters) == PARAMETERS[spec.name]
        assert {p.unit for p in spec.parameters if p.name != "direction"} == {"m"}
    assert tuple((field.name, field.size) for field in task.state_fields) == facts.state
    # 'the gripper position and state' are what methods without skills have beside it
    assert sum(field.size for field in low_level_fields(task)) == facts.low_level
    assert facts.low_level - sum(size for _, size in facts.state) == 4
    assert tuple(goal.name for goal in task.subgoals) == facts.steps


@EVERY
def test_its_tag_file_finds_what_its_state_speaks_of_wherever_the_steps_leave_it(name: str) -> None:
    task, facts = task_by_name(name), PAPER[name]
    found = tagging.load(task)
    spoken_of = {field.partition("_")[0] for field, _ in facts.state}
    assert found.objects.keys() == facts.rests.keys() == spoken_of
    for thing, what in found.objects.items():
        assert what.tags, "the paper's objects are tagged; colour is a fallback"
        assert sorted(what.rests) == pytest.approx(sorted(facts.rests[thing]))


@EVERY
def test_a_tag_fits_where_it_is_glued_and_the_fingers_leave_it_free(name: str) -> None:
    specs = {spec.name: spec for spec in task_by_name(name).objects}
    for thing, what in tagging.load(task_by_name(name)).objects.items():
        for on in what.tags:
            spec, edges = specs[thing], rim(on)
            assert any(lies_on(part, edges) for part in _parts(spec)), f"tag {on.number} hangs over an edge of {thing}"
            if spec.grip is not None:
                assert float(np.abs(edges[:, 0] - spec.grip.at[0]).min()) >= FINGER or on.faces != "up", on.number


@EVERY
def test_both_cameras_see_all_of_its_workspace(name: str) -> None:
    for spec in task_by_name(name).skills:
        x, y, z = spec.parameters[:3]
        corners = np.array([[a, b, c] for a in (x.low, x.high) for b in (y.low, y.high) for c in (z.low, z.high)])
        for eye in EYES.values():
            pixels = view(eye).pixels(corners)
            assert (pixels > 0).all(), (spec.name, pixels)
            assert (pixels < [WIDTH, HEIGHT]).all(), (spec.name, pixels)


@EVERY
def test_the_sheet_has_exactly_its_tags(name: str, tmp_path: Path) -> None:
    path = tmp_path / "tags.png"
    done = CliRunner().invoke(app, ["robot", "tags", str(path), "--task", name])
    sheets = [np.asarray(cv2.imread(line), dtype=np.uint8) for line in done.stdout.split()]
    printed = [tag.number for sheet in sheets for tag in TagDetector().find(sheet)]
    assert sorted(printed) == sorted(
        on.number for what in tagging.load(task_by_name(name)).objects.values() for on in what.tags
    )


def test_no_two_tasks_share_a_tag() -> None:
    numbers = [
        on.number
        for name in FrankaFactory.tasks
        for what in tagging.load(task_by_name(name)).objects.values()
        for on in what.tags
    ]
    assert len(numbers) == len(set(numbers))


def rim(on: TagOn) -> Array:
    """(4, 3) m, corners of the tag with its white rim of one module, in the object's frame."""
    corners: Array = np.array(on.at) + square(on.size * 10 / 8) @ FACES[on.faces].T
    return corners


def lies_on(part: Part, corners: Array) -> bool:
    """Whether all of that lies on one face of a part."""
    away = np.abs(corners - np.array(part.centre)) - np.array(part.half)
    on_a_face = (np.abs(away) < 1e-6).all(axis=0).any()
    return bool((away < 1e-6).all() and on_a_face)


def _parts(spec: ObjectSpec) -> tuple[Part, ...]:
    half = spec.half_size
    return spec.parts or (Part((0.0, 0.0, 0.0), (half, half, half), spec.colour),)
