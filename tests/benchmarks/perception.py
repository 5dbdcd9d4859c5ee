"""How far off the eyes are, in mm: rendered pictures with blur and noise, recorded, and played by the real pipeline."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from robot_adapters.base import Array
from robot_adapters.franka.eyes import Hand
from robot_adapters.franka.perception import perceive, tagging
from robot_adapters.franka.perception.calibration import Calibration, save
from robot_adapters.franka.perception.rays import View
from robot_adapters.franka.perception.tagging import FACES
from robot_adapters.franka.perception.tags import TagDetector, square
from robot_adapters.registry import task as task_by_name
from tests.benchmarks.result import Result
from tests.robot_adapters.franka.perception.conftest import tagged
from tests.robot_adapters.franka.perception.recording import record
from tests.robot_adapters.franka.perception.rendering import EYES, Stage, cube, view

SCENES = 12
AWAY = Hand(np.array([0.31, 0.0, 0.3]), 0.0, 0.08, False)
PINK = (0.95, 0.38, 0.66)
DEPTH_NOISE = 0.004
"""m, standard deviation of a pixel's depth, which neighbours share: an assumption, about 0.5 % of the distance."""
UNTAGGED = f"""version = 1
[objects.block_a]
rests = [0.020, 0.070]
colour = {list(PINK)}
half_height = 0.02
[objects.block_b]
rests = [0.025]
tags = [{{ number = 1, size = 0.036, at = [0.0, 0.0, 0.025], faces = "up" }}]
"""

Truth = Mapping[str, Array]
Film = dict[str, list[NDArray[np.uint8]]]


def run() -> Result:
    """Errors of block_a and block_b over 12 layouts of Stacking; the baseline is the pose of a single tag."""
    views = {name: view(eye) for name, eye in EYES.items()}
    stage = Stage({**tagged("stacking"), "pink": cube(0.02, PINK)}, views)
    try:
        with tempfile.TemporaryDirectory() as where:
            told = _measure(stage, views, Path(where))
    finally:
        stage.close()
    lines = tuple(
        f"{way}: median {np.median(off):.2f}, 95 % {np.percentile(off, 95):.2f}, worst {max(off):.2f} mm ({len(off)})"
        for way, off in told.items()
    )
    medians = [float(np.median(off)) for off in told.values()]
    return Result("perception", medians[0], "mm median, two cameras", baseline=medians[-1], lines=lines)


def _measure(stage: Stage, views: Mapping[str, View], where: Path) -> dict[str, list[float]]:
    for name, seen in views.items():
        grey = np.asarray(cv2.cvtColor(stage.draw(name), cv2.COLOR_RGB2GRAY), dtype=np.uint8)
        save(Calibration(name, "opencv:99", seen, 0.0, 0, grey), where)
    layouts = _layouts()
    film, _ = _shoot(stage, layouts, "stacking/block_a")
    pink, depths = _shoot(stage, layouts, "pink")
    (where / "untagged.toml").write_text(UNTAGGED)
    both = {n: record(where / f"{n}.db3", views[n].lens, film[n]) for n in views}
    coloured = {n: record(where / f"{n}-pink.db3", views[n].lens, pink[n], depths[n]) for n in views}
    at, untagged = str(where), str(where / "untagged.toml")
    return {
        "tags, triangulated by two cameras": _off(layouts, {"calibration": at, "cameras": both}),
        "tags, ray and plane of one camera": _off(layouts, {"calibration": at, "cameras": {"left": both["left"]}}),
        "colour and depth, two cameras": _off(
            layouts, {"calibration": at, "cameras": coloured, "tags": untagged}, ("block_a",)
        ),
        "baseline: pose of a single tag": _single(layouts, film["left"][1:], views["left"]),
    }


def _layouts() -> list[Truth]:
    staged = task_by_name("stacking")
    layouts = [staged.sample_layout(np.random.default_rng(seed)) for seed in range(SCENES)]
    return [{n: np.asarray(at) for n, at in each.items() if n != "gripper"} for each in layouts]


def _shoot(stage: Stage, layouts: Sequence[Truth], block_a: str) -> tuple[Film, dict[str, list[NDArray[np.float32]]]]:
    """The empty table, then every layout, by each camera."""
    film: Film = {name: [] for name in EYES}
    depths: dict[str, list[NDArray[np.float32]]] = {name: [] for name in EYES}
    turning = np.random.default_rng(1)
    stage.clear()
    for layout in [{}, *layouts]:
        for name, at in layout.items():
            stage.place(block_a if name == "block_a" else f"stacking/{name}", at, float(turning.uniform(-0.3, 0.3)))
        for name in EYES:
            film[name].append(stage.draw(name))
            if block_a != "pink":
                continue
            depth = stage.render(name)[1]
            noise = cv2.GaussianBlur(stage.rng.normal(0.0, 1.0, depth.shape), (0, 0), 2.0)
            depths[name].append((depth + DEPTH_NOISE * noise / noise.std()).astype(np.float32))
    return film, depths


def _off(layouts: Sequence[Truth], settings: Mapping[str, object], which: tuple[str, ...] = ()) -> list[float]:
    """Mm, of every object in every layout.

    Raises:
        RuntimeError: something wasn't seen.
    """
    eyes = perceive("stacking", {**settings, "lost_after": 0.0001})
    try:
        found = []
        for number, layout in enumerate(layouts):
            sight = eyes.look(AWAY)
            if sight.missing:
                raise RuntimeError(f"layout {number}: {dict(sight.missing)}")
            found += [1000 * float(np.linalg.norm(sight.objects[n] - layout[n])) for n in which or layout]
        return found
    finally:
        eyes.close()


def _single(layouts: Sequence[Truth], pictures: Sequence[NDArray[np.uint8]], seen: View) -> list[float]:
    """Mm, by the pose of the tag on top, as most packages give it."""
    on_top = {n: w.tags[0] for n, w in tagging.load(task_by_name("stacking")).objects.items()}
    detector, found = TagDetector(), []
    for layout, picture in zip(layouts, pictures, strict=True):
        tags = {tag.number: tag for tag in detector.find(picture)}
        for name, on in on_top.items():
            corners = square(on.size)[[3, 2, 1, 0]]  # the order that this solver asks for
            pixels = tags[on.number].corners[[3, 2, 1, 0]]
            _, turn, at = cv2.solvePnP(corners, pixels, seen.lens.matrix, np.zeros(5), flags=cv2.SOLVEPNP_IPPE_SQUARE)
            camera_from_tag = np.eye(4)
            camera_from_tag[:3, :3], camera_from_tag[:3, 3] = cv2.Rodrigues(turn)[0], at.ravel()
            base_from_tag = np.linalg.inv(seen.camera_from_base) @ camera_from_tag
            origin = base_from_tag[:3, :3] @ FACES[on.faces].T @ -np.array(on.at) + base_from_tag[:3, 3]
            found.append(1000 * float(np.linalg.norm(origin - layout[name])))
    return found
