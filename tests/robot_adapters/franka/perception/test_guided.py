"""A camera that was never calibrated refuses everything until an operator has led it through a calibration."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from robot_adapters.base import Array, Unavailable
from robot_adapters.franka.eyes import Hand
from robot_adapters.franka.perception import PerceptionSettings, perceive
from robot_adapters.franka.perception.hand_eye import NotEnough
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.seeing import Perception
from robot_adapters.guiding import GuideLook
from tests.robot_adapters.franka.perception.poses import as_told, facing, hand, transform
from tests.robot_adapters.franka.perception.recording import record
from tests.robot_adapters.franka.perception.rendering import TABLE, Stage

POSES = 9
AWAY = Hand(np.array([0.31, 0.0, 0.3]), 0.0, 0.08, False)
BLOCKS = {"block_a": (0.50, 0.06, TABLE + 0.02), "block_b": (0.60, -0.08, TABLE + 0.025)}


def test_a_new_camera_refuses_until_it_is_guided_through_a_calibration(
    stage: Stage, views: dict[str, View], tmp_path: Path
) -> None:
    truth, rng = views["left"], np.random.default_rng(3)
    told: list[Array] = []
    film: list[NDArray[np.uint8]] = [stage.draw("left")] * 2  # when it is opened, and when the calibration begins
    for _ in range(POSES):
        held = facing([truth.eye], rng)
        stage.place("board", held[:3, 3], held[:3, :3])
        told.append(as_told(hand(held), rng))
        film.append(stage.draw("left"))
    film.insert(3, film[2])  # the first pose is seen once before it is taken
    stage.clear()
    for name, place in BLOCKS.items():
        stage.place(f"stacking/{name}", place)
    film.extend(stage.draw("left") for _ in range(3))
    source = record(tmp_path / "left.db3", truth.lens, film)
    eyes = Perception("stacking", PerceptionSettings(calibration=str(tmp_path), cameras={"left": source}))
    at: list[Array] = [np.eye(4)]
    guide = eyes.guide(lambda: at[-1], square=0.036, wanted=POSES)

    def look(*, take: bool) -> GuideLook:
        return guide.look(take=take)

    try:
        assert eyes.refusal() == "camera left isn't calibrated"
        assert "isn't calibrated" in eyes.look(AWAY).missing["block_a"]
        with pytest.raises(NotEnough, match="nothing is calculated yet"):
            guide.store()
        at.append(told[0])
        ready = look(take=False)
        assert (ready.advice, ready.cameras[0].found, ready.cameras[0].taken) == ("ready", True, 0)
        assert ready.cameras[0].jpeg[:2] == b"\xff\xd8"
        for number, pose in enumerate(told, 1):
            at.append(pose)
            seen = look(take=True)
            assert seen.cameras[0].taken == number
        assert seen.done
        found = guide.solve().cameras[0]
        assert found.good
        assert (found.poses, found.left_out) == (POSES, 0)
        assert not (tmp_path / "left.json").exists()
        assert guide.store().stored
        assert eyes.refusal() is None
        sight = eyes.look(AWAY)
        assert not sight.missing
        for name, place in BLOCKS.items():
            assert np.linalg.norm(sight.objects[name] - place) < 0.004
    finally:
        eyes.close()


def test_a_camera_that_is_neither_named_nor_calibrated_is_told_at_the_start(tmp_path: Path) -> None:
    with pytest.raises(Unavailable, match="no camera is calibrated") as told:
        perceive("stacking", {"calibration": str(tmp_path)})
    assert "seed robot calibrate" in told.value.remedy


def test_the_arm_must_stand_still_and_the_pose_be_new(stage: Stage, views: dict[str, View], tmp_path: Path) -> None:
    truth = views["left"]
    held = facing([truth.eye], np.random.default_rng(1))
    empty = stage.draw("left")
    stage.place("board", held[:3, 3], held[:3, :3])
    source = record(tmp_path / "left.db3", truth.lens, [empty, empty, *[stage.draw("left")] * 3])
    eyes = Perception("stacking", PerceptionSettings(calibration=str(tmp_path), cameras={"left": source}))
    poses = [hand(held)] * 2
    poses += [hand(held), hand(held) @ transform(np.eye(3), (0.005, 0.0, 0.0))]
    poses += [hand(held)] * 4
    following = iter(poses)
    try:
        guide = eyes.guide(lambda: next(following), square=0.036, wanted=8)
        advice = [guide.look(take=True).advice for _ in range(4)]
        assert advice == ["unseen", "moving", "taken", "known"]
    finally:
        eyes.close()
