"""The calibration agrees with the pictures to a pixel, and the pictures show what a trainer needs."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from robot_adapters.base import SkillCall
from robot_adapters.projection import project
from robot_adapters.registry import task
from robot_adapters.robosuite.adapter import RobosuiteAdapter
from tests.robot_adapters.robosuite.conftest import shared

STACKING = task("stacking")
CAMERAS = ("left", "right")
SHOWN, HIDDEN = 1, 5  # geom groups: what is drawn, and what is not


@contextmanager
def alone(model: mujoco.MjModel, geom: int) -> Iterator[None]:
    """Only this geom is drawn: another block or the arm would hide a part of it and move its centroid."""
    groups = model.geom_group.copy()
    model.geom_group[:] = HIDDEN
    model.geom_group[geom] = SHOWN
    yield
    model.geom_group[:] = groups


def centroid(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(2,) u, v of the mask's middle; a pixel's centre is half a pixel from its corner."""
    v, u = np.nonzero(mask)
    return np.array([u.mean(), v.mean()]) + 0.5


@pytest.mark.parametrize("seed", [0, 1, 4, 14])
@pytest.mark.parametrize("camera", CAMERAS)
def test_a_block_s_centre_projects_onto_its_pixels(stacking: RobosuiteAdapter, camera: str, seed: int) -> None:
    state = stacking.reset(seed).state
    for block, position in (("block_a", state[:3]), ("block_b", state[3:])):
        geom = stacking.simulator.model.geom(f"{block}_g0_vis").id
        with alone(stacking.simulator.model, geom):
            mask = stacking.cameras.geoms(camera) == geom
        assert mask.sum() > 200
        dot = stacking.overlays(SkillCall("pick", tuple(position)))[camera].dot
        assert dot is not None
        assert np.linalg.norm(np.array(dot) - centroid(mask)) < 1.0


# a task's object -> a part that is drawn, and its middle from the object's origin
PARTS = {
    "sweeping": {"broom": ("broom_1_vis", (0.0, 0.0, -0.017)), "toy": ("toy_0_vis", (0.0, 0.0, 0.0))},
    "collecting_toy": {"toy": ("toy_0_vis", (0.0, 0.0, 0.0)), "drawer": ("drawer_5_vis", (-0.084, 0.0, 0.024))},
    "cooking_hotdog": {
        "skillet": ("skillet_17_vis", (-0.125, 0.0, 0.015)),
        "sausage": ("sausage_0_vis", (0.0, 0.0, 0.0)),
    },
}


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(("name", "thing"), [(name, thing) for name, things in PARTS.items() for thing in things])
def test_a_thing_projects_onto_its_pixels(name: str, thing: str, camera: str, seed: int) -> None:
    adapter = shared(name)
    adapter.reset(seed)
    drawn, offset = PARTS[name][thing]
    geom = adapter.simulator.model.geom(drawn).id
    with alone(adapter.simulator.model, geom):
        mask = adapter.cameras.geoms(camera) == geom
    assert mask.sum() > 150
    scene = adapter.simulator.scene()
    if thing in scene.joints:
        fixed = next(spec.fixed for spec in task(name).objects if spec.name == thing)
        assert fixed is not None
        origin = np.array(fixed) - [scene.joints[thing], 0.0, 0.0]
    else:
        origin = scene.objects[thing]
    pixel, _ = project(adapter.cameras.calibration(camera), origin + offset)
    assert np.linalg.norm(pixel[0] - centroid(mask)) < 2.0


COLOURS = {
    "sweeping": {
        "blue": ("broom_1_vis",),
        "yellow": ("broom_0_vis", "broom_2"),
        "pink": ("toy_0_vis",),
        "green": ("dustpan_0_vis", "dustpan_1_vis"),
    },
    "collecting_toy": {"blue": ("drawer_5_vis", "drawer_6_vis"), "pink": ("toy_0_vis",)},
    "cooking_hotdog": {"blue": ("skillet_17_vis",), "grey": ("stove_0_vis", "stove_2"), "red": ("stove_1",)},
}
LOOKS = {
    "blue": lambda r, g, b: b > 1.5 * max(r, g),
    "yellow": lambda r, g, b: min(r, g) > 2 * b,
    "pink": lambda r, g, b: r > 1.3 * b > 1.3 * g,
    "green": lambda r, g, b: g > 1.5 * max(r, b),
    "red": lambda r, g, b: r > 2 * max(g, b),
    "grey": lambda r, g, b: max(r, g, b) < 1.2 * min(r, g, b),
}


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("name", COLOURS)
def test_things_have_the_colours_that_trainers_are_told(name: str, camera: str) -> None:
    adapter = shared(name)
    frame = adapter.reset(0).frames[camera]
    picture = np.asarray(Image.open(io.BytesIO(frame.jpeg)).convert("RGB"), dtype=np.float64)
    seen = adapter.cameras.geoms(camera)
    for colour, geoms in COLOURS[name].items():
        mask = np.isin(seen, [adapter.simulator.model.geom(geom).id for geom in geoms])
        assert mask.sum() > 100, f"{colour} is hidden"
        assert LOOKS[colour](*picture[mask].mean(axis=0)), f"{colour} looks like {picture[mask].mean(axis=0)}"


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_whole_workspace_is_in_view(stacking: RobosuiteAdapter, camera: str) -> None:
    low, high = STACKING.skills[0].low, STACKING.skills[0].high
    for corner in np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T:
        assert stacking.overlays(SkillCall("pick", tuple(corner)))[camera].in_view


@pytest.mark.parametrize("camera", CAMERAS)
def test_both_blocks_can_be_seen_in_the_observation(stacking: RobosuiteAdapter, camera: str) -> None:
    frame = stacking.reset(0).frames[camera]
    pixels = np.asarray(Image.open(io.BytesIO(frame.jpeg)).convert("RGB"), dtype=np.int64)
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    assert ((red > 120) & (green < 70) & (blue < 70)).sum() > 150
    assert ((green > 60) & (red < 60) & (blue < 70)).sum() > 150


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_area_of_reaching_can_be_seen_and_touches_nothing(reaching: RobosuiteAdapter, camera: str) -> None:
    pixels = np.asarray(Image.open(io.BytesIO(reaching.reset(0).frames[camera].jpeg)).convert("RGB"), dtype=np.int64)
    assert ((pixels[..., 2] - pixels[..., 0]) > 80).sum() > 1000
    model = reaching.simulator.model
    assert "target" not in {model.geom(i).name for i in range(model.ngeom)}


@pytest.mark.parametrize("seed", [0, 1])  # the fingers stay straight in 0; in 1 they turn away from the other block
@pytest.mark.parametrize("camera", CAMERAS)
def test_the_bar_shows_the_angle_that_the_fingers_take(stacking: RobosuiteAdapter, camera: str, seed: int) -> None:
    call = STACKING.true_call(stacking.reset(seed).state)
    drawn = stacking.overlays(call)[camera]
    assert drawn.bar is not None
    stacking.execute(call, should_stop=lambda: False, on_step=lambda: None)
    assert (abs(stacking.simulator.pose()[1]) > 1) == (seed == 1)
    pads = [stacking.simulator.data.geom(f"gripper0_right_finger{i}_pad_collision").xpos for i in (1, 2)]
    axis = (pads[0] - pads[1]) / np.linalg.norm(pads[0] - pads[1]) * 0.04
    ends, _ = project(stacking.cameras.calibration(camera), np.array(call.parameters) + np.stack([axis, -axis]))
    swapped = np.linalg.norm(ends - drawn.bar, axis=1).max() > np.linalg.norm(ends[::-1] - drawn.bar, axis=1).max()
    assert (ends[::-1] if swapped else ends) == pytest.approx(np.array(drawn.bar), abs=2.0)


TARGETS = {"stacking": "block_a", "sweeping": "broom", "collecting_toy": "toy", "cooking_hotdog": "skillet"}
"""What the first true call of a task picks up."""


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("name", TARGETS)
def test_the_overlay_of_every_task_lies_on_what_it_means(name: str, camera: str) -> None:
    adapter = shared(name)

    call = task(name).true_call(adapter.reset(3).state)
    drawn = adapter.overlays(call)[camera]
    seen = adapter.cameras.geoms(camera)
    model = adapter.simulator.model
    body = adapter.simulator._bodies[TARGETS[name]]
    pixels = np.argwhere(np.isin(model.geom_bodyid[np.maximum(seen, 0)], [body]) & (seen >= 0))[:, ::-1]
    assert len(pixels) > 50, "it is hidden"
    assert drawn.dot is not None
    near = np.linalg.norm(pixels - np.array(drawn.dot), axis=1).min()
    assert near < 12, f"the dot is {near:.0f} px from the {TARGETS[name]}"
    # the ghost's fingers stand on both sides of it, as wide apart as the bar
    fingers = [np.array(outline).mean(axis=0) for outline in drawn.ghost[:2]]
    assert drawn.bar is not None
    assert np.linalg.norm(fingers[0] - fingers[1]) == pytest.approx(np.linalg.norm(np.subtract(*drawn.bar)), rel=0.45)
    assert np.linalg.norm(np.mean(fingers, axis=0) - np.array(drawn.dot)) < 30
