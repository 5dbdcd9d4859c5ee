"""Overlays land where the geometry says, and what a camera can't see is said to be out of view."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robot_adapters.base import CameraCalibration, ParameterSpec, SkillCall, SkillSpec
from robot_adapters.projection import hull, intrinsics, look_at, overlay, project

TABLE = -0.1


def spec(name: str, *parameters: str) -> SkillSpec:
    return SkillSpec(name, tuple(ParameterSpec(p, "m", -2.0, 2.0) for p in parameters))


PICK = spec("pick", "x", "y", "z")
PUSH = spec("push", "x", "y", "z", "direction", "delta")


@pytest.fixture
def above() -> CameraCalibration:
    """A camera 1 m above the base's origin that looks straight down: u grows with -y, v with -x. Focal length 500."""
    transform = np.array([[0.0, -1, 0, 0], [-1, 0, 0, 0], [0, 0, -1, 1], [0, 0, 0, 1]])
    return CameraCalibration(640, 480, np.array([[500.0, 0, 320], [0, 500, 240], [0, 0, 1]]), transform)


def test_points_project_by_hand(above: CameraCalibration) -> None:
    pixels, depth = project(above, np.array([[0.0, 0.0, 0.0], [0.1, 0.2, 0.5], [0.0, 0.0, 2.0]]))
    assert pixels[0] == pytest.approx([320, 240])
    assert pixels[1] == pytest.approx([320 - 500 * 0.2 / 0.5, 240 - 500 * 0.1 / 0.5])
    assert depth == pytest.approx([1.0, 0.5, -1.0])
    assert np.isnan(pixels[2]).all()


def test_looking_at_a_point_centres_it_with_up_upwards() -> None:
    eye, target = np.array([1.4, 0.6, 0.6]), np.array([0.5, 0.0, 0.0])
    camera = look_at(eye, target, vertical_field_of_view=math.radians(40), width=640, height=480)
    pixels, depth = project(camera, np.array([target, target + np.array([0, 0, 0.1])]))
    assert pixels[0] == pytest.approx([320, 240])
    assert depth[0] == pytest.approx(np.linalg.norm(eye - target))
    assert pixels[1][0] == pytest.approx(320)
    assert pixels[1][1] < 240


def test_the_field_of_view_fills_the_height() -> None:
    k = intrinsics(math.radians(90), 640, 480)
    assert k @ [0.0, 1.0, 1.0] == pytest.approx([320, 480, 1])


def test_pick_has_a_drop_line_to_a_ring_on_the_table(above: CameraCalibration) -> None:
    drawn = overlay(above, SkillCall("pick", (0.1, 0.05, 0.2)), PICK, TABLE)
    assert drawn.dot == pytest.approx((320 - 500 * 0.05 / 0.8, 240 - 500 * 0.1 / 0.8))
    foot = (320 - 500 * 0.05 / 1.1, 240 - 500 * 0.1 / 1.1)
    assert drawn.ring == pytest.approx(foot)
    assert drawn.line is not None
    assert drawn.line[0] == drawn.dot
    assert drawn.line[1] == pytest.approx(foot)
    assert not drawn.arrow
    assert drawn.in_view


@pytest.mark.parametrize(("yaw", "along"), [(0.0, (1, 0)), (math.pi / 2, (0, 1))])
def test_the_bar_is_eight_centimetres_along_the_closing_direction(
    above: CameraCalibration, yaw: float, along: tuple[int, int]
) -> None:
    call = SkillCall("pick", (0.0, 0.0, 0.0, yaw))
    for drawn in (
        overlay(above, call, spec("pick", "x", "y", "z", "yaw"), TABLE),
        overlay(above, SkillCall("pick", call.parameters[:3]), PICK, TABLE, yaw=yaw),
    ):
        assert drawn.bar is not None
        (u0, v0), (u1, v1) = drawn.bar
        assert (abs(u1 - u0), abs(v1 - v0)) == pytest.approx((40 * along[0], 40 * along[1]))
        assert ((u0 + u1) / 2, (v0 + v1) / 2) == pytest.approx(drawn.dot)


@pytest.mark.parametrize(("direction", "end"), [(-0.5, (320, 240 - 50)), (0.5, (320 - 50, 240))])
def test_a_push_is_an_arrow_of_its_length(above: CameraCalibration, direction: float, end: tuple[float, float]) -> None:
    drawn = overlay(above, SkillCall("push", (0.0, 0.0, 0.0, direction, 0.1)), PUSH, TABLE)
    assert drawn.arrow
    assert drawn.ring is None
    assert drawn.line is not None
    assert drawn.line[1] == pytest.approx(end)


def test_a_skill_without_a_position_has_only_its_name(above: CameraCalibration) -> None:
    drawn = overlay(above, SkillCall("release"), spec("release"), TABLE)
    assert (drawn.dot, drawn.line, drawn.bar, drawn.ring, drawn.in_view) == (None, None, None, None, True)


def test_outside_the_image_is_out_of_view(above: CameraCalibration) -> None:
    beside = overlay(above, SkillCall("pick", (0.0, 1.5, 0.0)), PICK, TABLE)
    assert beside.dot == pytest.approx((320 - 750, 240))
    assert not beside.in_view
    behind = overlay(above, SkillCall("pick", (0.0, 0.0, 1.5)), PICK, TABLE)
    assert behind.dot is None
    assert not behind.in_view


def test_the_ghost_is_the_gripper_at_the_target_turned_as_the_bar_is(above: CameraCalibration) -> None:
    drawn = overlay(above, SkillCall("pick", (0.0, 0.0, 0.0)), PICK, TABLE, yaw=math.pi / 2)
    left, right, hand = (np.array(outline) for outline in drawn.ghost)
    assert drawn.yaw == math.pi / 2
    # at this yaw the fingers lie along x, which is up and down in this picture, as far apart as the bar is long
    assert left[:, 0].mean() == pytest.approx(320)
    assert right[:, 0].mean() == pytest.approx(320)
    assert np.ptp(np.concatenate([left, right])[:, 1]) == pytest.approx(500 * 0.112 / (1 - 0.047), rel=0.02)
    assert np.ptp(hand[:, 1]) == pytest.approx(500 * 0.204 / (1 - 0.111), rel=0.01)


def test_the_ghost_of_a_push_is_where_it_ends_with_closed_fingers(above: CameraCalibration) -> None:
    drawn = overlay(above, SkillCall("push", (0.0, 0.0, 0.0, 1.0, 0.1)), PUSH, TABLE)
    assert drawn.line is not None
    assert np.concatenate(drawn.ghost[:2]).mean(axis=0) == pytest.approx(drawn.line[1], abs=4)
    assert not overlay(above, SkillCall("pick", (0.0, 0.0, 0.95)), PICK, TABLE).ghost  # the hand is behind the lens


def test_the_workspace_holds_every_place_that_a_skill_may_act_at(above: CameraCalibration) -> None:
    def at(x: float, y: float, z: float) -> SkillSpec:
        bounds = (("x", 0.0, x), ("y", -y, y), ("z", TABLE, z))
        return SkillSpec("pick", tuple(ParameterSpec(name, "m", low, high) for name, low, high in bounds))

    skills = (at(0.1, 0.2, 0.3), at(0.2, 0.1, 0.0))
    drawn = overlay(above, SkillCall("pick", (0.0, 0.0, 0.0)), skills[1], TABLE, skills=skills)
    expected = [(x, y, z) for z in (TABLE, 0.3) for x, y in ((0.0, -0.2), (0.2, -0.2), (0.2, 0.2), (0.0, 0.2))]
    assert np.array(drawn.workspace) == pytest.approx(project(above, np.array(expected))[0])
    release = SkillSpec("release")
    assert overlay(above, SkillCall("release"), release, TABLE, skills=(release,)).workspace == ()


def test_a_hull_keeps_only_corners() -> None:
    square = np.array([[0, 0], [2, 0], [1, 0], [1, 1], [2, 2], [0, 2], [0, 1]], dtype=float)
    assert sorted(hull(square)) == [(0, 0), (0, 2), (2, 0), (2, 2)]
