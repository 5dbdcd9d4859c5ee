"""A camera's place is found from the board in the hand, to a few mm; bad sessions and bad files say what to do."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from typer.testing import CliRunner

from robot_adapters.base import Array
from robot_adapters.franka.perception import calibration, hand_eye
from robot_adapters.franka.perception.board import Board, Corners
from robot_adapters.franka.perception.calibrating import BadPoses, Session, Step, read_poses
from robot_adapters.franka.perception.calibration import BadCalibration, Calibration
from robot_adapters.franka.perception.camera import Lens, Picture
from robot_adapters.franka.perception.hand_eye import FEWEST, NotEnough, Sighting
from robot_adapters.franka.perception.moved import Reference
from robot_adapters.franka.perception.rays import View, on_plane
from robot_adapters.franka.perception.watching import Watch
from server.cli import app
from tests.robot_adapters.franka.perception.poses import HAND_FROM_BOARD, as_told, facing, hand, transform
from tests.robot_adapters.franka.perception.recording import record
from tests.robot_adapters.franka.perception.rendering import EYES, HEIGHT, TABLE, WIDTH, Stage, view

CORNERS = np.array([[x, y, 0.0] for y in (0.036, 0.072, 0.108, 0.144) for x in 0.036 * np.arange(1, 7)])
TABLE_GRID = np.array([[x, y, TABLE] for x in (0.40, 0.55, 0.70) for y in (-0.15, 0.0, 0.15)])


def off_on_table(found: View, truth: View) -> float:
    """M, the most that a place on the table is off by when it is read off a picture."""
    at = on_plane(found.eye, found.rays(truth.pixels(TABLE_GRID)), TABLE)
    assert at is not None
    return float(np.linalg.norm(at - TABLE_GRID, axis=1).max())


def sightings(truth: View, count: int, *, tilt: float = 0.45, seed: int = 0, pixels: float = 0.1) -> list[Sighting]:
    """What a camera would see of the board, without drawing it."""
    rng = np.random.default_rng(seed)
    made = []
    for _ in range(count):
        held = hand(facing([truth.eye], rng, tilt=tilt))
        seen = View(truth.lens, truth.camera_from_base @ held @ HAND_FROM_BOARD).pixels(CORNERS)
        made.append(Sighting(as_told(held, rng), Corners(CORNERS, seen + rng.normal(0.0, pixels, seen.shape))))
    return made


def test_the_command_calibrates_two_cameras_from_a_recorded_session(
    stage: Stage, views: dict[str, View], tmp_path: Path
) -> None:
    rng = np.random.default_rng(3)
    eyes = [seen.eye for seen in views.values()]
    told: list[list[list[float]]] = []
    taken: dict[str, list[NDArray[np.uint8]]] = {name: [] for name in views}
    for _ in range(9):
        held = facing(eyes, rng)
        stage.place("board", held[:3, 3], held[:3, :3])
        told.append(as_told(hand(held), rng).tolist())
        for name, pictures in taken.items():
            pictures.append(stage.draw(name))
    stage.clear()
    arguments = []
    for name, pictures in taken.items():
        source = record(tmp_path / f"{name}.db3", views[name].lens, [*pictures, stage.draw(name)])
        arguments += ["--camera", f"{name}={source}"]
    (tmp_path / "poses.json").write_text(json.dumps(told))
    run = ["robot", "calibrate", *arguments, "--poses", str(tmp_path / "poses.json"), "--data-dir", str(tmp_path)]
    done = CliRunner().invoke(app, [*run, "--json"])
    assert done.exit_code == 0, done.output
    summary = json.loads(done.stdout.splitlines()[-1])
    assert summary["cameras_apart_mm"] < 3
    for name, truth in views.items():
        assert summary["cameras"][name]["poses"] >= 8
        assert 0 < summary["cameras"][name]["error_mm"] < 3
        stored = calibration.load(name, tmp_path / "calibration")
        assert off_on_table(stored.view, truth) < 0.003
        reference = Reference(stored.reference, stored.fixed_tags)
        assert not reference.compare(stage.draw(name), ()).moved


def test_a_lens_that_is_not_known_is_measured_too() -> None:
    matrix = np.array([[900.0, 0.0, 650.0], [0.0, 905.0, 350.0], [0.0, 0.0, 1.0]])
    truth = View(
        Lens(WIDTH, HEIGHT, matrix, np.array([0.08, -0.15, 0.001, -0.0005, 0.0])), view(EYES["left"]).camera_from_base
    )
    found = hand_eye.solve(sightings(truth, 14), None, (WIDTH, HEIGHT))
    assert off_on_table(found.view, truth) < 0.004
    with pytest.raises(NotEnough, match="8 poses of the board, of 12"):
        hand_eye.solve(sightings(truth, 8), None, (WIDTH, HEIGHT))


def test_poses_that_do_not_suffice_say_which_are_wanting() -> None:
    truth = view(EYES["left"])
    with pytest.raises(NotEnough, match="3 poses") as few:
        hand_eye.solve(sightings(truth, 3), truth.lens, (WIDTH, HEIGHT))
    assert "take more" in few.value.remedy
    with pytest.raises(NotEnough, match="hardly turned at all") as flat:
        hand_eye.solve(sightings(truth, 12, tilt=0.0)[:1] * 12, truth.lens, (WIDTH, HEIGHT))
    assert "tilt the hand" in flat.value.remedy
    start = sightings(truth, 1)[0]
    about_one_axis = []
    for angle in np.linspace(-0.5, 0.5, 12):
        turned = start.base_from_hand @ transform(Rotation.from_rotvec([0.0, 0.0, angle]).as_matrix(), (0.0, 0.0, 0.0))
        seen = View(truth.lens, truth.camera_from_base @ turned @ HAND_FROM_BOARD).pixels(CORNERS)
        about_one_axis.append(Sighting(turned, Corners(CORNERS, seen)))
    with pytest.raises(NotEnough, match="about more than one axis"):
        hand_eye.solve(about_one_axis, truth.lens, (WIDTH, HEIGHT))


def test_a_pose_in_which_the_board_slipped_is_left_out() -> None:
    truth = view(EYES["right"])
    seen = sightings(truth, 14)
    slipped = seen[5].base_from_hand @ transform(np.eye(3), (0.015, 0.0, 0.01))
    seen[5] = Sighting(slipped, seen[5].corners)
    found = hand_eye.solve(seen, truth.lens, (WIDTH, HEIGHT))
    assert found.left_out == 1
    assert off_on_table(found.view, truth) < 0.003


class Staged:
    """A live camera whose pictures a test draws; there is no device here."""

    live = False

    def __init__(self, lens: Lens, draw: Callable[[], Picture]) -> None:
        self.lens: Lens | None = lens
        self.read = draw

    def close(self) -> None:
        """Nothing to release."""


def test_the_guide_says_what_to_do_next(stage: Stage, views: dict[str, View]) -> None:
    truth = views["left"]
    watch = Watch("left", lambda: Staged(truth.lens, lambda: Picture(stage.draw("left"), 1.0)))
    session = Session({"left": watch}, Board(), wanted=2)
    rng = np.random.default_rng(1)
    held = facing([truth.eye], rng)

    def step(*poses: Array) -> Step:
        told = iter(poses)
        return session.step(lambda: next(told))

    assert "No camera sees the board" in step(hand(held), hand(held)).said
    stage.place("board", held[:3, 3], held[:3, :3])
    assert step(hand(held), hand(held) @ transform(np.eye(3), (0.005, 0.0, 0.0))).said == "Hold the arm still."
    taken = step(hand(held), hand(held))
    assert taken.taken == {"left": 1}
    assert len(taken.corners["left"]) == 24
    assert "tilt the board in another way" in step(hand(held), hand(held)).said
    with pytest.raises(NotEnough, match="camera left: 1 poses"):
        session.solve()
    assert session.wanted == FEWEST  # two were asked for, which can't do
    for _ in range(20):
        other = facing([truth.eye], rng)
        stage.place("board", other[:3, 3], other[:3, :3])
        if (last := step(hand(other), hand(other))).done:
            break
    assert (last.done, last.taken) == (True, {"left": FEWEST})


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda raw: raw | {"version": 7}, "has version 7, not 1"),
        (lambda raw: {k: v for k, v in raw.items() if k != "lens"}, "lens: Field required"),
        (lambda raw: raw | {"camera_from_base": [[1, 2], [3, 4]]}, "must be a rigid transform"),
        (lambda raw: raw | {"error_mm": -1}, "error_mm"),
        (lambda raw: [raw], "has version None"),
    ],
)
def test_a_damaged_calibration_is_told_with_what_to_do(
    change: Callable[[object], object], says: str, tmp_path: Path
) -> None:
    grey = np.zeros((HEIGHT, WIDTH), dtype=np.uint8)
    path = calibration.save(Calibration("left", "opencv:0", view(EYES["left"]), 0.001, 12, grey), tmp_path)
    path.write_text(json.dumps(change(json.loads(path.read_text()))))
    with pytest.raises(BadCalibration, match=says) as told:
        calibration.load("left", tmp_path)
    assert "seed robot calibrate --camera left=" in told.value.remedy


def test_files_that_are_missing_or_cut_off_are_told(tmp_path: Path) -> None:
    with pytest.raises(BadCalibration, match="isn't calibrated"):
        calibration.load("left", tmp_path)
    grey = np.zeros((HEIGHT, WIDTH), dtype=np.uint8)
    path = calibration.save(Calibration("left", "opencv:0", view(EYES["left"]), 0.001, 12, grey), tmp_path)
    loaded = calibration.load("left", tmp_path)
    assert np.allclose(loaded.view.camera_from_base, view(EYES["left"]).camera_from_base)
    path.with_suffix(".png").unlink()
    with pytest.raises(BadCalibration, match="the picture beside"):
        calibration.load("left", tmp_path)
    path.write_text(path.read_text()[:100])
    with pytest.raises(BadCalibration, match="can't be read"):
        calibration.load("left", tmp_path)
    (tmp_path / "poses.json").write_text("[[[1, 0], [0, 1]]]")
    with pytest.raises(BadPoses, match="pose 1 is no rigid transform"):
        read_poses(tmp_path / "poses.json")


def test_a_push_is_noticed_but_not_lamps_things_or_people(stage: Stage) -> None:
    reference = Reference(np.asarray(cv2.cvtColor(stage.draw("left"), cv2.COLOR_RGB2GRAY), dtype=np.uint8), {})
    held = facing([EYES["left"]], np.random.default_rng(0))
    stage.place("board", held[:3, 3], held[:3, :3])
    cluttered = stage.draw("left")
    for fine in (cluttered, (cluttered * 0.6).astype(np.uint8)):
        assert not reference.compare(fine, ()).moved
    stage.clear()
    for pushed in (
        view(EYES["left"] + [0.003, 0.0, 0.0]),
        view(EYES["left"], np.array([0.545, 0.0, -0.08])),
        view(EYES["left"] + [0.1, 0.1, 0.0]),
    ):
        stage.stand("left", pushed)
        assert reference.compare(stage.draw("left"), ()).moved
    covered = reference.compare(np.full((HEIGHT, WIDTH, 3), 30, dtype=np.uint8), ())
    assert covered.moved
    assert "covered or dark" in covered.detail
