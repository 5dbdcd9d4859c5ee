"""A scene that changes while somebody judges it: told, nothing proposed or moved by it, and over once it is put right.

Arm and cameras are doubles, so that a test says what is seen; the adapter is real.
"""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
import pytest

from robot_adapters.base import Array, CameraCalibration, CameraFrame, EndReason, SceneChanged, SceneUnclear, SkillCall
from robot_adapters.franka import FrankaSettings, adapter, connecting, scene_watch
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.franka.eyes import Hand, Sight
from tests.robot_adapters.franka.conftest import APART, TABLE, never, nothing
from tests.simulators.still_arm import StillArm

LOST = "not seen for 4 s"
MOVED = "camera left has moved since it was calibrated, or is covered (5% of 80 details are in place)"
PLACE = SkillCall("place", (0.6, 0.1, TABLE + 0.1))


class Seeing:
    """A double for cameras. A test says where things are, what is lost, and what is wrong with the cameras."""

    cameras: tuple[str, ...] = ()
    image_size = (640, 480)

    def __init__(self) -> None:
        self.at: dict[str, Array] = {name: np.array(at) for name, at in APART.items()}
        self.lost: dict[str, str] = {}
        self.wrong: str | None = None
        self.looks = 0

    def calibrations(self) -> dict[str, CameraCalibration]:
        return {}

    def refusal(self) -> str | None:
        return self.wrong

    def look(self, hand: Hand) -> Sight:
        self.looks += 1
        return Sight(dict(self.at), dict.fromkeys(self.at, time.time()), missing=dict(self.lost))

    def frame(self, camera: str, *, still: bool) -> CameraFrame:
        raise AssertionError("it has no cameras")

    def close(self) -> None:
        pass


@pytest.fixture
def arm() -> StillArm:
    return StillArm()


@pytest.fixture
def eyes() -> Seeing:
    return Seeing()


@pytest.fixture
def real(arm: StillArm, eyes: Seeing, monkeypatch: pytest.MonkeyPatch) -> Iterator[FrankaAdapter]:
    monkeypatch.setattr(connecting, "backend", lambda _: arm)
    monkeypatch.setattr(adapter, "find_eyes", lambda _: lambda *_: eyes)
    monkeypatch.setattr(scene_watch, "LOOK_AGAIN", -1.0)  # at every refresh
    made = FrankaAdapter("stacking", FrankaSettings(dead_man=10.0))
    yield made
    made.close()


def scene(real: FrankaAdapter) -> tuple[str | None, str]:
    told = real.telemetry()
    return told.scene, told.scene_detail


def test_what_is_lost_is_told_and_nothing_is_proposed_until_it_is_seen_again(
    real: FrankaAdapter, arm: StillArm, eyes: Seeing
) -> None:
    seen = real.reset()
    real.refresh()
    assert scene(real) == ("clear", "")
    assert real.overlays(PLACE) == {}
    eyes.lost = {"block_a": LOST}
    real.refresh()
    assert scene(real) == ("unclear", f"not everything is in sight: block_a: {LOST}")
    with pytest.raises(SceneUnclear, match="block_a"):
        real.overlays(PLACE)
    with pytest.raises(SceneUnclear, match="block_a"):
        real.execute(PLACE, should_stop=never, on_step=nothing)
    assert arm.orders == []
    eyes.lost = {}
    real.refresh()
    assert scene(real) == ("clear", "")
    assert real.observe().id == seen.id, "nothing has moved: what is judged is still so"
    assert real.execute(PLACE, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


def test_what_was_moved_is_looked_at_anew_and_never_acted_on_as_it_was(
    real: FrankaAdapter, arm: StillArm, eyes: Seeing
) -> None:
    seen = real.reset()
    eyes.at["block_b"] = eyes.at["block_b"] + np.array([0.0, 0.03, 0.0])
    real.refresh()
    assert scene(real) == ("changed", "block_b was moved by 30 mm since the picture was taken")
    with pytest.raises(SceneChanged):
        real.overlays(PLACE)
    for _ in range(2):  # it stays refused, whoever asks again
        with pytest.raises(SceneChanged):
            real.execute(PLACE, should_stop=never, on_step=nothing)
    assert arm.orders == []
    anew = real.observe()
    assert anew.id != seen.id
    assert scene(real) == ("clear", "")
    assert real.execute(PLACE, should_stop=never, on_step=nothing).end is EndReason.ARRIVED


def test_a_moved_camera_is_told_and_over_once_it_stands_where_it_stood(real: FrankaAdapter, eyes: Seeing) -> None:
    real.reset()
    eyes.wrong = MOVED
    real.refresh()
    assert scene(real) == ("unclear", MOVED)
    assert real.telemetry().calibration == "missing"
    with pytest.raises(SceneUnclear, match="camera left"):
        real.observe()
    real.refresh()
    assert scene(real) == ("unclear", MOVED)
    eyes.wrong = None
    real.refresh()
    assert scene(real) == ("clear", "")
    assert real.observe()


def test_nobody_looks_again_where_nothing_is_judged_or_between_two_set_points(
    real: FrankaAdapter, eyes: Seeing
) -> None:
    real.refresh()
    assert eyes.looks == 0
    real.reset()
    before = eyes.looks
    during: list[int] = []
    real.execute(PLACE, should_stop=never, on_step=lambda: during.append(eyes.looks))
    assert set(during) == {before + 1}, "once, before the arm moves"
