"""What has no tags is found by its colour and depth, beside what has some; without depth it isn't known."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.franka.eyes import Hand
from robot_adapters.franka.perception import perceive
from robot_adapters.franka.perception.rays import View
from robot_adapters.tasks.collecting_toy import PINK, TOY_HALF, TRAY_CLOSED
from tests.robot_adapters.franka.perception.conftest import Calibrate
from tests.robot_adapters.franka.perception.recording import record
from tests.robot_adapters.franka.perception.rendering import TABLE, Stage

AWAY = Hand(np.array([0.31, 0.0, 0.3]), 0.0, 0.08, False)
COARSE = 0.015
"""m; twice what the benchmark finds with this noise."""
FILE = f"""
version = 1
[objects.toy]
rests = [0.020, 0.026]
colour = {list(PINK)}
half_height = {TOY_HALF}
[objects.drawer]
rests = [0.006]
tags = [{{ number = 21, size = 0.022, at = [-0.088, 0.0, 0.032] }}]
"""


def noisy(metres: NDArray[np.float32], rng: np.random.Generator) -> NDArray[np.float32]:
    """Off by 4 mm, neighbouring pixels alike: what stereo does."""
    coarse = rng.normal(0.0, 0.004, (metres.shape[0] // 8, metres.shape[1] // 8)).astype(np.float32)
    return metres + cv2.resize(coarse, metres.shape[::-1], interpolation=cv2.INTER_CUBIC)


def test_a_toy_without_tags_is_found_by_colour_where_there_is_depth(
    stage: Stage, views: dict[str, View], calibrated: Calibrate, tmp_path: Path
) -> None:
    where, rng = calibrated(), np.random.default_rng(2)
    (tmp_path / "mine.toml").write_text(FILE)
    places = [np.array([0.40, 0.08, TABLE + TOY_HALF]), np.array([0.45, -0.10, TABLE + TOY_HALF])]
    colours: dict[str, list[NDArray[np.uint8]]] = {name: [stage.draw(name)] for name in views}
    depths = {name: [noisy(stage.render(name)[1], rng)] for name in views}
    stage.place("collecting_toy/drawer", np.array(TRAY_CLOSED) - np.array([0.12, 0.0, 0.0]))
    for at in places:
        stage.place("toy", at, 0.4)
        for name in views:
            colours[name].append(stage.draw(name))
            depths[name].append(noisy(stage.render(name)[1], rng))
    settings = {"calibration": str(where), "tags": str(tmp_path / "mine.toml")}
    films = {n: record(tmp_path / f"{n}.db3", views[n].lens, colours[n], depths[n]) for n in views}
    eyes = perceive("collecting_toy", {**settings, "cameras": films})
    try:
        for at in places:
            sight = eyes.look(AWAY)
            assert not sight.missing
            assert np.linalg.norm(sight.objects["toy"] - at) < COARSE
            assert abs(sight.joints["drawer"] - 0.12) < 0.002
    finally:
        eyes.close()
    flat = {n: record(tmp_path / f"{n}-flat.db3", views[n].lens, [*colours[n], colours[n][-1]]) for n in views}
    eyes = perceive("collecting_toy", {**settings, "cameras": flat})
    try:
        assert eyes.look(AWAY).missing == {"toy": "not seen yet"}
    finally:
        eyes.close()
