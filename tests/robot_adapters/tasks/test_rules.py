"""What the three long tasks call solved, what comes next, and what only a hand can put right."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robot_adapters import registry
from robot_adapters.base import EndReason, Scene, SkillCall
from robot_adapters.tasks import cooking_hotdog as cooking
from robot_adapters.tasks import sweeping, table
from robot_adapters.tasks.collecting_toy import TRAY_CLOSED, CollectingToy
from robot_adapters.tasks.cooking_hotdog import COOKED, CookingHotdog
from robot_adapters.tasks.episode import Episode
from robot_adapters.tasks.sweeping import Sweeping

GRIPPER = np.array([0.5, 0.0, 0.1])
H = table.HEIGHT
BROOM, TOY = (0.45, 0.16, H + 0.08), (0.55, 0.0, H + 0.02)
PAN_X, PAN_Y = sweeping.PAN_AT[:2]
Place = tuple[float, float, float]


def scene(
    *,
    held: str | None = None,
    joints: dict[str, float] | None = None,
    tilts: dict[str, float] | None = None,
    latched: frozenset[str] = frozenset(),
    **objects: Place,
) -> Scene:
    places = {name: np.array(at) for name, at in objects.items()}
    return Scene(places, GRIPPER, held is not None, held, joints or {}, tilts or {}, latched)


@pytest.mark.parametrize(
    ("toy", "swept"),
    [
        ((PAN_X, PAN_Y, H + 0.022), True),
        ((PAN_X - 0.049, PAN_Y, H + 0.022), True),
        ((PAN_X - 0.051, PAN_Y, H + 0.022), False),
        ((PAN_X, PAN_Y + 0.091, H + 0.022), False),
        ((PAN_X, PAN_Y, H + 0.031), False),
    ],
)
def test_swept_is_inside_the_pan_and_low(toy: Place, swept: bool) -> None:
    assert Sweeping().success(scene(broom=BROOM, toy=toy)) is swept


@pytest.mark.parametrize(
    ("case", "detail"),
    [
        (scene(broom=BROOM, toy=TOY), None),
        (scene(broom=BROOM, toy=TOY, tilts={"broom": math.radians(50)}), "the broom fell over"),
        (scene(broom=BROOM, toy=TOY, tilts={"broom": math.radians(40)}), None),
        (scene(broom=BROOM, toy=TOY, tilts={"broom": 2.0}, held="broom"), None),
        (scene(broom=BROOM, toy=(0.55, 0.12, H + 0.02)), "the toy is out of reach"),
        (scene(broom=BROOM, toy=(0.55, 0.12, -0.8)), "the toy fell off the table"),
        (scene(broom=BROOM, toy=(PAN_X, PAN_Y, H + 0.022)), None),
    ],
)
def test_sweeping_says_what_needs_a_hand(case: Scene, detail: str | None) -> None:
    found = Sweeping().violations(case)
    assert [(v.kind, v.detail) for v in found] == ([("manual_reset", detail)] if detail else [])


def test_collecting_flags_and_success_follow_the_drawer() -> None:
    task = CollectingToy()
    inside = (TRAY_CLOSED[0] - 0.15, 0.0, H + 0.026)
    closed = (TRAY_CLOSED[0] - 0.01, 0.0, H + 0.026)
    assert task.state(scene(toy=inside, joints={"drawer": 0.15})).tolist()[3:] == [0.15, 0, 1]
    assert task.state(scene(toy=inside, joints={"drawer": 0.15}, held="toy")).tolist()[3:] == [0.15, 1, 0]
    assert task.state(scene(toy=inside, joints={"drawer": 0.0})).tolist()[3:] == [0, 0, 0]
    assert not task.success(scene(toy=inside, joints={"drawer": 0.15}))
    assert task.success(scene(toy=closed, joints={"drawer": 0.019}))
    assert not task.success(scene(toy=closed, joints={"drawer": 0.021}))


def test_a_drawer_closed_on_nothing_needs_a_hand() -> None:
    (found,) = CollectingToy().violations(scene(toy=(0.42, 0.0, H + 0.02), joints={"drawer": 0.01}))
    assert (found.kind, found.detail) == ("manual_reset", "the drawer is closed and the toy outside")


STOVE = cooking.ON_THE_STOVE
IN_PAN = (STOVE[0], STOVE[1], STOVE[2] + cooking.FLOOR_Z + 0.012)
IN_BUN = (cooking.BUN_AT[0], cooking.BUN_AT[1], H + 0.022)
RAW, AWAY = (0.4, -0.1, H + 0.012), (0.66, -0.1, H + 0.015)


def beside(at: Place, dx: float = 0.0, dy: float = 0.0) -> Place:
    return (at[0] + dx, at[1] + dy, at[2])


@pytest.mark.parametrize(
    ("case", "flags", "stage"),
    [
        (scene(sausage=RAW, skillet=AWAY), (0, 0, 0, 0, 0), 0),
        (scene(sausage=RAW, skillet=AWAY, held="skillet"), (1, 0, 0, 0, 0), 1),
        (scene(sausage=RAW, skillet=STOVE), (0, 1, 0, 0, 0), 2),
        (scene(sausage=RAW, skillet=beside(STOVE, 0.046)), (0, 0, 0, 0, 0), 0),
        (scene(sausage=RAW, skillet=STOVE, tilts={"skillet": 1.0}), (0, 0, 0, 0, 0), 0),
        (scene(sausage=RAW, skillet=STOVE, held="sausage"), (0, 1, 1, 0, 0), 3),
        (scene(sausage=RAW, skillet=AWAY, held="sausage"), (0, 0, 1, 0, 0), 0),
        (scene(sausage=IN_PAN, skillet=STOVE), (0, 1, 0, 1, 0), 4),
        (scene(sausage=IN_PAN, skillet=STOVE, held="sausage"), (0, 1, 1, 0, 0), 3),
        (scene(sausage=beside(IN_PAN, 0.061), skillet=STOVE), (0, 1, 0, 0, 0), 2),
        (scene(sausage=RAW, skillet=STOVE, held="sausage", latched=frozenset({COOKED})), (0, 1, 1, 1, 0), 5),
        (scene(sausage=IN_BUN, skillet=STOVE, latched=frozenset({COOKED})), (0, 1, 0, 1, 1), 4),
        (scene(sausage=IN_BUN, skillet=STOVE), (0, 1, 0, 0, 1), 2),
    ],
)
def test_cooking_flags_and_what_comes_next(case: Scene, flags: tuple[int, ...], stage: int) -> None:
    task = CookingHotdog()
    state = task.state(case)
    assert tuple(state[6:].tolist()) == flags
    assert task.subgoal(state) == stage


@pytest.mark.parametrize(
    ("at", "latched", "solved"),
    [
        (IN_BUN, frozenset({COOKED}), True),
        (IN_BUN, frozenset(), False),
        (beside(IN_BUN, 0.034, 0.014), frozenset({COOKED}), True),
        (beside(IN_BUN, 0.036), frozenset({COOKED}), False),
        (beside(IN_BUN, 0.0, 0.016), frozenset({COOKED}), False),
    ],
)
def test_only_a_cooked_sausage_in_the_bun_solves(at: Place, latched: frozenset[str], solved: bool) -> None:
    assert CookingHotdog().success(scene(sausage=at, skillet=STOVE, latched=latched)) is solved


def test_an_episode_remembers_that_the_sausage_was_cooked_until_the_next() -> None:
    now = [scene(sausage=IN_PAN, skillet=STOVE)]
    episode = Episode(registry.task("cooking_hotdog"), lambda: now[0])
    assert episode.scene().latched == {COOKED}
    now[0] = scene(sausage=RAW, skillet=STOVE)
    assert episode.scene().latched == {COOKED}
    episode.reset()
    assert not episode.scene().latched


def test_two_good_picks_in_vain_need_a_hand() -> None:
    task = registry.task("sweeping")
    start, lifted = scene(broom=BROOM, toy=TOY), scene(broom=BROOM, toy=TOY, held="broom")
    state = task.state(start)
    good, bad = task.true_call(state), SkillCall("pick", (0.5, 0.0, H + 0.08))
    episode = Episode(task, lambda: start)

    def vain(call: SkillCall, end: EndReason = EndReason.NOTHING_GRASPED) -> list[str]:
        return [v.detail for v in episode.executed(state, call, end, start)]

    assert vain(good) == []
    assert vain(bad) == []
    assert vain(good, EndReason.STOPPED) == []
    assert vain(good) == ["2 good picks took nothing"]
    episode.reset()
    assert vain(good) == []
    assert episode.executed(state, good, EndReason.ARRIVED, lifted) == ()
    assert vain(good) == []
