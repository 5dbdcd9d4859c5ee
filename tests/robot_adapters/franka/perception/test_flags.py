"""The flags of the tasks' states (in the hand, in the drawer, on the stove), as the adapter tells them.

The pictures are rendered and recorded; the arm is a double without physics, which follows its goals at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from robot_adapters.base import Array, EndReason, Observation, SkillCall, Unavailable
from robot_adapters.franka import FrankaSettings, connecting
from robot_adapters.franka.adapter import FrankaAdapter
from robot_adapters.franka.perception.rays import View
from robot_adapters.registry import task as task_by_name
from robot_adapters.tasks.base import entry_names
from robot_adapters.tasks.collecting_toy import CABINET_HALF, TOY_HALF, TRAY_CLOSED, TRAY_HALF
from robot_adapters.tasks.cooking_hotdog import BUN_AT, ON_STOVE, ON_THE_STOVE, PAN_RADIUS, SKILLET_GRASP, STOVE_HALF
from tests.robot_adapters.franka.conftest import never, nothing
from tests.robot_adapters.franka.perception.conftest import Calibrate
from tests.robot_adapters.franka.perception.filming import Film
from tests.robot_adapters.franka.perception.rendering import TABLE, Stage
from tests.simulators.still_arm import HOME, StillArm

OPEN, EMPTY, TOY, HANDLE = 0.08, 0.0, 0.04, 0.024  # m between fingers: open, closed on nothing, on the toy, on a handle
PEN = 0.012
"""m: something that belongs to no task."""
OPENED = 0.15
TRAY = np.array(TRAY_CLOSED) - np.array([OPENED, 0.0, 0.0])
OUT = np.array([0.40, 0.05, TABLE + TOY_HALF])
Place = Array | tuple[Array, Array]
"""(3,) m, or with a rotation (3, 3)."""


class Lab:
    """An adapter that sees a film. Scenes are shot before it is opened."""

    def __init__(self, stage: Stage, film: Film, calibrate: Calibrate, views: dict[str, View]) -> None:
        self.arm = StillArm()
        self._stage, self._film, self._views = stage, film, views
        self._where = calibrate()
        self.adapter: FrankaAdapter | None = None
        film.shoot()

    def shoot(self, task: str, places: Mapping[str, Place], *, times: int = 1) -> None:
        """The task's objects there, and nothing else, for so many pictures of each camera."""
        self._stage.clear()
        for name, place in places.items():
            at, turned = place if isinstance(place, tuple) else (place, np.eye(3))
            self._stage.place(f"{task}/{name}", at, turned)
        self._film.shoot(times)

    def open(self, task: str) -> FrankaAdapter:
        settings = {"calibration": str(self._where), "cameras": self._film.sources(self._views), "lost_after": 0.5}
        self.adapter = FrankaAdapter(task, FrankaSettings(eyes_settings=settings))
        return self.adapter


@pytest.fixture
def lab(
    stage: Stage, film: Film, calibrated: Calibrate, views: dict[str, View], monkeypatch: pytest.MonkeyPatch
) -> Iterator[Lab]:
    made = Lab(stage, film, calibrated, views)
    monkeypatch.setattr(connecting, "backend", lambda _: made.arm)
    yield made
    if made.adapter is not None:
        made.adapter.close()


def flags(task: str, seen: Observation) -> dict[str, float]:
    names = entry_names(task_by_name(task).state_fields)
    return {n: v for n, v in zip(names, seen.state.tolist(), strict=True) if "position" not in n and "opening" not in n}


@dataclass(frozen=True)
class Case:
    """What is staged: where things and hand are, how far its closed fingers are apart; and the flags that are set."""

    what: str
    places: Mapping[str, Place]
    width: float
    site: Array
    up: frozenset[str] = frozenset()


def told(lab: Lab, task: str, cases: list[Case]) -> None:
    """Stage one after the other, and compare. The hand counts as closed: it was when the adapter found it."""
    for case in cases:
        lab.shoot(task, case.places)
    lab.arm.width = EMPTY
    adapter = lab.open(task)
    for case in cases:
        lab.arm.width, lab.arm.position = case.width, case.site
        found = flags(task, adapter.reset())
        assert {name for name, flag in found.items() if flag == 1.0} == case.up, case.what
        assert set(found.values()) <= {0.0, 1.0}


def off(place: Array, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Array:
    """(3,) m so far from a place."""
    moved: Array = place + np.array([x, y, z])
    return moved


def drawer(**places: Place) -> dict[str, Place]:
    return {"drawer": TRAY, **places}


IN_TRAY = off(TRAY, z=TOY_HALF)
BESIDE = off(IN_TRAY, y=TRAY_HALF[1] + 0.03)
ON_CABINET = np.array([TRAY_CLOSED[0], 0.0, TABLE + 2 * CABINET_HALF[2] + TOY_HALF])
GRASPED, IN_DRAWER = frozenset({"toy_grasped"}), frozenset({"toy_in_drawer"})


def test_the_toy_counts_as_grasped_between_fingers_and_as_in_the_drawer_only_in_its_tray(lab: Lab) -> None:
    told(
        lab,
        "collecting_toy",
        [
            Case("on the table, the hand away", drawer(toy=OUT), EMPTY, HOME),
            Case("closed on nothing, right at the toy", drawer(toy=OUT), EMPTY, OUT),
            Case("closed on the toy", drawer(toy=OUT), TOY, OUT, GRASPED),
            Case("told to close, and the fingers stay open", drawer(toy=OUT), OPEN, OUT),
            Case("something else in the hand, the toy 6 cm aside", drawer(toy=OUT), PEN, off(OUT, y=0.06)),
            Case("in the tray", drawer(toy=IN_TRAY), EMPTY, HOME, IN_DRAWER),
            Case("in the tray, and held", drawer(toy=IN_TRAY), TOY, IN_TRAY, GRASPED),
            Case("held above the tray", drawer(toy=off(IN_TRAY, z=0.1)), TOY, off(IN_TRAY, z=0.1), GRASPED),
            Case("beside the tray", drawer(toy=BESIDE), EMPTY, HOME),
            Case("before the tray", drawer(toy=off(IN_TRAY, x=-TRAY_HALF[0] - 0.035, y=0.055)), EMPTY, HOME),
            Case("on the closed cabinet", {"drawer": np.array(TRAY_CLOSED), "toy": ON_CABINET}, EMPTY, HOME),
        ],
    )


SKILLET, SAUSAGE = np.array([0.66, -0.10, TABLE + 0.015]), np.array([0.40, -0.10, TABLE + 0.012])
STOVE = np.array(ON_THE_STOVE)


def leaning() -> Place:
    """The skillet with its axis over the stove's edge: one side up on it, the other down on the table."""
    tilt = float(np.arcsin(2 * STOVE_HALF[2] / PAN_RADIUS))
    edge = off(STOVE, y=-STOVE_HALF[1], z=0.015 * (np.cos(tilt) - 1))
    return edge, Rotation.from_euler("x", tilt).as_matrix()


def kitchen(skillet: Place = SKILLET, sausage: Place = SAUSAGE) -> dict[str, Place]:
    return {"skillet": skillet, "sausage": sausage}


def test_the_skillet_counts_as_on_the_stove_only_well_upon_it_and_let_go(lab: Lab) -> None:
    on_stove, held = frozenset({"skillet_on_stove"}), frozenset({"skillet_held"})
    grip = np.array(SKILLET_GRASP)
    turn = Rotation.from_euler("z", 0.25).as_matrix()
    cooking = off(STOVE, z=0.004 - 0.015 + 0.012)
    bun = off(np.array(BUN_AT), z=0.022)
    told(
        lab,
        "cooking_hotdog",
        [
            Case("both on the table", kitchen(), EMPTY, HOME),
            Case("held by its handle, turned", kitchen((SKILLET, turn)), HANDLE, SKILLET + turn @ grip, held),
            Case("closed beside the pan, not at its handle", kitchen(), HANDLE, off(SKILLET, y=0.06)),
            Case("on the stove", kitchen(STOVE), EMPTY, HOME, on_stove),
            Case("on the stove, still in the hand", kitchen(STOVE), HANDLE, STOVE + grip, held),
            Case("near the stove's edge", kitchen(off(STOVE, y=0.005 - ON_STOVE)), EMPTY, HOME, on_stove),
            Case("too near its edge", kitchen(off(STOVE, y=-0.005 - ON_STOVE)), EMPTY, HOME),
            Case("half on the stove, half on the table", kitchen(leaning()), EMPTY, HOME),
            Case("held above the stove", kitchen(off(STOVE, z=0.05)), HANDLE, off(STOVE + grip, z=0.05), held),
            Case("the raw sausage in the bun", kitchen(sausage=bun), EMPTY, HOME, frozenset({"sausage_in_bun"})),
            Case("cooking", kitchen(STOVE, cooking), EMPTY, HOME, on_stove | {"sausage_cooked"}),
            Case("in the hand", kitchen(STOVE, cooking), HANDLE, cooking, on_stove | {"sausage_held"}),
            Case("beside the bun", kitchen(sausage=off(bun, y=0.03)), EMPTY, HOME),
        ],
    )


def test_a_broom_is_grasped_by_its_handle(lab: Lab) -> None:
    broom, toy = np.array([0.45, 0.16, TABLE + 0.08]), np.array([0.54, 0.0, TABLE + 0.02])
    scene: dict[str, Place] = {"broom": broom, "toy": toy}
    grasped = frozenset({"broom_grasped"})
    told(
        lab,
        "sweeping",
        [
            Case("standing there", scene, EMPTY, HOME),
            Case("held", scene, 0.03, broom, grasped),
            Case("held, 15 mm too high", scene, 0.03, off(broom, z=0.015), grasped),
            Case("the toy held instead", scene, TOY, toy),
            Case("closed above it", scene, EMPTY, broom),
        ],
    )


def run(adapter: FrankaAdapter, call: SkillCall) -> EndReason:
    return adapter.execute(call, should_stop=never, on_step=nothing).end


PICK = SkillCall("pick", (OUT[0], OUT[1], OUT[2]))


def test_what_the_hand_hides_is_in_it_until_it_lets_go_and_lost_if_it_isnt_seen_then(lab: Lab) -> None:
    lab.shoot("collecting_toy", drawer(toy=OUT), times=2)  # the look, and the one before the motion
    hidden = 5 * 3  # each of five looks tries three pictures: at the pick, the place, and what is observed after each
    lab.shoot("collecting_toy", drawer(), times=hidden)
    adapter = lab.open("collecting_toy")
    adapter.reset()
    assert run(adapter, PICK) is EndReason.ARRIVED
    held = adapter.observe()
    assert flags("collecting_toy", held) == {"toy_grasped": 1.0, "toy_in_drawer": 0.0}
    assert np.allclose(held.state[:3], lab.arm.position, atol=0.003)
    over = (float(TRAY[0]), 0.0, TABLE + 0.10)
    assert run(adapter, SkillCall("place", over)) is EndReason.ARRIVED
    with pytest.raises(Unavailable, match="toy: let go of, and not seen since"):
        adapter.observe()


def test_fingers_that_took_nothing_hold_nothing(lab: Lab) -> None:
    lab.shoot("collecting_toy", drawer(toy=OUT), times=4)
    lab.arm.found = EMPTY
    adapter = lab.open("collecting_toy")
    adapter.reset()
    assert run(adapter, PICK) is EndReason.NOTHING_GRASPED
    after = adapter.observe()
    assert flags("collecting_toy", after) == {"toy_grasped": 0.0, "toy_in_drawer": 0.0}
    assert np.allclose(after.state[:3], OUT, atol=0.002)


def test_what_was_moved_or_hidden_since_it_was_judged_isnt_reached_for(lab: Lab) -> None:
    lab.shoot("collecting_toy", drawer(toy=OUT))
    lab.shoot("collecting_toy", drawer(toy=off(OUT, y=0.03)), times=2)
    adapter = lab.open("collecting_toy")
    first = adapter.reset()
    with pytest.raises(Unavailable, match="toy was moved by 30 mm since the picture was taken"):
        run(adapter, PICK)
    assert not lab.arm.orders
    second = adapter.observe()
    assert second.id != first.id
    assert np.allclose(second.state[:3] - first.state[:3], [0.0, 0.03, 0.0], atol=0.002)
