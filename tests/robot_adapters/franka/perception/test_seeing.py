"""From a RealSense recording of a rendered table to the scene that a task is told: the production way, end to end."""

from __future__ import annotations

import io
import os

import cv2
import numpy as np
import pytest
from PIL import Image

from robot_adapters.base import Unavailable
from robot_adapters.franka.eyes import Hand
from robot_adapters.franka.perception import PerceptionSettings, perceive
from robot_adapters.franka.perception.calibration import Calibration, save
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.seeing import Perception
from robot_adapters.projection import project
from tests.robot_adapters.franka.perception.conftest import TASKS, Calibrate
from tests.robot_adapters.franka.perception.filming import Film, lay
from tests.robot_adapters.franka.perception.rendering import EYES, TABLE, Stage, view

AWAY = Hand(np.array([0.31, 0.0, 0.3]), 0.0, 0.08, False)
GENEROUS = 0.002
"""m; a bound on every object, several times what is expected of a working pipeline."""


@pytest.mark.parametrize("task", TASKS)
def test_every_task_is_seen_to_a_millimetre_or_two(
    task: str, stage: Stage, film: Film, views: dict[str, View], calibrated: Calibrate
) -> None:
    where = calibrated()
    truths = []
    film.shoot()
    for seed in range(3):
        truths.append(lay(stage, task, seed))
        film.shoot()
    eyes = perceive(task, {"calibration": str(where), "cameras": film.sources(views)})
    try:
        assert eyes.refusal() is None
        for objects, joints in truths:
            sight = eyes.look(AWAY)
            assert not sight.missing
            for name, at in objects.items():
                assert np.linalg.norm(sight.objects[name] - at) < GENEROUS, name
                assert sight.tilts[name] < 0.2
            for name, opening in joints.items():
                assert abs(sight.joints[name] - opening) < GENEROUS
    finally:
        eyes.close()


def test_a_still_is_the_picture_that_was_looked_at_and_projects_as_calibrated(
    stage: Stage, film: Film, views: dict[str, View], calibrated: Calibrate
) -> None:
    where = calibrated()
    film.shoot()
    stage.place("toy", (0.55, 0.05, TABLE + 0.02))
    lay(stage, "stacking", 1)
    film.shoot(3)
    eyes = perceive("stacking", {"calibration": str(where), "cameras": film.sources(views)})
    try:
        eyes.look(AWAY)
        assert eyes.cameras == ("left", "right")
        for name, seen in eyes.calibrations().items():
            still = eyes.frame(name, still=True)
            picture = np.asarray(Image.open(io.BytesIO(still.jpeg)), dtype=np.float64)
            assert picture.shape == (still.height, still.width, 3)
            pink = np.argwhere((picture[..., 0] > 130) & (picture[..., 0] > picture[..., 1] * 1.5))
            middle = pink.mean(axis=0)[::-1] + 0.5
            ((u, v),), _ = project(seen, np.array([[0.55, 0.05, TABLE + 0.02]]))
            assert np.linalg.norm(middle - (u, v)) < 6
        with pytest.raises(Unavailable, match="no camera 'top'"):
            eyes.frame("top", still=True)
    finally:
        eyes.close()


def test_a_camera_that_was_pushed_is_noticed_until_it_is_calibrated_again(
    stage: Stage, film: Film, views: dict[str, View], calibrated: Calibrate
) -> None:
    where = calibrated()
    lay(stage, "stacking", 0)
    film.shoot()
    pushed = view(EYES["left"] + [0.0, 0.004, 0.0])
    stage.stand("left", pushed)
    film.shoot(4)
    settings = PerceptionSettings(calibration=str(where), cameras=film.sources(views))
    eyes = Perception("stacking", settings)
    try:
        assert eyes.refusal() is None
        sight = eyes.look(AWAY)
        assert sight.missing.keys() == {"block_a", "block_b"}
        assert "camera left has moved" in sight.missing["block_a"]
        assert "camera left has moved" in str(eyes.refusal())
        views = {**views, "left": pushed}
        grey = cv2.cvtColor(stage.draw("left"), cv2.COLOR_RGB2GRAY)
        save(Calibration("left", "opencv:99", pushed, 0.001, 15, np.asarray(grey, dtype=np.uint8)), where)
        os.utime(where / "left.json", (1, 1))  # another time than before, however coarse the clock of the disk
        eyes.recheck()
        assert eyes.refusal() is None
        assert not eyes.look(AWAY).missing
    finally:
        eyes.close()


def test_what_is_hidden_is_lost_after_a_while_and_then_nothing_may_be_proposed(
    stage: Stage, film: Film, views: dict[str, View], calibrated: Calibrate
) -> None:
    where = calibrated()
    film.shoot()
    truth, _ = lay(stage, "stacking", 0)
    film.shoot()
    stage.place("stacking/block_a", (0.0, 0.0, -5.0))
    film.shoot(7)
    settings = {"calibration": str(where), "cameras": film.sources(views), "lost_after": 0.001}
    eyes = perceive("stacking", settings)
    try:
        assert not eyes.look(AWAY).missing
        sight = eyes.look(AWAY)
        assert list(sight.missing) == ["block_a"]
        assert sight.missing["block_a"].startswith("not seen for")
        assert np.allclose(sight.objects["block_a"], truth["block_a"], atol=GENEROUS)
        assert eyes.refusal() is None
    finally:
        eyes.close()


def test_a_recording_that_ends_is_a_camera_that_is_gone(
    stage: Stage, film: Film, views: dict[str, View], calibrated: Calibrate
) -> None:
    where = calibrated()
    lay(stage, "stacking", 0)
    film.shoot()
    eyes = perceive("stacking", {"calibration": str(where), "cameras": film.sources(views)})
    try:
        assert "camera left is gone" in eyes.look(AWAY).missing["block_a"]
        assert "camera left is gone" in str(eyes.refusal())
    finally:
        eyes.close()
