"""Printed sheets have their true size, and a detector reads them."""

from __future__ import annotations

import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from typer.testing import CliRunner

from robot_adapters.franka.perception import tagging
from robot_adapters.franka.perception.board import Board
from robot_adapters.franka.perception.moved import FIXED_FROM
from robot_adapters.franka.perception.tagging import BadTags
from robot_adapters.franka.perception.tags import TagDetector
from robot_adapters.registry import task as task_by_name
from server.cli import app
from tests.robot_adapters.franka.perception.conftest import TASKS

PIXELS = 300 / 0.0254
"""A metre, at 300 dots an inch."""


def printed(path: Path, *arguments: str) -> NDArray[np.uint8]:
    done = CliRunner().invoke(app, ["robot", arguments[0], str(path), *arguments[1:]])
    assert done.exit_code == 0, done.output
    assert done.stdout.strip() == str(path)
    return np.asarray(cv2.imread(str(path), cv2.IMREAD_COLOR), dtype=np.uint8)


@pytest.mark.parametrize("task", TASKS)
def test_a_tasks_tags_are_read_off_the_sheet_in_their_size(task: str, tmp_path: Path) -> None:
    found = {tag.number: tag for tag in TagDetector().find(printed(tmp_path / "tags.png", "tags", "--task", task))}
    wanted = {on.number: on for what in tagging.load(task_by_name(task)).objects.values() for on in what.tags}
    assert found.keys() == wanted.keys()
    for number, on in wanted.items():
        sides = np.linalg.norm(np.roll(found[number].corners, -1, axis=0) - found[number].corners, axis=1)
        assert np.allclose(sides / PIXELS, on.size, atol=0.0002)
        # upright on the paper: its right is to the right
        assert found[number].corners[1][0] > found[number].corners[0][0] + 10


def test_the_board_and_tags_that_never_move_are_read_too(tmp_path: Path) -> None:
    corners = Board().find(printed(tmp_path / "board.png", "board"))
    assert corners is not None
    assert len(corners.points) == 24
    spans = np.linalg.norm(corners.pixels - corners.pixels[0], axis=1) / PIXELS
    assert np.allclose(spans, np.linalg.norm(corners.points - corners.points[0], axis=1), atol=0.0002)
    found = TagDetector().find(printed(tmp_path / "fixed.png", "tags", "--fixed", "4"))
    assert sorted(tag.number for tag in found) == [FIXED_FROM + i for i in range(4)]


def test_a_pdf_page_and_an_svg_have_the_size_of_the_paper(tmp_path: Path) -> None:
    for command, width, height in ((["tags", "--task", "stacking"], 210, 297), (["board"], 297, 210)):
        for ending in ("pdf", "svg"):
            path = tmp_path / f"{command[0]}.{ending}"
            assert CliRunner().invoke(app, ["robot", command[0], str(path), *command[1:]]).exit_code == 0
            text = path.read_bytes().decode("latin-1")
            pattern = (
                r"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+)" if ending == "pdf" else r'width="([\d.]+)pt" height="([\d.]+)pt"'
            )
            size = re.search(pattern, text)
            assert size is not None
            assert [float(size[i]) / 72 * 25.4 for i in (1, 2)] == pytest.approx([width, height], abs=0.05)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["tags", "a.gif", "--task", "stacking"], "no ending that is known"),
        (["tags", "a.pdf"], "give either --task stacking or --fixed 4"),
        (["tags", "a.pdf", "--task", "flying"], "flying"),
        (["tags", "a.pdf", "--task", "reaching"], "nothing to tag"),
        (["tags", "nowhere/a.pdf", "--task", "stacking"], "can't be written"),
        (["tags", "a.pdf", "--task", "stacking", "--file", "nowhere.toml"], "there is no nowhere.toml"),
        (["calibrate", "--camera", "left"], "NAME=SOURCE"),
        (["calibrate", "--camera", "left=nowhere.db3", "--poses", "nowhere.json"], "can't be read"),
    ],
)
def test_a_wrong_command_says_what_is_right(arguments: list[str], says: str) -> None:
    done = CliRunner().invoke(app, ["robot", *arguments])
    assert done.exit_code in {2, 3}
    assert says in done.stderr
    assert "remedy:" in done.stderr


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("version = 1", "objects: Field required"),
        ("version = 2\n[objects.a]\nrests = [0.02]", "version"),
        ("version = ", "can't be read"),
        ("version = 1\n[objects.block_a]\nrests = [0.02]", "give tags, or a colour"),
        (
            "version = 1\n[objects.block_a]\nrests = [0.02]\ntags = [{number = 600, size = 0.03, at = [0, 0, 0.02]}]",
            "objects.block_a.tags.0.number",
        ),
        (
            "version = 1\n[objects.block_a]\nrests = [0.02]\ntags = [{number = 7, size = 0.03, at = [0, 0, 0.02]}]",
            "the task block_a, block_b",
        ),
    ],
)
def test_a_bad_tag_file_names_what_is_wrong(text: str, says: str, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(text)
    with pytest.raises(BadTags, match=says) as told:
        tagging.load(task_by_name("stacking"), str(tmp_path / "mine.toml"))
    assert told.value.remedy
